// What is said of output files before there is anything to write.
#define BOOST_TEST_MODULE output_files
#include "app/outputs/output_files.hpp"
#include "app/terminal/console.hpp"
#include "fixture.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

void check(const std::vector<RequestedFile>& files) { check_outputs(files, {}); }

}  // namespace

BOOST_AUTO_TEST_CASE(two_outputs_cannot_be_one_file) {
  const TemporaryFolder folder;
  const std::string a = folder / "a%d.npy";
  const auto npy = [](const char* option, const std::string& path) {
    return RequestedFile{option, path, {".npy"}, true};
  };
  check({npy("--labels", a), npy("--distance", folder / "b%d.npy"), npy("-o", ""), npy("--cells", "")});
  for (const char* other : {"a%d.npy", "./a%d.npy", "a%05d.npy"}) {
    check_error(
        [&] {
          check({npy("--labels", a), npy("--distance", folder / other)});
        },
        {other, "--labels and --distance"});
  }
  const RequestedFile one = {"--labels", folder / "a7.npy", {".npy"}};
  BOOST_CHECK_THROW(check({npy("--distance", a), one}), UsageError);
}

BOOST_AUTO_TEST_CASE(names_that_are_not_possible_are_usage_errors) {
  const auto refuses = [](const char* path, bool numbered) {
    BOOST_CHECK_THROW(check({{"-o", path, {".png", ".jpg"}, numbered}}), UsageError);
  };
  check({{"-o", "a.png", {".png"}}, {"-o", "A.PNG", {".png"}}, {"-o", "%03d.png", {".png"}, true}});
  refuses("a", false);
  refuses("a.npy", false);
  for (const char* pattern :
       {"a.png", "%5d.png", "%0d.png", "%00d.png", "%10d.png", "%d%d.png", "%d/a.png", "%.png"}) {
    refuses(pattern, true);
  }
}
