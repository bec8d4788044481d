// What the vorocl command refuses: each with its exit code, one line that says why, and no file left.
#define BOOST_TEST_MODULE refusals
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "run_command.hpp"

using namespace vorocl;

namespace {

const std::string square = " --size 10x10 --method jfa -o a.png";

const std::string pocl = "Portable Computing Language";

boost::test_tools::assertion_result pocl_is_there(boost::unit_test::test_unit_id) {
  const std::vector<DeviceDescription> devices = Device::list();
  return std::any_of(devices.begin(), devices.end(),
                     [](const auto& device) { return device.platform == pocl; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(files_that_cannot_be_read_are_refused) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.csv");
  folder.file("empty.csv", "");
  folder.file("header.csv", "x,y\n");
  folder.file("line.csv", "x,y\n1,2\n3,four\n");
  folder.file("text.npy", "1,2\n");
  folder.file("points.txt", "1,2\n");
  cv::imwrite(folder / "black.png", cv::Mat(3, 3, CV_8U, cv::Scalar(0)));
  cv::imwrite(folder / "white.png", cv::Mat(3, 3, CV_8U, cv::Scalar(255)));
  folder.file("cut.png", content_of(folder / "black.png").substr(0, 50));
  refuses(folder, "render --points missing.csv" + square, failure, {"missing.csv", "No such file"});
  refuses(folder, "render --points missing.npy" + square, failure, {"missing.npy", "No such file"});
  refuses(folder, "render --mask missing.png" + square, failure, {"missing.png", "No such file"});
  refuses(folder, "render --points folder.csv" + square, failure, {"folder.csv", "folder"});
  refuses(folder, "render --points empty.csv" + square, failure, {"empty.csv", "no points"});
  refuses(folder, "render --points header.csv" + square, failure, {"header.csv", "no points"});
  refuses(folder, "render --points line.csv" + square, failure, {"line.csv:3", "\"four\"", "3,four"});
  refuses(folder, "render --points text.npy" + square, failure, {"text.npy", "no .npy array"});
  refuses(folder, "render --points text.npy --columns x,y" + square, usage, {"--columns", ".csv"});
  refuses(folder, "render --points points.txt" + square, usage, {"points.txt", ".csv, .npy"});
  refuses(folder, "render --mask black.png --method jfa -o a.png", failure, {"black.png", "no seed"});
  refuses(folder, "render --mask cut.png --method jfa -o a.png", failure, {"cut.png", "no image"});
  refuses(folder, "render --mask white.png --size 4x4 --method jfa -o a.png", failure,
          {"white.png", "3 x 3", "4 x 4"});
}

BOOST_AUTO_TEST_CASE(empty_arguments_are_refused) {
  const TemporaryFolder folder;
  // The first one was parsed without end.
  for (const char* arguments :
       {"relax 4 '' --mask m.ppm --l--sigy", "render --random 5 --size 9x9 -o ''", "''"}) {
    refuses(folder, arguments, usage, {"an argument is empty"}, "timeout 20");
  }
}

BOOST_AUTO_TEST_CASE(bad_points_are_refused) {
  const TemporaryFolder folder;
  folder.file("nan.csv", "x,y\n1,2\ninf,3\n");
  folder.file("inf.csv", "x,y\n1,2\n1,2\n3,-inf\n");
  folder.file("far.csv", "1,2\n3,4\n");
  refuses(folder, "render --points nan.csv" + square, failure, {"nan.csv:3", "\"inf\" is not finite"});
  refuses(folder, "render --points inf.csv --bounds 0,0,9,9" + square, failure,
          {"inf.csv:4", "\"-inf\" is not finite"});
  refuses(folder, "render --points far.csv --bounds 0,0,3,3 --outside refuse" + square, failure,
          {"far.csv", "point 1", "(3, 4)", "0,0,3,3"});
  folder.file("farther.csv", "1,2\n1e12,4\n");
  refuses(folder, "render --points farther.csv --bounds 0,0,3,3" + square, failure,
          {"farther.csv", "point 1", "2^31 pixels"});
}

BOOST_AUTO_TEST_CASE(units_need_an_extent) {
  const TemporaryFolder folder;
  folder.file("row.csv", "x,y\n0,5\n4,5\n9,5\n");
  const std::string row = " --points row.csv --size 20x15 ";
  for (const char* line : {"cells --cells c.csv", "render --labels l.npy", "tiles --cells c.csv",
                           "relax --rounds 2 --relaxed-points r.csv"}) {
    refuses(folder, line + row + "--units data", failure, {"no extent in y", "--units data"});
  }
  refuses(folder, "render --labels l.tif --crs EPSG:32632" + row, failure, {"no extent in y", "--crs"});
  const Result noted = run(folder, "cells --cells c.csv" + row);
  BOOST_TEST(noted.exit_code == 0);
  BOOST_TEST(noted.error.find("no extent in y, so all measures stay in pixels") != std::string::npos);
  folder.file("flat.csv", "x,y,z\n0,5,3\n4,1,3\n9,2,3\n");
  const std::string flat = " --points flat.csv --size 9x5x4 ";
  refuses(folder, "cells --cells c.csv --units data" + flat, failure,
          {"flat.csv", "no extent in z", "--units data"});
  const Result of_voxels = run(folder, "cells --cells c.csv" + flat);
  BOOST_TEST(of_voxels.error.find("no extent in z, so all measures stay in voxels") != std::string::npos);
  folder.file("fall.xyz", "3\n\nA 0 0 0\nA 3 1 0\nA 1 2 0\n3\n\nA 0 4 0\nA 3 4 0\nA 1 4 0\n");
  const std::string fall =
      "simulate --trajectory fall.xyz --size 9x6 --fit frame --frames 1: --cells f%d.csv";
  refuses(folder, fall + " --units data", failure, {"fall.xyz", "no extent in y", "--units data"});
  BOOST_TEST(run(folder, fall).error.find("no extent in y") != std::string::npos);
  succeeds(folder, "cells --cells c.csv --units px" + row);
  succeeds(folder, "cells --cells c.csv --units data --bounds 0,0,20,15" + row);
}

BOOST_AUTO_TEST_CASE(bad_options_are_usage_errors) {
  const TemporaryFolder folder;
  folder.file("p.csv", "1,2\n3,4\n");
  const std::string render = "render --random 5 --method jfa -o a.png ",
                    points = "render --points p.csv --method jfa -o a.png ";
  refuses(folder, "", usage, {"no subcommand", "--help"});
  refuses(folder, "rendre", usage, {"rendre"});
  refuses(folder, render + "--size 10x10 --sise", usage, {"--sise"});
  for (const std::string subcommand :
       {"render", "simulate", "cells", "relax", "bench", "compare", "devices"}) {
    refuses(folder, subcommand + " --sise 3", usage, {"--sise"});
  }
  refuses(folder, render + "--sise p.csv --size 10x10", usage, {"--sise is unknown"});
  refuses(folder, "render --random 0" + square, usage, {"--random", "0"});
  refuses(folder, "render --random -3" + square, usage, {"--random", "-3"});
  refuses(folder, "render --random few" + square, usage, {"--random", "few"});
  for (const char* size :
       {"0x10", "10x0", "32769x10", "10", "10x", "10x10x10x10", "axb", "99999999999999999999x1"}) {
    refuses(folder, render + "--size " + size, usage, {"--size"});
  }
  refuses(folder, render, usage, {"--size"});
  refuses(folder, points, usage, {"--size", "--width"});
  refuses(folder, points + "--size 10x10 --width 10", usage, {"--width", "--size"});
  refuses(folder, points + "--width 32769", usage, {"--width", "32768"});
  refuses(folder, points + "--size 10x10 --bounds 0,0,1", usage, {"--bounds", "X0,Y0,X1,Y1"});
  refuses(folder, points + "--size 10x10 --columns x", usage, {"--columns"});
  refuses(folder, points + "--size 10x10 --periodic z", usage, {"--periodic with z is for volumes"});
  refuses(folder, points + "--size 10x10 --periodic w", usage, {"--periodic", "xy"});
  refuses(folder, points + "--size 10x10 --bounds 1,0,1,9", usage, {"--bounds", "X0 < X1"});
  refuses(folder, points + "--size 10x10 --domain 0,0,9,9", usage, {"--domain", "--periodic"});
  refuses(folder, points + "--size 10x10 --periodic y --domain 0,0,9,0.4 --bounds 0,0,9,9", failure,
          {"p.csv", "period in y is 0.4", "less than a pixel"});
  for (const char* command : {"bench --methods exact,opencv", "relax --rounds 2 --labels l.npy",
                              "simulate --frames 1 --step-length 1 --labels l%d.npy"}) {
    refuses(
        folder,
        command + std::string(" --points p.csv --size 5x9 --periodic x --domain 0,0,9,9 --bounds 0,0,5,9"),
        failure, {"part of a period", "whole period"});
  }
  refuses(folder, render + "--size 10x10 --domain 0,0,9,9", usage, {"--domain", "--points"});
  refuses(folder, render + "--size 10x10 --outside refuse", usage, {"--outside", "--points"});
  refuses(folder, points + "--size 8x8 --periodic xy --domain 0,0,8,8 --bounds 4,4,6,6 --outside refuse",
          failure, {"p.csv", "point 0", "outside the bounds 4,4,6,6"});
  refuses(folder, points + "--size 10x10 --outside ignore", usage, {"--outside", "count, refuse"});
  refuses(folder, render + "--size 32001x10 --periodic x", failure,
          {"whole of its grid", "at most 32,000 pixels", "only diagrams of the method exact"});
  refuses(folder, "bench --random 5 --size 10x10 --periodic x --methods opencv", failure,
          {"opencv", "periodic"});
  refuses(folder, render + "--size 10x10 --bounds 0,0,1,1", usage, {"--bounds", "--points"});
  refuses(folder, "render --method jfa --size 10x10 -o a.png", usage, {"--random", "--points", "--mask"});
  refuses(folder, points + "--random 5 --size 10x10", usage, {"--random", "--points"});
  refuses(folder, "render --random 5 --size 10x10 --method jfb -o a.png", usage,
          {"jfb", "standard-flooding", "1+jfa"});
  refuses(folder, render + "--size 10x10 --metric chess", usage, {"chess", "manhattan"});
  refuses(folder, render + "--size 10x10 --neighbourhood hex", usage, {"hex", "von-neumann"});
  refuses(folder, "render --random 5 --size 10x10 --neighbourhood moore -o a.png", usage,
          {"--neighbourhood", "exact has no waves"});
  refuses(folder, "render --points p.csv --size 9x9x9 --metric great-circle -o a.png", usage,
          {"great-circle", "without a depth"});
  refuses(folder, "simulate --trajectory t.xyz --size 9x9 --radius r --compare-with exact --cells c.csv",
          usage, {"--compare-with", "--radius"});
  refuses(folder, "bench --random 5 --size 10x10 --methods jfa,jfb", usage, {"jfb", "opencv"});
  refuses(folder, "bench --random 5 --size 10x10 --methods jfa --repeat 0", usage, {"--repeat"});
}

BOOST_AUTO_TEST_CASE(a_file_without_its_option_is_answered_with_it) {
  const TemporaryFolder folder;
  for (const std::string subcommand : {"render", "simulate", "cells", "relax --rounds 1", "bench"}) {
    refuses(folder, subcommand + " cities.csv", usage, {"write --points cities.csv"});
  }
  refuses(folder, "render a/b.NPY -o a.png", usage, {"write --points a/b.NPY"});
  refuses(folder, "render melt.lammpstrj" + square, usage, {"write --trajectory melt.lammpstrj"});
  refuses(folder, "render coins.png" + square, usage, {"write --mask coins.png"});
  refuses(folder, "render --random 3 nonsense" + square, usage, {"\"nonsense\"", "neither an option"});
  refuses(folder, "render --random 3 --y-up" + square, usage, {"--y-up", "--points or --trajectory"});
  refuses(folder, "render --random 3 --y-down" + square, usage, {"--y-down", "--points or --trajectory"});
  refuses(folder, "render --points a.csv --y-up --y-down" + square, usage, {"--y-up", "--y-down"});
}

BOOST_AUTO_TEST_CASE(outputs_are_checked_before_the_work) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.png");
  // A device that does not exist would be the next error: it is not reached.
  const std::string render = "render --random 5 --size 10x10 --method jfa --device none ";
  refuses(folder, render + "-o missing/a.png", failure, {"missing/a.png", "does not exist"});
  refuses(folder, render + "-o a.png --labels missing/a.npy", failure, {"missing/a.npy", "does not exist"});
  refuses(folder, render + "-o /proc/a.png", failure, {"/proc/a.png", "cannot write"});
  refuses(folder, render + "-o folder.png", failure, {"folder.png", "folder"});
  refuses(folder, render + "-o a.xyz", usage, {"a.xyz", ".png"});
  refuses(folder, render + "-o a", usage, {".png"});
  refuses(folder, render + "--labels a.png", usage, {"a.png", ".npy, .tif"});
  refuses(folder, render, usage, {"-o", "--labels"});
  refuses(folder, render + "--labels a.npy --edges", usage, {"--edges", "-o"});
}

BOOST_AUTO_TEST_CASE(devices_that_cannot_do_it_are_named) {
  const TemporaryFolder folder, no_drivers;
  const std::string no_platform = "OCL_ICD_VENDORS='" + no_drivers / "" + "'";
  for (const char* subcommand : {"devices", "render --random 5 --size 9x9 --method jfa -o a.png"}) {
    refuses(folder, subcommand, failure, {"no OpenCL platform", "pocl-opencl-icd"}, no_platform);
  }
}

BOOST_AUTO_TEST_CASE(too_little_device_memory_is_said_in_figures,
                     *boost::unit_test::precondition(pocl_is_there)) {
  // PoCL takes this limit, in GiB, for the memory of its device. Without a cache of kernels it is still
  // building one when the command ends, which must not end in PoCL's crash.
  const TemporaryFolder folder, cache;
  const std::string small =
      "VOROCL_DEVICE='" + pocl + "' POCL_MEMORY_LIMIT=1 POCL_CACHE_DIR='" + cache / "" + "'";
  refuses(folder, "render --random 5 --size 30000x30000 --method jfa -o a.png", failure,
          {"too little device memory", "3433.2 MiB", "1024.0 MiB"}, small);
}

BOOST_AUTO_TEST_CASE(outputs_do_not_replace_what_the_seeds_are_read_from) {
  const TemporaryFolder folder;
  const std::string points = "x,y\n1,2\n3,5\n";
  folder.file("io.csv", points);
  folder.file("io.npy", "any");
  folder.file("io00001.png", "any");
  std::filesystem::create_symlink("io.csv", folder / "link.csv");
  std::filesystem::create_directory(folder / "folder");
  for (const char* name : {"io.csv", "./io.csv", "link.csv", "folder/../io.csv"}) {
    const std::string replaces = std::string(name) + ": ";
    refuses(folder, std::string("cells --points io.csv --width 9 --cells ") + name, usage,
            {replaces + "--cells would replace the file that --points reads"});
    refuses(folder, std::string("relax --points io.csv --width 9 --rounds 1 --relaxed-points ") + name, usage,
            {replaces + "--relaxed-points would replace"});
    refuses(folder, std::string("tiles --points io.csv --size 9x9 --adjacency ") + name, usage,
            {replaces + "--adjacency would replace"});
  }
  refuses(folder, "render --points io.npy --width 9 --labels io.npy", usage, {"--labels would replace"});
  refuses(folder, "render --mask io00001.png --waves io%05d.png --method jfa", usage,
          {"--waves would replace the file that --mask reads"});
  refuses(folder, "simulate --mask io00001.png --step-length 1 --frames 2 -o io%05d.png", usage,
          {"-o would replace the file that --mask reads"});
  BOOST_TEST(content_of(folder / "io.csv") == points);
}

BOOST_AUTO_TEST_CASE(compare_refuses_what_it_cannot_use) {
  const TemporaryFolder folder;
  succeeds(folder, "render --random 5 --size 9x9 --labels a.npy");
  for (const std::string option : {"--metric manhattan", "--size 9x9", "--bounds 0,0,9,9", "--device 0:0"}) {
    refuses(folder, "compare a.npy a.npy " + option, usage,
            {option.substr(0, option.find(' ')) + " is for seeds"});
  }
  refuses(folder, "compare a.npy a.npy --random 5", usage, {"not both", "leave out a.npy or the seeds"});
  succeeds(folder, "compare a.npy a.npy --json");
}

BOOST_AUTO_TEST_CASE(what_is_unknown_is_told_where_the_help_is) {
  const TemporaryFolder folder;
  for (const char* const rest : {"", " --random 3 --size 9x9", " a b"}) {
    refuses(folder, std::string("rendr") + rest, usage,
            {"rendr is unknown; did you mean render? see vorocl --help\n"});
  }
  const std::string render = "render --random 5 --size 9x9 ";
  for (const std::string colour : {"--colour", "--colour area"}) {
    refuses(folder, render + colour, usage,
            {"--colour is unknown; did you mean --color? see vorocl render --help\n"});
  }
  refuses(folder, "render --size 9x9 --pints p.csv", usage,
          {"--pints is unknown; did you mean --points? see"});
  refuses(folder, render + "--xyzzy", usage, {"--xyzzy is unknown; see vorocl render --help\n"});
  refuses(folder, "rendr", usage, {"rendr is unknown; did you mean render? see vorocl --help\n"});
  refuses(folder, render + "-o a.png --color neighbors", usage,
          {"\"neighbors\" is unknown; did you mean neighbours? there are id, distance"});
  refuses(folder, render + "-o a.png --palette virdis", usage, {"did you mean viridis? "});
}

// refuses() wants one line: there is no note before that they count.
BOOST_AUTO_TEST_CASE(seeds_outside_are_refused_at_once_where_they_do_not_count) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n1,2\n30,5\n");
  const std::string input = " --points p.csv --bounds 0,0,9,9 --size 9x9 ";
  const std::string outside = "1 of 2 points lie outside the bounds 0,0,9,9, which ";
  for (const std::string line : {"render --labels a.npy --method jfa", "cells --cells a.csv --method djfa"}) {
    refuses(folder, line + input, failure, {outside + "flooding cannot take, only exact diagrams can"});
  }
  refuses(folder, "bench --methods exact" + input, failure, {outside + "bench cannot take"});
  refuses(folder, "relax --rounds 1 -o a.png" + input, failure, {outside + "relax cannot take"});
}

BOOST_AUTO_TEST_CASE(names_with_newlines_stay_in_one_line) {
  const TemporaryFolder folder;
  refuses(folder, "render --points \"$(printf 'no\\nfile.csv')\" --width 9 --labels a.npy", failure,
          {"no\\x0afile.csv"});
  const std::string said =
      succeeds(folder, "render --random 1 --size 9x9 --labels \"$(printf 'a\\nb.npy')\"");
  BOOST_TEST(said.find("exact: 1 seed on 9 x 9") == 0u, said);
  BOOST_TEST(said.find("wrote a\\x0ab.npy\n") != std::string::npos, said);
}

BOOST_AUTO_TEST_CASE(texts_do_not_end_at_a_nul) {
  const TemporaryFolder folder;
  folder.file("p.csv", std::string("x,y\0z\n1,2\n", 11));
  refuses(folder, "render --points p.csv --width 9 --labels a.npy", failure,
          {"no column y; there are x, y?z: x,y?z (choose two"});
}

BOOST_AUTO_TEST_CASE(larger_diagrams_are_told_of_tiles) {
  const TemporaryFolder folder;
  for (const char* size : {"--size 40000x9", "--width 40000"}) {
    refuses(folder, std::string("render --points p.csv --labels a.npy ") + size, usage,
            {"40000 pixels", "vorocl tiles makes larger ones"});
  }
  refuses(folder, "render --points p.csv --labels a.npy --width x", usage, {"\"x\" is no whole number"});
  refuses(folder, "render --points p.csv --labels a.npy --width 0", usage, {"must be from 1 to 32768"});
}

BOOST_AUTO_TEST_CASE(links_to_standard_output_are_written_into) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/stdout", folder / "out.csv");
  const Result result = run(folder, "cells --random 2 --size 9x9 --cells out.csv | cat");
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.error == "");
  BOOST_TEST(std::filesystem::is_symlink(folder / "out.csv"));
  // A file that it is appended to would be replaced, and lose what it has.
  for (const char* const output : {"out.csv", "log.csv"}) {
    folder.file("log.csv", "before\n");
    const Result into_file =
        run(folder, std::string("cells --random 2 --size 9x9 --cells ") + output, "", ">> log.csv");
    BOOST_TEST(into_file.exit_code == failure);
    BOOST_TEST(into_file.error == "vorocl: error: cannot write " + std::string(output) +
                                      ": standard output goes to this file\n");
    BOOST_TEST(content_of(folder / "log.csv") == "before\n");
  }
}

// 3 points: one has a cell, one shares its pixel, one lies outside and owns nothing.
BOOST_AUTO_TEST_CASE(counts_of_a_window_add_up) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n4,4\n4,4\n500,4\n");
  for (const std::string line : {"render --labels a.npy", "cells --cells a.csv"}) {
    const Result result = run(folder, line + " --points p.csv --bounds 0,0,9,9 --size 9x9");
    BOOST_TEST(result.out.find("exact: 3 seeds on 9 x 9") == 0u, result.out);
    BOOST_TEST(result.out.find("of these seeds: 1 with a cell, 1 inside and 1 outside that own no pixel\n") !=
                   std::string::npos,
               result.out);
  }
}

// Root may write everywhere but where there is no disk.
BOOST_AUTO_TEST_CASE(why_no_driver_starts_is_told) {
  const TemporaryFolder folder;
  const std::string line = "render --random 5 --size 9x9 --labels a.npy";
  folder.file("file", "");
  refuses(folder, line, failure, {"no OpenCL driver could start", "cache file/cache (", "POCL_CACHE_DIR"},
          "POCL_CACHE_DIR=file/cache");
  // A file where the folder should be does not keep the driver from starting.
  refuses(folder, line, failure,
          {"building ", " failed; PoCL cannot write its cache file (", "POCL_CACHE_DIR"},
          "POCL_CACHE_DIR=file");
  refuses(folder, line, failure, {"POCL_CACHE_DIR is set but empty", "unset it"}, "POCL_CACHE_DIR=");
  refuses(folder, line, failure, {"no OpenCL driver could start", "POCL_DEVICES is \"foo\"", "unset it"},
          "POCL_DEVICES=foo");
  refuses(folder, line, failure, {"no OpenCL driver could start", "limited to 195 MiB", "ulimit -v"},
          "ulimit -v 200000;");
  folder.file("vendors/none", "");
  refuses(folder, line, failure, {"no OpenCL platform was found; install a driver"},
          "OCL_ICD_VENDORS=/nowhere");
}

BOOST_AUTO_TEST_CASE(small_stacks_suffice) {
  for (const char* const stack : {"200", "1000"}) {
    const TemporaryFolder folder;
    const Result result = run(folder, "render --random 5 --size 50x50 --labels a.npy",
                              std::string("ulimit -s ") + stack + "; POCL_CACHE_DIR=cache");
    BOOST_TEST(result.exit_code == 0, result.error);
  }
}
