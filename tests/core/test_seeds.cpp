// Seeds: snapping, the caller's buffer, masks, and random numbers against the published known answers.
#define BOOST_TEST_MODULE seeds
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

cl::Buffer buffer_of(const std::vector<cl_float2>& values) {
  return cl::Buffer(test_device().queue(), values.begin(), values.end(), true);
}

/// Philox-4x32-10 as published (Salmon et al. 2011), in 64-bit products: another form than the kernel's.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xd2511f53} * c[0], p1 = std::uint64_t{0xcd9e8d57} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k = {k[0] + 0x9e3779b9u, k[1] + 0xbb67ae85u};
  }
  return c;
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_are_snapped_to_the_pixel_that_contains_them) {
  const Seeds seeds(test_device(), Grid(10, 8), {{0, 0}, {9.999, 7.999}, {3.0, 2.999}, {0.5, 5}});
  const std::vector<Point> centres = points_of(seeds);
  const std::vector<Point> expected = {{0.5, 0.5}, {9.5, 7.5}, {3.5, 2.5}, {0.5, 5.5}};
  BOOST_REQUIRE(centres.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    BOOST_TEST(centres[i].x == expected[i].x);
    BOOST_TEST(centres[i].y == expected[i].y);
  }
}

BOOST_AUTO_TEST_CASE(bad_points_are_named) {
  const Grid grid(10, 8);
  const auto seeds_with = [&](Point bad) { Seeds(test_device(), grid, {{1, 1}, {2, 2}, bad, bad}); };
  check_error([&] { seeds_with({not_a_number, 1}); }, {"point 2", "nan", "not finite"});
  check_error([&] { seeds_with({1, infinity}); }, {"point 2", "inf", "not finite"});
  check_error([&] { seeds_with({1e300, 1}); }, {"point 2", "too far away", "2^31"});
  BOOST_CHECK_NO_THROW(seeds_with({10, 1}));  // a window of a larger plane: see test_window
}

BOOST_AUTO_TEST_CASE(points_in_the_callers_buffer) {
  const Grid grid(300, 200);
  std::vector<cl_float2> values = {
      {{0, 0}}, {{-0.f, 5}}, {{std::nextafter(300.f, 0.f), std::nextafter(200.f, 0.f)}}};
  for (const Pixel& pixel : random_pixels(grid, 1000, 3)) {
    values.push_back({{static_cast<float>(pixel.x) + 0.75f, static_cast<float>(pixel.y) + 0.25f}});
  }
  const Seeds seeds(test_device(), grid, buffer_of(values), values.size());
  const std::vector<Point> read = points_of(seeds);
  BOOST_REQUIRE(read.size() == values.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    BOOST_TEST(read[i].x == std::floor(values[i].s[0]) + 0.5);
    BOOST_TEST(read[i].y == std::floor(values[i].s[1]) + 0.5);
  }
}

BOOST_AUTO_TEST_CASE(bad_points_in_the_callers_buffer_are_reported_at_the_next_wait) {
  const Grid grid(30, 20);
  std::vector<cl_float2> values(100, {{5, 5}});
  values[70] = {{-1, 0}};
  values[41] = {{3, static_cast<float>(not_a_number)}};
  const Seeds seeds(test_device(), grid, buffer_of(values), values.size());
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  check_error([&] { diagram.read(); }, {"point 41", "nan"});
  check_error([&] { seeds.read(); }, {"point 41", "nan"});
  const float next_to_none = -std::numeric_limits<float>::min();
  for (const cl_float2 beside : {cl_float2{{30, 1}}, {{1, 20}}, {{next_to_none, 1}}, {{1, next_to_none}}}) {
    check_error([&] { Seeds(test_device(), grid, buffer_of({beside}), 1).read(); }, {"point 0"});
  }
}

// Whatever was made from the bad frame throws, and nothing that was made from a good one.
BOOST_AUTO_TEST_CASE(a_bad_point_is_an_error_of_its_frame) {
  const Grid grid(30, 20);
  const std::vector<cl_float2> good = {{{1, 1}}, {{2, 9}}, {{3, 3}}}, bad = {{{1, 1}}, {{2, 99}}, {{3, 3}}};
  Seeds seeds(test_device(), grid, buffer_of(bad), 3);
  Diagram of_bad(test_device(), grid), of_good(test_device(), grid);
  exact_diagram(seeds, of_bad);
  CellSumsResult sums_of_bad, sums_of_good;
  cell_sums(seeds, of_bad, sums_of_bad);
  seeds.move_to(buffer_of(good), 3);
  exact_diagram(seeds, of_good);
  cell_sums(seeds, of_good, sums_of_good);
  seeds.move_to(buffer_of({{{-7, 4}}, {{5, 5}}, {{6, 6}}}), 3);
  check_error([&] { seeds.read(); }, {"point 0", "-7"});

  of_good.wait();
  BOOST_TEST(sums_of_good.read().size() == 3u);
  for (int wait = 0; wait < 2; ++wait) {
    check_error([&] { of_bad.wait(); }, {"point 1", "99"});
    check_error([&] { of_bad.read(); }, {"point 1", "99"});
    check_error([&] { sums_of_bad.read(); }, {"point 1", "99"});
  }
  seeds.move_to(buffer_of(good), 3);
  exact_diagram(seeds, of_bad);
  BOOST_TEST((of_bad.read() == of_good.read()));
  BOOST_TEST(points_of(seeds)[1].y == 9.5);

  try {
    Seeds(test_device(), grid, buffer_of(bad), 3).check();
    BOOST_ERROR("nothing was thrown");
  } catch (const BadPoint& error) {
    BOOST_TEST(error.index() == 1u);
    BOOST_TEST(error.point().y == 99.0);
    BOOST_TEST((error.kind() == ErrorKind::bad_point));
  }
}

// Seeds of a good frame are no help where the diagram is of a bad one.
BOOST_AUTO_TEST_CASE(a_bad_point_reaches_all_measures_of_its_diagram) {
  const Grid grid(30, 20);
  Seeds seeds(test_device(), grid, buffer_of({{{1, 1}}, {{2, 99}}}), 2);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  seeds.move_to({{1, 1}, {2, 9}});
  CellSumsResult sums;
  CellShapesResult shapes;
  Field<float> distances;
  Field<std::uint8_t> mask;
  cell_sums(seeds, diagram, sums);
  cell_shapes(seeds, diagram, shapes);
  distance_field(seeds, diagram, distances);
  border_mask(diagram, mask);
  exact_diagram(seeds, diagram);  // what was measured stays bad
  check_error([&] { sums.read(); }, {"point 1", "99"});
  check_error([&] { cell_statistics(sums); }, {"point 1", "99"});
  check_error([&] { shapes.read(); }, {"point 1", "99"});
  check_error([&] { distances.read(); }, {"point 1", "99"});
  check_error([&] { mask.read(); }, {"point 1", "99"});
  border_mask(diagram, mask);
  BOOST_TEST(mask.read().size() == grid.pixels());
}

// dJFA goes on from labels: not from those that a bad point may have left holes in.
BOOST_AUTO_TEST_CASE(a_frame_after_a_bad_one_is_a_fresh_diagram) {
  const Grid grid(64, 64);
  const std::vector<cl_float2> good = {{{1, 1}}, {{60, 60}}};
  Seeds seeds(test_device(), grid, buffer_of(good), 2);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram, 0);
  seeds.move_to(buffer_of({{{1, 1}}, {{99, 60}}}), 2);
  dynamic_jump_flooding(seeds, diagram, 1);
  seeds.move_to(buffer_of(good), 2);
  const Report report = dynamic_jump_flooding(seeds, diagram, 1);
  BOOST_TEST(report.waves() == static_cast<int>(jump_flooding_plan(grid).size()));
  BOOST_TEST((diagram.read() == brute_force(grid, {{1, 1}, {60, 60}}, Metric::euclidean)));
}

BOOST_AUTO_TEST_CASE(points_in_braces) {
  const Grid grid(20, 10);
  BOOST_TEST(Seeds(test_device(), grid, {}).size() == 0u);
  BOOST_TEST(Seeds(test_device(), grid, {Point{1, 1}, Point{2, 2}}).alive() == 2u);
  BOOST_TEST(Seeds(test_device(), grid, {Point{1, 1}, std::nullopt}).alive() == 1u);
  Seeds seeds(test_device(), grid, {{1, 1}, {2, 2}, {3, 3}});
  seeds.move_to(std::vector<Point>{{4, 4}, {5, 5}});
  BOOST_TEST(points_of(seeds)[1].x == 5.5);
  seeds.move_to({{6, 6}});
  BOOST_TEST(points_of(seeds).front().x == 6.5);
  seeds.move_to({Point{7, 7}, Point{8, 8}});
  BOOST_TEST(seeds.alive() == 2u);
  seeds.move_to({Point{7, 7}, std::nullopt});
  BOOST_TEST(seeds.alive() == 1u);
  seeds.move_to({});
  BOOST_TEST(seeds.size() == 0u);
}

// The three ways to say that a seed is absent.
BOOST_AUTO_TEST_CASE(absent_seeds) {
  const Grid grid(20, 10);
  const std::vector<std::optional<Point>> points = {Point{3, 4}, std::nullopt, Point{15, 5}, std::nullopt};
  const Seeds constructed(test_device(), grid, points);
  Seeds moved(test_device(), grid, std::vector<Point>{{1, 1}, {2, 2}, {3, 3}, {4, 4}});
  moved.move_to(points);
  const std::vector<cl_float2> values = {{{3, 4}}, {{-1, 0}}, {{15, 5}}, {{1, 1}}};
  const std::vector<cl_uchar> marks = {1, 0, 255, 0};
  const cl::Buffer present(test_device().queue(), marks.begin(), marks.end(), true);
  const Seeds in_buffers(test_device(), grid, buffer_of(values), 4, present);
  for (const Seeds* const seeds : std::initializer_list<const Seeds*>{&constructed, &moved, &in_buffers}) {
    BOOST_TEST(seeds->size() == 4u);
    BOOST_TEST(seeds->alive() == 2u);
    const auto read = seeds->read();
    for (std::size_t id = 0; id < 4; ++id) {
      BOOST_REQUIRE(read[id].has_value() == points[id].has_value());
      if (read[id]) BOOST_TEST(read[id]->x == points[id]->x + 0.5);
    }
    Diagram diagram(test_device(), grid);
    exact_diagram(*seeds, diagram);
    CellSumsResult sums;
    cell_sums(*seeds, diagram, sums);
    BOOST_TEST(cell_statistics(sums).cells == 2u);
    BOOST_TEST(cell_statistics(sums).empty_cells == 0u);
    BOOST_TEST(sums.read()[1].area == 0u);
  }
  const cl::Buffer few(test_device().context(), CL_MEM_READ_WRITE, 3);
  check_error([&] { Seeds(test_device(), grid, buffer_of(values), 4, few); },
              {"4 seeds are present", "3 bytes"});
}

BOOST_AUTO_TEST_CASE(a_clone_moves_on_its_own) {
  const Grid grid(20, 10);
  const std::vector<std::optional<Point>> points = {Point{3, 4}, std::nullopt, Point{15, 5}};
  Seeds seeds(test_device(), grid, points);
  Seeds copy = seeds.clone();
  seeds.move_to({Point{1, 1}, Point{2, 2}, Point{3, 3}, Point{4, 4}});
  random_step(seeds, 3, Border::reflect, 1, 1);
  BOOST_TEST(copy.size() == 3u);
  BOOST_TEST(copy.alive() == 2u);
  BOOST_TEST(copy.read()[2]->x == 15.5);
  copy.move_to({Point{9, 9}});
  BOOST_TEST(seeds.alive() == 4u);
  const Seeds taken = std::move(seeds);
  BOOST_TEST(taken.size() == 4u);
  // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  check_error([&] { seeds.size(); }, {"moved from"});
}

BOOST_AUTO_TEST_CASE(unfit_buffers_are_refused) {
  const Grid grid(30, 20);
  check_error([&] { Seeds(test_device(), grid, cl::Buffer(), 1); }, {"null"});
  const cl::Buffer small = buffer_of(std::vector<cl_float2>(9));
  check_error([&] { Seeds(test_device(), grid, small, 10); }, {"10 points", "72 bytes", "80 are needed"});
  const Device other = Device::select();
  check_error([&] { Seeds(other, grid, small, 9); }, {"another OpenCL context"});
}

BOOST_AUTO_TEST_CASE(a_mask_gives_ids_in_row_major_order) {
  const Grid grid(4, 3);
  const Seeds seeds = Seeds::from_mask(test_device(), grid, {0, 1, 0, 0, 9, 0, 0, 255, 0, 0, 1, 0});
  const std::vector<Point> read = points_of(seeds);
  const std::vector<Point> expected = {{1.5, 0.5}, {0.5, 1.5}, {3.5, 1.5}, {2.5, 2.5}};
  BOOST_REQUIRE(read.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    BOOST_TEST(read[i].x == expected[i].x);
    BOOST_TEST(read[i].y == expected[i].y);
  }
  check_error([&] { Seeds::from_mask(test_device(), grid, {1, 0}); }, {"2 pixels", "12"});
}

BOOST_AUTO_TEST_CASE(philox_has_its_published_answers) {
  // From the known-answer vectors of Random123, the authors' reference library.
  const auto expect = [](std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                         std::array<std::uint32_t, 4> answer) { BOOST_TEST(philox(counter, key) == answer); };
  expect({0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  expect({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  expect({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

BOOST_AUTO_TEST_CASE(random_seeds_are_philox_numbers) {
  const Grid grid(1000, 37);
  const std::uint64_t rng_seed = 0x123456789abcdef0;
  const std::vector<Point> read = points_of(Seeds::random(test_device(), grid, 5000, rng_seed));
  for (std::uint32_t id = 0; id < read.size(); ++id) {
    const auto bits = philox({id, 0, 0, 0}, {0x9abcdef0, 0x12345678});
    BOOST_REQUIRE(read[id].x == static_cast<double>((bits[0] * std::uint64_t{1000}) >> 32) + 0.5);
    BOOST_REQUIRE(read[id].y == static_cast<double>((bits[1] * std::uint64_t{37}) >> 32) + 0.5);
  }
}

BOOST_AUTO_TEST_CASE(random_seeds_are_uniform) {
  // Chi-squared over 8 x 8 blocks: 63 degrees of freedom, and 103.4 is passed by one run in a thousand.
  const Grid grid(512, 512);
  const std::size_t count = 64000;
  std::array<double, 64> blocks{};
  for (const Point& point : points_of(Seeds::random(test_device(), grid, count, 7))) {
    blocks[static_cast<std::size_t>(point.y / 64) * 8 + static_cast<std::size_t>(point.x / 64)] += 1;
  }
  double chi_squared = 0;
  for (const double block : blocks) chi_squared += (block - 1000) * (block - 1000) / 1000;
  BOOST_TEST(chi_squared < 103.4);
  BOOST_TEST(chi_squared > 30.0);  // and not suspiciously even either
}
