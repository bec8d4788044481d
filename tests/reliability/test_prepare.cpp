// vorocl prepare: what it refuses before it works, and with VOROCL_LONG_TESTS, because it compiles for
// minutes, that later runs build no program from its source.
#define BOOST_TEST_MODULE prepare
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

std::string with_cache_in(const TemporaryFolder& folder) {
  return "XDG_CACHE_HOME='" + folder / "cache" + "'";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_device_that_is_not_there_is_refused_once) {
  const TemporaryFolder folder;
  const Result result = run(folder, "prepare --device nonesuch", with_cache_in(folder));
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(result.error.rfind("vorocl: error: no usable OpenCL device matches \"nonesuch\"", 0) == 0u,
             result.error);
  BOOST_TEST(std::count(result.error.begin(), result.error.end(), '\n') == 1);
}

BOOST_AUTO_TEST_CASE(a_folder_that_others_can_read_is_refused_before_the_work) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "cache/vorocl/binaries");
  chmod((folder / "cache/vorocl/binaries").c_str(), 0755);
  if (test_device().platform_name() != "Portable Computing Language") return;  // which keeps them itself
  const Result result = run(folder, "prepare", with_cache_in(folder));
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(result.error.find("cannot keep binaries of programs in " + folder / "cache/vorocl/binaries") !=
                 std::string::npos,
             result.error);
  BOOST_TEST(std::filesystem::is_empty(folder / "cache/vorocl/binaries"));
}

BOOST_AUTO_TEST_CASE(after_it_nothing_is_built_from_its_source) {
  if (std::getenv("VOROCL_LONG_TESTS") == nullptr) return;
  const TemporaryFolder folder;
  const Result result = run(folder, "prepare --json", with_cache_in(folder));
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.error);
  const json prepared = json::parse(result.out);
  BOOST_TEST(prepared["binaries"] > 50);
  BOOST_TEST(prepared["folder"] == folder / "cache/vorocl/binaries");
  std::string points = "x,y,z,w\n", frame = "id x y z\n";
  for (int id = 0; id < 300; ++id) {
    const std::string place[] = {std::to_string(id * 7 % 20), std::to_string(id * 11 % 19),
                                 std::to_string(id * 13 % 17)};
    points += place[0] + ',' + place[1] + ',' + place[2] + ',' + std::to_string(id % 5) + '\n';
    frame += std::to_string(id) + ' ' + place[0] + ' ' + place[1] + ' ' + place[2] + '\n';
  }
  folder.file("points.csv", points);
  const std::string before = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n300\nITEM: BOX BOUNDS ";
  folder.file("box.lammpstrj", before + "pp pp pp\n0 20\n0 20\n0 20\nITEM: ATOMS " + frame);
  folder.file("tilted.lammpstrj", before + "xy xz yz pp pp pp\n0 29 6\n0 22 3\n0 20 2\nITEM: ATOMS " + frame);
  for (const std::string line :
       {"render --random 900 --size 700x500 -o p.png --color area --edges",
        "render --random 900 --size 700x500 --periodic xy --metric manhattan --labels l.npy --method djfa",
        "cells --random 900 --size 700x500 --periodic x --cells c.csv --adjacency a.csv --distance d.npy",
        "simulate --random 900 --size 700x500 --frames 3 --step-length 2 --method djfa --compare-with exact "
        "--similarity s.csv --statistics t.csv",
        "relax --random 900 --size 700x500 --rounds 2 --relaxed-points r.csv",
        "tiles --random 900 --size 700x500 --tile 256 --labels t.npy",
        "cells --points points.csv --weights w --size 40x40x40 --bounds 0,0,0,20,20,20 --cells c.csv",
        "cells --trajectory box.lammpstrj --size 40x40x40 --cells c.csv --adjacency a.csv",
        "cells --trajectory tilted.lammpstrj --size 40x40x40 --cells c.csv --adjacency a.csv",
        "cells --trajectory tilted.lammpstrj --exact --cells c.csv --adjacency a.csv"}) {
    const Result later = run(folder, line,
                             with_cache_in(folder) + " LD_PRELOAD='" VOROCL_FAULTS
                                                     "' VOROCL_FAULT='clCreateProgramWithSource 1 on'");
    BOOST_TEST(later.exit_code == 0, line << '\n' << later.error);
  }
}
