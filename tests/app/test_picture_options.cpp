// The command's options for pictures, as its users give them: what they draw and what they refuse.
#define BOOST_TEST_MODULE picture_options
#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "app/options/option_groups.hpp"
#include "brute_force.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

const std::string random_render = "render --random 9 --size 60x40 --method exact -o a.png ";

cv::Mat render(const TemporaryFolder& folder, const std::string& arguments) {
  succeeds(folder, "render --method exact -o a.png " + arguments);
  return cv::imread(folder / "a.png");
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_scale_may_be_of_percentiles) {
  const ScaleEnds ends = parse_scale("2%, 98.5 %");
  BOOST_TEST(ends.percent);
  BOOST_TEST(ends.low == 2);
  BOOST_TEST(ends.high == 98.5);
  for (const char* bad : {"2%,98", "2,98%", "-1%,50%", "0%,101%", "5%,5%", "%,5%"}) {
    check_error([&] { parse_scale(bad); }, {bad, "2%,98%"});
  }
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,v\n5,5,0\n15,5,10\n25,5,20\n35,5,30\n45,5,1000\n");
  const std::string points = "--points p.csv --size 50x10 --bounds 0,0,50,10 --color column:v --color-bar ";
  // Linear between the values in order, as NumPy's percentile.
  BOOST_TEST(same(render(folder, points + "--scale 10%,75%"), render(folder, points + "--scale 4,30")));
  BOOST_TEST(same(render(folder, points + "--scale 0%,100%"), render(folder, points + "--scale 0,1000")));
}

BOOST_AUTO_TEST_CASE(a_logarithmic_scale_leaves_out_what_has_no_logarithm) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,v\n5,5,1\n15,5,10\n25,5,100\n35,5,0\n45,5,-7\n");
  const std::string points =
      "render --snap --points p.csv --size 50x10 --bounds 0,0,50,10 --color column:v --log -o a.png ";
  const Result result = run(folder, points);
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.error.find("2 of 5 values are 0 or less") != std::string::npos, result.error);
  const auto labels =
      brute_force(Grid(50, 10), {{5, 5}, {15, 5}, {25, 5}, {35, 5}, {45, 5}}, Metric::euclidean);
  const double none = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(same(cv::imread(folder / "a.png"),
                  color_by_value(labels, Grid(50, 10), {0, 1, 2, none, none}, {0, 2}, Palette::viridis)));
  // A series has no scale before there is a value above 0: the note comes once nevertheless.
  std::string frames;
  for (const char* const value : {"0", "-2", "3"}) {
    frames += dump(walled_box, "id x y c_pe", {"1 2.5 5 0", std::string("2 7.5 5 ") + value});
  }
  folder.file("t.lammpstrj", frames);
  const std::string notes =
      run(folder, "simulate --trajectory t.lammpstrj --size 9x9 --color column:c_pe --log -o %d.png").error;
  BOOST_TEST(notes ==
             "vorocl: note: 2 of 2 values are 0 or less; a logarithmic scale leaves them out, and "
             "they are grey\n");
  refuses(folder, points + "--scale 0,10", usage, {"--log", "above 0"});
  refuses(folder, points + "--palette okabe-ito", usage, {"--log", "okabe-ito"});
  refuses(folder, random_render + "--log", usage, {"--log", "--color", "area"});
}

BOOST_AUTO_TEST_CASE(frames_are_stamped) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", dump(walled_box, "id x y", {"1 2.5 5", "2 7.5 5"}, "ITEM: TIMESTEP\n4500\n"));
  cv::Mat stamped = render(folder, "--trajectory t.lammpstrj --size 160x160");
  draw_text(stamped, "frame 0, step 4500");
  BOOST_TEST(same(render(folder, "--trajectory t.lammpstrj --size 160x160 --stamp"), stamped));
  succeeds(folder, "simulate --trajectory t.lammpstrj --size 160x160 --stamp -o s%d.png");
  BOOST_TEST(same(cv::imread(folder / "s0.png"), stamped));
  refuses(folder, random_render + "--stamp", usage, {"--stamp", "--trajectory"});
}

BOOST_AUTO_TEST_CASE(a_scale_is_two_rising_numbers) {
  BOOST_TEST(parse_scale(" -1.5 , 2e3").low == -1.5);
  BOOST_TEST(parse_scale("-1.5,2e3").high == 2000);
  for (const char* bad : {"", "1", "1,", ",1", "2,1", "1,1", "1,2,3", "a,2", "0,inf", "nan,1"}) {
    check_error([&] { parse_scale(bad); }, {bad, "LOW,HIGH"});
  }
}

BOOST_AUTO_TEST_CASE(cells_are_coloured_by_a_column_of_the_csv_file) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,height,y\n5,10,5\n25,,5\n5,30,25\n25,20,25\n");
  const Grid grid(40, 30);
  const std::vector<Pixel> pixels = {{5, 5}, {25, 5}, {5, 25}, {25, 25}};
  const auto labels = brute_force(grid, pixels, Metric::euclidean);
  const std::vector<double> values = {10, std::numeric_limits<double>::quiet_NaN(), 30, 20};
  const std::string points = "--snap --points p.csv --size 40x30 --bounds 0,0,40,30 --color column:height ";
  BOOST_TEST(same(render(folder, points), color_by_value(labels, grid, values, {10, 30}, Palette::viridis)));
  BOOST_TEST(same(render(folder, points + "--scale 0,20 --palette greys"),
                  color_by_value(labels, grid, values, {0, 20}, Palette::greys)));
  const cv::Mat bar = with_color_bar(color_by_value(labels, grid, values, {10, 30}, Palette::viridis),
                                     {{10, 30}, Palette::viridis, "height", true, false});
  BOOST_TEST(same(render(folder, points + "--color-bar"), bar));
  // The same seeds in motion: each keeps its value.
  succeeds(folder, "simulate --method exact -o s%d.png --frames 1 --step-length 0 " + points);
  BOOST_TEST(
      same(cv::imread(folder / "s1.png"), color_by_value(labels, grid, values, {10, 30}, Palette::viridis)));
}

BOOST_AUTO_TEST_CASE(particles_are_coloured_by_a_column_of_the_trajectory) {
  const TemporaryFolder folder;
  const auto rows = [](const char* a, const char* b) {
    return std::vector<std::string>{std::string("9 2.5 5 ") + a, std::string("4 7.5 5 ") + b, "5 7.5 5 100"};
  };
  // Particle 4 hides particle 5, which is on its pixel. In the second frame the values go beyond the first's.
  folder.file("t.lammpstrj", dump(walled_box, "id x y c_pe", rows("1", "3")) +
                                 dump(walled_box, "id x y c_pe", rows("9", "2")));
  folder.file("t.xyz",
              "2\nLattice=\"10 0 0 0 10 0 0 0 1\" pbc=\"F F F\" Properties=pos:R:3:q:R:2\n"
              "2.5 5 0 7 1\n7.5 5 0 7 3\n");
  const Result film = run(
      folder,
      "simulate --snap --trajectory t.lammpstrj --size 20x20 --method exact -o %d.png --color column:c_pe");
  BOOST_TEST(film.exit_code == 0);
  BOOST_TEST(film.error.find("--scale 1,100 holds all") != std::string::npos, film.error);
  const Grid grid(20, 20);
  const auto labels = brute_force(grid, {{5, 10}, {15, 10}}, Metric::euclidean);
  const auto expected = [&](double left, double right) {
    return color_by_value(labels, grid, {left, right}, {1, 3}, Palette::viridis);
  };
  BOOST_TEST(same(cv::imread(folder / "0.png"), expected(1, 3)));
  BOOST_TEST(same(cv::imread(folder / "1.png"), expected(3, 2)));  // 9 is drawn as 3
  BOOST_TEST(
      same(render(folder, "--snap --trajectory t.xyz --size 20x20 --color column:q[2]"), expected(1, 3)));

  // Particle 3 is new in the second frame, so that the pixel carries the label of 5, which it hides.
  folder.file("new.lammpstrj",
              dump(walled_box, "id x y c_pe", {"9 2.5 5 1", "5 7.5 5 3"}) +
                  dump(walled_box, "id x y c_pe", {"9 2.5 5 1", "5 7.5 5 100", "3 7.5 5 2"}));
  succeeds(folder,
           "simulate --trajectory new.lammpstrj --size 20x20 --method djfa -o n%d.png --color column:c_pe");
  BOOST_TEST(same(cv::imread(folder / "n0.png"), expected(1, 3)));
  BOOST_TEST(same(cv::imread(folder / "n1.png"), expected(1, 2)));
}

BOOST_AUTO_TEST_CASE(texts_of_a_column_are_classes) {
  const TemporaryFolder folder;
  const auto frame = [](const std::string& left, const std::string& right) {
    return "2\nLattice=\"10 0 0 0 10 0 0 0 1\" pbc=\"F F F\" Properties=species:S:1:pos:R:3:fixed:L:1\n" +
           left + " 2.5 5 0 T\n" + right + " 7.5 5 0 F\n";
  };
  // In the order of their letters; those of a later frame come behind.
  folder.file("t.xyz", frame("Si", "O") + frame("Si", "Na"));
  const Grid grid(20, 20);
  const auto labels = brute_force(grid, {{5, 10}, {15, 10}}, Metric::euclidean);
  const auto expected = [&](double left, double right, Palette palette = Palette::okabe_ito) {
    return color_by_value(labels, grid, {left, right}, {0, 2}, palette);
  };
  const std::string trajectory = "--snap --trajectory t.xyz --size 20x20 --color column:";
  succeeds(folder, "simulate --method exact -o %d.png " + trajectory + "species");
  BOOST_TEST(same(cv::imread(folder / "0.png"), expected(1, 0)));
  BOOST_TEST(same(cv::imread(folder / "1.png"), expected(1, 2)));
  // A palette that is stretched over the first picture's texts stays so.
  const Result stretched =
      run(folder, "simulate --method exact --palette turbo -o t%d.png " + trajectory + "species");
  BOOST_TEST(
      stretched.error.find("the first picture does not have Na: they have the colour of its last text") !=
          std::string::npos,
      stretched.error);
  for (const int picture : {0, 1}) {
    const Scale of_first = {0, 1};
    BOOST_TEST(same(cv::imread(folder / fmt::format("t{}.png", picture)),
                    color_by_value(labels, grid, {1, picture == 0 ? 0.0 : 2.0}, of_first, Palette::turbo)));
  }
  const Result barred =
      run(folder, "simulate --method exact --color-bar -o b%d.png " + trajectory + "species");
  BOOST_TEST(barred.error.find("does not have Na: they have colours, but no names") != std::string::npos,
             barred.error);
  BOOST_TEST(same(render(folder, trajectory + "fixed"), expected(1, 0)));

  folder.file("p.csv", "x,y,kind\n2.5,5,Na\n7.5,5,\"C, 13\"\n2,5,\n2,4.9,3\n");  // 3 is a text here
  const std::string points =
      "--snap --points p.csv --size 20x20 --bounds 0,0,10,10 --y-up --color column:kind ";
  cv::Mat bar = render(folder, points + "--color-bar --palette viridis --enlarge 10");
  BOOST_TEST(same(bar(cv::Rect(120, 0, 80, 200)), cv::Mat(200, 80, CV_8UC3, bar.at<cv::Vec3b>(0, 120))));
  const cv::Mat plain = render(folder, points + "--enlarge 10");
  BOOST_TEST(
      same(render(folder, points + "--color-bar --enlarge 10"),
           with_color_bar(plain, {{0, 2}, Palette::okabe_ito, "kind", true, false, {"3", "C, 13", "Na"}})));
  refuses(folder, "render -o a.png --log " + points, failure, {"kind", "texts", "--log"});
}

BOOST_AUTO_TEST_CASE(films_with_a_colour_bar_have_even_sides) {
  const TemporaryFolder folder;
  const Result result =
      run(folder,
          "simulate --random 9 --size 65x101 --frames 3 --step-length 5 --method djfa -o a.mp4 "
          "--color area --color-bar");
  BOOST_TEST(result.exit_code == 0);
  cv::VideoCapture film(folder / "a.mp4");
  BOOST_TEST(film.get(cv::CAP_PROP_FRAME_COUNT) == 4);
  BOOST_TEST(static_cast<int>(film.get(cv::CAP_PROP_FRAME_WIDTH)) % 2 == 0);
  BOOST_TEST(film.get(cv::CAP_PROP_FRAME_WIDTH) > 65 + 40);
  BOOST_TEST(film.get(cv::CAP_PROP_FRAME_HEIGHT) == 102);
}

BOOST_AUTO_TEST_CASE(edges_and_contours_have_a_default) {
  const TemporaryFolder folder;
  const std::string seeds = "--random 9 --size 60x40 ";
  const cv::Mat plain = render(folder, seeds), edges = render(folder, "--edges " + seeds);
  BOOST_TEST(!same(edges, plain));
  BOOST_TEST(same(edges, render(folder, seeds + "--edges 1")));
  BOOST_TEST(!same(edges, render(folder, seeds + "--edges 3")));
  // The largest distance is more than 10 and at most 20.
  BOOST_TEST(same(render(folder, seeds + "--contours"), render(folder, seeds + "--contours 2")));
}

BOOST_AUTO_TEST_CASE(options_that_contradict_each_other_are_usage_errors) {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& options, std::initializer_list<std::string> parts) {
    refuses(folder, random_render + options, usage, parts);
  };
  refuse("--color red", {"red", "id, distance, area, neighbours, column:NAME"});
  refuse("--color column:", {"column:NAME"});
  refuse("--palette jet", {"jet", "viridis, turbo, greys, viridis_r, turbo_r, greys_r, okabe-ito"});
  refuse("--palette turbo", {"--palette", "ids", "okabe-ito"});
  refuse("--color distance --palette okabe-ito", {"okabe-ito", "distances", "continuous", "viridis"});
  refuse("--color area --palette okabe-ito", {"okabe-ito", "areas", "continuous", "viridis"});
  refuse("--color-bar", {"--color-bar", "--color", "area"});
  refuse("--color id --scale 0,1", {"--scale", "--color", "area"});
  refuse("--color area --scale 5,1", {"--scale", "5,1", "LOW,HIGH"});
  refuse("--color area --scale 5", {"--scale", "LOW,HIGH"});
  for (const char* width : {"0", "101", "1.5"}) refuse(std::string("--edges ") + width, {"--edges"});
  for (const char* interval : {"0", "inf", "near"}) {
    refuse(std::string("--contours ") + interval, {"--contours", interval});
  }
  refuses(folder, "render --random 9 --size 9x9 --method exact --labels a.npy --color-bar", usage,
          {"--color-bar", "-o"});
}

BOOST_AUTO_TEST_CASE(columns_that_are_not_there_are_refused) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,height\n1,2,NA\n1,2,3\n3,4,tall\n");
  folder.file("p.npy", "");
  folder.file("t.lammpstrj", dump(walled_box, "id x y c_pe", {"1 2 3 4"}));
  const std::string square = " --size 10x10 --method exact -o a.png --color column:";
  refuses(folder, "render --random 9" + square + "q", usage,
          {"--color column:NAME", "--points", "--trajectory"});
  refuses(folder, "render --points p.npy" + square + "q", usage, {"--color column:NAME", ".csv"});
  refuses(folder, "render --points p.csv" + square + "depth", failure, {"p.csv:1", "depth", "x, y, height"});
  refuses(folder, "render --points p.csv" + square + "height", failure, {"p.csv:4", "\"tall\""});
  refuses(folder, "render --trajectory t.lammpstrj" + square + "vx", failure,
          {"t.lammpstrj:9", "\"vx\"", "id, x, y, c_pe"});
  refuses(folder, "simulate --trajectory t.lammpstrj --size 9x9 --method exact -o %d.png --color column:vx",
          failure, {"t.lammpstrj:9", "\"vx\""});
  folder.file("f.csv", "x,y,q\n1,2,3\n3,4,0.5\n");
  refuses(folder, "render --points f.csv" + square + "q --palette okabe-ito", failure,
          {"q", "0.5", "okabe-ito"});
}

BOOST_AUTO_TEST_CASE(a_film_whose_scale_does_not_do_says_which_one_would) {
  const TemporaryFolder folder;
  const auto film = [&](const std::vector<int>& sides) {
    std::string text;
    for (const int side : sides) {
      text += fmt::format("4\nLattice=\"{0} 0 0 0 {0} 0 0 0 1\"\n", side);
      for (const double at : {0.1, 0.2, 0.5, 0.9}) text += fmt::format("A {} {} 0\n", at * side, at * side);
    }
    folder.file("t.xyz", text);
    return run(folder, "simulate --trajectory t.xyz --width 60 --color area -o p%d.png").error;
  };
  BOOST_TEST(film({30, 30, 29}) == "");
  const std::string note = film({30, 20, 10});
  BOOST_TEST(note.find("values of the first picture") != std::string::npos, note);
  BOOST_TEST(note.find("--scale ") != std::string::npos);
  const std::string scale =
      note.substr(note.find("--scale "), note.find(" holds all") - note.find("--scale "));
  BOOST_TEST(succeeds(folder, "simulate --trajectory t.xyz --width 60 --color area -o p%d.png " + scale) !=
             "");
}
