// Many frames whose seeds come and go, by four threads on one device, which build their kernels at once: the
// process's memory, which is the device's too where that is the CPU, stays what it was after a tenth of them,
// and exact diagrams are right. 800 frames; with VOROCL_LONG_TESTS 20,000.
#define BOOST_TEST_MODULE soak
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <random>
#include <thread>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

constexpr int threads = 4;
constexpr std::size_t most_seeds = 600;

/// What the process has in memory, in MiB.
double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0, pages = 0;
  file >> all >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Some seeds, of which about one in eight is absent.
std::vector<std::optional<Pixel>> some_seeds(const Grid& grid, std::mt19937& random) {
  std::vector<std::optional<Pixel>> seeds;
  for (const Pixel& pixel : random_pixels(grid, random() % most_seeds, static_cast<unsigned>(random()))) {
    seeds.push_back(random() % 8 == 0 ? std::nullopt : std::optional<Pixel>(pixel));
  }
  return seeds;
}

/// As brute_force(), with the ids that present seeds have among all.
std::vector<std::uint32_t> expected_labels(const Grid& grid, const std::vector<std::optional<Pixel>>& seeds,
                                           Metric metric) {
  std::vector<Pixel> present;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < seeds.size(); ++id) {
    if (!seeds[id]) continue;
    present.push_back(*seeds[id]);
    ids.push_back(id);
  }
  std::vector<std::uint32_t> labels = brute_force(grid, present, metric);
  for (std::uint32_t& label : labels) label = label == no_label ? no_label : ids[label];
  return labels;
}

/// Makes frames, exact ones and those of dJFA in turn in one diagram. Every hundredth exact one is compared.
void make_frames(unsigned number, int frames, std::atomic<int>& wrong, std::atomic<int>& compared) {
  const Grid grid(256, 256);
  const Metric metric = number % 2 == 0 ? Metric::euclidean : Metric::manhattan;
  std::mt19937 random(number);
  Seeds seeds(test_device(), grid, {}, to_centres);
  Diagram diagram(test_device(), grid);
  for (int frame = 0; frame < frames; ++frame) {
    const auto pixels = some_seeds(grid, random);
    seeds.move_to(transformed(pixels, [](const std::optional<Pixel>& pixel) {
      return pixel ? std::optional(centre(*pixel)) : std::nullopt;
    }));
    if (frame % 2 == 1) {
      dynamic_jump_flooding(seeds, diagram, {metric});
      continue;
    }
    exact_diagram(seeds, diagram, {metric});
    if (frame % 100 != 0) continue;
    wrong += diagram.read() != expected_labels(grid, pixels, metric);
    ++compared;
  }
  diagram.wait();
}

/// Returns how many exact diagrams were wrong.
int make_frames_on_threads(unsigned first, int frames, std::atomic<int>& compared) {
  std::atomic<int> wrong = 0;
  std::vector<std::thread> all;
  for (unsigned i = 0; i < threads; ++i) {
    all.emplace_back(make_frames, first + i, frames / threads, std::ref(wrong), std::ref(compared));
  }
  for (std::thread& thread : all) thread.join();
  return wrong;
}

}  // namespace

BOOST_AUTO_TEST_CASE(many_frames_take_no_more_memory_than_some) {
  const int frames = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 20000 : 800;
  test_device().finish();  // is made before there are threads
  std::atomic<int> compared = 0;
  BOOST_TEST(make_frames_on_threads(0, frames / 10, compared) == 0);
  const double before = resident();
  BOOST_TEST(make_frames_on_threads(threads, frames - frames / 10, compared) == 0);
  const double after = resident();
  BOOST_TEST_MESSAGE(frames << " frames, " << compared << " compared, " << before << " MiB, then " << after);
  BOOST_TEST(compared >= frames / 100);
  BOOST_TEST(after < before + 32);  // allocators keep what four threads need at once
}
