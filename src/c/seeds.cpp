// The C functions of seeds and their motion.
#include <limits>
#include <optional>
#include <vector>

#include "calls.hpp"

using namespace vorocl;

namespace {

std::vector<std::optional<Point>> to_points(const vorocl_point* points, const uint8_t* present,
                                            std::size_t count) {
  if (count > 0) given(points, "points");
  // Checked before the list is copied.
  if (count > Grid::max_pixels)
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
  std::vector<std::optional<Point>> list(count);
  for (std::size_t id = 0; id < count; ++id) {
    if (present == nullptr || present[id] != 0) list[id] = Point{points[id].x, points[id].y};
  }
  return list;
}

Domain to_domain(const vorocl_domain& domain) {
  return {domain.x, domain.y, domain.width, domain.height, to_periodic(domain.periodic)};
}

Border to_border(vorocl_border border) {
  if (border == VOROCL_REFLECT) return Border::reflect;
  if (border == VOROCL_PERIODIC) return Border::periodic;
  refuse("border", border);
}

}  // namespace

vorocl_status vorocl_seeds_from_points(const vorocl_device* device, vorocl_grid grid,
                                       const vorocl_point* points, const uint8_t* present, size_t count,
                                       vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{Seeds(of(device), to_grid(grid), to_points(points, present, count))};
  });
}

vorocl_status vorocl_seeds_in_domain(const vorocl_device* device, vorocl_grid grid, vorocl_domain domain,
                                     const vorocl_point* points, const uint8_t* present, size_t count,
                                     vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{
        Seeds(of(device), to_grid(grid), to_points(points, present, count), to_domain(domain))};
  });
}

vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, vorocl_grid grid, cl_mem points,
                                       cl_mem present, size_t count, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    given(points, "points");
    return vorocl_seeds{Seeds(of(device), to_grid(grid), retained(points), count, retained(present))};
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

vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points, const uint8_t* present,
                                   size_t count) {
  return guarded([&] { of(seeds).move_to(to_points(points, present, count)); });
}

vorocl_status vorocl_seeds_move_in_domain(vorocl_seeds* seeds, vorocl_domain domain,
                                          const vorocl_point* points, const uint8_t* present, size_t count) {
  return guarded([&] { of(seeds).move_to(to_points(points, present, count), to_domain(domain)); });
}

vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points, cl_mem present, size_t count) {
  return guarded([&] {
    given(points, "points");
    of(seeds).move_to(retained(points), count, retained(present));
  });
}

vorocl_status vorocl_random_step(vorocl_seeds* seeds, int max_displacement, vorocl_border border,
                                 uint64_t rng_seed, uint32_t frame) {
  return guarded([&] { random_step(of(seeds), max_displacement, to_border(border), rng_seed, frame); });
}

vorocl_status vorocl_seeds_positions(const vorocl_seeds* seeds, cl_mem* positions) {
  return answer(positions, "positions", [&] { return of(seeds).positions()(); });
}

vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count) {
  return guarded([&] {
    check_count(of(seeds).size(), "seeds", count);
    if (count > 0) given(points, "points");
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const std::optional<Point>& point : of(seeds).read()) {
      *points++ = to_c(point.value_or(Point{none, none}));
    }
  });
}

vorocl_status vorocl_seeds_check(const vorocl_seeds* seeds) {
  return guarded([&] { of(seeds).check(); });
}
