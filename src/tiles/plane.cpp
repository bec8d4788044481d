#include <algorithm>
#include <string>

#include "runtime/opencl_info.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

namespace {

void check_side(const char* side, std::int64_t pixels) {
  if (pixels < 1 || pixels > Plane::max_side) {
    throw Error("the plane's " + std::string(side) + " is " + std::to_string(pixels) +
                "; it must be from 1 to " + std::to_string(Plane::max_side) + " pixels");
  }
}

void check_part(const char* axis, std::int64_t first, std::int64_t count, std::int64_t pixels) {
  if (first < 0 || count < 1 || count > pixels || first > pixels - count) {
    throw Error("the part of the plane has " + std::to_string(count) + " pixels from " + axis + " = " +
                std::to_string(first) + " on; the plane has " + std::to_string(pixels) + " along that axis");
  }
}

std::uint64_t tiles_along(std::int64_t pixels, int side) {
  return static_cast<std::uint64_t>((pixels - 1) / side + 1);
}

}  // namespace

Plane::Plane(std::int64_t width, std::int64_t height, Periodic periodic)
    : width_(width), height_(height), periodic_(periodic) {
  check_side("width", width);
  check_side("height", height);
}

Tiling::Tiling(const Plane& plane, std::int64_t side)
    : Tiling(plane, side, {0, 0, plane.width(), plane.height()}) {}

Tiling::Tiling(const Plane& plane, std::int64_t side, const PlaneRectangle& part)
    : plane_(plane), part_(part), side_(Grid(side, side).width()) {
  check_part("x", part.x, part.width, plane.width());
  check_part("y", part.y, part.height, plane.height());
  columns_ = tiles_along(part.width, side_);
  rows_ = tiles_along(part.height, side_);
}

Tile Tiling::tile(std::uint64_t number) const {
  if (number >= count()) {
    throw Error("there is no tile " + std::to_string(number) + "; the plane has " + std::to_string(count()));
  }
  const auto x = static_cast<std::int64_t>(number % columns_) * side_;
  const auto y = static_cast<std::int64_t>(number / columns_) * side_;
  return {part_.x + x, part_.y + y, static_cast<int>(std::min<std::int64_t>(side_, part_.width - x)),
          static_cast<int>(std::min<std::int64_t>(side_, part_.height - y))};
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
