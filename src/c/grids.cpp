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

}  // namespace

Grid to_grid(const vorocl_grid& grid) {
  const Axis z = is_zero(grid.z) ? Axis(1) : to_axis(grid.z);
  return Grid(to_axis(grid.x), to_axis(grid.y), z).tilted(grid.tilt, grid.tilt_xz, grid.tilt_yz);
}

Window to_window(const vorocl_window& window) {
  const Grid grid = to_grid(window.grid);
  const bool has_all_slices = window.z == 0 && window.depth == 0;
  return Window(grid, window.x, window.y, window.z, window.width, window.height,
                has_all_slices ? grid.depth() : window.depth);
}

vorocl_grid to_c(const Grid& grid) {
  return {to_c(grid.x()), to_c(grid.y()), grid.tilt(), to_c(grid.z()), grid.tilt_xz(), grid.tilt_yz()};
}

vorocl_window to_c(const Window& window) {
  return {to_c(window.grid()), window.x(), window.y(),    window.width(),
          window.height(),     window.z(), window.depth()};
}

}  // namespace vorocl

using namespace vorocl;

vorocl_grid vorocl_grid_of_pixels(int64_t width, int64_t height, vorocl_periodic periodic) {
  return vorocl_grid_of_voxels(width, height, 1, periodic);
}

vorocl_grid vorocl_grid_of_voxels(int64_t width, int64_t height, int64_t depth, vorocl_periodic periodic) {
  const auto axis = [periodic](std::int64_t pixels, vorocl_periodic its_own) -> vorocl_axis {
    // What is no choice of axes makes an axis that is refused.
    const bool is_known = periodic >= VOROCL_PERIODIC_NONE && periodic <= VOROCL_PERIODIC_XYZ;
    const int flag = is_known ? (periodic & its_own) / its_own : -1;
    return {pixels, 0, static_cast<double>(pixels), flag, 0, 0, 1};
  };
  return {axis(width, VOROCL_PERIODIC_X),
          axis(height, VOROCL_PERIODIC_Y),
          0,
          axis(depth, VOROCL_PERIODIC_Z),
          0,
          0};
}

vorocl_window vorocl_window_of_grid(vorocl_grid grid) {
  return {grid, 0, 0, grid.x.pixels, grid.y.pixels, 0, grid.z.pixels};
}
