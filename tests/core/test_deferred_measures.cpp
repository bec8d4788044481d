// A loop that measures every frame and reads nothing until its end: what it reads then is what one that reads
// at once does.
#define BOOST_TEST_MODULE deferred_measures
#include <chrono>
#include <future>

#include "all_measures.hpp"
#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

constexpr std::uint32_t frames = 12;

/// Seeds that move in one way after another, and two diagrams of them.
class Film {
 public:
  Film(const Grid& grid, Metric metric)
      : grid_(grid),
        metric_(metric),
        seeds_(test_device(), grid, centres(random_pixels(grid, 80, 1))),
        flooded_(test_device(), grid),
        exact_(test_device(), grid) {}

  void make(std::uint32_t frame) {
    const std::vector<Point> points = centres(random_pixels(grid_, frame % 3 == 0 ? 80 : 50 + frame, frame));
    if (frame % 4 == 1) {
      seeds_.move_to(points);
    } else if (frame % 4 == 2) {
      const auto values = transformed(points, [](const Point& point) {
        return cl_float2{{static_cast<float>(point.x), static_cast<float>(point.y)}};
      });
      seeds_.move_to(
          PointBuffer(cl::Buffer(test_device().queue(), values.begin(), values.end(), true), values.size()));
    } else if (frame > 0) {
      random_step(seeds_, 6, Border::reflect, 2, frame);
    }
    jump_flooding(seeds_, flooded_, {metric_});
    exact_diagram(seeds_, exact_, {metric_});
  }

  const Diagram& flooded() const { return flooded_; }
  const Diagram& exact() const { return exact_; }

 private:
  Grid grid_;
  Metric metric_;
  Seeds seeds_;
  Diagram flooded_, exact_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(measures_read_at_the_end_are_those_read_at_once) {
  for (const Grid& grid : {Grid(143, 61), Grid(90, 90, Axes::xy)}) {
    for (const Metric metric : both_metrics) {
      std::vector<std::vector<double>> expected;
      Film at_once(grid, metric);
      AllMeasures reused;
      for (std::uint32_t frame = 0; frame < frames; ++frame) {
        at_once.make(frame);
        reused.take(at_once.flooded(), at_once.exact());
        expected.push_back(reused.read());
      }
      std::vector<AllMeasures> results(frames);
      {
        Film deferred(grid, metric);
        for (std::uint32_t frame = 0; frame < frames; ++frame) {
          deferred.make(frame);
          results[frame].take(deferred.flooded(), deferred.exact());
        }
      }
      for (std::uint32_t frame = 0; frame < frames; ++frame) {
        BOOST_TEST((results[frame].read() == expected[frame]), name_of(metric) << ", frame " << frame);
        if (frame > 0) BOOST_TEST((expected[frame] != expected[frame - 1]));
      }
    }
  }
}

// While an event holds the queue back, a call that waits for the device does not return.
BOOST_AUTO_TEST_CASE(measures_do_not_wait) {
  const Grid grid(143, 61);
  Film film(grid, Metric::euclidean);
  AllMeasures expected, found;
  film.make(0);
  expected.take(film.flooded(), film.exact());
  const std::vector<double> numbers = expected.read();
  test_device().finish();
  cl::UserEvent gate(test_device().context());
  test_device().wait_for({gate});
  std::future<void> measured =
      std::async(std::launch::async, [&] { found.take(film.flooded(), film.exact()); });
  const bool returned = measured.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
  gate.setStatus(CL_COMPLETE);
  BOOST_TEST(returned);
  measured.get();
  BOOST_TEST((found.read() == numbers));
}
