// Measures of windows of grids, periodic ones too, against the host's in 64 bits.
#define BOOST_TEST_MODULE window_measures
#include <algorithm>
#include <climits>
#include <cmath>

#include "read_measures.hpp"
#include "window_cases.hpp"

using namespace vorocl;

namespace {

struct MeasuredWindow {
  Window window;
  std::vector<Pixel> seeds;
};

/// Windows with seeds all around, near and far, parts of periods, and one whole period in some spellings.
std::vector<MeasuredWindow> measured_windows() {
  std::mt19937_64 rng(10);
  const Grid plain(61, 47), torus(61, 47, Axes::xy), cylinder(61, 47, Axes::x);
  const auto between = [&](const Pixel& first, const Pixel& last, std::size_t count) {
    return random_pixels_between(first, last, count, rng);
  };
  std::vector<MeasuredWindow> windows;
  windows.push_back({plain, between({-60, -60}, {120, 100}, 60)});
  windows.push_back({plain, between({-20000, -20000}, {20000, 20000}, 60)});
  windows.push_back({plain, between({-2000000000, -2000000000}, {-1999990000, 0}, 60)});
  windows.push_back({{Grid(200, 100), 90, 30, 61, 47}, between({0, 0}, {199, 99}, 60)});
  windows.push_back({{Grid(80, 70, Axes::xy), 40, 30, 61, 47}, between({0, 0}, {79, 69}, 12)});
  windows.push_back({{Grid(30, 25, Axes::xy), -10, -5, 61, 47}, between({0, 0}, {29, 24}, 12)});
  windows.push_back({{Grid(30, 90000, Axes::xy), -10, 50000, 61, 47}, between({0, 0}, {29, 89999}, 12)});
  windows.push_back({{Grid(50, 47, Axes::x), -1, 0, 61, 47}, between({0, -90}, {49, 90}, 60)});
  windows.push_back({torus, between({0, 0}, {60, 46}, 12)});
  windows.push_back({{torus, 20, 30, 61, 47}, between({0, 0}, {60, 46}, 12)});
  windows.push_back({{Grid(61, 70, Axes::xy), 20, 30, 61, 47}, between({0, 0}, {60, 69}, 12)});
  windows.push_back({cylinder, between({0, -90}, {60, 90}, 60)});
  windows.push_back({{Grid(61, 60, Axes::x), -7, 3, 61, 47}, between({0, 0}, {60, 59}, 12)});
  windows.push_back({Grid(32011, 9, Axes::x), between({0, 0}, {32010, 8}, 60)});
  return windows;
}

/// The devices for a window and a metric: measures take vectors of 16, of 4, or none, and each metric has one
/// of its own. Kernels are built anew for the axes along which the window shows one whole period: so only
/// one.
std::vector<Engine> engines_for(const Window& window, Metric metric) {
  const Engine &wide = engines()[0], &narrow = engines()[1], &without_vectors = engines()[2];
  if (metric == Metric::manhattan) return {without_vectors};
  if (window.periodic() != Axes::none) return {wide};
  return {wide, narrow};
}

/// Calls a function with the exact diagram of each window, by brute force, in both metrics and on each
/// device.
template <typename Use>
void each_exact_diagram(Use use) {
  for (const MeasuredWindow& measured : measured_windows()) {
    const Window& window = measured.window;
    for (const Metric metric : both_metrics) {
      for (const Engine& engine : engines_for(window, metric)) {
        Diagram diagram(engine.device, window);
        diagram.write(brute_force(window, measured.seeds, metric),
                      Seeds(engine.device, window.grid(), centres(measured.seeds), to_centres), metric);
        BOOST_TEST_CONTEXT(text_of(window, measured.seeds.size()) << ", " << engine.name) {
          use(measured, metric, diagram);
        }
      }
    }
  }
}

/// Calls a function with each pixel that has a label, counted as the window shows it, and its distance to the
/// label's seed.
template <typename Use>
void each_labelled_pixel(const MeasuredWindow& measured, const Labels& labels, Metric metric, Use use) {
  const Window& window = measured.window;
  std::size_t i = 0;
  for (std::int64_t y = 0; y < window.height(); ++y) {
    for (std::int64_t x = 0; x < window.width(); ++x, ++i) {
      if (labels[i] == no_label) continue;
      const Pixel seed = in_period(window.grid(), measured.seeds[labels[i]]);
      use(i, labels[i], Pixel{x, y},
          distance(window.grid(), shown_pixel(window, x, y).value(), seed, metric));
    }
  }
}

/// A pixel of the grid, or beside it, counted from the window's first one.
Pixel seen_from(const Window& window, const Pixel& pixel) {
  const auto along = [](const Axis& axis, std::int64_t begin, std::int64_t length, std::int64_t at) {
    const std::int64_t seen = at - begin;
    if (!axis.is_periodic() || length > axis.pixels()) return seen;
    return (seen % axis.pixels() + axis.pixels()) % axis.pixels();
  };
  const Pixel own = in_period(window.grid(), pixel);
  return {along(window.grid().x(), window.x(), window.width(), own.x),
          along(window.grid().y(), window.y(), window.height(), own.y)};
}

/// Where measures count a pixel of a seed's cell: the shorter way round along axes of which the window shows
/// one whole period.
Pixel counted_at(const Window& window, const Pixel& shown, const Pixel& seed) {
  const Pixel from = seen_from(window, seed);
  const Grid& grid = window.grid();
  return {has_x(window.periodic()) ? nearest_image(shown.x, from.x, grid.x()) : shown.x,
          has_y(window.periodic()) ? nearest_image(shown.y, from.y, grid.y()) : shown.y};
}

bool is_on_border(const Window& window, const Pixel& shown) {
  return (!has_x(window.periodic()) && (shown.x == 0 || shown.x == window.width() - 1)) ||
         (!has_y(window.periodic()) && (shown.y == 0 || shown.y == window.height() - 1));
}

}  // namespace

BOOST_AUTO_TEST_CASE(distances_of_windows) {
  each_exact_diagram([](const MeasuredWindow& measured, Metric metric, const Diagram& diagram) {
    const Labels labels = diagram.read();
    std::vector<std::int64_t> expected(labels.size(), -1);
    each_labelled_pixel(measured, labels, metric,
                        [&](std::size_t i, std::uint32_t, const Pixel&, std::int64_t d) { expected[i] = d; });
    const bool fits = *std::max_element(expected.begin(), expected.end()) < no_distance;

    Field<float> floats;
    distance_field(diagram, floats);
    const std::vector<float> in_pixels = floats.read();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto d = static_cast<double>(expected[i]);
      const double right = metric == Metric::euclidean ? std::sqrt(d) : d;
      if (expected[i] < 0) {
        wrong += std::isinf(in_pixels[i]) ? 0 : 1;
      } else {
        wrong += std::abs(in_pixels[i] - right) <= 1e-6 * right ? 0 : 1;
      }
    }
    BOOST_TEST(wrong == 0u);

    Field<std::int32_t> integers;
    distance_field(diagram, integers);
    if (!fits) {
      check_error([&] { integers.read(); }, {"31 bits", "floats"});
      return;
    }
    for (std::int64_t& d : expected) d = d < 0 ? no_distance : d;
    const std::vector<std::int32_t> found = integers.read();
    BOOST_TEST(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
  });
}

BOOST_AUTO_TEST_CASE(cells_of_windows) {
  each_exact_diagram([](const MeasuredWindow& measured, Metric metric, const Diagram& diagram) {
    const Window& window = measured.window;
    const std::size_t count = measured.seeds.size();
    std::vector<CellShape> shapes(count, CellShape{INT_MAX, INT_MAX, INT_MIN, INT_MIN, -1, false});
    std::vector<CellSums> sums(count);
    each_labelled_pixel(measured, diagram.read(), metric,
                        [&](std::size_t, std::uint32_t label, const Pixel& shown, std::int64_t d) {
                          const Pixel at = counted_at(window, shown, measured.seeds[label]);
                          const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
                          CellShape& shape = shapes[label];
                          shape.left = std::min(shape.left, x);
                          shape.top = std::min(shape.top, y);
                          shape.right = std::max(shape.right, x);
                          shape.bottom = std::max(shape.bottom, y);
                          shape.largest_distance = std::max(shape.largest_distance, static_cast<double>(d));
                          shape.touches_border |= is_on_border(window, shown);
                          ++sums[label].area;
                          sums[label].sum_x += x;
                          sums[label].sum_y += y;
                        });
    CellShapesResult found_shapes;
    cell_shapes(diagram, found_shapes);
    const std::vector<CellShape> read_shapes = found_shapes.read();
    const std::vector<CellSums> read_sums = sums_of(diagram);
    BOOST_REQUIRE(read_shapes.size() == count);
    BOOST_REQUIRE(read_sums.size() == count);
    std::size_t wrong = 0;
    for (std::size_t id = 0; id < count; ++id) {
      const CellShape &a = read_shapes[id], &b = shapes[id];
      wrong += sums[id].area > 0 &&
               (a.left != b.left || a.top != b.top || a.right != b.right || a.bottom != b.bottom);
      wrong += sums[id].area == 0 && (a.right >= a.left || a.bottom >= a.top);
      wrong += a.largest_distance != b.largest_distance || a.touches_border != b.touches_border;
      wrong += read_sums[id].area != sums[id].area || read_sums[id].sum_x != sums[id].sum_x ||
               read_sums[id].sum_y != sums[id].sum_y;
    }
    BOOST_TEST(wrong == 0u);
    const bool far = std::any_of(measured.seeds.begin(), measured.seeds.end(),
                                 [&](const Pixel& seed) { return std::abs(seed.x) > 50000; });
    if (far) BOOST_TEST((found_shapes.largest_distances()() == nullptr));
    // A seed counts if it is in the window or owns a pixel.
    std::size_t cells = 0;
    for (std::size_t id = 0; id < count; ++id) {
      const Pixel seed = seen_from(window, measured.seeds[id]);
      const bool inside = seed.x >= 0 && seed.x < window.width() && seed.y >= 0 && seed.y < window.height();
      cells += inside || sums[id].area > 0 ? 1 : 0;
    }
    BOOST_TEST(statistics_of(diagram).cells == cells);
  });
}

BOOST_AUTO_TEST_CASE(errors_of_labels_of_windows) {
  for (const MeasuredWindow& measured : measured_windows()) {
    const Window& window = measured.window;
    const Grid& grid = window.grid();
    for (const Metric metric : both_metrics) {
      const Seeds seeds(test_device(), grid, centres(measured.seeds), to_centres);
      Diagram exact(test_device(), window), diagram(test_device(), window);
      const Labels right = brute_force(window, measured.seeds, metric);
      exact.write(right, seeds, metric);
      Labels labels = right;
      for (std::size_t i = 0; i < labels.size(); i += 3) {
        if (labels[i] != no_label) labels[i] = static_cast<std::uint32_t>(i % (seeds.size() + 1));
      }
      diagram.write(labels, seeds, metric);
      DistanceErrors expected;
      double sum = 0;
      each_labelled_pixel(
          measured, right, metric, [&](std::size_t i, std::uint32_t, const Pixel& shown, std::int64_t least) {
            if (labels[i] == seeds.size()) {
              ++expected.wrong_pixels;
              ++expected.unlabelled_pixels;
              return;
            }
            const std::int64_t d = distance(grid, shown_pixel(window, shown.x, shown.y).value(),
                                            in_period(grid, measured.seeds[labels[i]]), metric);
            if (d == least) return;
            ++expected.wrong_pixels;
            const auto longer = static_cast<double>(d - least);
            const double roots = std::sqrt(static_cast<double>(d)) + std::sqrt(static_cast<double>(least));
            const double excess = metric == Metric::euclidean ? longer / roots : longer;
            sum += excess;
            expected.largest_excess = std::max(expected.largest_excess, excess);
          });
      const DistanceErrors found = errors_of(diagram, exact);
      BOOST_TEST_CONTEXT(text_of(window, seeds.size()) << ", " << name_of(metric)) {
        BOOST_TEST(found.wrong_pixels == expected.wrong_pixels);
        BOOST_TEST(found.unlabelled_pixels == expected.unlabelled_pixels);
        BOOST_TEST(std::abs(found.largest_excess - expected.largest_excess) <=
                   1e-4 * expected.largest_excess);
        const double mean = sum / static_cast<double>(labels.size());
        BOOST_TEST(std::abs(found.mean_excess - mean) <= 1e-4 * mean);
        BOOST_TEST(errors_of(exact, exact).wrong_pixels == 0u);
      }
    }
  }
}
