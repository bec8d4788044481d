// Standard streams that are closed, full, or read by nobody, and what is printed of foreign texts.
#define BOOST_TEST_MODULE streams
#include <filesystem>

#include "app/terminal/console.hpp"
#include "run_command.hpp"

using namespace vorocl;

namespace {

Result run_with(const TemporaryFolder& folder, const std::string& arguments,
                const std::string& redirections) {
  return run(folder, arguments, "", redirections);
}

const std::string film = "simulate --random 30 --size 65x49 --frames 5 --step-length 1 --method jfa -o f.mp4";

}  // namespace

BOOST_AUTO_TEST_CASE(notes_never_get_into_files) {
  const TemporaryFolder whole, folder;
  const Result expected = run(whole, film + " --statistics s.csv --labels l%d.npy");
  BOOST_TEST(expected.error.find("note: ") != std::string::npos);
  for (const char* closed : {"2>&-", "0<&- 2>&-", "0<&- 1>/dev/null 2>&-"}) {
    const Result result = run_with(folder, film + " --labels l%d.npy", closed);
    BOOST_TEST(result.exit_code == 0, closed);
    for (const std::string& name : folder.names()) {
      BOOST_TEST((content_of(folder / name) == content_of(whole / name)), closed << " " << name);
    }
    std::filesystem::remove(folder / "f.mp4");
  }
  // A warning, and a table that is the first file to be opened.
  folder.file("p.csv", "0,0\n1,9\n");
  for (const char* closed : {"", "2>&-"}) {
    const std::string name = closed[0] == '\0' ? "a" : "b";
    BOOST_TEST(
        run_with(folder, "relax --points p.csv --size 30x20 --rounds 2 --energy " + name + ".csv", closed)
            .exit_code == 0);
  }
  BOOST_TEST(content_of(folder / "a.csv") == content_of(folder / "b.csv"));
}

BOOST_AUTO_TEST_CASE(an_unwritable_standard_error_ends_nothing) {
  const TemporaryFolder folder;
  for (const char* redirection : {"2> /dev/full", "2>&-"}) {
    std::filesystem::remove(folder / "f.mp4");
    BOOST_TEST(run_with(folder, film, redirection).exit_code == 0, redirection);
    BOOST_TEST(std::filesystem::exists(folder / "f.mp4"), redirection);
  }
  // A pipe that nobody reads; the exit code comes by a file.
  run(folder, film + " 2>&1 > /dev/null; echo $? > code) | true #", "(");
  BOOST_TEST(content_of(folder / "code") == "0\n");
  BOOST_TEST(run_with(folder, "render --random 0", "2> /dev/full").exit_code == usage);
}

BOOST_AUTO_TEST_CASE(results_that_cannot_be_printed_are_errors) {
  const TemporaryFolder folder;
  const std::string render = "render --random 5 --size 9x9 --method jfa --labels a.npy";
  for (const std::string& arguments :
       {render, render + " --json", std::string("devices"), std::string("devices --json"),
        std::string("--help"), std::string("--version"), std::string("compare a.npy a.npy"),
        std::string("bench --random 5 --size 9x9 --methods jfa --repeat 1")}) {
    const Result full = run_with(folder, arguments, "> /dev/full");
    BOOST_TEST(full.exit_code == failure, arguments);
    BOOST_TEST(full.error == "vorocl: error: cannot write standard output: No space left on device\n");
    const Result closed = run_with(folder, arguments, ">&-");
    BOOST_TEST(closed.exit_code == failure, arguments);
    BOOST_TEST(closed.error == "vorocl: error: cannot write standard output: Bad file descriptor\n");
  }
}

BOOST_AUTO_TEST_CASE(escape_sequences_of_files_do_not_reach_the_terminal) {
  const TemporaryFolder folder;
  const std::string evil =
      "\x1b[2Jred\x1b]0;title\x07\x9b"
      "31m\xc2\x9b"
      "1m";
  folder.file("p.csv", evil + ",lat\n1,2\n");
  folder.file("p.xyz", "1\nProperties=species:S:1:pos:R:3:" + evil + ":R:1\nAr 1 2 3 4\n");
  folder.file("p.dump",
              "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
              "ITEM: ATOMS id x y " +
                  evil + "\n1 0.5 0.5 1\n");
  const std::string size = " --size 9x9 --method jfa -o a.png";
  for (const std::string& arguments :
       {std::string("render --points p.csv" + size), "render --trajectory p.xyz --color column:no" + size,
        "render --trajectory p.dump --color column:no" + size}) {
    const Result result = run(folder, arguments);
    BOOST_TEST(result.exit_code == failure);
    BOOST_TEST(result.error.find("\\x1b[2Jred\\x1b]0;title\\x07\\x9b31m\\xc2\\x9b1m") != std::string::npos,
               result.error);
    for (const char c : {'\x1b', '\x07', '\x9b'}) BOOST_TEST(result.error.find(c) == std::string::npos);
  }
  const std::string text = "a\tb\n\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80";
  BOOST_TEST(command::printable(text, true) == text);
  BOOST_TEST(command::printable("a\tb\n") == "a\tb\\x0a");
  BOOST_TEST(command::printable("\x7f\r\xff\xc3") == "\\x7f\\x0d\\xff\\xc3");
}

// With AVX2, PoCL has warnings about vectors of 512 bits.
BOOST_AUTO_TEST_CASE(a_first_run_says_nothing_of_the_compiler) {
  const TemporaryFolder folder;
  for (const char* const exact : {"", " --exact"}) {
    const Result result =
        run(folder, "cells --random 9 --size 40x30 --cells c.csv" + std::string(exact),
            "XDG_CACHE_HOME='" + folder / "cache" + "' POCL_CACHE_DIR='" + folder / "pocl" + "'");
    BOOST_TEST(result.exit_code == 0);
    BOOST_TEST(result.error == "");
  }
}
