// Dynamic jump flooding of seeds that are spread and move in any way, against the exact diagram: no farther
// from it than jump flooding is.
#define BOOST_TEST_MODULE any_motion
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"

using namespace vorocl;

namespace {

constexpr int side = 256;

using Frame = std::vector<std::optional<Point>>;

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  int below(int most) { return static_cast<int>(bits_() % static_cast<unsigned>(most)); }
  double uniform() { return static_cast<double>(bits_()) / 4294967296.0; }

  /// Roughly normal: the sum of twelve uniform numbers.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::mt19937 bits_;
};

Point inside(double x, double y) {
  return {std::clamp(std::floor(x), 0.0, side - 1.0) + 0.5, std::clamp(std::floor(y), 0.0, side - 1.0) + 0.5};
}

Point anywhere(Random& random) { return inside(side * random.uniform(), side * random.uniform()); }

Point in_box(Random& random, double corner, double width) {
  return inside(corner + width * random.uniform(), corner + width * random.uniform());
}

/// So many points, each made by a function of its index.
Frame make(int count, const std::function<Point(int)>& point) {
  Frame points;
  for (int i = 0; i < count; ++i) points.push_back(point(i));
  return points;
}

/// Where seeds start, and where they are a frame later.
struct Motion {
  const char* name;
  std::function<Frame(Random&)> start;
  std::function<void(Frame&, int frame, Random&)> move;
};

/// Each seed moves by up to `step` pixels along each axis, and is stopped by the border.
std::function<void(Frame&, int, Random&)> walk(int step) {
  return [=](Frame& points, int, Random& random) {
    for (auto& point : points) {
      const int dx = random.below(2 * step + 1) - step, dy = random.below(2 * step + 1) - step;
      point = inside(point->x + dx, point->y + dy);
    }
  };
}

/// Clusters of so many seeds in a lattice of 64 x 64 pixels.
std::function<Frame(Random&)> lattice(int seeds_of_a_cluster) {
  return [=](Random& random) {
    return make(16 * seeds_of_a_cluster, [&](int i) {
      return inside(32 + 64 * (i % 4) + 3 * random.normal(), 32 + 64 * (i / 4 % 4) + 3 * random.normal());
    });
  };
}

/// Horizontal lines of seeds, one in every second pixel.
std::function<Frame(Random&)> lines(int apart) {
  return [=](Random&) {
    constexpr int in_line = side / 2;
    return make(in_line * (side / apart), [&](int i) {
      const int x = 2 * (i % in_line), y = apart * (i / in_line) + apart / 2;
      return inside(x, y);
    });
  };
}

Frame evenly(int count, Random& random) {
  return make(count, [&](int) { return anywhere(random); });
}

/// Evenly spread seeds outside a disc, and so many on its rim.
Frame with_rim(Random& random, double radius, int rim) {
  Frame points = evenly(655, random);
  const auto in_disc = [=](const std::optional<Point>& at) {
    return std::hypot(at->x - 110, at->y - 120) < radius;
  };
  points.erase(std::remove_if(points.begin(), points.end(), in_disc), points.end());
  for (int i = 0; i < rim; ++i) {
    const double turn = 6.283185307179586 * random.uniform();
    points.push_back(inside(110 + radius * std::cos(turn), 120 + radius * std::sin(turn)));
  }
  return points;
}

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all = {
      {"evenly spread, 100 pixels per seed", [](Random& r) { return evenly(655, r); }, walk(5)},
      {"evenly spread, 16 pixels per seed", [](Random& r) { return evenly(4096, r); }, walk(5)},
      {"evenly spread, fast", [](Random& r) { return evenly(655, r); }, walk(25)},
      {"a corner", [](Random& r) { return make(700, [&](int) { return in_box(r, 0, 16); }); }, walk(5)},
      {"two corners",
       [](Random& r) { return make(700, [&](int i) { return in_box(r, i % 2 * (side - 16), 16); }); },
       walk(5)},
      {"16 clusters",
       [](Random& r) {
         const Frame centres = evenly(16, r);
         return make(700, [&](int i) {
           const Point& centre = *centres[static_cast<std::size_t>(i % 16)];
           return inside(centre.x + 5 * r.normal(), centre.y + 5 * r.normal());
         });
       },
       walk(5)},
      {"a line", [](Random&) { return make(side, [](int i) { return inside(i, 128); }); }, walk(2)},
      {"a blob that sweeps",
       [](Random& r) {
         return make(400, [&](int) { return inside(64 + 8 * r.normal(), 128 + 8 * r.normal()); });
       },
       [](Frame& points, int frame, Random&) {
         const int step = frame / 20 % 2 == 0 ? 6 : -6;
         for (auto& point : points) point = inside(point->x + step, point->y);
       }},
      {"3 seeds that jump anywhere", [](Random& r) { return evenly(3, r); },
       [](Frame& points, int, Random& r) { points = evenly(3, r); }},
      {"3 seeds of 655 that jump anywhere", [](Random& r) { return evenly(655, r); },
       [](Frame& points, int, Random& r) {
         for (std::size_t i = 0; i < 3; ++i) points[i] = anywhere(r);
       }},
      {"a lattice of clusters of 3", lattice(3), walk(4)},
      {"a lattice of clusters of 6", lattice(6), walk(4)},
      {"a lattice of clusters of 40", lattice(40), walk(4)},
      {"lines 24 apart", lines(24), walk(1)},
      {"lines 64 apart", lines(64), walk(2)},
      {"a gradient",
       [](Random& r) {
         return make(655, [&](int) { return inside(side * std::sqrt(r.uniform()), side * r.uniform()); });
       },
       walk(5)},
      {"a ring",
       [](Random& r) {
         return make(300, [&](int) {
           const double turn = 6.283185307179586 * r.uniform();
           return inside(128 + 100 * std::cos(turn), 128 + 100 * std::sin(turn));
         });
       },
       walk(2)},
      {"seeds that appear in empty space",
       [](Random& r) {
         Frame points = make(300, [&](int) { return in_box(r, 0, 80); });
         points.resize(400);
         return points;
       },
       [](Frame& points, int frame, Random& r) {
         points[299 + static_cast<std::size_t>(frame)] = anywhere(r);
       }},
      {"evenly spread but for a hole",
       [](Random& r) {
         Frame points = evenly(2621, r);
         const auto in_hole = [](const std::optional<Point>& at) {
           return std::hypot(at->x - 120, at->y - 110) < 36;
         };
         points.erase(std::remove_if(points.begin(), points.end(), in_hole), points.end());
         return points;
       },
       walk(2)},
      {"a void whose rim spins", [](Random& r) { return with_rim(r, 36, 200); },
       [](Frame& points, int, Random&) {
         for (std::size_t i = points.size() - 200; i < points.size(); ++i) {
           const double turn = std::atan2(points[i]->y - 120, points[i]->x - 110) + 0.08;
           points[i] = inside(110 + 36 * std::cos(turn), 120 + 36 * std::sin(turn));
         }
       }},
      {"a void that the waves just reach", [](Random& r) { return with_rim(r, 54, 400); }, walk(1)},
      {"one seed dies in each frame, one is born", [](Random& r) { return evenly(655, r); },
       [](Frame& points, int frame, Random& r) {
         const auto last = static_cast<std::size_t>(frame) % points.size();
         if (frame > 1) points[last - 1] = anywhere(r);
         points[last].reset();
         for (auto& point : points)
           if (point) point = inside(point->x + r.below(11) - 5, point->y + r.below(11) - 5);
       }},
      {"discs that are cleared and refilled", [](Random& r) { return evenly(655, r); },
       [](Frame& points, int frame, Random& r) {
         for (auto& point : points) {
           const bool in_disc = point && std::hypot(point->x - 128, point->y - 128) < 50;
           if (frame % 10 == 1 && in_disc) point.reset();
           if (frame % 10 == 5 && !point) point = in_box(r, 100, 56);
         }
       }},
  };
  return all;
}

struct Similarities {
  double mean = 0, least = 100;
  void add(double percent, int frames) {
    mean += percent / frames;
    least = std::min(least, percent);
  }
};

/// The greatest displacement along an axis of a seed that is there in both frames.
double greatest_displacement(const Frame& before, const Frame& now, Axes periodic) {
  const auto along = [&](double way, bool wraps) {
    return wraps ? std::min(std::abs(way), side - std::abs(way)) : std::abs(way);
  };
  double most = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!before[i] || !now[i]) continue;
    most = std::max({most, along(now[i]->x - before[i]->x, has_x(periodic)),
                     along(now[i]->y - before[i]->y, has_y(periodic))});
  }
  return most;
}

/// Holds dJFA against JFA over so many frames.
void check_motion(const Motion& motion, Metric metric, Axes periodic, int frames) {
  const Grid grid(side, side, periodic);
  Random random(7);
  Frame points = motion.start(random);
  Seeds seeds(test_device(), grid, points, to_centres);
  Diagram dynamic(test_device(), grid), jfa(test_device(), grid), exact(test_device(), grid);
  dynamic_jump_flooding(seeds, dynamic, {metric});
  Similarities of_dynamic, of_jfa;
  for (int frame = 1; frame <= frames; ++frame) {
    const Frame before = points;
    motion.move(points, frame, random);
    seeds.move_to(points);
    BOOST_TEST(seeds.displacement() == greatest_displacement(before, points, periodic));
    const Report report = dynamic_jump_flooding(seeds, dynamic, {metric});
    const Report full = jump_flooding(seeds, jfa, {metric});
    BOOST_TEST(report.waves() <= full.waves());
    exact_diagram(seeds, exact, {metric});
    of_dynamic.add(similarity_of(dynamic, exact), frames);
    of_jfa.add(similarity_of(jfa, exact), frames);
  }
  const std::string name = std::string(motion.name) + ", " + name_of(metric);
  BOOST_TEST(of_dynamic.mean >= of_jfa.mean - 0.01,
             name << ": dJFA " << of_dynamic.mean << ", JFA " << of_jfa.mean << " in the mean");
  BOOST_TEST(of_dynamic.least >= of_jfa.least - 0.03,
             name << ": dJFA " << of_dynamic.least << ", JFA " << of_jfa.least << " at the least");
}

}  // namespace

BOOST_AUTO_TEST_CASE(djfa_is_as_near_to_the_exact_diagram_as_jfa) {
  for (const Motion& motion : motions()) check_motion(motion, Metric::euclidean, Axes::none, 100);
}

BOOST_AUTO_TEST_CASE(so_it_is_with_the_manhattan_distance) {
  for (const Motion& motion : motions()) check_motion(motion, Metric::manhattan, Axes::none, 10);
}

BOOST_AUTO_TEST_CASE(so_it_is_on_periodic_grids) {
  for (const Motion& motion : motions()) check_motion(motion, Metric::euclidean, Axes::xy, 10);
}

// The paper's plan fails on most of these motions: if it did not, the cases above would show nothing.
BOOST_AUTO_TEST_CASE(the_paper_s_plan_does_not_reach_seeds_in_a_corner) {
  const Grid grid(side, side);
  Random random(7);
  const Motion& corner = motions()[3];
  Frame points = corner.start(random);
  Seeds seeds(test_device(), grid, points, to_centres);
  Diagram dynamic(test_device(), grid), exact(test_device(), grid);
  const DynamicJumpFloodingOptions paper = {Metric::euclidean, {}, 0, Reach::paper};
  dynamic_jump_flooding(seeds, dynamic, paper);
  corner.move(points, 1, random);
  seeds.move_to(points);
  dynamic_jump_flooding(seeds, dynamic, paper);
  exact_diagram(seeds, exact);
  BOOST_TEST(similarity_of(dynamic, exact) < 90);
}

// Evenly spread seeds get the wave that mends JFA's labels where the paper's plan has as many waves.
BOOST_AUTO_TEST_CASE(evenly_spread_seeds_take_few_waves) {
  const Grid grid(400, 300);
  for (const Metric metric : both_metrics) {
    for (const std::size_t count : {200u, 1200u, 7500u, 12000u}) {
      Seeds seeds = Seeds::random(test_device(), grid, count, 3);
      Diagram measured(test_device(), grid), jfa(test_device(), grid), exact(test_device(), grid);
      double of_measured = 0, of_jfa = 0;
      for (std::uint32_t frame = 0; frame <= 20; ++frame) {
        const Report report = dynamic_jump_flooding(seeds, measured, {metric});
        jump_flooding(seeds, jfa, {metric});
        exact_diagram(seeds, exact, {metric});
        if (frame > 0) {
          const std::size_t of_paper = dynamic_jump_flooding_plan(grid, count, 5).size();
          BOOST_TEST(report.waves() <= static_cast<int>(of_paper) + 1, count << " seeds, frame " << frame);
          of_measured += similarity_of(measured, exact);
          of_jfa += similarity_of(jfa, exact);
        }
        random_step(seeds, 5, Border::reflect, 4, frame);
      }
      BOOST_TEST(of_measured >= of_jfa, count << " seeds, " << name_of(metric));
    }
  }
}

// What is measured, and so every plan, is the same for all vector widths; the widths of the grid have vectors
// that overlap.
BOOST_AUTO_TEST_CASE(the_same_plans_for_every_kernel_shape) {
  const Grid grid(143, 61, Axes::x);
  std::vector<std::string> expected;
  for (const Tuning& shape : {Tuning{1, 32, 8}, Tuning{2, 64, 1}, Tuning{4, 1, 16}, Tuning{16, 64, 1}}) {
    const Device device = test_device().with_tuning(shape);
    Diagram diagram(device, grid);
    Seeds seeds(device, grid, centres(random_pixels(Grid(110, 61), 150, 8)), to_centres);
    for (std::size_t frame = 0; frame < 12; ++frame) {
      const Report report = dynamic_jump_flooding(seeds, diagram);
      const std::string plan =
          std::to_string(report.start().first_step) + ": " + std::to_string(report.waves());
      if (expected.size() <= frame) expected.push_back(plan);
      BOOST_TEST(plan == expected[frame], "vector width " << shape.vector_width << ", frame " << frame);
      if (frame == 5) seeds.move_to(centres(random_pixels(Grid(40, 61), 150, 8)));
      random_step(seeds, 6, Border::reflect, 5, static_cast<std::uint32_t>(frame));
    }
  }
  BOOST_TEST(std::set<std::string>(expected.begin(), expected.end()).size() > 2u);
}
