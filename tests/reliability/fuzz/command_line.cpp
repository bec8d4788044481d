// Command lines, a word in each line of the input, up to where a device is needed: none is found. Words
// have no slash, so that nothing is written outside a folder of the test's own; files of all kinds that are
// read lie there.
#include <unistd.h>

#include <exception>
#include <set>
#include <sstream>
#include <vector>

#include "app/commands/commands.hpp"
#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

/// The folder that the process works in, with its files.
class WorkFolder {
 public:
  WorkFolder() {
    folder_.file("p.csv", "x,y,v\n1,2,3\n4,5,\n");
    folder_.file("t.xyz", "1\nLattice=\"9 0 0 0 9 0 0 0 1\" pbc=\"T T F\"\nA 1 2 0\n");
    folder_.file("m.ppm", "P2\n2 2\n255\n0 1 1 0\n");
    if (chdir((folder_ / "").c_str()) != 0 || setenv("OCL_ICD_VENDORS", (folder_ / "none").c_str(), 1) != 0) {
      std::abort();
    }
    given_ = folder_.names();
  }

  /// Removes what a run has left, such as the journal of one that could be resumed.
  void clean() const {
    for (const std::string& name : folder_.names()) {
      if (given_.count(name) == 0) std::filesystem::remove_all(folder_ / name);
    }
  }

 private:
  TemporaryFolder folder_;
  std::set<std::string> given_;
};

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const WorkFolder folder;
  std::vector<std::string> words = {"vorocl"};
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string word; std::getline(text, word);) {
    for (char& c : word) c = c == '/' || c == '\0' ? '_' : c;
    words.push_back(word);
  }
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  read_or_refuse([&] { run_command(static_cast<int>(words.size()), arguments.data()); });
  folder.clean();
  return 0;
}
