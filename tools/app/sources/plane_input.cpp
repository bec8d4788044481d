#include "app/sources/plane_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/random_pixels.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/files.hpp"
#include "formats/hash.hpp"
#include "formats/point_files.hpp"

namespace vorocl::command {

namespace {

constexpr std::size_t block_points = 1 << 16;

/// What a first reading of a file says: how many points there are, and the rectangle that they fill.
struct Survey {
  std::size_t points = 0;
  Bounds box;
};

/// Adds seeds, and keeps the hash of those that were added.
class SeedAdder {
 public:
  explicit SeedAdder(const Plane& plane) : seeds_(plane) {}

  PlaneSeeds& seeds() { return seeds_; }

  void add(const std::vector<Point>& pixels) {
    seeds_.add(pixels.data(), pixels.size());
    for (const Point& pixel : pixels) {
      for (const double at : {pixel.x, pixel.y}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &at, sizeof bits);
        hash_.add(bits);
      }
    }
  }

  PlaneInput take(const Units& units) {
    std::string name = fmt::format("{} {:016x}", seeds_.size(), hash_.value());
    return {std::move(seeds_), units, std::move(name)};
  }

 private:
  PlaneSeeds seeds_;
  Hash hash_;
};

void check_stop(const std::function<bool()>& stops) {
  if (stops()) throw Error("interrupted, before all seeds were read");
}

/// Throws Error for a point of the file, counted from 0, that is not `possible`.
void require(bool possible, const SeedOptions& options, std::size_t index, const Point& point,
             const std::string& why) {
  if (possible) return;
  throw Error(fmt::format("{}: point {} at ({}, {}) is {}", options.points, index, point.x, point.y, why));
}

Survey survey(const SeedOptions& options, const std::function<bool()>& stops) {
  Survey result;
  read_in_blocks(options.points, options.columns, [&](const std::vector<Point>& block) {
    check_stop(stops);
    for (const Point& point : block) {
      require(std::isfinite(point.x) && std::isfinite(point.y), options, result.points, point, "not finite");
      const Bounds here = {point.x, point.y, point.x, point.y};
      result.box = result.points++ == 0 ? here : joined(result.box, here);
    }
  });
  return result;
}

/// Reads the file a second time, and adds its points as they lie in the plane.
PlaneInput map_points(const SeedOptions& options, const Plane& plane, const Survey& survey,
                      const std::function<bool()>& stops) {
  const Bounds bounds = options.bounds.value_or(survey.box);
  const Outside outside = options.outside.value_or(Outside::count);
  PixelMap map(bounds, plane, points_up(options), !options.bounds || outside == Outside::refuse);
  map.repeat(plane.periodic(), bounds);
  SeedAdder adder(plane);
  adder.seeds().reserve(survey.points);
  std::size_t first = 0, points_outside = 0;
  std::vector<Point> pixels;
  read_in_blocks(options.points, options.columns, [&](const std::vector<Point>& block) {
    check_stop(stops);
    pixels.clear();
    for (const Point& point : block) {
      const Point pixel = map.pixel(point);
      const bool inside = pixel.x >= 0 && pixel.x < static_cast<double>(plane.width()) && pixel.y >= 0 &&
                          pixel.y < static_cast<double>(plane.height());
      require(outside == Outside::count || (inside && !map.is_outside(point)), options, first + pixels.size(),
              point, "outside the bounds " + to_string(bounds) + "; give --bounds that hold it");
      points_outside += inside ? 0 : 1;
      pixels.push_back(pixel);
    }
    try {
      adder.add(pixels);
    } catch (const BadPoint& bad) {
      require(false, options, first + bad.index(), block[bad.index()],
              "2^31 pixels or more away from a pixel of the bounds " + to_string(bounds));
    }
    first += block.size();
  });
  warn_of_scales(bounds, plane, "give a --size of the same shape");
  if (plane.periodic() != Periodic::none && !options.bounds) {
    print_note(fmt::format("the period is the bounding box of the points, {}; --bounds says another one",
                           to_string(bounds)));
  }
  note_outside(points_outside, first, bounds);
  const Units units = in_pixels(options)
                          ? Units()
                          : Units((bounds.x1 - bounds.x0) / static_cast<double>(plane.width()),
                                  (bounds.y1 - bounds.y0) / static_cast<double>(plane.height()),
                                  has_square_pixels(bounds, plane));
  return adder.take(units);
}

PlaneInput read_points(const SeedOptions& options, const Plane& plane, const std::function<bool()>& stops) {
  const SteadyFile file(options.points);
  PlaneInput input = map_points(options, plane, survey(options, stops), stops);
  file.check();
  return input;
}

PlaneInput at_random(const SeedOptions& options, const Plane& plane, const std::function<bool()>& stops) {
  SeedAdder adder(plane);
  adder.seeds().reserve(options.random);
  std::vector<Point> pixels;
  for (std::size_t id = 0; id < options.random; ++id) {
    pixels.push_back(random_pixel(plane, static_cast<std::uint32_t>(id), options.rng_seed));
    if (pixels.size() < block_points && id + 1 < options.random) continue;
    check_stop(stops);
    adder.add(pixels);
    pixels.clear();
  }
  return adder.take(Units());
}

}  // namespace

Plane PlaneInputOptions::plane() const {
  if (!size) throw UsageError("--size WxH is required");
  return {size->width(), size->height(), seeds.periodic.value_or(Periodic::none)};
}

void check_plane_options(const PlaneInputOptions& options) {
  const SeedOptions& seeds = options.seeds;
  if (!seeds.points.empty()) {
    as_usage([&] { check_extension(seeds.points, {".csv", ".npy"}); });
    if (seeds.columns && extension_of(seeds.points) != ".csv")
      throw UsageError("--columns is for .csv files");
    if (seeds.bounds) check_bounds(*seeds.bounds, options.plane());
    return;
  }
  const char* const given = seeds.bounds                        ? "--bounds"
                            : seeds.outside                     ? "--outside"
                            : seeds.y_up                        ? "--y-up"
                            : seeds.y_down                      ? "--y-down"
                            : seeds.units == MeasureUnits::data ? "--units data"
                                                                : nullptr;
  if (given != nullptr) throw UsageError(std::string(given) + " needs --points");
}

PlaneInput read_plane_input(const PlaneInputOptions& options, const std::function<bool()>& stops) {
  const SeedOptions& seeds = options.seeds;
  return seeds.points.empty() ? at_random(seeds, options.plane(), stops)
                              : read_points(seeds, options.plane(), stops);
}

}  // namespace vorocl::command
