#include "app/sources/trajectory_bounds.hpp"

#include <filesystem>
#include <memory>
#include <system_error>

#include "app/sources/bounds.hpp"
#include "app/terminal/progress.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// The next frame. A bad one counts as the end: whoever makes the diagrams comes there too, and says what is
/// wrong when those before it are made.
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

std::optional<Bounds> bounds_of_all_frames(const std::string& path, std::optional<int> frames,
                                           const Interruption& interruption) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return std::nullopt;
  const std::unique_ptr<TrajectoryReader> reader = open_trajectory(path);
  const std::optional<std::uintmax_t> bytes = reader->bytes_left();
  Progress progress({"frames read"});
  Frame frame;
  std::optional<Bounds> all;
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
