#include "checks/known_answers.hpp"

#include <algorithm>
#include <random>

#include "formats/values.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

namespace {

struct Setting {
  const char* name;
  int width, height;
  std::size_t seeds;  // of those that are random
  int frames, depth = 1;
};

const Setting& setting_of(Scene scene) {
  static const Setting all[] = {{"", 61, 47, 300, 3},
                                {"window", 61, 47, 300, 3},
                                {"ring", 301, 287, 0, 1},
                                {"blocks", 260, 200, 0, 1},
                                {"few seeds", 500, 300, 5, 1},
                                {"long period", 16001, 24, 40, 1},
                                {"full size", 2048, 2048, 16384, 2},
                                {"points", 61, 47, 300, 3},
                                {"volume", 61, 47, 900, 3, 21},
                                {"mask", 301, 287, 0, 1}};
  return all[static_cast<int>(scene)];
}

/// In whole numbers, which are the same with every compiler: the pixels between two circles.
std::vector<Point> ring(const Setting& setting) {
  std::vector<Point> points;
  for (int y = 0; y < setting.height; ++y) {
    for (int x = 0; x < setting.width; ++x) {
      const int dx = 2 * x - setting.width, dy = 2 * y - setting.height, squared = dx * dx + dy * dy;
      if (squared >= 278 * 278 && squared < 280 * 280) points.push_back({x + 0.5, y + 0.5});
    }
  }
  return points;
}

std::vector<Point> blocks(const Setting& setting) {
  constexpr int side = 64;
  std::vector<Point> points;
  for (int y = 0; y < setting.height; ++y) {
    for (int x = 0; x < setting.width; ++x) {
      if ((x / side + y / side) % 2 == 0) points.push_back({x + 0.5, y + 0.5});
    }
  }
  return points;
}

}  // namespace

const std::vector<KnownAnswer>& known_answers() {
  constexpr Metric euclidean = Metric::euclidean, manhattan = Metric::manhattan;
  constexpr Axes none = Axes::none, xy = Axes::xy;
  constexpr Scene plain = Scene::scattered;
  static const std::vector<KnownAnswer> all = {
      {"standard-flooding", euclidean, none, plain, 0x3108721ca3f0548f},
      {"standard-flooding", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"standard-flooding", manhattan, none, plain, 0xb0930d64a2657292},
      {"standard-flooding", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"jfa", euclidean, none, plain, 0x72c2e55b8e6085c9},
      {"jfa", euclidean, xy, plain, 0x296df24cdc07a7d2},
      {"jfa", manhattan, none, plain, 0xb0930d64a2657292},
      {"jfa", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"jfa+1", euclidean, none, plain, 0x3108721ca3f0548f},
      {"jfa+1", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"jfa+1", manhattan, none, plain, 0xb0930d64a2657292},
      {"jfa+1", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"jfa+2", euclidean, none, plain, 0x3108721ca3f0548f},
      {"jfa+2", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"jfa+2", manhattan, none, plain, 0xb0930d64a2657292},
      {"jfa+2", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"1+jfa", euclidean, none, plain, 0x3108721ca3f0548f},
      {"1+jfa", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"1+jfa", manhattan, none, plain, 0xb0930d64a2657292},
      {"1+jfa", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"djfa", euclidean, none, plain, 0x72c2e55b8e6085c9},
      {"djfa", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"djfa", manhattan, none, plain, 0xb0930d64a2657292},
      {"djfa", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"low-resolution", euclidean, none, plain, 0x3108721ca3f0548f},
      {"low-resolution", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"exact", euclidean, none, plain, 0x3108721ca3f0548f},
      {"exact", euclidean, xy, plain, 0xc758a8ac434e6e6c},
      {"exact", manhattan, none, plain, 0xb0930d64a2657292},
      {"exact", manhattan, xy, plain, 0x9e1f6a0c8cdce5da},
      {"exact", euclidean, none, Scene::window, 0x74b92478e058a27c},
      {"exact", manhattan, none, Scene::window, 0x99a9e17a3772c216},
      {"exact", euclidean, none, Scene::ring, 0x3d94d10a382b024e},
      {"exact", manhattan, none, Scene::ring, 0x8cda90e1be87eaa2},
      {"exact", euclidean, none, Scene::blocks, 0xb7aa335c714b0dcc},
      {"exact", manhattan, none, Scene::blocks, 0xb7aa335c714b0dcc},
      {"exact", euclidean, none, Scene::few, 0xc31094612a376823},
      {"exact", manhattan, none, Scene::few, 0x2fe792820a313112},
      {"exact", euclidean, Axes::x, Scene::long_period, 0xef105ace872187fd},
      {"exact", manhattan, Axes::x, Scene::long_period, 0x31ebfe0273924a41},
      {"jfa", euclidean, none, Scene::full_size, 0xf001996b02f60428},
      {"djfa", euclidean, none, Scene::full_size, 0xf001996b02f60428},
      {"exact", euclidean, none, Scene::points, 0xaf37ec7da1cf9130},
      {"exact", euclidean, xy, Scene::points, 0xa642c5bbe1d2448d},
      {"exact", manhattan, none, Scene::points, 0x3fb93ca577bc0552},
      {"exact", euclidean, none, Scene::volume, 0x55122db87f37c0ad},
      {"exact", euclidean, Axes::xyz, Scene::volume, 0x2fcb4623457ea524},
      {"exact", euclidean, none, Scene::mask, 0x3d94d10a382b024e},
      {"exact", euclidean, xy, Scene::mask, 0x3d94d10a382b024e},
  };
  return all;
}

Grid known_grid(const KnownAnswer& answer) {
  const Setting& setting = setting_of(answer.scene);
  return {setting.width, setting.height, setting.depth, answer.periodic};
}

namespace {

/// Between the centres of pixels, all anew in each frame: every other one of a volume in a corner of it.
std::vector<std::vector<Point>> frames_of_points(const Setting& setting) {
  constexpr int parts = 4096;
  std::mt19937 random(1);
  const auto below = [&](int end) {
    return static_cast<double>(random() % static_cast<unsigned>(end * parts)) / parts;
  };
  std::vector<std::vector<Point>> frames(static_cast<std::size_t>(setting.frames));
  for (std::vector<Point>& points : frames) {
    for (std::size_t i = 0; i < setting.seeds; ++i) {
      const int share = setting.depth > 1 && i % 2 == 0 ? 5 : 1;
      const double x = below(setting.width / share), y = below(setting.height / share);
      points.push_back({x, y, setting.depth > 1 ? below(setting.depth / share) : 0.5});
    }
  }
  return frames;
}

}  // namespace

std::vector<std::vector<Point>> known_frames(const KnownAnswer& answer) {
  const Setting& setting = setting_of(answer.scene);
  if (answer.scene == Scene::ring || answer.scene == Scene::mask) return {ring(setting)};
  if (answer.scene == Scene::points || answer.scene == Scene::volume) return frames_of_points(setting);
  if (answer.scene == Scene::blocks) return {blocks(setting)};
  std::mt19937 random(1);  // the same numbers with every standard library
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  const int width = setting.width, height = setting.height;
  std::vector<int> x(setting.seeds), y(setting.seeds);
  for (std::size_t i = 0; i < setting.seeds; ++i) {
    x[i] = below(width);
    y[i] = below(height);
  }
  std::vector<std::vector<Point>> result;
  for (int frame = 0; frame < setting.frames; ++frame) {
    std::vector<Point>& points = result.emplace_back();
    for (std::size_t i = 0; i < setting.seeds; ++i) {
      const bool spread = answer.scene == Scene::window;
      const int column = spread ? 3 * x[i] - width : x[i], row = spread ? 3 * y[i] - height : y[i];
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
         (answer.periodic == Axes::none ? "" : ", periodic") +
         (answer.scene == Scene::scattered ? "" : std::string(", ") + setting_of(answer.scene).name);
}

namespace {

std::vector<std::uint8_t> mask_of(const Grid& grid, const std::vector<Point>& points) {
  std::vector<std::uint8_t> mask(grid.pixels());
  for (const Point& point : points)
    mask[static_cast<std::size_t>(point.y) * static_cast<std::size_t>(grid.width()) +
         static_cast<std::size_t>(point.x)] = 1;
  return mask;
}

std::uint64_t hash_on(const Device& device, const KnownAnswer& answer) {
  const Grid grid = known_grid(answer);
  const bool are_points = answer.scene == Scene::points || answer.scene == Scene::volume;
  Seeds moving(device, grid, std::vector<Point>(),
               {Outside::count, are_points ? Snap::none : Snap::to_pixels});
  Diagram diagram(device, grid);
  Hash hash;
  for (const std::vector<Point>& points : known_frames(answer)) {
    if (answer.scene == Scene::mask) {
      moving = Seeds::from_mask(device, grid, mask_of(grid, points));
    } else {
      moving.move_to(points);
    }
    method(answer.method).run(moving, diagram, {answer.metric});
    for (const std::uint32_t label : diagram.read()) hash.add(label);
  }
  return hash.value();
}

}  // namespace

std::vector<std::string> wrong_answers(const Device& device, const std::string& only) {
  std::vector<std::string> wrong;
  for (const KnownAnswer& answer : known_answers()) {
    const std::string name = to_string(answer);
    if (!only.empty() && name != only) continue;
    try {
      if (hash_on(device, answer) != answer.hash) wrong.push_back(name);
    } catch (const std::exception& error) {  // ours, or out of memory
      const std::string reason = error.what();
      wrong.push_back(name + ": " + reason.substr(0, reason.find('\n')));
    }
  }
  return wrong;
}

}  // namespace vorocl::command
