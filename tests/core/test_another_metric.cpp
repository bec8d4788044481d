// The worked example of docs/extending.md, "Adding a metric": Chebyshev's, the greater offset along an axis,
// in flooding.
#define BOOST_TEST_MODULE another_metric
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "fixture.hpp"
#include "runtime/kernel_sources.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;

namespace {

/// The kernels' one function of an offset, and what it is for the Chebyshev metric.
const std::string sum_of_both_axes =
    "  return AS_UINT_V(CONVERT_INT_V(offset.even) * CONVERT_INT_V(factor.even) +\n"
    "                   CONVERT_INT_V(offset.odd) * CONVERT_INT_V(factor.odd));\n";
const std::string greater_one =
    "  return AS_UINT_V(max(CONVERT_INT_V(offset.even) * CONVERT_INT_V(factor.even),\n"
    "                       CONVERT_INT_V(offset.odd) * CONVERT_INT_V(factor.odd)));\n";

/// From now on kernels are built with the Chebyshev metric in the place of the Manhattan one.
void replace_manhattan_by_chebyshev(const TemporaryFolder& folder) {
  for (const char* const room : {"core", "flooding", "volumes"})
    std::filesystem::create_directory(folder / room);
  for (const auto& [name, text] : kernel_sources()) {
    std::string kernel = text;
    const auto at = kernel.find(sum_of_both_axes);
    if (at != std::string::npos) kernel.replace(at, sum_of_both_axes.size(), greater_one);
    BOOST_TEST((at != std::string::npos) == (name == "core/position.cl"), name);
    const bool is_used = std::filesystem::exists(folder / name.substr(0, name.find('/')));
    if (is_used) folder.file(name, kernel);
  }
  setenv("VOROCL_KERNEL_DIR", std::string(folder / "").c_str(), 1);
}

/// The label of a pixel: of the seeds at the least Chebyshev distance the first one in row-major order.
std::uint32_t nearest(const std::vector<Point>& seeds, int x, int y) {
  std::uint32_t best = no_label;
  std::array<int, 3> chosen = {};  // distance, row, column
  for (std::uint32_t id = 0; id < seeds.size(); ++id) {
    const int seed_x = static_cast<int>(seeds[id].x), seed_y = static_cast<int>(seeds[id].y);
    const int distance = std::max(std::abs(seed_x - x), std::abs(seed_y - y));
    const std::array<int, 3> choice = {distance, seed_y, seed_x};
    if (best == no_label || choice < chosen) {
      best = id;
      chosen = choice;
    }
  }
  return best;
}

}  // namespace

// Standard flooding is exact in this metric: the pixel one step nearer to the nearest seed has that seed's
// label, or that of another one which is as near to both pixels.
BOOST_AUTO_TEST_CASE(standard_flooding_by_the_chebyshev_metric) {
  const TemporaryFolder folder;
  replace_manhattan_by_chebyshev(folder);
  const Grid grid(157, 93);
  const std::vector<Point> points = {{3.5, 80.5},  {20.5, 11.5}, {21.5, 11.5},  {70.5, 45.5},  {71.5, 47.5},
                                     {99.5, 90.5}, {130.5, 2.5}, {156.5, 92.5}, {130.5, 60.5}, {44.5, 70.5}};
  const Seeds seeds(test_device(), grid, points, to_centres);
  Diagram diagram(test_device(), grid);
  standard_flooding(seeds, diagram, {Metric::manhattan, Neighbourhood::moore});
  const auto labels = diagram.read();
  std::size_t wrong = 0;
  for (int y = 0; y < 93; ++y) {
    for (int x = 0; x < 157; ++x)
      wrong += labels[static_cast<std::size_t>(y * 157 + x)] != nearest(points, x, y) ? 1 : 0;
  }
  BOOST_TEST(wrong == 0);
}
