// vorocl simulate and render on trajectories: ids, boxes, bounds, particles that come and go, and bad files.
#define BOOST_TEST_MODULE simulate_trajectory
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>
#include <random>

#include "brute_force.hpp"
#include "formats/raster_files.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;
using nlohmann::json;

namespace {

std::vector<std::uint32_t> labels_of(const TemporaryFolder& folder, const std::string& name) {
  return read_labels(folder / name).labels;
}

using Particles = std::map<std::uint32_t, Point>;  // by id, in a box of 10 x 10

std::string frame_text(const Particles& particles, const std::string& box = periodic_box) {
  std::vector<std::string> rows;
  for (const auto& [id, at] : particles) rows.insert(rows.begin(), fmt::format("{} {} {}", at.x, id, at.y));
  return dump(box, "x id y", rows);
}

/// The exact labels of a box of 10 x 10, whose y axis points up, as ids of particles.
std::vector<std::uint32_t> exact_labels(const Particles& particles, const Grid& grid) {
  const command::Size size(grid);
  std::vector<Pixel> pixels;
  std::vector<std::uint32_t> ids;
  for (const auto& [id, at] : particles) {
    pixels.push_back({static_cast<int>(std::floor(at.x * size.width() / 10)),
                      size.height() - 1 - static_cast<int>(std::floor(at.y * size.height() / 10))});
    ids.push_back(id);
  }
  std::vector<std::uint32_t> labels = brute_force(grid, pixels, Metric::euclidean);
  for (std::uint32_t& label : labels) label = label == no_label ? no_label : ids[label];
  return labels;
}

/// Particles that drift through a periodic box; some vanish, some come back, new ones appear.
std::vector<Particles> drifting(int frames) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0, 10), step(-0.4, 0.4);
  std::vector<Particles> all(1);
  for (std::uint32_t id = 0; id < 40; ++id)
    all[0][4000000000u - 1000 * id] = {anywhere(random), anywhere(random)};
  std::map<std::uint32_t, Point> away;
  for (int frame = 1; frame < frames; ++frame) {
    Particles now = all.back();
    for (auto& [id, at] : now) {
      at = {std::fmod(at.x + step(random) + 10, 10), std::fmod(at.y + step(random) + 10, 10)};
    }
    if (frame % 3 == 0) {
      now.insert(away.begin(), away.end());
      away.clear();
    }
    for (int i = 0; i < 3; ++i) {
      away.insert(*now.begin());
      now.erase(now.begin());
    }
    now[static_cast<std::uint32_t>(frame)] = {anywhere(random), anywhere(random)};
    all.push_back(now);
  }
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_the_ids_of_particles_that_come_and_go) {
  const TemporaryFolder folder;
  const Grid grid(120, 120, Axes::xy);
  const std::vector<Particles> frames = drifting(12);
  std::string text;
  for (const Particles& particles : frames) text += frame_text(particles);
  folder.file("t.lammpstrj", text);
  const json result = json::parse(succeeds(
      folder,
      "simulate --trajectory t.lammpstrj --width 120 --method djfa --labels l%d.npy --json -o f.mp4"));
  BOOST_TEST(result.at("frames") == 11);
  BOOST_TEST(result.at("seeds") == frames.back().size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto labels = labels_of(folder, fmt::format("l{}.npy", i));
    for (const std::uint32_t label : labels) BOOST_REQUIRE(frames[i].count(label) == 1u);
    // Holes where particles vanished may be filled wrongly in part.
    BOOST_TEST(similarity(labels, exact_labels(frames[i], grid)) > 98.5, "frame " << i);
  }
  BOOST_TEST(cv::VideoCapture(folder / "f.mp4").get(cv::CAP_PROP_FRAME_COUNT) == 12);
}

BOOST_AUTO_TEST_CASE(of_particles_on_one_pixel_the_lowest_id_has_the_cell) {
  const TemporaryFolder folder;
  // In frame 1 particle 3 is new, so that its seed is not the first one.
  const std::vector<Particles> frames = {{{5, {1, 1}}, {9, {8, 1}}}, {{3, {1, 1}}, {5, {1, 1}}, {9, {8, 1}}}};
  folder.file("t.lammpstrj", frame_text(frames[0]) + frame_text(frames[1]));
  succeeds(folder, "simulate --trajectory t.lammpstrj --size 20x20 --method djfa --labels l%d.npy");
  for (std::size_t i = 0; i < 2; ++i) {
    BOOST_TEST(labels_of(folder, fmt::format("l{}.npy", i)) ==
               exact_labels(frames[i], Grid(20, 20, Axes::xy)));
  }
}

BOOST_AUTO_TEST_CASE(of_a_crowd_the_lowest_ids_have_the_cells) {
  const TemporaryFolder folder;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 10);
  std::vector<Particles> frames(3);
  std::string text;
  for (Particles& particles : frames) {
    while (particles.size() < 900)
      particles[static_cast<std::uint32_t>(random() % 100'000)] = {anywhere(random), anywhere(random)};
    text += frame_text(particles);
  }
  folder.file("t.lammpstrj", text);
  succeeds(folder, "simulate --snap --trajectory t.lammpstrj --size 30x30 --labels l%d.npy");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    BOOST_TEST(labels_of(folder, fmt::format("l{}.npy", i)) ==
               exact_labels(frames[i], Grid(30, 30, Axes::xy)));
  }
}

BOOST_AUTO_TEST_CASE(each_frame_is_seen_in_its_own_box_and_one_frame_can_be_rendered) {
  const TemporaryFolder folder;
  const std::string twice = "pp pp pp\n-10 10\n-10 10\n-1 1";
  folder.file("t.lammpstrj",
              dump(periodic_box, "id x y", {"7 1 1", "8 9 6"}) + dump(twice, "id x y", {"8 8 2", "7 -8 -8"}));
  succeeds(folder,
           "simulate --trajectory t.lammpstrj --fit frame --size 50x50 --method jfa --labels l%d.npy");
  BOOST_TEST(labels_of(folder, "l0.npy") == labels_of(folder, "l1.npy"));
  succeeds(folder,
           "render --trajectory t.lammpstrj --frame 1 --size 50x50 --method jfa --labels a.npy -o a.png");
  BOOST_TEST(labels_of(folder, "a.npy") == labels_of(folder, "l1.npy"));
  run(folder,
      "render --trajectory t.lammpstrj --size 50x50 --method jfa --bounds -10,-10,10,10 --periodic none "
      "--labels b.npy");
  const auto labels = labels_of(folder, "b.npy");
  BOOST_TEST(labels[22 * 50 + 27] == 7u);  // (1, 1) is column floor(11 * 50 / 20), row 49 - 27
  BOOST_TEST(labels[10 * 50 + 47] == 8u);
  refuses(folder, "render --trajectory t.lammpstrj --frame 2 --size 9x9 --method jfa -o b.png", failure,
          {"t.lammpstrj", "no frame 2", "is 1"});
}

BOOST_AUTO_TEST_CASE(the_axes_of_the_box_are_periodic_unless_told_otherwise) {
  const TemporaryFolder folder;
  const Particles particles = {{1, {0.5, 5}}, {2, {6, 5}}};
  const std::string x_alone = "pp ff pp\n0 10\n0 10\n-0.5 0.5";
  folder.file("xy.lammpstrj", frame_text(particles));
  folder.file("x.lammpstrj", frame_text(particles, x_alone));
  folder.file("none.lammpstrj", frame_text(particles, walled_box));
  const auto labels = [&](const std::string& file, const std::string& more, const std::string& note = "") {
    const Result result = run(folder, "render --trajectory " + file +
                                          ".lammpstrj --size 40x40 --method exact --snap "
                                          "--labels l.npy " +
                                          more);
    BOOST_TEST(result.exit_code == 0, result.error);
    const std::string expected_note =
        note.empty() && more.find("--periodic") != std::string::npos ? "counts instead" : note;
    BOOST_TEST((expected_note.empty() ? result.error.empty()
                                      : result.error.find(expected_note) != std::string::npos),
               result.error);
    return labels_of(folder, "l.npy");
  };
  const auto expected = [&](Axes axes) { return exact_labels(particles, Grid(40, 40, axes)); };
  BOOST_TEST(expected(Axes::x) != expected(Axes::none));
  BOOST_TEST(labels("xy", "") == expected(Axes::xy));
  BOOST_TEST(labels("x", "") == expected(Axes::x));
  BOOST_TEST(labels("none", "") == expected(Axes::none));
  BOOST_TEST(labels("xy", "--periodic none") == expected(Axes::none));
  BOOST_TEST(labels("none", "--periodic x") == expected(Axes::x));
  BOOST_TEST(labels("xy", "--bounds 0,0,10,10") == expected(Axes::xy));
  BOOST_TEST(labels("xy", "--bounds 0,0,10,10 --periodic x") == expected(Axes::x));
  BOOST_TEST(labels("xy", "--bounds 0,0,10,10 --periodic none") == expected(Axes::none));

  // A tilted box repeats with its tilt, unless the axes are told otherwise.
  folder.file("tilted.lammpstrj",
              dump("xy xz yz pp pp pp\n0 12 2\n0 10 0\n-0.5 0.5 0", "id x y", {"1 0.5 5", "2 6 5"}));
  const auto tilted = labels("tilted", "");
  BOOST_TEST(tilted != expected(Axes::xy));
  BOOST_TEST(labels("tilted", "--bounds 0,0,10,10") == tilted);
  BOOST_TEST(
      run(folder, "render --trajectory tilted.lammpstrj --size 40x40 --snap --labels t.npy --periodic xy")
          .error.empty());
  BOOST_TEST(labels_of(folder, "t.npy") == tilted);
  BOOST_TEST(labels("tilted", "--periodic x") == expected(Axes::x));
  // What repeats is told of bounds that are a window of the box, too.
  const std::string zoom = "render --trajectory x.lammpstrj --size 9x9 --bounds 2,2,4,4 --json -o zoom.png";
  BOOST_TEST(run(folder, zoom).out.find("\"periodic\":\"x\"") != std::string::npos);
  folder.file("both.lammpstrj", frame_text(particles) + frame_text(particles, x_alone));
  for (const std::string method : {"exact", "djfa"}) {
    succeeds(
        folder,
        "simulate --snap --trajectory both.lammpstrj --size 40x40 --labels both%d.npy --method " + method);
    BOOST_TEST(labels_of(folder, "both0.npy") == expected(Axes::xy));
    BOOST_TEST(labels_of(folder, "both1.npy") == expected(Axes::x));
  }
}

BOOST_AUTO_TEST_CASE(a_frame_without_a_box_repeats_only_where_no_axes_are_told) {
  const TemporaryFolder folder;
  const std::string box = "Lattice=\"10 0 0 0 10 0 0 0 1\" pbc=\"T T F\" Properties=species:S:1:pos:R:3";
  folder.file("t.xyz", "1\n" + box + "\nA 9 9 0\n1\n\nA 1 1 0\n");
  const std::string zoom = "simulate --trajectory t.xyz --size 6x6 --bounds 0,0,2,2 --labels l%d.npy ";
  const Result result = run(folder, zoom + "--periodic xy");
  BOOST_TEST(result.exit_code == failure);
  for (const char* part : {"t.xyz", "frame 1", "box", "--periodic none"}) {
    BOOST_TEST(result.error.find(part) != std::string::npos, result.error);
  }
  BOOST_TEST(run(folder, zoom + "--periodic none").exit_code == 0);
}

BOOST_AUTO_TEST_CASE(without_a_box_all_frames_give_the_bounds) {
  const TemporaryFolder folder;
  folder.file("t.xyz", "2\n\nA 0 0 0\nA 4 2 0\n1\n\nA 1 1 0\n");
  succeeds(folder, "simulate --trajectory t.xyz --width 8 --method jfa --labels l%d.npy");
  BOOST_TEST(read_labels(folder / "l0.npy").size.height() == 4);
  folder.file("far.xyz", "2\n\nA 0 0 0\nA 4 2 0\n2\n\nA 1 1 0\nA 5 1 0\n");
  succeeds(folder, "simulate --trajectory far.xyz --width 10 --method jfa --labels all%d.npy");  // 5 x 2
  BOOST_TEST(read_labels(folder / "all0.npy").size.height() == 4);
  // A pipe cannot be read twice: the first frame's.
  const std::string pipe = "simulate --snap --trajectory /dev/stdin --width 8 --labels far%d.npy ";
  const auto fails = [&](const std::string& options, std::initializer_list<const char*> parts) {
    const TemporaryFolder files;
    files.file("far.xyz", content_of(folder / "far.xyz"));
    const Result result = run(files, pipe + options, "cat far.xyz |");
    BOOST_TEST(result.exit_code == failure);
    for (const char* part : parts) BOOST_TEST(result.error.find(part) != std::string::npos, part);
    BOOST_TEST((files.names().count("far0.npy") == 1 && files.names().count("far1.npy") == 0));
  };
  fails("--outside refuse", {"frame 1", "particle 1 at (5, 1)", "outside the bounds 0,0,4,2", "--bounds"});
  fails("--method jfa", {"1 of 2 seeds", "exact"});
  BOOST_TEST(run(folder, pipe, "cat far.xyz |").exit_code == 0);
  // (1, 1) is in column 2, (5, 1) in column 10, and column 6 is as far from both.
  const std::vector<std::uint32_t> row = {0, 0, 0, 0, 0, 0, 0, 1};
  BOOST_TEST(std::equal(row.begin(), row.end(), labels_of(folder, "far1.npy").begin()));
  succeeds(folder, "simulate --trajectory far.xyz --width 10 --bounds 0,0,5,2 --outside refuse --method jfa");
  folder.file("none.xyz", "0\n\n1\n\nA 1 1 0\n");
  succeeds(folder, "simulate --trajectory none.xyz --size 9x9 --units px --method djfa --labels none%d.npy");
  BOOST_TEST(labels_of(folder, "none0.npy") == std::vector<std::uint32_t>(81, no_label));
  BOOST_TEST(labels_of(folder, "none1.npy") == std::vector<std::uint32_t>(81, 0));
  refuses(folder, "simulate --trajectory none.xyz --width 9 --method djfa", failure, {"none.xyz", "--size"});
}

BOOST_AUTO_TEST_CASE(different_scales_are_warned_of_once) {
  const TemporaryFolder folder;
  const std::string frame = dump(periodic_box, "x y", {"1 2"});
  folder.file("t.lammpstrj", frame + frame + frame);
  const std::string error = run(folder, "simulate --trajectory t.lammpstrj --size 20x10 --method jfa").error;
  BOOST_TEST(std::count(error.begin(), error.end(), '\n') == 1);
  BOOST_TEST(error.find("--width 20") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_bad_frame_keeps_those_before_it) {
  const std::string good = dump(periodic_box, "id x y", {"1 1 1", "2 5 5"});
  const struct {
    std::string bad;
    int line;  // of the file
    std::string part;
  } cases[] = {
      {dump(periodic_box, "id x y", {"1 1 1", "2 5 nan"}), 33, "nan"},
      {dump(periodic_box, "id x y", {"1 1 1", "2 5 five"}), 33, "five"},
      {dump(periodic_box, "id x y", {"1 1 1", "1 5 5"}), 33, "id 1 comes twice"},
      {dump(periodic_box, "id x y", {"1 1 1", "2 5"}), 33, "2 fields"},
      {dump(walled_box, "id x y", {"1 1 1", "2 5 11"}), 33, "outside the fixed wall"},
      {good.substr(0, good.size() - 5), 33, "fields"},
      {good.substr(0, good.size() - 7), 32, "cut off"},
      {good + "3 7 7\n", 34, "more atoms"},
      {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1000000000\nITEM: BOX BOUNDS " + periodic_box +
           "\nITEM: ATOMS id x y\n1 1 1\n",
       26, "1000000000 particles"},
  };
  for (const auto& bad : cases) {
    BOOST_TEST_CONTEXT(bad.bad) {
      const TemporaryFolder folder;
      folder.file("t.lammpstrj", good + good + bad.bad);
      const Result result =
          run(folder,
              "simulate --trajectory t.lammpstrj --width 20 --method djfa --labels l%d.npy -o f.mp4 "
              "--compare-with jfa --similarity s.csv");
      BOOST_TEST(result.exit_code == failure);
      BOOST_TEST(result.out == "");
      BOOST_TEST(result.error.find(fmt::format("vorocl: error: t.lammpstrj:{}: ", bad.line)) == 0u,
                 result.error);
      BOOST_TEST(result.error.find(bad.part) != std::string::npos, result.error);
      const bool extra = bad.part == "more atoms";  // the frame itself is whole
      BOOST_TEST(result.error.find(extra ? "that: 3, written of them: 3\n"
                                         : "that: 2, written of them: 2\n") != std::string::npos);
      BOOST_TEST(cv::VideoCapture(folder / "f.mp4").get(cv::CAP_PROP_FRAME_COUNT) == (extra ? 3 : 2));
      BOOST_TEST(folder.names().size() == (extra ? 6u : 5u));
    }
    const TemporaryFolder folder;
    folder.file("first.lammpstrj", bad.bad);
    if (bad.part == "more atoms") continue;
    refuses(folder,
            "simulate --trajectory first.lammpstrj --width 20 --method djfa --labels l/%d.npy -o f.mp4",
            failure, {fmt::format("first.lammpstrj:{}: ", bad.line - 22), bad.part});
  }
}

BOOST_AUTO_TEST_CASE(options_of_random_motion_are_refused) {
  const TemporaryFolder folder;
  folder.file("t.xyz", "1\n\nA 0 0 0\n");
  const std::string simulate = "simulate --trajectory t.xyz --size 9x9 --method djfa ";
  refuses(folder, simulate + "--step-length 3", usage, {"--step-length", "--trajectory"});
  refuses(folder, simulate + "--border periodic", usage, {"--border", "--trajectory"});
  refuses(folder, simulate + "--rng-seed 3", usage, {"--rng-seed", "--trajectory"});
  refuses(folder, simulate + "--random 5", usage, {"--random", "--trajectory"});
  refuses(folder, "simulate --trajectory t.xyz --method djfa", usage, {"--size", "--width"});
  refuses(folder, "simulate --trajectory none.xyz --size 9x9 --method djfa", failure,
          {"none.xyz", "No such file"});
}
