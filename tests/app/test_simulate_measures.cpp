// What vorocl simulate measures of each frame: tables of cells and pairs, distances, statistics, collections.
#define BOOST_TEST_MODULE simulate_measures
#include <fmt/format.h>

#include <regex>
#include <sstream>

#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;

namespace {

LabelledGrid labels_of(const TemporaryFolder& folder, const std::string& name, Axes axes = Axes::none) {
  return on_grid(command::read_labels(folder / name), axes);
}

/// The statistics of labels, with the pixels that changed since those before.
TableRow statistics_on_host(int frame, const LabelledGrid& image, const std::optional<LabelledGrid>& before,
                            const SeedsById& seeds) {
  std::map<std::uint32_t, double> areas;
  each_pixel(image.grid, image.labels, [&](std::uint32_t label, const Pixel&) { ++areas[label]; });
  const auto cells = static_cast<double>(seeds.size());
  const double mean = static_cast<double>(image.grid.pixels()) / cells;
  double variance = 0;
  for (const auto& seed : seeds) {
    const double area = areas.count(seed.first) > 0 ? areas[seed.first] : 0;
    variance += (area - mean) * (area - mean) / cells;
  }
  std::optional<double> changed;
  if (before) {
    changed = 0;
    for (std::size_t i = 0; i < image.labels.size(); ++i)
      *changed += image.labels[i] != before->labels[i] ? 1 : 0;
  }
  TableRow row = {frame,  cells, cells - static_cast<double>(areas.size()), mean, std::sqrt(variance),
                  changed};
  row.resize(12);
  std::map<double, double> with;  // so many neighbours
  for (const TableRow& cell : cells_on_host(image, seeds, Metric::euclidean)) {
    if (*cell[3] > 0) with[*cell[11]] += 1 / static_cast<double>(areas.size());
  }
  for (const int neighbours : {3, 4, 5, 6, 7, 8, 9}) row.emplace_back(with[neighbours]);
  return row;
}

void check_statistics(const TableRow& row, const TableRow& expected) {
  BOOST_TEST_REQUIRE(row.size() == 19u);
  for (const std::size_t exact : {0u, 1u, 2u, 5u})
    BOOST_TEST((row[exact] == expected[exact]), "column " << exact);
  for (const std::size_t near : {3u, 4u}) {
    BOOST_TEST(row[near].value() == expected[near].value(), boost::test_tools::tolerance(1e-9));
  }
  BOOST_TEST(row[6].value() > 0);
  for (std::size_t share = 12; share < row.size(); ++share) {
    BOOST_TEST(std::abs(row[share].value() - expected[share].value()) < 1e-9, "column " << share);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_kth_frame_is_measured_and_every_frame_counted) {
  const TemporaryFolder folder;
  succeeds(
      folder,
      "simulate --random 120 --size 90x70 --frames 6 --step-length 4 --method djfa --metric manhattan "
      "--every 3 "
      "--cells f/c%d.csv --adjacency f/a%02d.csv --distance f/d%d.npy --labels f/l%d.npy --statistics s.csv");
  succeeds(folder,
           "simulate --random 120 --size 90x70 --frames 6 --step-length 4 --method djfa --metric manhattan "
           "--labels all%d.npy");
  const Grid grid(90, 70);
  Seeds moving = Seeds::random(test_device(), grid, 120, 1);
  const Table table = read_table(folder / "s.csv");
  BOOST_TEST(table.header ==
             "frame,cells,empty_cells,mean_area,area_deviation,changed_pixels,milliseconds,"
             "box_x0,box_y0,box_x1,box_y1,timestep,neighbours_3,neighbours_4,neighbours_5,neighbours_6,"
             "neighbours_7,neighbours_8,neighbours_9");
  BOOST_TEST_REQUIRE(table.rows.size() == 7u);
  std::optional<LabelledGrid> before;
  for (int frame = 0; frame <= 6; ++frame) {
    if (frame > 0) random_step(moving, 4, Border::reflect, 1, static_cast<std::uint32_t>(frame));
    SeedsById seeds;
    for (const Point& seed : points_of(moving)) {
      seeds[static_cast<std::uint32_t>(seeds.size())] = {static_cast<int>(seed.x), static_cast<int>(seed.y)};
    }
    const LabelledGrid image = labels_of(folder, fmt::format("all{}.npy", frame));
    check_statistics(table.rows[static_cast<std::size_t>(frame)],
                     statistics_on_host(frame, image, before, seeds));
    before = image;
    const std::string cells = fmt::format("f/c{}.csv", frame);
    BOOST_TEST(std::filesystem::exists(folder / cells) == (frame % 3 == 0));
    if (frame % 3 != 0) continue;
    BOOST_TEST(labels_of(folder, fmt::format("f/l{}.npy", frame)).labels == image.labels);
    check_cells_table(folder / cells, image, seeds, Metric::manhattan);
    check_adjacency_table(folder / fmt::format("f/a{:02}.csv", frame), image);
    const auto distances = read_raw_npy<float>(folder / fmt::format("f/d{}.npy", frame));
    BOOST_TEST(wrong_distances(image, distances.values, seeds, Metric::manhattan) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_table_without_a_number_in_its_name_is_one_of_all_frames) {
  const TemporaryFolder folder;
  const std::string frames_1_and_3 =
      "simulate --trajectory '" VOROCL_SAMPLES "/lj-melt.lammpstrj' --width 80 --frames 3 --every 2 ";
  succeeds(folder, frames_1_and_3 + "--cells c%d.csv --adjacency a%d.csv");
  succeeds(folder, frames_1_and_3 + "--cells c.csv --adjacency a.csv");
  std::vector<command::Frame> frames;
  command::read_frames(VOROCL_SAMPLES "/lj-melt.lammpstrj", frames);
  for (const std::string name : {"c", "a"}) {
    std::string expected;
    for (const std::size_t frame : {std::size_t{0}, std::size_t{2}}) {
      std::istringstream of_frame(content_of(folder / fmt::format("{}{}.csv", name, frame)));
      std::string line;
      std::getline(of_frame, line);
      if (expected.empty()) expected = "frame,timestep," + line + "\n";
      while (std::getline(of_frame, line)) {
        expected += fmt::format("{},{},{}\n", frame, frames[frame].timestep.value(), line);
      }
    }
    BOOST_TEST(content_of(folder / name + ".csv") == expected);
  }
  refuses(folder, frames_1_and_3 + "--cells t.csv --adjacency t.csv", usage, {"--cells", "--adjacency"});
  refuses(folder, frames_1_and_3 + "--labels l.npy", usage, {"l.npy", "%05d.npy"});
}

// Frames are written while later ones are made: each file is that of a run which makes its frame alone.
BOOST_AUTO_TEST_CASE(each_frame_is_written_as_it_is_alone) {
  const TemporaryFolder folder, alone;
  const std::string melt = "--trajectory " VOROCL_SAMPLES "/lj-melt.lammpstrj --width 400 ",
                    picture = " --color area --scale 0,2 --edges --points-overlay";
  const int frames = 3;
  run(folder,
      fmt::format("simulate {} --frames {} --labels l%d.npy --cells c%d.csv --adjacency a%d.csv --distance "
                  "d%d.vti -o p%d.png {}",
                  melt, frames, picture));
  BOOST_TEST(folder.names().size() == 5u * (frames + 1) + 1);
  for (int frame = 0; frame <= frames; ++frame) {
    const std::string of_frame = fmt::format("{} --frame {} ", melt, frame);
    run(alone,
        fmt::format("cells {} --labels l{frame}.npy --cells c{frame}.csv --adjacency a{frame}.csv --distance "
                    "d{frame}.vti",
                    of_frame, fmt::arg("frame", frame)));
    run(alone, fmt::format("render {} -o p{}.png {}", of_frame, frame, picture));
  }
  for (const std::string& name : alone.names())
    BOOST_TEST((content_of(folder / name) == content_of(alone / name)), name);
  BOOST_TEST(alone.names().size() == 5u * (frames + 1));
}

BOOST_AUTO_TEST_CASE(collections_have_the_time_steps_of_the_trajectory) {
  const TemporaryFolder folder;
  const std::string trajectory =
      "simulate --trajectory '" VOROCL_SAMPLES
      "/lj-melt.lammpstrj' --units px --width 80 --method jfa --frames 5 --every 2 ";
  succeeds(folder, trajectory + "--labels f/%03d.vti --distance f/d_%d.vti --statistics s.csv");
  succeeds(folder, trajectory + "--labels l%d.npy --distance d%d.npy");
  BOOST_TEST((folder.names() == std::set<std::string>{"f", "s.csv", "l0.npy", "l2.npy", "l4.npy", "d0.npy",
                                                      "d2.npy", "d4.npy"}));
  std::vector<command::Frame> frames;
  command::read_frames(VOROCL_SAMPLES "/lj-melt.lammpstrj", frames);
  const std::string labels = content_of(folder / "f/labels.pvd"), distances = content_of(folder / "f/d.pvd");
  for (const std::size_t frame : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
    const std::string entry =
        fmt::format("timestep=\"{}\"[^>]*file=\"([^\"]*)\"", frames[frame].timestep.value());
    BOOST_TEST(found_in(labels, entry) == fmt::format("{:03}.vti", frame));
    BOOST_TEST(found_in(distances, entry) == fmt::format("d_{}.vti", frame));
    BOOST_TEST(read_raw_vti<std::uint32_t>(folder / fmt::format("f/{:03}.vti", frame)).values ==
               labels_of(folder, fmt::format("l{}.npy", frame)).labels);
    BOOST_TEST(read_raw_vti<float>(folder / fmt::format("f/d_{}.vti", frame)).values ==
               read_raw_npy<float>(folder / fmt::format("d{}.npy", frame)).values);
  }
  const std::regex entry("<DataSet");
  BOOST_TEST(std::distance(std::sregex_iterator(labels.begin(), labels.end(), entry), {}) == 3);
  BOOST_TEST(read_table(folder / "s.csv").rows.size() == 6u);
}

BOOST_AUTO_TEST_CASE(without_time_steps_collections_count_frames) {
  const TemporaryFolder folder;
  succeeds(folder,
           "simulate --random 5 --size 9x9 --frames 2 --step-length 1 --method jfa --labels l-%d.vti");
  const std::string content = content_of(folder / "l.pvd");
  for (const char* frame : {"0", "1", "2"}) {
    BOOST_TEST(found_in(content, fmt::format("timestep=\"{}\"[^>]*file=\"([^\"]*)\"", frame)) ==
               fmt::format("l-{}.vti", frame));
  }
}

BOOST_AUTO_TEST_CASE(particles_on_one_pixel_have_a_row_each) {
  const TemporaryFolder folder;
  // 3 is new in the second frame and meets 5 and 8, whose slots are lower; in the third they part, and 9 is
  // gone.
  const std::vector<SeedsById> frames = {{{5, {1, 1}}, {8, {5, 5}}, {9, {16, 1}}},
                                         {{3, {2, 2}}, {5, {2, 2}}, {8, {2, 2}}, {9, {16, 1}}},
                                         {{3, {3, 12}}, {5, {2, 2}}, {8, {8, 8}}}};
  std::string text;
  for (const SeedsById& seeds : frames) {
    std::vector<std::string> rows;
    rows.reserve(seeds.size());
    for (const auto& [id, pixel] : seeds) {
      rows.push_back(fmt::format("{} {} {}", id, centre(pixel).x / 2, centre(pixel).y / 2));
    }
    text += command::dump(command::periodic_box, "id x y", rows);
  }
  folder.file("t.lammpstrj", text);
  succeeds(folder,
           "simulate --trajectory t.lammpstrj --y-down --units px --size 20x20 --method djfa --labels "
           "l%d.npy --cells "
           "c%d.csv "
           "--adjacency a%d.csv --distance d%d.npy --statistics s.csv");
  const Table table = read_table(folder / "s.csv");
  BOOST_TEST_REQUIRE(table.rows.size() == frames.size());
  std::optional<LabelledGrid> before;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const LabelledGrid image = labels_of(folder, fmt::format("l{}.npy", i), Axes::xy);
    check_cells_table(folder / fmt::format("c{}.csv", i), image, frames[i], Metric::euclidean);
    check_adjacency_table(folder / fmt::format("a{}.csv", i), image);
    check_statistics(table.rows[i], statistics_on_host(static_cast<int>(i), image, before, frames[i]));
    before = image;
  }
  const std::vector<std::uint32_t> labels = labels_of(folder, "l1.npy").labels;
  BOOST_TEST(labels[2 * 20 + 2] == 3u);
}

BOOST_AUTO_TEST_CASE(bad_outputs_are_refused_before_the_work) {
  const TemporaryFolder folder;
  const std::string simulate =
      "simulate --random 5 --size 10x10 --frames 3 --step-length 1 --method djfa --device none ";
  refuses(folder, simulate + "--distance d.npy", usage, {"d.npy", "%05d.npy"});
  refuses(folder, simulate + "--labels f/l.vti", usage, {"f/l.vti", "%05d.vti"});
  refuses(folder, simulate + "--cells c%d.txt", usage, {"c%d.txt", ".csv"});
  refuses(folder, simulate + "--adjacency a%d.npy", usage, {"a%d.npy", ".csv"});
  refuses(folder, simulate + "--distance d%d.png", usage, {"d%d.png", ".npy, .tif, .tiff, .vti"});
  refuses(folder, simulate + "--statistics s.txt", usage, {"s.txt", ".csv"});
  refuses(folder, simulate + "--statistics missing/s.csv", failure, {"missing/s.csv", "does not exist"});
  refuses(folder, simulate + "--distance new/%d.vti --statistics /proc/s.csv", failure, {"/proc/s.csv"});
  refuses(folder, simulate + "--cells /proc/c%d.csv", failure, {"/proc/c0.csv", "cannot write"});
  refuses(folder, simulate + "--cells a%d.csv --adjacency a%05d.csv", usage, {"--cells and --adjacency"});
  refuses(folder, simulate + "--labels a%d.tif -o a%d.tif", usage, {"--labels and -o"});
  refuses(folder, simulate + "--cells a%d.csv --statistics a12.csv", usage, {"--cells and --statistics"});
  refuses(folder, simulate + "--labels a%d.vti --distance a_%d.vti", usage,
          {"a.pvd", "--labels and --distance"});
  refuses(folder, simulate + "--compare-with jfa --similarity s.csv --statistics s.csv", usage,
          {"s.csv", "--similarity and --statistics"});
}
