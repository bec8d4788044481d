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
  return to_flag(axis.closed, "closed") ? made.closed() : made;
}

vorocl_axis to_c(const Axis& axis) {
  return {
      axis.pixels(),           axis.from(), axis.to(), axis.is_periodic() ? 1 : 0, axis.is_reversed() ? 1 : 0,
      axis.is_closed() ? 1 : 0};
}

vorocl_axis axis_of_pixels(std::int64_t pixels) { return {pixels, 0, static_cast<double>(pixels), 0, 0, 0}; }

}  // namespace

Grid to_grid(const vorocl_grid& grid) { return Grid(to_axis(grid.x), to_axis(grid.y)).tilted(grid.tilt); }

Window to_window(const vorocl_window& window) {
  return {to_grid(window.grid), window.x, window.y, window.width, window.height};
}

vorocl_grid to_c(const Grid& grid) { return {to_c(grid.x()), to_c(grid.y()), grid.tilt()}; }

vorocl_window to_c(const Window& window) {
  return {to_c(window.grid()), window.x(), window.y(), window.width(), window.height()};
}

}  // namespace vorocl

using namespace vorocl;

vorocl_grid vorocl_grid_of_pixels(int64_t width, int64_t height, vorocl_periodic periodic) {
  vorocl_grid grid = {axis_of_pixels(width), axis_of_pixels(height), 0};
  const bool known = periodic >= VOROCL_PERIODIC_NONE && periodic <= VOROCL_PERIODIC_XY;
  // What is no choice of axes is no flag either, so that the grid is refused.
  grid.x.periodic = known ? periodic & VOROCL_PERIODIC_X : -1;
  grid.y.periodic = known ? (periodic & VOROCL_PERIODIC_Y) / VOROCL_PERIODIC_Y : -1;
  return grid;
}

vorocl_window vorocl_window_of_grid(vorocl_grid grid) { return {grid, 0, 0, grid.x.pixels, grid.y.pixels}; }
