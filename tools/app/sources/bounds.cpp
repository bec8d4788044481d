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

Bounds parse_bounds(const std::string& text) {
  const Error error("\"" + text + "\" must be X0,Y0,X1,Y1: four numbers with X0 < X1 and Y0 < Y1");
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    const auto value = parse_number<double>(std::string_view(text).substr(begin, comma - begin));
    if (!value || !std::isfinite(*value)) throw error;
    values.push_back(*value);
    begin = comma + 1;
  }
  if (values.size() != 4 || values[0] >= values[2] || values[1] >= values[3]) throw error;
  return {values[0], values[1], values[2], values[3]};
}

std::string to_string(const Bounds& bounds) {
  return fmt::format("{},{},{},{}", bounds.x0, bounds.y0, bounds.x1, bounds.y1);
}

std::string to_string(Axes axes) {
  static const char* const names[] = {"none", "x", "y", "xy", "z", "xz", "yz", "xyz"};
  return names[static_cast<std::size_t>(axes)];
}

Bounds bounding_box(const std::vector<Point>& points) {
  Bounds box{points.at(0).x, points[0].y, points[0].x, points[0].y};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      throw Error(fmt::format("point {} at ({}, {}) is not finite", i, point.x, point.y));
    }
    box = joined(box, {point.x, point.y, point.x, point.y});
  }
  return box;
}

Bounds joined(const Bounds& a, const Bounds& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

Bounds widened(const Bounds& bounds, double percent) {
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

void note_of_turn(const Frame& frame) {
  if (!frame.box || frame.box->turned == 0) return;
  print_note(
      fmt::format("the box is turned by {:.6g} degrees in its plane: it is turned back, with its particles",
                  frame.box->turned));
}

void note_of_frame(const Frame& frame, int number, const std::optional<Axes>& told) {
  note_of_turn(frame);
  if (frame.z_span > 0) {
    print_note(fmt::format("z is left out, along which the particles of frame {} span {:.6g}", number,
                           frame.z_span));
  }
  if (!frame.box || !told) return;
  const Axes axes = axes_of(frame.box->periodic_x, frame.box->periodic_y);
  if (*told == axes) return;
  print_note(fmt::format("the periodic axes of the file's box are {}; --periodic {} counts instead",
                         to_string(axes), to_string(*told)));
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
  if (frame.box) return Bounds{frame.box->x0, frame.box->y0, frame.box->x1, frame.box->y1};
  if (frame.positions.empty()) return std::nullopt;
  return bounding_box(frame.positions);
}

bool read_all_frames(const std::string& path, Wanted wanted, std::optional<int> frames,
                     const Interruption& interruption, const std::function<void(const Frame&)>& take) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  const std::unique_ptr<TrajectoryReader> reader = open_trajectory(path, "", wanted);
  const std::optional<std::uintmax_t> bytes = reader->bytes_left();
  Progress progress({"frames read"});
  Frame frame;
  for (int count = 0; (!frames || count <= *frames) && read(*reader, frame); ++count) {
    take(frame);
    const auto left = reader->bytes_left();
    progress.show(count + 1,
                  bytes && left && *bytes > 0
                      ? std::optional<double>(1 - static_cast<double>(*left) / static_cast<double>(*bytes))
                      : std::nullopt);
    if (interruption.came()) throw Error("interrupted before the first frame was made");
  }
  return true;
}

std::optional<Bounds> bounds_of_all_frames(const std::string& path, std::optional<int> frames,
                                           const Interruption& interruption) {
  std::optional<Bounds> all;
  read_all_frames(path, Wanted::box, frames, interruption, [&all](const Frame& frame) {
    if (const auto bounds = bounds_of(frame)) all = all ? joined(*all, *bounds) : *bounds;
  });
  return all;
}

}  // namespace vorocl::command
