#include "trials/known_answers.hpp"

#include <algorithm>
#include <random>

#include "formats/values.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

namespace {

constexpr int width = 61, height = 47, seeds = 300, frames = 3;

}  // namespace

const std::vector<KnownAnswer>& known_answers() {
  constexpr Metric euclidean = Metric::euclidean, manhattan = Metric::manhattan;
  constexpr Periodic none = Periodic::none, xy = Periodic::xy;
  static const std::vector<KnownAnswer> all = {
      {"standard-flooding", euclidean, none, false, 0x3108721ca3f0548f},
      {"standard-flooding", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"standard-flooding", manhattan, none, false, 0xb0930d64a2657292},
      {"standard-flooding", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"jfa", euclidean, none, false, 0x72c2e55b8e6085c9},
      {"jfa", euclidean, xy, false, 0x296df24cdc07a7d2},
      {"jfa", manhattan, none, false, 0xb0930d64a2657292},
      {"jfa", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"jfa+1", euclidean, none, false, 0x3108721ca3f0548f},
      {"jfa+1", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"jfa+1", manhattan, none, false, 0xb0930d64a2657292},
      {"jfa+1", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"jfa+2", euclidean, none, false, 0x3108721ca3f0548f},
      {"jfa+2", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"jfa+2", manhattan, none, false, 0xb0930d64a2657292},
      {"jfa+2", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"1+jfa", euclidean, none, false, 0x3108721ca3f0548f},
      {"1+jfa", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"1+jfa", manhattan, none, false, 0xb0930d64a2657292},
      {"1+jfa", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"djfa", euclidean, none, false, 0x45ee351e7f225d29},
      {"djfa", euclidean, xy, false, 0x369dfa1e13d278ff},
      {"djfa", manhattan, none, false, 0xb0930d64a2657292},
      {"djfa", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"low-resolution", euclidean, none, false, 0x3108721ca3f0548f},
      {"low-resolution", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"low-resolution", manhattan, none, false, 0x1cf00f1969cdb6c7},
      {"low-resolution", manhattan, xy, false, 0xeeb35281394bec7b},
      {"exact", euclidean, none, false, 0x3108721ca3f0548f},
      {"exact", euclidean, xy, false, 0xc758a8ac434e6e6c},
      {"exact", manhattan, none, false, 0xb0930d64a2657292},
      {"exact", manhattan, xy, false, 0x9e1f6a0c8cdce5da},
      {"exact", euclidean, none, true, 0x74b92478e058a27c},
      {"exact", manhattan, none, true, 0x99a9e17a3772c216},
  };
  return all;
}

Grid known_grid(const KnownAnswer& answer) { return {width, height, answer.periodic}; }

std::vector<std::vector<Point>> known_frames(const KnownAnswer& answer) {
  std::mt19937 random(1);  // the same numbers with every standard library
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  std::vector<int> x(seeds), y(seeds);
  for (std::size_t i = 0; i < seeds; ++i) {
    x[i] = below(width);
    y[i] = below(height);
  }
  std::vector<std::vector<Point>> result;
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<Point>& points = result.emplace_back();
    for (std::size_t i = 0; i < seeds; ++i) {
      const int column = answer.window ? 3 * x[i] - width : x[i],
                row = answer.window ? 3 * y[i] - height : y[i];
      points.push_back({column + 0.5, row + 0.5});
      const int dx = below(2 * known_displacement + 1), dy = below(2 * known_displacement + 1);
      x[i] = std::clamp(x[i] + dx - known_displacement, 0, width - 1);
      y[i] = std::clamp(y[i] + dy - known_displacement, 0, height - 1);
    }
  }
  return result;
}

std::string to_string(const KnownAnswer& answer) {
  return answer.method + ", " + to_string(answer.metric) +
         (answer.periodic == Periodic::none ? "" : ", periodic") + (answer.window ? ", window" : "");
}

std::uint64_t hash_on(const Device& device, const KnownAnswer& answer) {
  const Grid grid = known_grid(answer);
  Seeds moving(device, grid, std::vector<Point>());
  Diagram diagram(device, grid);
  Hash hash;
  for (const std::vector<Point>& points : known_frames(answer)) {
    moving.move_to(points);
    method(answer.method).run(moving, diagram, {answer.metric});
    for (const std::uint32_t label : diagram.read()) hash.add(label);
  }
  return hash.value();
}

}  // namespace vorocl::command
