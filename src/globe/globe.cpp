#include "globe/globe.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "runtime/buffer.hpp"
#include "runtime/has_doubles.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"
#include "globe/sizes.cl"

namespace vorocl {

namespace {

constexpr double half_turn = 180, quarter_turn = 90;

struct Turn {
  double cosine, sine;
};

Turn turn_of(double degrees) {
  constexpr double pi = 3.14159265358979323846;
  const double angle = std::remainder(degrees, 2 * half_turn) * (pi / half_turn);
  return {std::cos(angle), std::sin(angle)};
}

cl_int rounded(double part) { return static_cast<cl_int>(std::llrint(part * direction_length)); }

cl_int4 direction_of(const Point& point) {
  const Turn east = turn_of(point.x), north = turn_of(point.y);
  cl_int4 direction = {
      {rounded(north.cosine * east.cosine), rounded(north.cosine * east.sine), rounded(north.sine), 0}};
  const bool is_pole = direction.s[0] == 0 && direction.s[1] == 0;
  const double longitude = std::remainder(point.x, 2 * half_turn);
  if (!is_pole) direction.s[3] = rounded(longitude == half_turn ? -1 : longitude / half_turn);
  return direction;
}

/// The pixel of a coordinate, from a window's first one; one beside the window stands for all beyond.
cl_int pixel_in(const Axis& axis, double coordinate, std::int64_t first, std::int64_t length) {
  double pixel = axis.pixel(coordinate) - static_cast<double>(first);
  if (axis.is_periodic() && pixel < 0) pixel += static_cast<double>(axis.pixels());
  return static_cast<cl_int>(std::clamp(pixel, -1.0, static_cast<double>(length)));
}

}  // namespace

std::vector<std::optional<Point>> points_on_globe(const SeedsFrame& frame) {
  std::vector<std::optional<Point>> points =
      frame.is_off_centre ? frame.read_given() : frame.read_positions();
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    if (!frame.is_off_centre) points[id] = frame.grid.point(*points[id]);
    if (std::abs(points[id]->y) > quarter_turn)
      throw BadPoint(id, *points[id],
                     "is no place on the globe: y is its latitude, from -90 to 90 degrees, x its longitude");
  }
  return points;
}

std::shared_ptr<const GlobeSeeds> seeds_on_globe(const SeedsFrame& frame) {
  std::vector<cl_int4> directions;
  directions.reserve(frame.size + 1);
  for (const std::optional<Point>& point : points_on_globe(frame))
    directions.push_back(point ? direction_of(*point) : cl_int4{});
  const DirectionSites tree = sites_of_directions(directions);
  directions.push_back({});
  GlobeSeeds seeds;
  const auto put = [&](cl::Buffer& buffer, const auto& values) {
    if (!values.empty()) buffer = allocate_with(frame.device, values, "the seeds on the globe");
  };
  put(seeds.directions, directions);
  put(seeds.places, tree.places);
  put(seeds.boxes, boxes_along(tree));
  put(seeds.levels, tree.levels);
  put(seeds.ids, tree.ids);
  seeds.sites = tree.count();
  seeds.top_level = tree.top_level();
  return std::make_shared<const GlobeSeeds>(std::move(seeds));
}

GlobePixels::GlobePixels(const Device& device, const Window& window) {
  const auto turn_at = [](const Axis& axis, std::int64_t pixel) {
    const std::int64_t of_axis =
        axis.is_periodic() ? (pixel % axis.pixels() + axis.pixels()) % axis.pixels() : pixel;
    return turn_of(axis.coordinate(static_cast<double>(of_axis) + 0.5));
  };
  std::vector<cl_int> of_columns, sines;
  for (std::int64_t x = 0; x < window.width() + FAN; ++x) {
    const Turn turn = turn_at(window.grid().x(), window.x() + std::min(x, window.width() - 1));
    of_columns.push_back(rounded(turn.cosine));
    sines.push_back(rounded(turn.sine));
  }
  of_columns.insert(of_columns.end(), sines.begin(), sines.end());
  std::vector<cl_int2> of_rows;
  for (std::int64_t y = 0; y < window.height(); ++y) {
    const Turn turn = turn_at(window.grid().y(), window.y() + y);
    of_rows.push_back({{rounded(turn.cosine),
                        rounded(turn.sine * (direction_length / 0x1p31))}});  // as products are scaled
  }
  columns = allocate_with(device, of_columns, "the pixels on the globe");
  rows = allocate_with(device, of_rows, "the pixels on the globe");
}

void check_globe(const Grid& grid) {
  refuse_volume(grid, "the metric of great circles");
  refuse_tilted(grid, "the metric of great circles");
  const double round = grid.x().to() - grid.x().from();
  const bool fits = grid.x().is_periodic() ? round == 2 * half_turn : round <= 2 * half_turn;
  if (fits && !grid.y().is_periodic() && grid.y().from() >= -quarter_turn && grid.y().to() <= quarter_turn)
    return;
  std::ostringstream text;
  text << "great circles need a grid of longitudes and latitudes in degrees: x no longer than 360, and 360 "
          "if it is periodic, y from -90 to 90 and not periodic; this one shows x from "
       << grid.x().from() << " to " << grid.x().to() << " and y from " << grid.y().from() << " to "
       << grid.y().to() << periodic_text(grid.periodic());
  throw Error(text.str());
}

std::shared_ptr<const PointPlacement> place_on_globe(const Window& window, const PixelGrid& shown,
                                                     const SeedsFrame& frame) {
  const Grid& grid = window.grid();
  const auto centre = [](std::int64_t pixel) { return static_cast<cl_int>(centre_of(pixel)); };
  std::vector<cl_int2> seeds;
  seeds.reserve(frame.size + 1);
  for (const std::optional<Point>& point : points_on_globe(frame)) {
    if (!point) {
      seeds.push_back({{absent_coordinate, 0}});
      continue;
    }
    const double west = grid.x().from(),
                 east = point->x - 2 * half_turn * std::floor((point->x - west) / (2 * half_turn));
    seeds.push_back({{centre(pixel_in(grid.x(), east, window.x(), window.width())),
                      centre(pixel_in(grid.y(), point->y, window.y(), window.height()))}});
  }
  seeds.push_back({{absent_coordinate, 0}});
  return std::make_shared<const PointPlacement>(
      PointPlacement{shown, allocate_with(frame.device, seeds, "the seeds on the globe"), {}, {}, {}});
}

Report exact_diagram_on_globe(Filling& filling, DiagramState& state) {
  if (!has_doubles(state.device))  // which what the kernels share with those of exact cells names
    throw Error("great circles need doubles (cl_khr_fp64), which " + state.device.name() + " does not have");
  const std::shared_ptr<const GlobeSeeds> seeds = filling.seeds().on_globe();
  filling.take_places();
  const GlobePixels pixels(state.device, state.window);
  if (seeds->sites == 0) {
    const cl::Event filled = fill(state.device, state.labels, no_label, state.grid.pixels());
    return filling.commit(0, filled, filled);
  }
  const auto blocks_along = [](int side) { return static_cast<std::size_t>(side - 1) / GLOBE_BLOCK + 1; };
  Kernel& kernel = state.kernels.get(without_vectors(state.device), "globe/globe.cl", "label_globe",
                                     state.grid.without_periods());
  // Work-items that do much each: small groups spread them over the compute units of a CPU.
  if (state.device.tuning().shape == Shape::vector) kernel.in_groups_of(1);
  const cl::Event done = kernel.over_items(
      blocks_along(state.grid.width()) * blocks_along(state.grid.height()), seeds->sites, seeds->places,
      seeds->boxes, seeds->levels, seeds->top_level, seeds->ids, seeds->directions, pixels.columns,
      pixels.rows, state.grid.width(), state.grid.height(), state.labels);
  return filling.commit(0, done, done);
}

}  // namespace vorocl
