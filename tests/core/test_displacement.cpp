// How far seeds have moved: what they know of it, and what dynamic jump flooding makes of it.
#define BOOST_TEST_MODULE displacement
#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

const Grid dense(256, 256);  // with 4096 seeds 2 L = 8

Seeds dense_seeds() { return Seeds::random(test_device(), dense, 4096, 11); }

DynamicJumpFloodingOptions by_paper() { return {Metric::euclidean, {}, 0, Reach::paper, {}}; }

int first_step_of(const Seeds& seeds, Diagram& diagram,
                  const DynamicJumpFloodingOptions& options = by_paper()) {
  const Report report = dynamic_jump_flooding(seeds, diagram, options);
  return report.start().from_seeds ? -report.start().first_step : report.start().first_step;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_greatest_way_along_an_axis_in_pixels) {
  const Grid pixels(100, 50), ring(100, 50, Axes::x);
  const Grid data(Axis(100, 0, 1), Axis(50, -5, 5).reversed());
  Seeds on_pixels(test_device(), pixels, {{1, 1}, {50, 20}, {98, 40}}, to_centres);
  BOOST_TEST(on_pixels.displacement() == 0);
  on_pixels.move_to({{4, 1}, {50, 13}, {98, 40}});
  BOOST_TEST(on_pixels.displacement() == 7);
  on_pixels.move_to({{4, 1}, {50, 13}, {98, 40}});
  BOOST_TEST(on_pixels.displacement() == 0);
  on_pixels.move_to({{99, 1}, {50, 13}, {98, 40}});
  BOOST_TEST(on_pixels.displacement() == 95);

  Seeds on_ring(test_device(), ring, {{1, 1}, {50, 20}, {98, 40}}, to_centres);
  on_ring.move_to({{97, 1}, {50, 20}, {102, 40}});  // 4 pixels to the left, and 4 to the right
  BOOST_TEST(on_ring.displacement() == 4);

  Seeds on_data(test_device(), data, {{0.015, 4.9}, {0.505, 1}}, to_centres);
  on_data.move_to({{0.035, 4.9}, {0.505, 0}});  // 2 pixels, and 5 down
  BOOST_TEST(on_data.displacement() == 5, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(seeds_that_come_and_go_have_not_moved) {
  const Grid grid(100, 50);
  using Frame = std::vector<std::optional<Point>>;
  Seeds seeds(test_device(), grid, Frame{Point{1, 1}, std::nullopt, Point{50, 20}}, to_centres);
  seeds.move_to(Frame{std::nullopt, Point{90, 3}, Point{51, 20}});
  BOOST_TEST(seeds.displacement() == 1);
  seeds.move_to(Frame{Point{80, 1}, Point{90, 6}});
  BOOST_TEST(seeds.displacement() == 3);
  seeds.move_to(Frame{Point{80, 1}, Point{90, 6}, Point{1, 1}, Point{2, 2}});
  BOOST_TEST(seeds.displacement() == 0);
}

BOOST_AUTO_TEST_CASE(from_buffers_and_from_random_steps) {
  const Grid grid(64, 64);
  const std::vector<cl_float2> values = {{{60.5f, 3.f}}, {{2.f, 62.f}}},
                               later = {{{55.5f, 3.f}}, {{2.f, 62.f}}};
  const cl::Buffer buffer(test_device().queue(), values.begin(), values.end(), true);
  const cl::Buffer next(test_device().queue(), later.begin(), later.end(), true);
  Seeds seeds(test_device(), grid, {{58, 3}, {2, 60}}, to_centres);
  seeds.move_to(PointBuffer(buffer, 2));
  BOOST_TEST(seeds.displacement() >= 2);
  BOOST_TEST(seeds.displacement() <= 2.5);  // by points or by pixels
  seeds.move_to(PointBuffer(next, 2));
  BOOST_TEST(seeds.displacement() == 5);
  random_step(seeds, 9, Border::reflect, 1, 1);
  BOOST_TEST(seeds.displacement() == 9);
}

// The waves begin at the least power of two that covers the way: the paper's Eq. 4.
BOOST_AUTO_TEST_CASE(waves_cover_what_the_seeds_have_moved) {
  Seeds seeds = dense_seeds();
  Diagram diagram(test_device(), dense);
  BOOST_TEST(first_step_of(seeds, diagram) == -128);  // the first frame: from the seeds
  BOOST_TEST(first_step_of(seeds, diagram) == 8);     // unmoved: 2 L
  random_step(seeds, 12, Border::reflect, 1, 1);
  BOOST_TEST(first_step_of(seeds, diagram) == 16);
  random_step(seeds, 33, Border::reflect, 1, 2);
  BOOST_TEST(first_step_of(seeds, diagram) == 64);
  auto points = seeds.read();
  points[7]->x += points[7]->x < 128 ? 17 : -17;
  seeds.move_to(points);
  BOOST_TEST(first_step_of(seeds, diagram) == 32);
  BOOST_TEST(first_step_of(seeds, diagram) == 8);
}

// A diagram that was left out for some frames sums what passed since it was filled; others do not.
BOOST_AUTO_TEST_CASE(ways_of_frames_that_were_left_out_are_summed) {
  Seeds seeds = dense_seeds();
  Diagram each(test_device(), dense), third(test_device(), dense);
  first_step_of(seeds, each);
  first_step_of(seeds, third);
  for (std::uint32_t frame = 1; frame <= 6; ++frame) {
    random_step(seeds, 12, Border::reflect, 1, frame);
    BOOST_TEST(first_step_of(seeds, each) == 16, "frame " << frame);
    if (frame % 3 == 0) BOOST_TEST(first_step_of(seeds, third) == 64, "frame " << frame);  // 36 pixels
  }
}

BOOST_AUTO_TEST_CASE(the_caller_knows_better) {
  Seeds seeds = dense_seeds();
  Diagram diagram(test_device(), dense);
  DynamicJumpFloodingOptions options = by_paper();
  options.max_displacement = 100;
  first_step_of(seeds, diagram, options);
  BOOST_TEST(first_step_of(seeds, diagram, options) == 128);
  random_step(seeds, 60, Border::reflect, 1, 1);
  options.max_displacement = 5;
  BOOST_TEST(first_step_of(seeds, diagram, options) == 8);
  random_step(seeds, 60, Border::reflect, 1, 2);
  options.max_displacement = 20;
  BOOST_TEST(first_step_of(seeds, diagram, options) == 32);
  // By its name too.
  MethodOptions by_name;
  by_name.reach = Reach::paper;
  by_name.max_displacement = 40;
  BOOST_TEST(method("djfa").run(seeds, diagram, by_name).start().first_step == 64);
  for (const double bad : {-1.0, std::nan("")}) {
    options.max_displacement = bad;
    check_error([&] { dynamic_jump_flooding(seeds, diagram, options); }, {"displacement"});
  }
}

// A clone is moved on its own.
BOOST_AUTO_TEST_CASE(a_clone_has_ways_of_its_own) {
  Seeds seeds = dense_seeds();
  Diagram diagram(test_device(), dense);
  first_step_of(seeds, diagram);
  Seeds clone = seeds.clone();
  random_step(clone, 30, Border::reflect, 1, 1);
  BOOST_TEST(clone.displacement() == 30);
  BOOST_TEST(seeds.displacement() == 0);
  BOOST_TEST(first_step_of(seeds, diagram) == 8);
}
