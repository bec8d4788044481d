#include "core/placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/seeds_frame.hpp"
#include "core/window_places.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/error.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

constexpr std::int64_t most_pixels_away = std::int64_t{1} << AWAY_BITS;
static_assert(Window::max_side <= 1 << SIDE_BITS);

}  // namespace

bool are_crowded(const PixelGrid& volume, const std::vector<std::uint32_t>& voxels) {
  // By bins of 8 x 8 x 8 voxels. Measured: with fewer crowded bins, and where nearly all bins have seeds,
  // labelling by candidates takes a shorter time.
  constexpr int bin_bits = 3;
  constexpr std::uint8_t crowded_from = 16;
  constexpr std::size_t bins_per_crowded_one = 48, fewest_bins = 512;
  const VoxelBits bits(volume);
  const auto bins_along = [](int side) { return (static_cast<std::size_t>(side - 1) >> bin_bits) + 1; };
  const std::size_t across = bins_along(volume.width()), down = bins_along(volume.height());
  const std::size_t bins = across * down * bins_along(volume.depth());
  if (bins < fewest_bins || voxels.size() < bins / bins_per_crowded_one * crowded_from) return false;
  std::vector<std::uint8_t> seeds(bins);
  std::size_t crowded = 0, occupied = 0;
  for (const std::uint32_t voxel : voxels) {
    if (voxel == absent_voxel) continue;
    const auto [x, y, z] = bits.unpack(voxel);
    const auto bin = [](int at) { return static_cast<std::size_t>(at) >> bin_bits; };
    std::uint8_t& of_bin = seeds[(bin(z) * down + bin(y)) * across + bin(x)];
    if (of_bin == crowded_from) continue;
    occupied += of_bin == 0 ? 1 : 0;
    ++of_bin;
    crowded += of_bin == crowded_from ? 1 : 0;
  }
  return crowded > bins / bins_per_crowded_one && occupied < bins / 8 * 7;
}

namespace {

/// How far the nearest image of a place may be in a tilted grid, in units of the spacing (docs/exact.md).
std::int64_t reach_of_tilts(const Grid& grid) {
  const Periods periods(grid);
  return (periods.x * grid.x().spacing() + periods.y * grid.y().spacing() + periods.z * grid.z().spacing() +
          1) /
         2;
}

}  // namespace

bool tilts_fit(const Grid& grid) {
  if (!grid.is_tilted()) return true;
  const Grid::Shifts shifts = grid.shifts();
  const std::int64_t reach = reach_of_tilts(grid);
  // So many images are walked at most, by boxes that may stick out of the grid.
  const auto images = [reach](const Axis& axis) {
    return (reach / axis.spacing() + SIDE_OF_PLANE) / axis.pixels() + 2;
  };
  const std::int64_t along_x =
      images(grid.y()) * std::abs(shifts.xy) + images(grid.z()) * std::abs(shifts.xz);
  const std::int64_t along_y = images(grid.z()) * std::abs(shifts.yz);
  const std::int64_t most = (std::numeric_limits<cl_int>::max() - in_fractions(2 * Window::max_side)) /
                            std::max({grid.x().spacing(), grid.y().spacing()});
  return along_x <= most && along_y <= most;
}

bool kernels_go_round(const Window& window, const PixelGrid& shown) {
  constexpr int most = 32000;  // ways across the ends of periods must fit in 16 bits
  return window.is_whole() && tilts_fit(window.grid()) && shown.periodic() == window.periodic() &&
         (!shown.periodic_x() || shown.width() <= most) && (!shown.periodic_y() || shown.height() <= most);
}

PackedPositions::PackedPositions(const PixelGrid& grid) : bits{{16, 15}}, empty(absent_position) {
  if (!grid.has_voxels()) return;
  const VoxelBits of_voxels(grid);
  bits = {{of_voxels.x, of_voxels.y}};
  empty = absent_voxel;
}

std::shared_ptr<const Placement> place_in_window(const Device& device, const Window& window,
                                                 const PixelGrid& shown, const std::vector<Place>& places) {
  const Place origin = {in_fractions(window.x()), in_fractions(window.y())};
  const std::int64_t width = in_fractions(shown.width()), height = in_fractions(shown.height());
  const auto is_outside = [&](const Place& place) {
    const auto [x, y] = place - origin;
    return x < 0 || x >= width || y < 0 || y >= height;
  };
  std::size_t outside = 0;
  for (const Place& place : places) outside += !is_absent(place) && is_outside(place) ? 1 : 0;
  if (outside > 0 || !kernels_go_round(window, shown)) {
    return std::make_shared<const Placement>(
        Placement{shown.without_periods(), nullptr, nullptr, false, true, outside});
  }
  std::vector<std::uint32_t> packed;
  packed.reserve(places.size() + 1);
  const auto pixel = [](std::int64_t at) { return static_cast<int>(pixel_of(at)); };
  for (const Place& place : places) {
    const bool is_there = !is_absent(place);
    packed.push_back(is_there ? pack(pixel(place.x - origin.x), pixel(place.y - origin.y)) : absent_position);
  }
  packed.push_back(absent_position);
  return std::make_shared<const Placement>(Placement{
      shown, std::make_shared<const cl::Buffer>(allocate_with(device, packed, "the seeds")), nullptr});
}

namespace {

Region centres_of(const Region& pixels) {
  return {centre_of(pixels.left), centre_of(pixels.top), centre_of(pixels.right), centre_of(pixels.bottom)};
}

bool fits(const Place& place) {
  const std::int64_t most = in_fractions(most_pixels_away);
  return place.x >= -most && place.x <= most && place.y >= -most && place.y <= most;
}

cl_int2 as_int2(const Place& place) { return {{static_cast<cl_int>(place.x), static_cast<cl_int>(place.y)}}; }

constexpr cl_int2 absent_point = {{absent_coordinate, 0}};

/// The place itself if it is near, else that of its images which is nearest to the window's first pixel.
Place near_image(const Place& place, const Images& images) {
  if (fits(place)) return place;
  const auto along = [](std::int64_t at, std::int64_t period) {
    return period == 0 ? at
                       : at - period * std::llround(static_cast<double>(at) / static_cast<double>(period));
  };
  return {along(place.x, images.x), along(place.y, images.y)};
}

/// By id: numbers in the order of where seeds lie themselves, of those that own places.
template <typename PlaceOf>
std::vector<cl_int2> order_of(std::vector<cl_uint> ids, std::size_t count, PlaceOf place_of) {
  const auto position = [&](cl_uint id) {
    const Place place = place_of(id);
    return std::make_pair(place.y, place.x);
  };
  std::sort(ids.begin(), ids.end(), [&](cl_uint a, cl_uint b) { return position(a) < position(b); });
  std::vector<cl_int2> order(count, absent_point);
  cl_int number = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0 && position(ids[i - 1]) < position(ids[i])) ++number;
    order[ids[i]] = {{number, number}};
  }
  return order;
}

/// What does not depend on where the seeds are; all of them are places themselves.
PointPlacement placement_of(const Window& window, const PixelGrid& shown, const cl::Buffer& seeds,
                            std::size_t count) {
  const Region region = labelled_region(window);
  const auto as_int = [](std::int64_t number) { return static_cast<cl_int>(number); };
  const Periods periods(window.grid());
  const Grid::Shifts shifts = window.grid().is_tilted() ? window.grid().shifts() : Grid::Shifts{};
  return {shown,
          seeds,
          seeds,
          seeds,
          {},
          static_cast<cl_uint>(count),
          {{as_int(region.left), as_int(region.top), 0}},
          {{as_int(region.right), as_int(region.bottom), shown.depth() - 1}},
          {{as_int(periods.x), as_int(periods.y), as_int(periods.z), 0, as_int(shifts.xy), as_int(shifts.xz),
            as_int(shifts.yz), window.grid().is_tilted() ? as_int(reach_of_tilts(window.grid())) : 0}}};
}

}  // namespace

std::shared_ptr<const PointPlacement> placed_points(const Window& window, const PixelGrid& shown,
                                                    const cl::Buffer& places, std::size_t count) {
  return std::make_shared<const PointPlacement>(placement_of(window, shown, places, count));
}

std::shared_ptr<const PointPlacement> place_points(const Device& device, const Window& window,
                                                   const PixelGrid& shown, const std::vector<Place>& given,
                                                   bool are_points, const Lags* lags) {
  const std::size_t count = given.size();
  // So that all seeds are near where they lie themselves.
  constexpr std::int64_t most_if_tilted = most_pixels_away / 2;
  const Grid& grid = window.grid();
  if (grid.is_tilted() && std::max(grid.width(), grid.height()) > most_if_tilted) {
    throw Error("the grid is tilted and has " + std::to_string(grid.width()) + " x " +
                std::to_string(grid.height()) + " pixels; diagrams of such grids take sides of at most " +
                std::to_string(most_if_tilted));
  }
  const auto place_of = [&](std::size_t id) {
    return given[id] - Place{in_fractions(window.x()), in_fractions(window.y())};
  };
  const Images images(grid);
  std::vector<cl_int2> seeds(count + 1, absent_point);
  bool all_inside = true, all_near = true, seeds_fit = true, places_fit = true;
  for (std::size_t id = 0; id < count; ++id) {
    if (is_absent(given[id])) continue;
    const Place place = place_of(id), near = near_image(place, images);
    all_near = all_near && fits(place);
    if (fits(near)) {
      seeds[id] = as_int2(near);
    } else {
      seeds_fit = false;
    }
    all_inside = all_inside && place.x >= 0 && place.x < in_fractions(shown.width()) && place.y >= 0 &&
                 place.y < in_fractions(shown.height());
  }

  std::vector<Place> places;
  std::vector<cl_uint> ids;
  const bool go_round = all_inside && kernels_go_round(window, shown);
  const Region region = labelled_region(window);
  if (!go_round && !region.empty()) {
    const Region centres = centres_of(region);
    const auto each = [&](const Images& of_seeds, auto use) {
      for (std::size_t id = 0; id < count; ++id) {
        if (is_absent(given[id])) continue;
        each_place(centres, of_seeds, place_of(id), [&](const Place& place) { use(place, id); });
      }
    };
    const auto lag_of = [lags](std::size_t id) {
      constexpr double unit = fractions_of_pixel * (fractions_of_pixel >> LAG_BITS);
      return lags == nullptr ? 0.0 : unit * lags->of_seeds[id];
    };
    Rim rim(centres);
    each(images, [&](const Place& place, std::size_t id) { rim.add_to_middle(place, lag_of(id)); });
    each(images.within(rim.reach()), [&](const Place& place, std::size_t id) {
      rim.add(place, lag_of(id));
      places.push_back(place);
      ids.push_back(static_cast<cl_uint>(id));
    });
    std::size_t stay = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (rim.rules_out(places[i], lag_of(ids[i]))) continue;
      if (!fits(places[i]) && are_points) {
        throw Error("seed " + std::to_string(ids[i]) + " may own pixels of the diagram, and lies more than " +
                    std::to_string(most_pixels_away) +
                    " pixels from its window's first one: that is too far for positions within a pixel; snap "
                    "the seeds to pixels, or take a window nearer to them");
      }
      places_fit = places_fit && fits(places[i]);
      places[stay] = places[i];
      ids[stay] = ids[i];
      ++stay;
    }
    places.resize(stay);
    ids.resize(stay);
  }

  const auto in_whole_pixels = [](const Place& place) {
    return as_int2({pixel_of(place.x), pixel_of(place.y)});
  };
  const bool seeds_in_pixels = !seeds_fit && !are_points;
  if (seeds_in_pixels) {
    for (std::size_t id = 0; id < count; ++id) {
      if (!is_absent(given[id])) seeds[id] = in_whole_pixels(place_of(id));
    }
  }
  PointPlacement placed = placement_of(window, shown, allocate_with(device, seeds, "the seeds"), count);
  if (go_round) return std::make_shared<const PointPlacement>(std::move(placed));

  placed.grid = shown.without_periods();
  placed.seeds_in_pixels = seeds_in_pixels;
  placed.places_in_pixels = !places_fit;
  placed.count = static_cast<cl_uint>(places.size());
  if (!places.empty()) {
    std::vector<cl_int2> of_places;
    of_places.reserve(places.size());
    for (const Place& place : places)
      of_places.push_back(places_fit ? as_int2(place) : in_whole_pixels(place));
    placed.places = allocate_with(device, of_places, "the seeds of a window");
    placed.ids = allocate_with(device, ids, "the seeds of a window");
    if (!all_near)
      placed.order = allocate_with(device, order_of(ids, count, place_of), "the order of the seeds");
  }
  return std::make_shared<const PointPlacement>(std::move(placed));
}

}  // namespace vorocl
