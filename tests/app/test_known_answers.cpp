// The hashes of the diagrams that `vorocl devices --check` knows, computed anew on the host; and a check of a
// device that errs.
#define BOOST_TEST_MODULE known_answers
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "checks/known_answers.hpp"
#include "formats/values.hpp"
#include "reference_flood.hpp"
#include "run_command.hpp"
#include "seed_tree.hpp"

using namespace vorocl;
using namespace vorocl::command;
using nlohmann::json;

namespace {

using Labels = std::vector<std::uint32_t>;

Plan plan_of(const std::string& method, const Grid& grid) {
  if (method == "standard-flooding")
    return Plan(static_cast<std::size_t>(Window(grid).longest_side()));  // enough
  const std::map<std::string, JumpFloodingVariant> variants = {{"jfa", JumpFloodingVariant::jfa},
                                                               {"djfa", JumpFloodingVariant::jfa},
                                                               {"jfa+1", JumpFloodingVariant::jfa_plus_1},
                                                               {"jfa+2", JumpFloodingVariant::jfa_plus_2},
                                                               {"1+jfa", JumpFloodingVariant::one_plus_jfa}};
  return jump_flooding_plan(grid, variants.at(method));
}

/// JFA's plan from the least step that reaches as far as the pixels of a row of every eight are from where
/// their labels' seeds are now, or 2 L, and 4 rows more; and a wave of step 1 if the paper's plan has a wave
/// more than that, or JFA's has on a periodic grid.
Plan measured_plan(const Grid& grid, const std::vector<Pixel>& seeds, const Labels& labels, Metric metric) {
  const double length_squared = static_cast<double>(grid.pixels()) / static_cast<double>(seeds.size());
  const bool squared = metric == Metric::euclidean;
  double greatest =
      squared ? 2 * std::sqrt(length_squared) : std::sqrt(2 * 3.14159265358979 * length_squared);
  for (std::int64_t of_row = 0; of_row < grid.height(); of_row += 8) {
    const std::int64_t y = std::min<std::int64_t>(of_row + 4, grid.height() - 1);
    for (std::int64_t x = 0; x < grid.width(); ++x) {
      const auto at = static_cast<std::size_t>(y * grid.width() + x);
      const auto to_seed = static_cast<double>(distance(grid, {x, y}, seeds[labels[at]], metric));
      greatest = std::max(greatest, squared ? std::sqrt(to_seed) : to_seed);
    }
  }
  const Plan full = plan_of("jfa", grid);
  Plan plan = full;
  while (plan.size() > 1 && plan.front().step - 1 >= greatest + 4) plan.erase(plan.begin());
  if (plan.size() < dynamic_jump_flooding_plan(grid, seeds.size(), 0).size() ||
      (grid.periodic() != Axes::none && plan.size() < full.size()))
    plan.push_back({1, Neighbourhood::moore});
  return plan;
}

/// Frame 0 is one of both methods, and takes the host seconds.
const Labels& jfa_of_full_size(const Grid& grid, const std::vector<Pixel>& seeds) {
  static std::map<std::vector<Pixel>, Labels> known;
  Labels& labels = known[seeds];
  if (labels.empty()) labels = reference_flood(grid, seeds, plan_of("jfa", grid), Metric::euclidean);
  return labels;
}

Labels expected_labels(const KnownAnswer& answer, const std::vector<Pixel>& seeds, const Labels& before) {
  const Grid grid = known_grid(answer);
  if (answer.method == "exact") {
    const bool few = grid.pixels() * seeds.size() < 20'000'000;
    return few ? brute_force(grid, seeds, answer.metric) : tree_labels(grid, seeds, answer.metric);
  }
  if (answer.method == "low-resolution") return reference_low_resolution(grid, seeds);
  if (answer.method == "djfa" && !before.empty()) {
    return reference_flood(grid, seeds, measured_plan(grid, seeds, before, answer.metric), answer.metric);
  }
  if (answer.scene == Scene::full_size) return jfa_of_full_size(grid, seeds);
  return reference_flood(grid, seeds, plan_of(answer.method, grid), answer.metric);
}

/// In whole numbers of 1/4096 pixel, of which a period may lie between a pixel and a point.
Labels labels_of_points(const Grid& grid, const std::vector<Point>& points, Metric metric) {
  constexpr std::int64_t parts = 4096;
  const auto whole = [](double at) { return static_cast<std::int64_t>(at * parts); };
  const auto way = [&](std::int64_t pixel, double at, const Axis& axis) {
    const std::int64_t inside = std::abs(pixel * parts + parts / 2 - whole(at)),
                       period = axis.pixels() * parts;
    return axis.is_periodic() ? std::min(inside, period - inside) : inside;
  };
  Labels labels;
  for (std::int64_t z = 0; z < grid.depth(); ++z) {
    for (std::int64_t y = 0; y < grid.height(); ++y) {
      for (std::int64_t x = 0; x < grid.width(); ++x) {
        std::tuple<std::int64_t, double, double, double, std::uint32_t> best(
            std::numeric_limits<std::int64_t>::max(), 0, 0, 0, 0);
        for (std::uint32_t id = 0; id < points.size(); ++id) {
          const Point& p = points[id];
          const std::int64_t dx = way(x, p.x, grid.x()), dy = way(y, p.y, grid.y());
          const std::int64_t dz = grid.is_volume() ? way(z, p.z, grid.z()) : 0;
          const std::int64_t distance =
              metric == Metric::manhattan ? dx + dy + dz : dx * dx + dy * dy + dz * dz;
          best = std::min(best, std::make_tuple(distance, p.z, p.y, p.x, id));
        }
        labels.push_back(std::get<4>(best));
      }
    }
  }
  return labels;
}

std::uint64_t expected_hash(const KnownAnswer& answer) {
  Hash hash;
  Labels labels;
  for (const std::vector<Point>& points : known_frames(answer)) {
    labels = answer.scene == Scene::points || answer.scene == Scene::volume
                 ? labels_of_points(known_grid(answer), points, answer.metric)
                 : expected_labels(answer, pixels_of(points), labels);
    for (const std::uint32_t label : labels) hash.add(label);
  }
  return hash.value();
}

/// Copies the kernels into the folder, with one text in one file replaced.
void copy_kernels(const TemporaryFolder& folder, const std::string& file, const std::string& text,
                  const std::string& by) {
  std::filesystem::copy(VOROCL_KERNELS, folder / "kernels", std::filesystem::copy_options::recursive);
  std::string source = content_of(folder / ("kernels/" + file));
  const std::size_t at = source.find(text);
  BOOST_REQUIRE(at != std::string::npos);
  folder.file("kernels/" + file, source.replace(at, text.size(), by));
}

}  // namespace

BOOST_AUTO_TEST_CASE(hashes_are_those_of_the_host) {
  std::set<std::string> names;
  for (const KnownAnswer& answer : known_answers()) {
    names.insert(answer.method);
    const std::uint64_t expected = expected_hash(answer);
    BOOST_TEST(answer.hash == expected, to_string(answer) << ": 0x" << std::hex << expected);
  }
  for (const Method& method : methods()) BOOST_TEST(names.count(method.name) == 1u, method.name);
}

BOOST_AUTO_TEST_CASE(this_device_knows_them) {
  const TemporaryFolder folder;
  const std::string all = std::to_string(known_answers().size());
  BOOST_TEST(succeeds(folder, "devices --check").find(all + " of " + all + " known diagrams") !=
             std::string::npos);
  const json devices = json::parse(succeeds(folder, "devices --check --json")).at("devices");
  BOOST_REQUIRE(devices.size() == 1u);  // VOROCL_DEVICE says which
  BOOST_TEST(devices[0]["checked"] == known_answers().size());
  BOOST_TEST(devices[0]["wrong"].empty());
}

BOOST_AUTO_TEST_CASE(the_shape_for_gpus_knows_them) {
  Tuning tuning = test_device().tuning();
  tuning.shape = Shape::group;
  const Device device = test_device().with_tuning(tuning);
  for (const char* name : {"exact, euclidean, points", "exact, euclidean, volume", "exact, euclidean, mask"})
    BOOST_TEST(wrong_answers(device, name).empty(), name);
}

BOOST_AUTO_TEST_CASE(all_devices_are_checked_unless_one_is_asked_for) {
  const TemporaryFolder folder;
  // Two devices of PoCL; and no kernels, so that a check is short.
  const auto checked = [&](const std::string& variable) {
    const Result result =
        run(folder, "devices --check --json", "POCL_DEVICES='basic pthread' VOROCL_KERNEL_DIR=. " + variable);
    BOOST_TEST(result.exit_code == failure, result.error);
    return json::parse(result.out).at("devices").size();
  };
  const std::size_t all = checked("env -u VOROCL_DEVICE");
  BOOST_TEST(all >= 2u);
  BOOST_TEST(checked("VOROCL_DEVICE=") == all);
  BOOST_TEST(checked("VOROCL_DEVICE=0:0") == 1u);
}

BOOST_AUTO_TEST_CASE(a_kernel_that_errs_is_named) {
  const TemporaryFolder folder;
  copy_kernels(folder, "flooding/jump_flooding.cl", "height, step), out", "height, 1), out");
  const Result result = run(folder, "devices --check", "VOROCL_KERNEL_DIR=kernels");
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(result.out.find("wrong: jfa, euclidean\n") != std::string::npos, result.out);
  BOOST_TEST(result.out.find("wrong: exact") == std::string::npos, result.out);
  BOOST_TEST(result.error.find("vorocl: error: ") == 0u, result.error);
}

BOOST_AUTO_TEST_CASE(a_kernel_that_cannot_be_built_is_named) {
  const TemporaryFolder folder;
  copy_kernels(folder, "flooding/jump_flooding.cl", "height, step), out", "no such word");
  const Result result = run(folder, "devices --check --json", "VOROCL_KERNEL_DIR=kernels");
  BOOST_TEST(result.exit_code == failure);
  const json wrong = json::parse(result.out).at("devices")[0]["wrong"];
  BOOST_TEST(wrong.size() == 28u);  // all but the exact ones
  BOOST_TEST(wrong[0].get<std::string>().rfind("standard-flooding, euclidean: building", 0) == 0u, wrong[0]);
}
