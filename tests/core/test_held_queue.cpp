// What enqueues and returns: while an event holds the queue back, a call that waits for the device does not
// come back.
#define BOOST_TEST_MODULE held_queue
#include <chrono>
#include <future>

#include "all_measures.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

template <typename Call>
void expect_no_wait(Call call) {
  test_device().finish();
  cl::UserEvent gate(test_device().context());
  test_device().wait_for({gate});
  std::future<void> called = std::async(std::launch::async, call);
  const bool returned = called.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
  gate.setStatus(CL_COMPLETE);
  BOOST_TEST(returned);
  called.get();
}

template <typename Number>
cl::Buffer points_of(const Grid& grid, std::size_t count) {
  std::vector<Number> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const auto along = [&](const Axis& axis, std::size_t step) {
      const auto part = static_cast<double>(i * step % 997) / 997;
      return static_cast<Number>(axis.from() + part * (axis.to() - axis.from()));
    };
    numbers.push_back(along(grid.x(), 613));
    numbers.push_back(along(grid.y(), 389));
    if (grid.z().pixels() > 1) numbers.push_back(along(grid.z(), 211));
  }
  return cl::Buffer(test_device().queue(), numbers.begin(), numbers.end(), true);
}

}  // namespace

BOOST_AUTO_TEST_CASE(from_points_in_buffers_to_measures_without_a_wait) {
  constexpr std::size_t count = 300;
  std::vector<std::uint8_t> all_but_some(count, 1);
  for (std::size_t i = 0; i < count; i += 7) all_but_some[i] = 0;
  const cl::Buffer marks(test_device().queue(), all_but_some.begin(), all_but_some.end(), true);
  for (const Grid& grid : {Grid(64, 48), Grid(Axis(64, 0.5, 3).closed(), Axis(48, -2, 2).reversed()),
                           Grid(Axis(64, -1, 9).periodic(), Axis(48, 0, 5).periodic())}) {
    const PointBuffer buffers[] = {{points_of<float>(grid, count), count, PointFormat::floats_xy},
                                   {points_of<double>(grid, count), count, PointFormat::doubles_xy},
                                   {points_of<float>(grid, count), count, PointFormat::floats_xy, marks},
                                   {points_of<double>(grid, count), count, PointFormat::doubles_xy, marks}};
    Diagram exact(test_device(), grid), flooded(test_device(), grid);
    for (const Outside outside : {Outside::refuse, Outside::absent, Outside::count}) {
      // Of those that may lie outside, the host asks whether one does.
      if (outside == Outside::count && grid.periodic() != Axes::xy) continue;
      for (const Snap snap : {Snap::none, Snap::to_pixels}) {
        for (const PointBuffer& buffer : buffers) {
          std::optional<Seeds> seeds;
          expect_no_wait([&] { seeds.emplace(test_device(), grid, buffer, SeedsOptions{outside, snap}); });
          expect_no_wait([&] { seeds->move_to(buffer); });
          expect_no_wait([&] { exact_diagram(*seeds, exact); });
          expect_no_wait([&] { jump_flooding(*seeds, flooded); });
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_of_tilted_grids_and_windows_of_points_on_the_host_enqueue) {
  const Grid tilted = Grid(Axis(64, -1, 9).periodic(), Axis(48, 0, 5).periodic()).tilted(2);
  const PointBuffer buffer(points_of<double>(tilted, 300), 300, PointFormat::doubles_xy);
  std::optional<Seeds> seeds;
  expect_no_wait([&] { seeds.emplace(test_device(), tilted, buffer); });
  expect_no_wait([&] { seeds->move_to(buffer); });
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i) points.push_back({i * 7 % 64 + 0.3, i * 11 % 48 + 0.7});
  for (const Grid& grid : {Grid(64, 48), Grid(64, 48, Axes::xy)}) {
    Diagram part(test_device(), Window(grid, 10, 5, 32, 24));
    for (const Snap snap : {Snap::none, Snap::to_pixels}) {
      expect_no_wait([&] { seeds.emplace(test_device(), grid, points, SeedsOptions{Outside::count, snap}); });
      expect_no_wait([&] { exact_diagram(*seeds, part); });
    }
  }
}

BOOST_AUTO_TEST_CASE(methods_and_measures_enqueue) {
  const Grid grid(Axis(64, -1, 9), Axis(48, 0, 5));
  const PointBuffer buffer(points_of<double>(grid, 300), 300, PointFormat::doubles_xy);
  Seeds seeds(test_device(), grid, buffer, {Outside::refuse, Snap::none});
  Diagram diagram(test_device(), grid), exact(test_device(), grid);
  for (const auto variant : {JumpFloodingVariant::jfa, JumpFloodingVariant::jfa_plus_1,
                             JumpFloodingVariant::jfa_plus_2, JumpFloodingVariant::one_plus_jfa}) {
    expect_no_wait([&] {
      jump_flooding(seeds, diagram, {Metric::euclidean, Neighbourhood::moore, variant});
    });
  }
  expect_no_wait([&] { low_resolution(seeds, diagram); });
  const DynamicJumpFloodingOptions paper = {Metric::euclidean, {}, 0, Reach::paper, 3.0, 300};
  for (int frame = 0; frame < 3; ++frame) {
    expect_no_wait([&] { seeds.move_to(buffer); });
    expect_no_wait([&] { dynamic_jump_flooding(seeds, diagram, paper); });
  }
  expect_no_wait([&] { exact_diagram(seeds, exact); });
  AllMeasures measures;
  measures.take(diagram, exact);  // makes their buffers
  expect_no_wait([&] { measures.take(diagram, exact); });
}

BOOST_AUTO_TEST_CASE(volumes_and_spaced_planes_enqueue) {
  constexpr std::size_t count = 200;
  std::vector<std::uint8_t> all_but_some(count, 1);
  for (std::size_t i = 0; i < count; i += 7) all_but_some[i] = 0;
  const cl::Buffer marks(test_device().queue(), all_but_some.begin(), all_but_some.end(), true);
  const Axis x(24, -1, 9), y(20, 0, 5), z(16, 2, 3);
  for (const Grid& grid : {Grid(x.periodic(), y.periodic(), z.periodic()), Grid(x.spaced(3), y)}) {
    const bool is_volume = grid.z().pixels() > 1;
    const PointFormat floats = is_volume ? PointFormat::floats_xyz : PointFormat::floats_xy,
                      doubles = is_volume ? PointFormat::doubles_xyz : PointFormat::doubles_xy;
    Diagram exact(test_device(), grid), flooded(test_device(), grid);
    std::optional<Seeds> seeds;
    for (const Snap snap : {Snap::to_pixels, Snap::none}) {
      for (const PointBuffer& buffer : {PointBuffer(points_of<float>(grid, count), count, floats, marks),
                                        PointBuffer(points_of<double>(grid, count), count, doubles)}) {
        for (const Outside outside : {Outside::refuse, Outside::absent}) {
          expect_no_wait([&] { seeds.emplace(test_device(), grid, buffer, SeedsOptions{outside, snap}); });
          expect_no_wait([&] { seeds->move_to(buffer); });
          expect_no_wait([&] { exact_diagram(*seeds, exact); });
          expect_no_wait([&] { jump_flooding(*seeds, flooded); });
        }
      }
    }
    AllMeasures measures;
    measures.take(flooded, exact);  // makes their buffers
    expect_no_wait([&] { measures.take(flooded, exact); });
  }
}
