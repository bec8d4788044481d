// The command while calls of OpenCL, of the file system and of memory fail: it ends with an error and leaves
// whole files alone, or it makes the right ones. Of each kind of call of files and memory that a subcommand
// makes, one fails, and of each kind of call of OpenCL one in a sixth of the subcommands; with
// VOROCL_LONG_TESTS, 100 of each in all. (test_faults makes all calls of the library fail.)
#define BOOST_TEST_MODULE faults_in_commands
#include <boost/test/data/test_case.hpp>
#include <random>
#include <set>

#include "left_files.hpp"

using namespace vorocl;
namespace data = boost::unit_test::data;

namespace {

const std::string subcommands[] = {
    "render --random 9 --size 40x30 --method djfa -o a.png --labels a.npy",
    "render --random 9 --size 40x30 --method standard-flooding --waves w/%d.bmp --labels a.tif",
    "render --random 9 --size 12x10x8 --slice z=3 -o a.png --labels a.npy",
    ("simulate --random 9 --size 40x30 --frames 4 --step-length 1 --method djfa -o f.mp4 --labels l/%05d.vti "
     "--cells c%d.csv --compare-with exact --similarity s.csv"),
    ("simulate --trajectory '" VOROCL_SAMPLES
     "/lj-melt.lammpstrj' --width 40 --frames 2 --method exact -o p/%d.jpg "
     "--distance d%d.npy --adjacency a%d.csv"),
    ("cells --random 9 --size 40x30 --cells c.csv --adjacency a.csv --distance d.tif --border b.png --labels "
     "l.npy"),
    "relax --random 9 --size 40x30 --rounds 4 -o r.mp4 --relaxed-points p.csv --energy e.csv --labels l.npy",
    "tiles --random 9 --size 40x30 --tile 16 --labels l.tif -o p.png --cells c.csv --adjacency a.csv",
    "bench --random 9 --size 40x30 --methods jfa,exact --repeat 1",
    "bench --random 9 --size 12x10x8 --methods jfa,exact --repeat 1",
    "devices"};

struct Fault {
  std::string subcommand;
  std::string request;  // as faults.cpp reads it
};

/// Programs are built from their sources, also where the user has prepared them.
std::string preloaded(const std::string& settings) {
  return "VOROCL_BINARY_CACHE=0 LD_PRELOAD='" VOROCL_FAULTS "' " + settings;
}

/// Whether a call of OpenCL fails in this subcommand: in the first that makes it, and in every sixth one.
bool is_turn_of(const std::string& subcommand, const std::string& kind) {
  static std::set<std::string> known;
  const bool is_new = known.insert(kind).second;
  const auto number = static_cast<std::size_t>(
      std::find(std::begin(subcommands), std::end(subcommands), subcommand) - std::begin(subcommands));
  return is_new || (number + kind.size()) % 6 == 0;
}

/// Some calls of the kinds that a run of the subcommand makes, to fail once or from then on.
std::vector<Fault> faults_of(const std::string& subcommand, std::mt19937& random) {
  const bool is_long = std::getenv("VOROCL_LONG_TESTS") != nullptr;
  const std::size_t of_each_kind = is_long ? 100 : 1;
  const TemporaryFolder folder;
  const Result result = run(folder, subcommand, preloaded("VOROCL_FAULT_COUNTS=counts"));
  BOOST_TEST(result.exit_code == 0, subcommand << "\n" << result.error);
  std::vector<Fault> faults;
  std::ifstream counts(folder / "counts");
  std::string kind;
  std::size_t kinds = 0;
  for (int calls = 0; counts >> kind >> calls; ++kinds) {
    if (!is_long && kind.rfind("cl", 0) == 0 && !is_turn_of(subcommand, kind)) continue;
    std::vector<std::string> of_kind;
    for (int number = 1; number <= calls; ++number) {
      for (const char* mode : {"", " on"}) of_kind.push_back(kind + " " + std::to_string(number) + mode);
    }
    std::shuffle(of_kind.begin(), of_kind.end(), random);
    of_kind.resize(std::min(of_kind.size(), of_each_kind));
    for (const std::string& request : of_kind) faults.push_back({subcommand, request});
  }
  BOOST_TEST(kinds >= 4u);
  return faults;
}

/// Tables of times differ from run to run.
bool has_times(const std::string& file) { return file == "times.csv"; }

void check_with(const Fault& fault, const TemporaryFolder& whole) {
  const TemporaryFolder folder;
  const Result result = run(folder, fault.subcommand, preloaded("VOROCL_FAULT='" + fault.request + "'"));
  BOOST_TEST_CONTEXT("VOROCL_FAULT='" << fault.request << "' vorocl " << fault.subcommand << "\n"
                                      << result.error) {
    if (result.exit_code == 0) {
      BOOST_TEST((files_of(folder) == files_of(whole)));
      for (const std::string& file : files_of(folder)) {
        BOOST_TEST((has_times(file) || content_of(folder / file) == content_of(whole / file)), file);
      }
    } else {
      BOOST_TEST(result.exit_code == failure);
      BOOST_TEST(result.error.rfind("vorocl: error: ", 0) == 0u);
      BOOST_TEST(result.error.back() == '\n');
      BOOST_TEST(result.error.find(".vorocl-") == std::string::npos);
      if (fault.subcommand.find("times.csv") == std::string::npos) check_left(folder, whole, false);
    }
  }
}

}  // namespace

BOOST_DATA_TEST_CASE(a_call_that_fails_is_an_error_and_leaves_whole_files, data::make(subcommands),
                     subcommand) {
  std::mt19937 random(1);
  const TemporaryFolder whole;
  run(whole, subcommand);
  const std::vector<Fault> faults = faults_of(subcommand, random);
  for (const Fault& fault : faults) check_with(fault, whole);
  BOOST_TEST_MESSAGE(faults.size() << " calls failed");
}

// With positions that are freed too early the device writes anywhere.
BOOST_AUTO_TEST_CASE(what_the_device_still_reads_is_kept_where_waiting_for_it_fails) {
  const std::string& ablation = subcommands[10];
  const TemporaryFolder whole;
  run(whole, ablation);
  for (int number = 30; number < 40; number += 3)
    check_with({ablation, "clWaitForEvents " + std::to_string(number) + " on"}, whole);
}

BOOST_AUTO_TEST_CASE(a_signal_while_kernels_are_compiled_is_an_interruption) {
  for (const std::string subcommand :
       {"tiles --random 9 --size 40x30 --tile 16 --labels l.npy",
        "simulate --random 9 --size 40x30 --frames 4 --step-length 1 --method exact --labels l%d.npy",
        "relax --random 9 --size 40x30 --rounds 4 -o r.bmp"}) {
    const TemporaryFolder folder, whole;
    succeeds(whole, subcommand);
    const Result result = run(folder, subcommand, preloaded("VOROCL_FAULT='compiler 1'"));
    BOOST_TEST_CONTEXT(subcommand << "\n" << result.error) {
      BOOST_TEST(result.exit_code == failure);
      BOOST_TEST(result.error.find("vorocl: error: interrupted") != std::string::npos);
      check_left(folder, whole, false);
    }
  }
}
