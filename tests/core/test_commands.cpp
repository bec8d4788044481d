// How many commands a diagram and a frame give to the device's queue, and how often they read from it: on a
// GPU a command costs microseconds, and a read a round trip. docs/gpu.md has these numbers.
#define BOOST_TEST_MODULE commands
#include <map>
#include <mutex>
#include <random>
#include <set>

#include "faulty_calls.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

/// OpenCL's calls since they were last forgotten.
class Calls {
 public:
  void add(const std::string& name) {
    const std::lock_guard<std::mutex> turn(mutex_);
    ++by_name_[name];
  }

  void forget() {
    const std::lock_guard<std::mutex> turn(mutex_);
    by_name_.clear();
  }

  std::size_t of(const std::set<std::string>& names) {
    const std::lock_guard<std::mutex> turn(mutex_);
    std::size_t sum = 0;
    for (const auto& [name, count] : by_name_) sum += names.count(name) > 0 ? count : 0;
    return sum;
  }

 private:
  std::mutex mutex_;  // the library may call from threads of its own
  std::map<std::string, std::size_t> by_name_;
};

Calls& calls() {
  static Calls all;
  return all;
}

struct Counts {
  std::size_t commands, reads;
};

/// What an action enqueues, and how often it waits for what it reads. (It may wait for commands of long ago:
/// a queue takes so many.) The action runs twice: first it builds programs and reserves memory.
template <typename Action>
Counts counts_of(Action action) {
  action();
  test_device().finish();
  calls().forget();
  action();
  const Counts counts = {calls().of({"clEnqueueNDRangeKernel", "clEnqueueFillBuffer", "clEnqueueCopyBuffer",
                                     "clEnqueueWriteBuffer", "clEnqueueUnmapMemObject"}),
                         calls().of({"clEnqueueReadBuffer", "clEnqueueMapBuffer", "clFinish"})};
  test_device().finish();
  return counts;
}

Device shaped(Shape shape) {
  Tuning tuning = test_device().tuning();
  tuning.shape = shape;
  return test_device().with_tuning(tuning);
}

const Grid flat(2048, 2048), periodic(2048, 2048, Axes::xy);

Seeds random_seeds(const Device& device, const Grid& grid, Snap snap) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(0, 2048);
  std::vector<Point> points(16384);
  for (Point& point : points) point = {place(random), place(random)};
  return {device, grid, points, {Outside::refuse, snap}};
}

std::size_t to_size(int number) { return static_cast<std::size_t>(number); }

}  // namespace

namespace vorocl {

bool call_fails(const char* name) {
  calls().add(name);
  return false;
}

}  // namespace vorocl

BOOST_AUTO_TEST_CASE(an_exact_diagram_takes_few_commands_and_reads_nothing) {
  struct Case {
    Shape shape;
    Snap snap;
    std::size_t commands, commands_if_periodic;
  };
  for (const Case& c : {Case{Shape::group, Snap::to_pixels, 9, 9},
                        {Shape::vector, Snap::to_pixels, 5, 5},
                        {Shape::group, Snap::none, 9, 9},
                        {Shape::vector, Snap::none, 5, 5}}) {
    if (!takes(c.shape)) continue;
    for (const Grid& grid : {flat, periodic}) {
      const Device device = shaped(c.shape);
      const Seeds seeds = random_seeds(device, grid, c.snap);
      Diagram diagram(device, grid);
      const Counts counts = counts_of([&] { exact_diagram(seeds, diagram); });
      BOOST_TEST_CONTEXT("shape " << static_cast<int>(c.shape) << ", snap " << static_cast<int>(c.snap)) {
        BOOST_TEST(counts.commands == (grid == periodic ? c.commands_if_periodic : c.commands));
        BOOST_TEST(counts.reads == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_distance_transform_of_buffers_takes_few_commands_and_reads_nothing) {
  struct Case {
    Shape shape;
    Grid grid;
    std::size_t commands;
  };
  for (const Case& c : {Case{Shape::group, flat, 5}, Case{Shape::group, Grid(256, 128, 128), 6},
                        Case{Shape::vector, flat, 4}, Case{Shape::vector, Grid(256, 128, 128), 3}}) {
    if (!takes(c.shape)) continue;
    const Device device = shaped(c.shape);
    const cl::Buffer image(device.context(), CL_MEM_READ_WRITE, c.grid.pixels()),
        distances(device.context(), CL_MEM_READ_WRITE, c.grid.pixels() * sizeof(float));
    device.queue().enqueueFillBuffer(image, cl_uchar{1}, 0, c.grid.pixels());
    device.queue().enqueueFillBuffer(image, cl_uchar{0}, 0, 1);
    DistanceTransform transform(device, c.grid);
    TransformTargets targets;
    targets.distances = {distances, PixelType::float32};
    const Counts counts = counts_of([&] { transform.run({image, PixelType::uint8}, targets); });
    BOOST_TEST(counts.commands == c.commands);
    BOOST_TEST(counts.reads == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_volume_takes_few_commands_and_reads_nothing) {
  const Grid grid(64, 64, 64);
  const Device device = shaped(Shape::group);
  std::vector<Point> points;
  std::vector<std::uint8_t> mask(grid.pixels());
  for (std::size_t i = 0; i < mask.size(); i += 7) {
    mask[i] = 1;
    points.push_back({static_cast<double>(i % 64) + 0.5, static_cast<double>(i / 64 % 64) + 0.5,
                      static_cast<double>(i / 4096) + 0.5});
  }
  const Seeds of_mask = Seeds::from_mask(device, grid, mask),
              of_points(device, grid, points, {Outside::refuse, Snap::to_pixels});
  Diagram diagram(device, grid);
  const Counts masked = counts_of([&] { exact_diagram(of_mask, diagram); }),
               painted = counts_of([&] { exact_diagram(of_points, diagram); });
  BOOST_TEST(masked.commands == 4u);
  BOOST_TEST(masked.reads == 0u);
  BOOST_TEST(painted.commands == 8u);
  BOOST_TEST(painted.reads == 0u);
  const Seeds seeds = Seeds::random(device, grid, 500, 1);
  exact_diagram(seeds, diagram);
  const Counts listed = counts_of([&] { exact_diagram(seeds, diagram); });
  BOOST_TEST(listed.commands == 7u);
  BOOST_TEST(listed.reads == 0u);
  const Seeds between(device, grid, points, {Outside::refuse, Snap::none});
  exact_diagram(between, diagram);
  const Counts stamped = counts_of([&] { exact_diagram(between, diagram); });
  BOOST_TEST(stamped.commands == 8u);
  BOOST_TEST(stamped.reads == 0u);
}

BOOST_AUTO_TEST_CASE(jump_flooding_takes_a_command_per_wave_and_four_more) {
  const Seeds seeds = random_seeds(test_device(), flat, Snap::to_pixels);
  Diagram diagram(test_device(), flat);
  int waves = 0;
  const Counts counts = counts_of([&] { waves = jump_flooding(seeds, diagram).waves(); });
  BOOST_TEST(counts.commands == to_size(waves) + 4);
  BOOST_TEST(counts.reads == 0u);
}

BOOST_AUTO_TEST_CASE(a_frame_of_dynamic_jump_flooding_reads_once) {
  Seeds seeds = random_seeds(test_device(), flat, Snap::to_pixels);
  Diagram diagram(test_device(), flat);
  dynamic_jump_flooding(seeds, diagram);
  std::uint32_t frame = 0;
  int waves = 0;
  const Counts counts = counts_of([&] {
    random_step(seeds, 3, Border::reflect, 1, ++frame);
    waves = dynamic_jump_flooding(seeds, diagram).waves();
  });
  BOOST_TEST(counts.commands == to_size(waves) + 8);
  BOOST_TEST(counts.reads == 1u);
}
