#include <algorithm>
#include <string>

#include "runtime/opencl_info.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

namespace {

std::uint64_t tiles_along(std::int64_t pixels, int side) {
  return static_cast<std::uint64_t>((pixels - 1) / side + 1);
}

void refuse_longer_than_a_period(const Axis& axis, std::int64_t pixels, const char* name) {
  if (!axis.is_periodic() || pixels <= axis.pixels()) return;
  throw Error("the window has " + std::to_string(pixels) + " pixels along " + name +
              ", where the grid repeats after " + std::to_string(axis.pixels()) +
              "; take a window that is no longer than that");
}

}  // namespace

Tiling::Tiling(const Window& window, std::int64_t side)
    : window_(window), side_(PixelGrid(Window(Grid(side, side))).width()) {
  refuse_volume(window.grid(), "tiles");
  refuse_tilted(window.grid(), "tiles");
  refuse_longer_than_a_period(window.grid().x(), window.width(), "x");
  refuse_longer_than_a_period(window.grid().y(), window.height(), "y");
  columns_ = tiles_along(window.width(), side_);
  rows_ = tiles_along(window.height(), side_);
}

Window Tiling::tile(std::uint64_t number) const {
  if (number >= count()) {
    throw Error("there is no tile " + std::to_string(number) + "; there are " + std::to_string(count()));
  }
  const auto x = static_cast<std::int64_t>(number % columns_) * side_;
  const auto y = static_cast<std::int64_t>(number / columns_) * side_;
  return {window_.grid(), window_.x() + x, window_.y() + y,
          std::min<std::int64_t>(side_, window_.width() - x),
          std::min<std::int64_t>(side_, window_.height() - y)};
}

int default_tile_side(const Device& device) {
  constexpr std::uint64_t bytes_per_pixel = 20;
  constexpr int least = 256, most = 4096;
  const cl_device_id id = device.cl_device()();
  const auto memory = device_info<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
  const auto largest_buffer = device_info<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  int side = most;
  const auto pixels = [&] { return static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side); };
  while (side > least &&
         (pixels() * bytes_per_pixel > memory / 4 || pixels() * sizeof(cl_uint) > largest_buffer)) {
    side /= 2;
  }
  return side;
}

}  // namespace vorocl
