// Four threads with a device each, then four with a shared one; each thread has its own seeds and diagram.
#include <atomic>
#include <thread>
#include <vorocl/vorocl.hpp>

#include "nearest.hpp"

namespace {

constexpr int width = 97, height = 61, seeds = 30, frames = 5;

/// Frames of moving seeds that differ from thread to thread; true if all labels are right.
bool run(const vorocl::Device& device, int thread) {
  const vorocl::Grid grid(width, height);
  vorocl::Diagram diagram(device, grid);
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<int> x, y;
    std::vector<vorocl::Point> points;
    for (int i = 0; i < seeds; ++i) {
      x.push_back((i * 13 + frame + thread * 5) % width);
      y.push_back(i * 2 + (frame + thread) % 2);  // a row of its own each: no two seeds share a pixel
      points.push_back({x.back() + 0.5, y.back() + 0.5});
    }
    vorocl::exact_diagram(vorocl::Seeds(device, grid, points), diagram);
    if (!all_nearest(diagram.read(), width, height, x, y)) return false;
  }
  return true;
}

bool run_in_threads(const vorocl::Device* shared) {
  std::atomic<int> right{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&right, shared, i] {
      try {
        right += run(shared == nullptr ? vorocl::Device::select() : *shared, i) ? 1 : 0;
      } catch (const vorocl::Error& error) {
        std::cerr << error.what() << '\n';
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  return right == 4;
}

}  // namespace

int main() try {
  if (!run_in_threads(nullptr)) return 1;
  const vorocl::Device shared = vorocl::Device::select();
  return run_in_threads(&shared) ? 0 : 1;
} catch (const vorocl::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
