// The C structs of axes, grids and windows.
#include "calls.hpp"

namespace vorocl {

namespace {

bool to_flag(int flag, const char* name) {
  if (flag != 0 && flag != 1)
    throw Error("an axis says " + std::to_string(flag) + " for " + name + "; it must be 0 or 1");
  return flag == 1;
}

Axis to_axis(const vorocl_axis& axis) {
  const bool in_pixels = axis.from == 0 && axis.to == static_cast<double>(axis.pixels);
  Axis made = in_pixels ? Axis(axis.pixels) : Axis(axis.pixels, axis.from, axis.to);
  if (to_flag(axis.periodic, "periodic")) made = made.periodic();
  if (to_flag(axis.reversed, "reversed")) made = made.reversed();
  if (to_flag(axis.closed, "closed")) made = made.closed();
  return axis.spacing == 0 ? made : made.spaced(axis.spacing);
}

vorocl_axis to_c(const Axis& axis) {
  return {axis.pixels(),
          axis.from(),
          axis.to(),
          axis.is_periodic() ? 1 : 0,
          axis.is_reversed() ? 1 : 0,
          axis.is_closed() ? 1 : 0,
          axis.spacing()};
}

bool is_zero(const vorocl_axis& axis) {
  return axis.pixels == 0 && axis.from == 0 && axis.to == 0 && axis.periodic == 0 && axis.reversed == 0 &&
         axis.closed == 0 && axis.spacing == 0;
}

/// What is no choice of axes makes an axis that is refused.
vorocl_axis axis_of_pixels(std::int64_t pixels, vorocl_periodic periodic, vorocl_periodic axis,
                           vorocl_periodic all) {
  const bool is_known = periodic >= VOROCL_PERIODIC_NONE && periodic <= all;
  const int flag = is_known ? (periodic & axis) / axis : -1;
  return {pixels, 0, static_cast<double>(pixels), flag, 0, 0, 1};
}

}  // namespace

Grid to_grid(const vorocl_grid& grid) {
  const Axis z = is_zero(grid.z) ? Axis(1) : to_axis(grid.z);
  return Grid(to_axis(grid.x), to_axis(grid.y), z).tilted(grid.tilt);
}

Window to_window(const vorocl_window& window) {
  const Grid grid = to_grid(window.grid);
  const bool is_whole =
      window.x == 0 && window.y == 0 && window.width == grid.width() && window.height == grid.height();
  return is_whole ? Window(grid) : Window(grid, window.x, window.y, window.width, window.height);
}

vorocl_grid to_c(const Grid& grid) { return {to_c(grid.x()), to_c(grid.y()), grid.tilt(), to_c(grid.z())}; }

vorocl_window to_c(const Window& window) {
  return {to_c(window.grid()), window.x(), window.y(), window.width(), window.height()};
}

}  // namespace vorocl

using namespace vorocl;

vorocl_grid vorocl_grid_of_pixels(int64_t width, int64_t height, vorocl_periodic periodic) {
  return {axis_of_pixels(width, periodic, VOROCL_PERIODIC_X, VOROCL_PERIODIC_XY),
          axis_of_pixels(height, periodic, VOROCL_PERIODIC_Y, VOROCL_PERIODIC_XY), 0,
          axis_of_pixels(1, VOROCL_PERIODIC_NONE, VOROCL_PERIODIC_Z, VOROCL_PERIODIC_XYZ)};
}

vorocl_grid vorocl_grid_of_voxels(int64_t width, int64_t height, int64_t depth, vorocl_periodic periodic) {
  const auto axis = [periodic](std::int64_t voxels, vorocl_periodic its_own) {
    return axis_of_pixels(voxels, periodic, its_own, VOROCL_PERIODIC_XYZ);
  };
  return {axis(width, VOROCL_PERIODIC_X), axis(height, VOROCL_PERIODIC_Y), 0, axis(depth, VOROCL_PERIODIC_Z)};
}

vorocl_window vorocl_window_of_grid(vorocl_grid grid) { return {grid, 0, 0, grid.x.pixels, grid.y.pixels}; }
