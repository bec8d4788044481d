#include "app/sources/bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>

#include "app/terminal/console.hpp"
#include "app/terminal/progress.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

void check_bounds(const Bounds& bounds, Axes axes) {
  const auto refuse = [&](const std::string& why) {
    throw Error("the bounds " + to_string(bounds) + " " + why);
  };
  const double width = bounds.x1 - bounds.x0, height = bounds.y1 - bounds.y0;
  // Written so that a NaN fails.
  if (!(width >= 0 && height >= 0)) refuse("must be numbers x0 <= x1 and y0 <= y1");
  try {
    Axis(Axis::max_pixels, bounds.x0, bounds.x1);
    Axis(Axis::max_pixels, bounds.y0, bounds.y1);
  } catch (const Error&) {
    refuse("are too far apart, or too near, to compute with");
  }
  if (has_x(axes) && width == 0) refuse("have no extent in x, which is to be periodic");
  if (has_y(axes) && height == 0) refuse("have no extent in y, which is to be periodic");
}

Bounds parse_bounds(const std::string& text, bool of_volumes) {
  const std::vector<std::string_view> parts = parts_of(text, ',');
  std::vector<double> values;
  for (const std::string_view part : parts) {
    const auto value = parse_number<double>(part);
    if (value && std::isfinite(*value)) values.push_back(*value);
  }
  const bool has_z = of_volumes && parts.size() == 6;
  const std::size_t axes = has_z ? 3 : 2;
  bool is_good = parts.size() == 2 * axes && values.size() == parts.size();
  for (std::size_t axis = 0; is_good && axis < axes; ++axis) is_good = values[axis] < values[axis + axes];
  if (is_good && has_z) return {values[0], values[1], values[3], values[4], values[2], values[5]};
  if (is_good) return {values[0], values[1], values[2], values[3]};
  const bool crosses = values.size() == 4 && parts.size() == 4 && values[2] < values[0] && values[0] <= 180 &&
                       values[2] >= -180 && values[1] < values[3];
  throw Error(
      "\"" + text + "\" must be " +
      (of_volumes && parts.size() != 4
           ? "X0,Y0,X1,Y1 or, of a volume, X0,Y0,Z0,X1,Y1,Z1: numbers with X0 < X1, Y0 < Y1 and Z0 < Z1"
           : "X0,Y0,X1,Y1: four numbers with X0 < X1 and Y0 < Y1") +
      (crosses ? fmt::format("; across the date line longitudes go on, as {},{},{},{}", values[0], values[1],
                             values[2] + 360, values[3])
               : ""));
}

Grid with_bounds(const Grid& pixels, const Bounds& bounds, bool closed, bool y_up) {
  const auto along = [closed](const Axis& of, double low, double high) {
    const Axis axis(of.pixels(), low, high);
    return of.is_periodic() ? axis.periodic() : closed ? axis.closed() : axis;
  };
  const Axis x = along(pixels.x(), bounds.x0, bounds.x1), y = along(pixels.y(), bounds.y0, bounds.y1);
  return pixels.is_volume() ? Grid(x, y, along(pixels.z(), bounds.z0, bounds.z1))
                            : Grid(x, y_up ? y.reversed() : y);
}

std::string to_string(const Bounds& bounds) {
  return fmt::format("{},{},{},{}", bounds.x0, bounds.y0, bounds.x1, bounds.y1);
}

std::string to_string(Axes axes) {
  static const char* const names[] = {"none", "x", "y", "xy", "z", "xz", "yz", "xyz"};
  return names[static_cast<std::size_t>(axes)];
}

Bounds bounding_box(const std::vector<Point>& points, bool of_volume) {
  const auto around = [](const Point& point) {
    return Bounds{point.x, point.y, point.x, point.y, point.z, point.z};
  };
  Bounds box = around(points.at(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
      throw Error(fmt::format("point {} at ({}, {}{}) is not finite", i, point.x, point.y,
                              of_volume ? fmt::format(", {}", point.z) : ""));
    }
    box = joined(box, around(point));
  }
  return box;
}

Bounds joined(const Bounds& a, const Bounds& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1),
          std::max(a.y1, b.y1), std::min(a.z0, b.z0), std::max(a.z1, b.z1)};
}

Bounds widened(const Bounds& bounds, double percent) {
  if (percent == 0) return bounds;  // whose sides may be infinite
  const double margin = std::max(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0) * percent / 100;
  return {bounds.x0 - margin, bounds.y0 - margin, bounds.x1 + margin, bounds.y1 + margin};
}

Size size_of_width(const Bounds& bounds, int width) {
  check_bounds(bounds);
  if (bounds.x0 == bounds.x1) {
    throw Error("the bounds " + to_string(bounds) +
                " have no width to scale by: give --size instead of --width");
  }
  const double height = std::round(width * (bounds.y1 - bounds.y0) / (bounds.x1 - bounds.x0));
  if (height > Size::max_side) {
    throw Error(fmt::format(
        "a width of {} makes a height of {:.0f} pixels with the bounds {}; at most {} are possible", width,
        height, to_string(bounds), Size::max_side));
  }
  return Size(width, std::max(1, static_cast<int>(height)));
}

namespace {

/// A pixel is a square up to here, by its sides: of few rows or columns rounding changes more.
constexpr double most_rounding = 1.05;

}  // namespace

bool has_square_pixels(const Bounds& bounds, const Grid& grid) {
  const double x_extent = bounds.x1 - bounds.x0, y_extent = bounds.y1 - bounds.y0;
  if (x_extent == 0 || y_extent == 0) return true;
  const auto width = static_cast<double>(grid.width()), height = static_cast<double>(grid.height());
  const double ratio = x_extent / width / (y_extent / height);
  if (std::max(ratio, 1 / ratio) > most_rounding) return false;
  const double wanted_height = std::max(1.0, width * y_extent / x_extent);
  const double wanted_width = std::max(1.0, height * x_extent / y_extent);
  return std::abs(height - wanted_height) <= 0.5 || std::abs(width - wanted_width) <= 0.5;
}

void warn_of_scales(const Bounds& bounds, const Grid& grid, const std::string& advice) {
  if (has_square_pixels(bounds, grid)) return;
  const double height = static_cast<double>(grid.width()) * (bounds.y1 - bounds.y0) / (bounds.x1 - bounds.x0);
  const bool width_helps = height >= 0.5 / (most_rounding - 1) && height <= Size::max_side;
  const std::string usual = width_helps ? fmt::format("--width {} keeps pixels square", grid.width())
                                        : "more pixels along the shorter side make them nearly square";
  print_warning(
      fmt::format("the bounds {} get different scales in x and y on {} x {} pixels, so the cells are not "
                  "Voronoi cells in data units; {}",
                  to_string(bounds), grid.width(), grid.height(), advice.empty() ? usual : advice));
}

void note_outside(std::size_t outside, std::size_t points, const Bounds& bounds,
                  const std::string& keeps_inside) {
  if (outside == 0) return;
  const std::string what =
      fmt::format("{} of {} points lie outside the bounds {}", outside, points, to_string(bounds));
  if (!keeps_inside.empty()) throw Error(what + ", which " + keeps_inside + "; give bounds that hold them");
  print_note(what + "; they count, and --outside refuse makes them an error");
}

void note_of_frame(const Frame& frame, int number, const std::optional<Axes>& told, bool of_volume) {
  if (frame.box && frame.box->turned != 0) {
    print_note(
        fmt::format("the box is turned by {:.6g} degrees in its plane: it is turned back, with its particles",
                    frame.box->turned));
  }
  if (!of_volume && frame.z_span > 0) {
    print_note(fmt::format("z is left out, along which the particles of frame {} span {:.6g}", number,
                           frame.z_span));
  }
  if (!frame.box || !told) return;
  const Axes axes = periodic_axes(*frame.box, of_volume);
  if (*told == axes) return;
  print_note(fmt::format("the periodic axes of the file's box are {}; --periodic {} counts instead",
                         to_string(axes), to_string(*told)));
}

Axes periodic_axes(const Box& box, bool of_volume) {
  return axes_of(box.periodic_x, box.periodic_y, of_volume && box.periodic_z);
}

std::vector<Point> points_of(const Frame& frame) {
  std::vector<Point> points = frame.positions;
  for (std::size_t i = 0; i < frame.z.size(); ++i) points[i].z = frame.z[i];
  return points;
}

namespace {

/// The next frame. One whose box is bad counts as the end: whoever makes the diagrams comes there too, and
/// says what is wrong when those before it are made.
bool read(TrajectoryReader& reader, Frame& frame) {
  try {
    return reader.next(frame);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::optional<Bounds> bounds_of(const Frame& frame) {
  if (frame.box) return *frame.box;
  if (frame.positions.empty()) return std::nullopt;
  return frame.z.empty() ? bounding_box(frame.positions) : bounding_box(points_of(frame), true);
}

std::optional<Bounds> bounds_of_all_frames(const std::string& path, bool of_volume, std::optional<int> frames,
                                           const Interruption& interruption) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return std::nullopt;
  const std::unique_ptr<TrajectoryReader> reader =
      open_trajectory(path, "", of_volume ? Wanted::box_of_volume : Wanted::box);
  const std::optional<std::uintmax_t> bytes = reader->bytes_left();
  Progress progress({"frames read"});
  std::optional<Bounds> all;
  Frame frame;
  for (int count = 0; (!frames || count <= *frames) && read(*reader, frame); ++count) {
    if (const auto bounds = bounds_of(frame)) all = all ? joined(*all, *bounds) : *bounds;
    const auto left = reader->bytes_left();
    progress.show(count + 1,
                  bytes && left && *bytes > 0
                      ? std::optional<double>(1 - static_cast<double>(*left) / static_cast<double>(*bytes))
                      : std::nullopt);
    if (interruption.came()) throw Error("interrupted before the first frame was made");
  }
  return all;
}

}  // namespace vorocl::command
