// Points and masks in the caller's buffers: what is bad about them is an error of their frame, at every wait.
#define BOOST_TEST_MODULE point_buffers
#include <cmath>
#include <limits>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"

using namespace vorocl;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

template <typename T>
cl::Buffer buffer_of(const std::vector<T>& values) {
  return cl::Buffer(test_device().queue(), values.begin(), values.end(), true);
}

/// A buffer of points in floats.
PointBuffer points_in(const std::vector<cl_float2>& values) { return {buffer_of(values), values.size()}; }

PointBuffer in_doubles(const std::vector<Point>& points) {
  const auto values = transformed(points, [](const Point& p) { return cl_double2{{p.x, p.y}}; });
  return {buffer_of(values), values.size(), PointFormat::doubles_xy};
}

PointBuffer in_floats(const std::vector<Point>& points) {
  return points_in(transformed(points, [](const Point& p) {
    return cl_float2{{static_cast<float>(p.x), static_cast<float>(p.y)}};
  }));
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_in_the_callers_buffer) {
  const Grid grid(300, 200);
  std::vector<cl_float2> values = {
      {{0, 0}}, {{-0.f, 5}}, {{std::nextafter(300.f, 0.f), std::nextafter(200.f, 0.f)}}};
  for (const Pixel& pixel : random_pixels(grid, 1000, 3)) {
    values.push_back({{static_cast<float>(pixel.x) + 0.75f, static_cast<float>(pixel.y) + 0.25f}});
  }
  const Seeds seeds(test_device(), grid, points_in(values), kept_on_device);
  const std::vector<Point> read = centres_of(seeds);
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
  const Seeds seeds(test_device(), grid, points_in(values), kept_on_device);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  check_error([&] { diagram.read(); }, {"point 41", "nan"});
  check_error([&] { seeds.read(); }, {"point 41", "nan"});
  const float next_to_none = -std::numeric_limits<float>::min();
  for (const cl_float2 beside : {cl_float2{{30, 1}}, {{1, 20}}, {{next_to_none, 1}}, {{1, next_to_none}}}) {
    check_error([&] { Seeds(test_device(), grid, points_in({beside}), kept_on_device).read(); }, {"point 0"});
  }
}

// Whatever was made from the bad frame throws, and nothing that was made from a good one.
BOOST_AUTO_TEST_CASE(a_bad_point_is_an_error_of_its_frame) {
  const Grid grid(30, 20);
  const std::vector<cl_float2> good = {{{1, 1}}, {{2, 9}}, {{3, 3}}}, bad = {{{1, 1}}, {{2, 99}}, {{3, 3}}};
  Seeds seeds(test_device(), grid, points_in(bad), kept_on_device);
  Diagram of_bad(test_device(), grid), of_good(test_device(), grid);
  exact_diagram(seeds, of_bad);
  CellSumsResult sums_of_bad, sums_of_good;
  cell_sums(of_bad, sums_of_bad);
  seeds.move_to(points_in(good));
  exact_diagram(seeds, of_good);
  cell_sums(of_good, sums_of_good);
  seeds.move_to(points_in({{{-7, 4}}, {{5, 5}}, {{6, 6}}}));
  check_error([&] { seeds.read(); }, {"point 0", "-7"});

  of_good.wait();
  BOOST_TEST(sums_of_good.read().size() == 3u);
  for (int wait = 0; wait < 2; ++wait) {
    check_error([&] { of_bad.wait(); }, {"point 1", "99"});
    check_error([&] { of_bad.read(); }, {"point 1", "99"});
    check_error([&] { sums_of_bad.read(); }, {"point 1", "99"});
  }
  seeds.move_to(points_in(good));
  exact_diagram(seeds, of_bad);
  BOOST_TEST((of_bad.read() == of_good.read()));
  BOOST_TEST(centres_of(seeds)[1].y == 9.5);

  try {
    Seeds(test_device(), grid, points_in(bad), kept_on_device).check();
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
  Seeds seeds(test_device(), grid, points_in({{{1, 1}}, {{2, 99}}}), kept_on_device);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  seeds.move_to({{1, 1}, {2, 9}});
  CellSumsResult sums;
  CellShapesResult shapes;
  Field<float> distances;
  Field<std::uint8_t> mask;
  cell_sums(diagram, sums);
  cell_shapes(diagram, shapes);
  distance_field(diagram, distances);
  border_mask(diagram, mask);
  exact_diagram(seeds, diagram);  // what was measured stays bad
  check_error([&] { sums.read(); }, {"point 1", "99"});
  CellStatisticsResult statistics;
  cell_statistics(sums, statistics);
  check_error([&] { statistics.read(); }, {"point 1", "99"});
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
  Seeds seeds(test_device(), grid, points_in(good), kept_on_device);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram);
  seeds.move_to(points_in({{{1, 1}}, {{99, 60}}}));
  dynamic_jump_flooding(seeds, diagram);
  seeds.move_to(points_in(good));
  const Report report = dynamic_jump_flooding(seeds, diagram);
  BOOST_TEST(report.waves() == static_cast<int>(jump_flooding_plan(grid).size()));
  BOOST_TEST((diagram.read() == brute_force(grid, {{1, 1}, {60, 60}}, Metric::euclidean)));
}

BOOST_AUTO_TEST_CASE(marks_say_which_seeds_are_there) {
  const Grid grid(20, 10);
  const cl::Buffer present = buffer_of(std::vector<cl_uchar>{1, 0, 255, 0, 1});
  const std::vector<Point> points = {{3, 4}, {-1, 0}, {15, 5}, {1, 1}, {3, 9}};
  for (PointBuffer marked : {in_floats(points), in_doubles(points)}) {
    marked.present = present;
    Seeds moved(test_device(), grid, {{1, 1}}, to_centres);
    moved.move_to(marked);
    const Seeds constructed(test_device(), grid, marked, kept_on_device);
    for (const Seeds* const seeds : {&constructed, &std::as_const(moved)}) {
      BOOST_TEST(seeds->size() == 5u);
      BOOST_TEST(seeds->alive() == 3u);
      const auto read = seeds->read_pixels();
      for (const std::size_t id : {0u, 2u, 4u}) BOOST_TEST(read[id].value().x == points[id].x + 0.5);
      BOOST_TEST(!read[1].has_value());
      BOOST_TEST(!read[3].has_value());
      Diagram diagram(test_device(), grid);
      exact_diagram(*seeds, diagram);
      BOOST_TEST(statistics_of(diagram).cells == 3u);
      BOOST_TEST(statistics_of(diagram).empty_cells == 0u);
      BOOST_TEST(sums_of(diagram)[1].area == 0u);
    }
  }
  const cl::Buffer few(test_device().context(), CL_MEM_READ_WRITE, 3);
  check_error(
      [&] {
        Seeds(test_device(), grid, {buffer_of(std::vector<cl_float2>(4)), 4, PointFormat::floats_xy, few},
              kept_on_device);
      },
      {"4 seeds are present", "3 bytes"});
}

// On the device as on the host, whatever the units.
BOOST_AUTO_TEST_CASE(points_outside_the_grid) {
  std::mt19937 rng(5);
  for (const Grid& grid : {Grid(20, 10), Grid(20, 10, Axes::x), Grid(20, 10, Axes::xy),
                           Grid(Axis(20, -1, 9).periodic(), Axis(10, 0, 5).reversed()),
                           Grid(Axis(20).closed(), Axis(10).reversed())}) {
    std::vector<Point> points = {{20, 5}, {5, 10}, {0, 0}, {-0.0, 0}, {1e9, -1e9}};
    for (int i = 0; i < 300; ++i) {
      points.push_back({static_cast<int>(rng() % 800) / 8.0 - 40, static_cast<int>(rng() % 800) / 8.0 - 40});
    }
    for (const PointBuffer& buffer : {in_floats(points), in_doubles(points)}) {
      for (const Outside outside : {Outside::count, Outside::absent}) {
        const Seeds on_host(test_device(), grid, points, {outside, Snap::to_pixels});
        const Seeds seeds(test_device(), grid, buffer, {outside, Snap::to_pixels});
        BOOST_TEST(seeds.alive() == on_host.alive());
        BOOST_TEST(seeds.outside() == on_host.outside());
        const auto read = seeds.read_pixels(), expected = on_host.read_pixels();
        for (std::size_t id = 0; id < points.size(); ++id) {
          BOOST_REQUIRE(read[id].has_value() == expected[id].has_value());
          if (!read[id]) continue;
          BOOST_TEST(read[id]->x == expected[id]->x);
          BOOST_TEST(read[id]->y == expected[id]->y);
        }
        Diagram diagram(test_device(), grid), diagram_on_host(test_device(), grid);
        exact_diagram(seeds, diagram);
        exact_diagram(on_host, diagram_on_host);
        BOOST_TEST((diagram.read() == diagram_on_host.read()));
      }
      if (grid.periodic() == Axes::xy) {
        BOOST_TEST(Seeds(test_device(), grid, buffer, kept_on_device).alive() == points.size());
      } else {
        check_error([&] { Seeds(test_device(), grid, buffer, kept_on_device).read(); }, {"outside the grid"});
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(points_wrap_however_far_away_they_are) {
  const Grid grid(21, 10, Axes::xy);
  const std::vector<Point> points = {{3e9, 5}, {-16777216, 8589934592}, {-1e-30, 1}, {1, -1e30}};
  const Seeds on_host(test_device(), grid, points, to_centres);
  for (const PointBuffer& buffer : {in_floats(points), in_doubles(points)}) {
    const std::vector<Point> read = centres_of(Seeds(test_device(), grid, buffer, kept_on_device));
    for (std::size_t id = 0; id < 3; ++id) {
      BOOST_TEST(read[id].x == centres_of(on_host)[id].x);
      BOOST_TEST(read[id].y == centres_of(on_host)[id].y);
    }
    BOOST_TEST((read[3].y >= 0.5 && read[3].y <= 9.5));
  }
}

BOOST_AUTO_TEST_CASE(the_greatest_way_of_a_seed) {
  const Grid grid(40, 30, Axes::x);
  Seeds seeds(test_device(), grid, in_floats({{1, 1}, {20, 20}, {5, 5}}), kept_on_device);
  BOOST_TEST(seeds.displacement() == 0);
  seeds.move_to(in_floats({{38, 2}, {20, 20}, {5, 4}}));
  BOOST_TEST(seeds.displacement() == 3);  // round the end
  seeds.move_to({{38, 29}, {22, 20}});
  BOOST_TEST(seeds.displacement() == 27);
  PointBuffer some = in_floats({{38, 1}, {22, 21}, {0, 0}});
  some.present = buffer_of(std::vector<cl_uchar>{0, 1, 1});
  seeds.move_to(some);
  BOOST_TEST(seeds.displacement() == 1);
  seeds.move_to(in_doubles({{0, 0}, {22, 25}, {0, 9}}));
  BOOST_TEST(seeds.displacement() == 9);
}

BOOST_AUTO_TEST_CASE(unfit_buffers_are_refused) {
  const Grid grid(30, 20);
  check_error([&] { Seeds(test_device(), grid, PointBuffer(cl::Buffer(), 1), kept_on_device); }, {"null"});
  const cl::Buffer small = buffer_of(std::vector<cl_float2>(9));
  check_error([&] { Seeds(test_device(), grid, PointBuffer(small, 10), kept_on_device); },
              {"10 points", "72 bytes", "80 are needed"});
  check_error(
      [&] { Seeds(test_device(), grid, PointBuffer(small, 9, PointFormat::doubles_xy), kept_on_device); },
      {"9 points", "72 bytes", "144 are needed"});
  const Device other = Device::select();
  check_error([&] { Seeds(other, grid, PointBuffer(small, 9), kept_on_device); }, {"another OpenCL context"});
}

BOOST_AUTO_TEST_CASE(a_mask_gives_ids_in_row_major_order) {
  const Grid grid(4, 3);
  const std::vector<std::uint8_t> mask = {0, 1, 0, 0, 9, 0, 0, 255, 0, 0, 1, 0};
  const std::vector<Point> expected = {{1.5, 0.5}, {0.5, 1.5}, {3.5, 1.5}, {2.5, 2.5}};
  for (const Seeds& seeds : {Seeds::from_mask(test_device(), grid, mask),
                             Seeds::from_mask(test_device(), grid, buffer_of(mask))}) {
    BOOST_TEST(seeds.alive() == 4u);
    const std::vector<Point> read = points_of(seeds);
    BOOST_REQUIRE(read.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      BOOST_TEST(read[i].x == expected[i].x);
      BOOST_TEST(read[i].y == expected[i].y);
    }
  }
  const Grid in_units(Axis(4, 0, 8), Axis(3, 0, 9).reversed());
  BOOST_TEST(points_of(Seeds::from_mask(test_device(), in_units, mask))[0].x == 3);
  BOOST_TEST(points_of(Seeds::from_mask(test_device(), in_units, mask))[0].y == 7.5);
  check_error(
      [&] {
        Seeds::from_mask(test_device(), grid, std::vector<std::uint8_t>{1, 0});
      },
      {"2 pixels", "12"});
  check_error([&] { Seeds::from_mask(test_device(), {5, 3}, buffer_of(mask)); }, {"mask", "12 bytes", "15"});
  check_error(
      [&] {
        Seeds::from_mask(test_device(), {40000, 1}, std::vector<std::uint8_t>(40000));
      },
      {"a mask", "no larger than a diagram", "40000"});
}
