// Trajectories whose box changes: what the picture shows, which pixels have labels, and that the labels are
// those of a search among the positions themselves.
#define BOOST_TEST_MODULE boxes
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;
using nlohmann::json;

namespace {

/// A box in data units, with particles in it.
struct Scene {
  double x0, y0, x1, y1;
  std::vector<Point> points;
};

std::string text_of(const std::vector<Scene>& scenes, const std::string& flags) {
  std::string text;
  for (const Scene& scene : scenes) {
    std::vector<std::string> rows;
    for (const Point& point : scene.points)
      rows.push_back(fmt::format("{} {} {}", rows.size(), point.x, point.y));
    text += dump(fmt::format("{}\n{} {}\n{} {}\n-0.5 0.5", flags, scene.x0, scene.x1, scene.y0, scene.y1),
                 "id x y", rows);
  }
  return text;
}

/// A box about the origin that goes from square to 1.9 : 1 at the same area; particles go with it.
std::vector<Scene> stretched(int frames, std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  std::vector<Point> parts;
  for (std::size_t i = 0; i < count; ++i) parts.push_back({anywhere(random), anywhere(random)});
  std::vector<Scene> scenes;
  for (int frame = 0; frame < frames; ++frame) {
    const double ratio = 1 + 0.9 * frame / (frames - 1), width = 10 * std::sqrt(ratio),
                 height = 10 / std::sqrt(ratio);
    Scene scene = {-width / 2, -height / 2, width / 2, height / 2, {}};
    for (const Point& part : parts) scene.points.push_back({part.x * width, part.y * height});
    scenes.push_back(scene);
  }
  return scenes;
}

/// The particle nearest to a place in a periodic box, in data units.
std::uint32_t nearest(const Scene& scene, const Point& place) {
  const double width = scene.x1 - scene.x0, height = scene.y1 - scene.y0;
  std::size_t found = 0;
  double least = INFINITY;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const double distance = std::hypot(std::remainder(scene.points[i].x - place.x, width),
                                       std::remainder(scene.points[i].y - place.y, height));
    if (distance < least) {
      least = distance;
      found = i;
    }
  }
  return static_cast<std::uint32_t>(found);
}

bool is_in(const Scene& scene, const Point& place) {
  return place.x > scene.x0 && place.x < scene.x1 && place.y > scene.y0 && place.y < scene.y1;
}

LabelImage labels_of(const TemporaryFolder& folder, const std::string& name) {
  return read_labels(folder / name);
}

/// The columns of a row that have labels, from ... up to and without.
std::pair<int, int> labelled_columns(const LabelImage& image, int row) {
  int begin = 0, end = image.size.width();
  while (begin < end && label_at(image.size.grid(), image.labels, {begin, row}) == no_label) ++begin;
  while (end > begin && label_at(image.size.grid(), image.labels, {end - 1, row}) == no_label) --end;
  return {begin, end};
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_in_a_box_that_is_stretched_are_those_of_the_data) {
  const TemporaryFolder folder;
  const std::vector<Scene> scenes = stretched(7, 60);
  folder.file("t.lammpstrj", text_of(scenes, "pp pp pp"));
  const double side = std::sqrt(1.9) * 10, bottom = -5;  // of all boxes
  for (const std::string method : {"exact", "djfa", "jfa+2"}) {
    succeeds(folder, "simulate --trajectory t.lammpstrj --width 280 --labels l%d.npy --method " + method);
    for (std::size_t frame = 0; frame < scenes.size(); ++frame) {
      const LabelImage image = labels_of(folder, fmt::format("l{}.npy", frame));
      BOOST_TEST(image.size.width() == 280);
      BOOST_TEST(image.size.height() == std::lround(280 * 10 / side));
      const double unit = side / 280, high = 10.0 / image.size.height();
      double inside = 0, equal = 0, astray = 0;
      each_pixel(image.size.grid(), image.labels, [&](std::uint32_t label, const Pixel& pixel) {
        const Point at = centre(pixel);
        const Point place = {-side / 2 + at.x * unit, bottom + (image.size.height() - at.y) * high};
        if (!is_in(scenes[frame], place)) {
          astray += label == no_label ? 0 : 1;
          return;
        }
        ++inside;
        equal += label == nearest(scenes[frame], place) ? 1 : 0;
      });
      BOOST_TEST(equal / inside > 0.96, method << " " << frame << ": " << equal / inside);
      // A box is rounded to whole pixels: at most half a one at each side is beyond it.
      BOOST_TEST(astray <= 280 + image.size.height(), method << " " << frame << ": " << astray);
    }
  }
}

BOOST_AUTO_TEST_CASE(measures_in_a_part_of_the_picture_are_those_of_its_pixels) {
  const TemporaryFolder folder;
  // The picture is 40 x 30 pixels of 1/4; the second frame's box is 20 x 24 of them, from column 8 and row 6.
  const Scene all = {0, 0, 10, 7.5, {{1, 1}, {9, 7}}};
  Scene part = {2, 0, 7, 6, {}};
  SeedsById seeds;
  std::mt19937 random(11);
  for (std::uint32_t id = 0; id < 9; ++id) {
    const Pixel pixel = {static_cast<int>(random() % 20), static_cast<int>(random() % 24)};
    seeds[id] = pixel;
    const Point at = centre(pixel);
    part.points.push_back({2 + at.x / 4, (24 - at.y) / 4});
  }
  folder.file("t.lammpstrj", text_of({all, part}, "pp pp pp"));
  for (const std::string method : {"exact", "djfa"}) {
    succeeds(folder,
             "simulate --trajectory t.lammpstrj --width 40 --units px --labels l%d.npy --cells c%d.csv "
             "--adjacency a%d.csv --method " +
                 method);
    const LabelImage picture = labels_of(folder, "l1.npy");
    LabelledGrid box = {Grid(20, 24, Axes::xy), {}};
    for (int y = 6; y < 30; ++y) {
      for (int x = 8; x < 28; ++x)
        box.labels.push_back(label_at(picture.size.grid(), picture.labels, {x, y}));
    }
    BOOST_TEST(std::count(picture.labels.begin(), picture.labels.end(), no_label) == 40 * 30 - 20 * 24);
    check_adjacency_table(folder / "a1.csv", box);
    std::vector<TableRow> rows = cells_on_host(box, seeds, Metric::euclidean);
    for (TableRow& row : rows) {
      for (const std::size_t x : {1u, 4u, 6u, 8u})
        if (row[x]) *row[x] += 8;
      for (const std::size_t y : {2u, 5u, 7u, 9u})
        if (row[y]) *row[y] += 6;
    }
    check_rows(folder / "c1.csv", rows);
  }
}

BOOST_AUTO_TEST_CASE(measures_are_in_data_units) {
  const TemporaryFolder folder;
  std::vector<Scene> scenes = stretched(3, 30);
  folder.file("t.lammpstrj", text_of(scenes, "pp pp pp"));
  const std::string simulate = "simulate --trajectory t.lammpstrj --width 200 --method jfa ";
  const std::string files =
      "--cells {0}c%d.csv --adjacency {0}a%d.csv --distance {0}d%d.npy --statistics {0}s.csv ";
  succeeds(folder, simulate + fmt::format(files, "p") + "--units px");
  const json result = json::parse(succeeds(folder, simulate + fmt::format(files, "u") + "--json"));
  BOOST_TEST(result.at("area_unit") == "data");
  BOOST_TEST(result.at("length_unit") == "data");
  const double unit = std::sqrt(1.9) * 10 / 200;
  const auto close = boost::test_tools::tolerance(0.01);  // a box is a whole number of pixels
  for (const int frame : {0, 1, 2}) {
    const Table cells = read_table(folder / fmt::format("uc{}.csv", frame));
    const Table in_pixels = read_table(folder / fmt::format("pc{}.csv", frame));
    double area = 0;
    for (std::size_t i = 0; i < 30; ++i) {
      const TableRow &row = cells.rows.at(i), &pixels = in_pixels.rows.at(i);
      area += *row[3];
      BOOST_TEST(*row[3] == *pixels[3] * unit * unit, close);
      for (const std::size_t length : {10u, 12u}) BOOST_TEST(*row[length] == *pixels[length] * unit, close);
      for (const std::size_t same : {0u, 11u, 13u}) BOOST_TEST(*row[same] == *pixels[same]);
      // y points up. A seed is in the pixel of its particle, and all else lies about it as in pixels.
      const Scene& scene = scenes[static_cast<std::size_t>(frame)];
      const Point& particle = scene.points[i];
      BOOST_TEST(std::abs(std::remainder(*row[1] - particle.x, scene.x1 - scene.x0)) < 0.51 * unit);
      BOOST_TEST(std::abs(std::remainder(*row[2] - particle.y, scene.y1 - scene.y0)) < 0.51 * unit);
      const auto about = boost::test_tools::tolerance(0.01);
      for (const std::size_t x : {4u, 6u})
        BOOST_TEST(20 + *row[x] - *row[1] == 20 + (*pixels[x] - *pixels[1]) * unit, about);
      for (const std::size_t y : {5u, 7u})
        BOOST_TEST(20 + *row[2] - *row[y] == 20 + (*pixels[y] - *pixels[2]) * unit, about);
      BOOST_TEST(*row[8] - *row[6] == (*pixels[8] + 1 - *pixels[6]) * unit, close);
      BOOST_TEST(*row[7] - *row[9] == (*pixels[9] + 1 - *pixels[7]) * unit, close);
    }
    BOOST_TEST(area == 100, boost::test_tools::tolerance(1e-12));  // every box has this area
    const Table statistics = read_table(folder / "us.csv");
    const TableRow& row = statistics.rows.at(static_cast<std::size_t>(frame));
    const Scene& scene = scenes[static_cast<std::size_t>(frame)];
    BOOST_TEST(*row[3] == 100.0 / 30, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(
        *row[4] == *read_table(folder / "ps.csv").rows.at(static_cast<std::size_t>(frame))[4] * unit * unit,
        close);
    BOOST_TEST((*row[7] == scene.x0 && *row[8] == scene.y0 && *row[9] == scene.x1 && *row[10] == scene.y1));
    BOOST_TEST(*read_table(folder / fmt::format("ua{}.csv", frame)).rows.at(0)[2] ==
                   *read_table(folder / fmt::format("pa{}.csv", frame)).rows.at(0)[2] * unit,
               close);
    const auto distances = read_raw_npy<float>(folder / fmt::format("ud{}.npy", frame)).values;
    const auto of_pixels = read_raw_npy<float>(folder / fmt::format("pd{}.npy", frame)).values;
    for (std::size_t i = 0; i < distances.size(); i += 97) {
      const bool none = std::isinf(of_pixels[i]);
      BOOST_TEST((none ? std::isinf(distances[i])
                       : std::abs(distances[i] - of_pixels[i] * unit) <= 0.01 * distances[i]));
    }
  }
  // An image of VTK lies where the data does: from the lower left corner of all boxes.
  succeeds(folder, "render --trajectory t.lammpstrj --width 100 --labels l.vti");
  const std::string vti = content_of(folder / "l.vti");
  BOOST_TEST(vti.find("Origin=\"-5 -5 0\" Spacing=\"0.1 0.1 1\"") != std::string::npos, vti.substr(0, 300));
  // Where pixels are no squares, areas alone have a scale; without bounds nothing has.
  const auto unit_of = [&](const std::string& seeds, const std::string& quantity) {
    return json::parse(run(folder, "render --labels l.npy --json " + seeds).out).at(quantity + "_unit");
  };
  BOOST_TEST(unit_of("--trajectory t.lammpstrj --size 90x30", "area") == "data");
  BOOST_TEST(unit_of("--trajectory t.lammpstrj --size 90x30", "length") == "px");
  BOOST_TEST(unit_of("--random 5 --size 9x9", "area") == "px");
  refuses(folder, "render --labels x.npy --random 5 --size 9x9 --units data", usage,
          {"--units data", "--points"});
}

BOOST_AUTO_TEST_CASE(columns_say_which_lengths_are_in_pixels) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", text_of(stretched(3, 20), "pp pp pp"));
  folder.file("p.csv", "x,y\n1,1\n9,3\n2,8\n");
  const auto header = [&folder](const std::string& name) { return read_table(folder / name).header; };
  const std::string seeds = "cells --points p.csv --bounds 0,0,10,10 --cells c.csv --adjacency a.csv ",
                    some = "--cell-columns area,perimeter,largest_distance ";
  for (const auto& [size, ending] :
       {std::pair{"--size 20x10", "_px"}, {"--size 20x20", ""}, {"--size 20x10 --units px", ""}}) {
    BOOST_TEST_CONTEXT(size) {
      BOOST_TEST(run(folder, seeds + some + size).exit_code == 0);
      BOOST_TEST(header("c.csv") == fmt::format("area,perimeter{0},largest_distance{0}", ending));
      BOOST_TEST(header("a.csv") == fmt::format("a,b,length{}", ending));
      BOOST_TEST(run(folder, fmt::format("tiles --points p.csv --bounds 0,0,10,10 {} --tile 16 --cells t.csv "
                                         "--adjacency b.csv",
                                         size))
                     .exit_code == 0);
      BOOST_TEST(header("t.csv").find(fmt::format(",perimeter{},", ending)) != std::string::npos);
      BOOST_TEST(header("b.csv") == fmt::format("a,b,length{}", ending));
    }
  }
  BOOST_TEST(
      run(folder, "simulate --trajectory t.lammpstrj --size 90x30 --cells c.csv --adjacency a%d.csv " + some)
          .exit_code == 0);
  BOOST_TEST(header("c.csv") == "frame,timestep,area,perimeter_px,largest_distance_px");
  BOOST_TEST(header("a1.csv") == "a,b,length_px");
}

BOOST_AUTO_TEST_CASE(one_frame_has_its_own_box_and_a_fitted_film_too) {
  const TemporaryFolder folder;
  const std::vector<Scene> scenes = stretched(3, 20);
  folder.file("t.lammpstrj", text_of(scenes, "pp pp pp"));
  const Result result =
      run(folder, "simulate --trajectory t.lammpstrj --size 60x60 --fit frame --labels l%d.npy --method jfa");
  BOOST_TEST(result.exit_code == 0);
  // Every frame but the square one has different scales.
  BOOST_TEST(std::count(result.error.begin(), result.error.end(), '\n') == 2, result.error);
  BOOST_TEST(result.error.find("--fit all") != std::string::npos, result.error);
  // The square frame has a scale for lengths: it is not used, because others have none.
  const Result lengths =
      run(folder, "simulate --trajectory t.lammpstrj --size 60x60 --fit frame --frames 1 --json");
  BOOST_TEST(json::parse(lengths.out).at("length_unit") == "px");
  for (const int frame : {0, 1, 2}) {
    run(folder,
        fmt::format("render --trajectory t.lammpstrj --size 60x60 --frame {} --labels f.npy --method jfa",
                    frame));
    BOOST_TEST(labels_of(folder, "f.npy").labels == labels_of(folder, fmt::format("l{}.npy", frame)).labels);
  }
  refuses(folder, "simulate --trajectory t.lammpstrj --width 9 --fit frame --bounds 0,0,1,1 --labels x%d.npy",
          usage, {"--fit", "--bounds"});
  refuses(folder, "simulate --random 3 --size 9x9 --frames 1 --step-length 1 --fit frame --labels x%d.npy",
          usage, {"--fit", "--trajectory"});
}

BOOST_AUTO_TEST_CASE(a_displacement_is_that_between_frames_of_one_grid) {
  const TemporaryFolder folder;
  const Scene wide = {0, 0, 10, 10, {{1, 1}, {9, 9}}}, moved = {0, 0, 10, 10, {{1, 3}, {9, 9}}},
              narrow = {2, 0, 8, 10, {{3, 5}, {7, 5}}};
  const std::string simulate = "simulate --trajectory t.lammpstrj --width 40 --method djfa ";
  const auto displacements = [&](const std::vector<Scene>& scenes) {
    folder.file("t.lammpstrj", text_of(scenes, "pp pp pp"));
    return json::parse(succeeds(folder, simulate + "--json")).at("plans").at("max_displacement");
  };
  const json eight = {{"least", 8.0}, {"greatest", 8.0}}, none = {{"least", nullptr}, {"greatest", nullptr}};
  BOOST_TEST(displacements({wide, moved}) == eight);
  BOOST_TEST(displacements({narrow, wide, moved, narrow}) == eight);
  BOOST_TEST(displacements({wide, narrow, wide}) == none);
  BOOST_TEST(succeeds(folder, simulate).find("waves, no d_max (") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(there_is_nothing_beyond_fixed_sides_and_cells_go_on_beyond_shrink_wrapped_ones) {
  const TemporaryFolder folder;
  const Scene wide = {0, 0, 10, 10, {{1, 1}, {9, 9}}}, narrow = {2, 0, 8, 10, {{3, 5}, {7, 5}}};
  const auto columns = [&](const std::string& flags, const std::string& method) {
    folder.file("t.lammpstrj", text_of({wide, narrow}, flags + " ff pp"));
    succeeds(folder, "simulate --trajectory t.lammpstrj --width 40 --labels l%d.npy --method " + method);
    return labelled_columns(labels_of(folder, "l1.npy"), 20);
  };
  for (const char* method : {"exact", "djfa"}) {
    BOOST_TEST((columns("ff", method) == std::pair(8, 32)));
    BOOST_TEST((columns("pp", method) == std::pair(8, 32)));
    BOOST_TEST((columns("fs", method) == std::pair(8, 40)));
    BOOST_TEST((columns("mf", method) == std::pair(0, 32)));
    BOOST_TEST((columns("ss", method) == std::pair(0, 40)));
  }
  // In a window, too; and a box that is not in it is an error.
  folder.file("t.lammpstrj", text_of({narrow}, "ff ff pp"));
  succeeds(folder, "render --trajectory t.lammpstrj --width 40 --bounds 0,0,10,10 --labels w.npy");
  BOOST_TEST((labelled_columns(labels_of(folder, "w.npy"), 20) == std::pair(8, 32)));
  refuses(folder, "render --trajectory t.lammpstrj --width 40 --bounds 20,0,30,10 --labels x.npy", failure,
          {"t.lammpstrj", "frame 0", "box 2,0,8,10", "outside the bounds 20,0,30,10"});
}

BOOST_AUTO_TEST_CASE(a_pipe_shows_the_box_of_its_first_frame) {
  const TemporaryFolder folder;
  const Scene small = {0, 0, 10, 10, {{2, 2}, {8, 8}}}, large = {-5, -5, 15, 15, {{1, 1}, {9, 9}}};
  folder.file("t.lammpstrj", text_of({small, large}, "pp pp pp"));
  const std::string pipe = "simulate --trajectory /dev/stdin --width 20 --labels l%d.npy ";
  const Result piped = run(folder, pipe, "cat t.lammpstrj |");
  BOOST_TEST(piped.exit_code == 0);
  BOOST_TEST(piped.error.find("frame 1 fills more than the picture") != std::string::npos, piped.error);
  const LabelImage image = labels_of(folder, "l1.npy");
  BOOST_TEST(image.labels.at(380) == 0u);  // (0.25, 0.25)
  BOOST_TEST(image.labels.at(19) == 1u);
  succeeds(folder, "simulate --trajectory t.lammpstrj --width 20 --bounds 0,0,10,10 --labels w%d.npy");
  BOOST_TEST(image.labels == labels_of(folder, "w1.npy").labels);
  const Result flooded = run(folder, pipe + "--method jfa", "cat t.lammpstrj |");
  BOOST_TEST(flooded.exit_code == failure);
  BOOST_TEST(flooded.error.find("only diagrams of the method exact do") != std::string::npos, flooded.error);
}

BOOST_AUTO_TEST_CASE(what_is_left_out_of_the_file_is_said) {
  const TemporaryFolder folder;
  const auto note = [&](const std::string& options, const std::string& part) {
    const Result result = run(folder, "simulate --size 9x9 --labels l%d.npy --trajectory " + options);
    BOOST_TEST(result.exit_code == 0, result.error);
    BOOST_TEST(result.error.find(part) != std::string::npos, result.error);
  };
  folder.file("z.lammpstrj", dump("pp pp pp\n0 10\n0 10\n-2 2", "x y z", {"1 1 -1.5", "2 2 1"}));
  note("z.lammpstrj", "z is left out, along which the particles of frame 0 span 2.5");
  folder.file("zs.lammpstrj", dump("pp pp pp\n0 10\n0 10\n-2 2", "xs ys zs", {"0.1 0.1 0.25", "0.2 0.2 1"}));
  note("zs.lammpstrj", "span 3");
  folder.file("z.xyz", "2\n\nA 0 0 1\nA 1 1 2\n");
  note("z.xyz", "span 1");
  folder.file("flat.lammpstrj", dump(periodic_box, "x y z", {"1 1 0", "2 2 0"}));
  succeeds(folder, "render --size 9x9 --labels l.npy --trajectory flat.lammpstrj");
  note("flat.lammpstrj --periodic x",
       "the periodic axes of the file's box are xy; --periodic x counts instead");
  // Where both axes repeat, a note would be of no use.
  succeeds(folder, "render --size 9x9 --labels l.npy --periodic xy --trajectory flat.lammpstrj");
}

BOOST_AUTO_TEST_CASE(seeds_that_share_a_pixel_are_counted) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", dump(periodic_box, "x y", {"1 1", "1.01 1", "1.02 1", "5 5"}));
  const std::string said = "2 of 4 seeds own no pixel\n";
  for (const char* command : {"render --labels l.npy", "cells --cells c.csv", "simulate --labels l%d.npy"}) {
    const std::string line = std::string(command) + " --snap --size 20x20 --trajectory t.lammpstrj";
    BOOST_TEST(succeeds(folder, line).find(said) != std::string::npos, command);
    BOOST_TEST(json::parse(succeeds(folder, line + " --json")).at("empty_cells") == 2, command);
    // In a window the last one is too far away for a cell.
    const std::string in_window = run(folder, line + " --bounds 0,0,2,2").out;
    BOOST_TEST(
        in_window.find("1 with a cell, 2 inside and 1 outside that own no pixel\n") != std::string::npos,
        in_window);
  }
}

BOOST_AUTO_TEST_CASE(a_box_is_compared_with_where_it_is) {
  const TemporaryFolder folder;
  const Scene part = {2, 0, 7, 6, {{3, 1}, {6, 5}, {4, 4}}};
  folder.file("t.lammpstrj", text_of({part}, "pp ff pp"));
  const std::string window = "--trajectory t.lammpstrj --bounds 0,0,10,7.5 ";
  succeeds(folder, "render --width 40 --method jfa --labels l.npy " + window);
  const json result = json::parse(succeeds(folder, "compare l.npy --json " + window));
  BOOST_TEST(result.at("similarity").get<double>() > 99);
  BOOST_TEST(result.at("pixels") == 40 * 30);
  refuses(folder, "relax --width 40 --rounds 2 --labels x.npy " + window, failure, {"relax", "box"});
  refuses(folder, "render --width 40 --labels x.npy --trajectory t.lammpstrj --bounds 0,0,1000,1000", failure,
          {"t.lammpstrj", "frame 0", "period in x is 5, less than a pixel"});
}
