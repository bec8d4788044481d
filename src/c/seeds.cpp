// The C functions of seeds and their motion.
#include <limits>
#include <optional>
#include <vector>

#include "calls.hpp"

using namespace vorocl;

namespace {

/// A view of the caller's points.
Points to_points(const vorocl_point* points, const uint8_t* present, std::size_t count) {
  static_assert(sizeof(vorocl_point) == 3 * sizeof(double));
  if (count == 0) return Points(std::vector<Point>());
  return Points(&given(points, "points").x, &points->y, &points->z, count, sizeof(vorocl_point))
      .marked(present);
}

Points to_weighted(const vorocl_point* points, const double* weights, const uint8_t* present,
                   std::size_t count) {
  return to_points(points, present, count).weighted(count == 0 ? nullptr : &given(weights, "weights"));
}

PointBuffer to_points(cl_mem points, vorocl_point_format format, cl_mem present, std::size_t count) {
  given(points, "points");
  constexpr PointFormat formats[] = {PointFormat::floats_xy, PointFormat::doubles_xy, PointFormat::floats_xyz,
                                     PointFormat::doubles_xyz};
  if (format < VOROCL_FLOATS_XY || format > VOROCL_DOUBLES_XYZ) refuse("format of points", format);
  return {retained(points), count, formats[format], retained(present)};
}

Outside to_outside(vorocl_outside outside) {
  if (outside == VOROCL_OUTSIDE_COUNTS) return Outside::count;
  if (outside == VOROCL_OUTSIDE_IS_ABSENT) return Outside::absent;
  if (outside == VOROCL_OUTSIDE_IS_REFUSED) return Outside::refuse;
  refuse("choice for points outside", outside);
}

Border to_border(vorocl_border border) {
  if (border == VOROCL_REFLECT) return Border::reflect;
  if (border == VOROCL_PERIODIC) return Border::periodic;
  refuse("border", border);
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Stores what `read` gives of the seeds, where there is room for so many.
template <typename Read>
vorocl_status read_points(const vorocl_seeds* seeds, Read read, vorocl_point* points, std::size_t count) {
  return guarded([&] {
    check_count(of(seeds).size(), "seeds", count);
    if (count > 0) given(points, "points");
    for (const std::optional<Point>& point : (of(seeds).*read)()) {
      *points++ = to_c(point.value_or(Point{none, none, none}));
    }
  });
}

}  // namespace

vorocl_status vorocl_seeds_from_points(const vorocl_device* device, vorocl_grid grid,
                                       const vorocl_point* points, const uint8_t* present, size_t count,
                                       vorocl_outside outside, vorocl_snap snap, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{Seeds(of(device), to_grid(grid), to_points(points, present, count),
                              {to_outside(outside), to_snap(snap)})};
  });
}

vorocl_status vorocl_seeds_from_weighted_points(const vorocl_device* device, vorocl_grid grid,
                                                const vorocl_point* points, const double* weights,
                                                const uint8_t* present, size_t count, vorocl_outside outside,
                                                vorocl_snap snap, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{Seeds(of(device), to_grid(grid), to_weighted(points, weights, present, count),
                              {to_outside(outside), to_snap(snap)})};
  });
}

vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, vorocl_grid grid, cl_mem points,
                                       vorocl_point_format format, cl_mem present, size_t count,
                                       vorocl_outside outside, vorocl_snap snap, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{Seeds(of(device), to_grid(grid), to_points(points, format, present, count),
                              {to_outside(outside), to_snap(snap)})};
  });
}

vorocl_status vorocl_seeds_from_mask(const vorocl_device* device, vorocl_grid grid, const uint8_t* mask,
                                     size_t count, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    const Grid of_mask = to_grid(grid);
    check_count(of_mask.pixels(), "pixels", count);
    const uint8_t* const first = &given(mask, "mask");
    return vorocl_seeds{Seeds::from_mask(of(device), of_mask, {first, first + count})};
  });
}

vorocl_status vorocl_seeds_random(const vorocl_device* device, vorocl_grid grid, size_t count,
                                  uint64_t rng_seed, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds",
                     [&] { return vorocl_seeds{Seeds::random(of(device), to_grid(grid), count, rng_seed)}; });
}

vorocl_status vorocl_seeds_clone(const vorocl_seeds* seeds, vorocl_seeds** clone) {
  return make_object(clone, "clone", [&] { return vorocl_seeds{of(seeds).clone()}; });
}

void vorocl_seeds_free(vorocl_seeds* seeds) { delete seeds; }

vorocl_status vorocl_seeds_grid(const vorocl_seeds* seeds, vorocl_grid* grid) {
  return answer(grid, "grid", [&] { return to_c(of(seeds).grid()); });
}

vorocl_status vorocl_seeds_count(const vorocl_seeds* seeds, size_t* count) {
  return answer(count, "count", [&] { return of(seeds).size(); });
}

vorocl_status vorocl_seeds_alive(const vorocl_seeds* seeds, size_t* alive) {
  return answer(alive, "alive", [&] { return of(seeds).alive(); });
}

vorocl_status vorocl_seeds_outside(const vorocl_seeds* seeds, size_t* outside) {
  return answer(outside, "outside", [&] { return of(seeds).outside(); });
}

vorocl_status vorocl_seeds_displacement(const vorocl_seeds* seeds, double* displacement) {
  return answer(displacement, "displacement", [&] { return of(seeds).displacement(); });
}

vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points, const uint8_t* present,
                                   size_t count) {
  return guarded([&] { of(seeds).move_to(to_points(points, present, count)); });
}

vorocl_status vorocl_seeds_move_to_weighted_points(vorocl_seeds* seeds, const vorocl_grid* grid,
                                                   const vorocl_point* points, const double* weights,
                                                   const uint8_t* present, size_t count) {
  return guarded([&] {
    const Grid next = grid == nullptr ? of(seeds).grid() : to_grid(*grid);
    of(seeds).move_to(next, to_weighted(points, weights, present, count));
  });
}

vorocl_status vorocl_seeds_move_to_grid(vorocl_seeds* seeds, vorocl_grid grid, const vorocl_point* points,
                                        const uint8_t* present, size_t count) {
  return guarded([&] { of(seeds).move_to(to_grid(grid), to_points(points, present, count)); });
}

vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points, vorocl_point_format format,
                                          cl_mem present, size_t count) {
  return guarded([&] { of(seeds).move_to(to_points(points, format, present, count)); });
}

vorocl_status vorocl_random_step(vorocl_seeds* seeds, int max_displacement, vorocl_border border,
                                 uint64_t rng_seed, uint32_t frame) {
  return guarded([&] { random_step(of(seeds), max_displacement, to_border(border), rng_seed, frame); });
}

vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count) {
  return read_points(seeds, &Seeds::read, points, count);
}

vorocl_status vorocl_seeds_read_pixels(const vorocl_seeds* seeds, vorocl_point* points, size_t count) {
  return read_points(seeds, &Seeds::read_pixels, points, count);
}

vorocl_status vorocl_seeds_check(const vorocl_seeds* seeds) {
  return guarded([&] { of(seeds).check(); });
}
