#include "app/sources/plane_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/sources/bounds.hpp"
#include "app/sources/random_seeds.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/point_files.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

void check_stop(const std::function<bool()>& stops) {
  if (stops()) throw Error("interrupted, before all seeds were read");
}

/// Throws Error for a point of the file, counted from 0, that is not `possible`.
void require(bool possible, const SeedOptions& options, std::uint64_t index, const Point& point,
             const std::string& why) {
  if (possible) return;
  throw Error(fmt::format("{}: point {} at ({}, {}) is {}", options.points, index, point.x, point.y, why));
}

Survey survey(const SeedOptions& options, const PlaneReading& reading) {
  Survey result;
  const std::vector<std::string> notes = read_in_blocks(
      options.points, options.csv(), reading.slice, [&](std::uint64_t first, const Block& block) {
        check_stop(reading.stops);
        result.rows += block.size();
        for (std::size_t i = 0; i < block.size(); ++i) {
          if (!block[i]) continue;
          const Point& point = *block[i];
          require(std::isfinite(point.x) && std::isfinite(point.y), options, first + i, point, "not finite");
          const Bounds here = {point.x, point.y, point.x, point.y};
          result.box = result.points++ == 0 ? here : joined(result.box, here);
        }
      });
  for (const std::string& note : notes) print_note(note);
  return reading.join(result);
}

/// A hash of the seeds that does not depend on their order, or on which process has them.
class SeedsHash {
 public:
  void add(std::uint64_t first, const Block& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      Hash hash;
      hash.add(first + i);
      for (const double at : {places[i]->x, places[i]->y}) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &at, sizeof bits);
        hash.add(bits);
      }
      sum_ += hash.value();
    }
  }

  std::string name(std::uint64_t seeds, const PlaneReading& reading) const {
    return fmt::format("{} {:016x}", seeds, reading.sum(sum_));
  }

 private:
  std::uint64_t sum_ = 0;
};

/// Reads the file a second time, and adds its points as they lie in the plane.
PlaneFacts map_points(const SeedOptions& options, const Grid& plane, const Survey& survey,
                      const PlaneReading& reading) {
  const Bounds bounds = options.bounds.value_or(widened(survey.box, options.margin));
  const Outside outside = options.outside.value_or(Outside::count);
  check_bounds(bounds, plane.periodic());
  note_no_extent(options, bounds);
  const Grid data =
      with_bounds(plane, bounds, !options.bounds || outside == Outside::refuse, points_up(options));
  reading.reserve(survey.rows);
  SeedsHash hash;
  std::uint64_t points_outside = 0;
  const auto place_of = [data, snap = options.snapping()](const Point& point) {
    const auto along = [snap](const Axis& axis, double at) {
      return snap == Snap::none ? axis.rounded_position(at) : axis.pixel(at) + 0.5;
    };
    return Point{along(data.x(), point.x), along(data.y(), point.y)};
  };
  Block places;
  const auto add = [&](std::uint64_t first, const Block& block) {
    check_stop(reading.stops);
    places.clear();
    for (const std::optional<Point>& there : block) {
      if (!there) {
        places.emplace_back();
        continue;
      }
      const Point &point = *there, place = place_of(point);
      const bool inside = place.x >= 0 && place.x < static_cast<double>(plane.width()) && place.y >= 0 &&
                          place.y < static_cast<double>(plane.height());
      require(outside == Outside::count || (inside && data.x().covers(point.x) && data.y().covers(point.y)),
              options, first + places.size(), point,
              "outside the bounds " + to_string(bounds) + "; give --bounds that hold it");
      points_outside += inside ? 0 : 1;
      places.push_back(place);
    }
    try {
      reading.add(first, places);
    } catch (const BadPoint& bad) {
      require(false, options, bad.index(), block[bad.index() - first].value(),
              "2^31 pixels or more away from a pixel of the bounds " + to_string(bounds));
    }
    hash.add(first, places);
  };
  read_in_blocks(options.points, options.csv(), reading.slice, add);
  warn_of_scales(bounds, plane, "give a --size of the same shape");
  if (plane.periodic() != Axes::none && !options.bounds) {
    print_note(fmt::format("the period is the bounding box of the points{}, {}; --bounds says another one",
                           options.margin > 0 ? " and its margin" : "", to_string(bounds)));
  }
  note_outside(reading.sum(points_outside), survey.points, bounds);
  const Units units =
      in_pixels(options) ? Units() : Units({data.x()}, {data.y()}, has_square_pixels(bounds, plane));
  return {survey.points, units, hash.name(survey.points, reading), place_of};
}

PlaneFacts read_points(const SeedOptions& options, const Grid& plane, const PlaneReading& reading) {
  const SteadyFile file(options.points);
  PlaneFacts facts = map_points(options, plane, survey(options, reading), reading);
  file.check();
  return facts;
}

PlaneFacts make_random(const SeedOptions& options, const Grid& plane, const PlaneReading& reading) {
  reading.reserve(options.random);
  SeedsHash hash;
  Block pixels;
  for (std::size_t first = 0; first < options.random; first += block_points) {
    if (!reading.slice.holds(first / block_points)) continue;
    check_stop(reading.stops);
    pixels.clear();
    const std::size_t end = std::min(first + block_points, options.random);
    for (std::size_t id = first; id < end; ++id) {
      pixels.push_back(random_pixel(plane, static_cast<std::uint32_t>(id), options.rng_seed));
    }
    reading.add(first, pixels);
    hash.add(first, pixels);
  }
  return {options.random, Units(), hash.name(options.random, reading)};
}

}  // namespace

Grid plane_of(const SeedOptions& options) {
  if (!options.size) throw UsageError("--size WxH is required");
  return options.grid();
}

std::unique_ptr<MaskRows> open_plane_mask(SeedOptions& options) {
  if (options.mask.empty()) return nullptr;
  auto rows = std::make_unique<MaskRows>(options.mask, options.threshold);
  for (const std::string& note : rows->notes()) print_note(note);
  const Grid plane(rows->width(), rows->height());
  check_mask_size(options.mask, plane, options.size);
  options.size = plane;
  return rows;
}

void check_plane_options(const SeedOptions& options) {
  if (!options.points.empty()) {
    as_usage([&] { check_extension(options.points, {".csv", ".npy"}); });
    refuse_csv_options(options);
    if (options.bounds) check_bounds(*options.bounds, plane_of(options).periodic());
    return;
  }
  const char* const given = option_of_data(options);
  if (given != nullptr) throw UsageError(std::string(given) + " needs --points");
  if (options.mask.empty()) plane_of(options);
}

PlaneFacts read_plane_seeds(const SeedOptions& options, const PlaneReading& reading) {
  return options.points.empty() ? make_random(options, plane_of(options), reading)
                                : read_points(options, plane_of(options), reading);
}

void each_seed(const SeedOptions& options, const PlaneFacts& facts, const SeedRows& rows) {
  if (!options.keep.empty()) {
    const SteadyFile file(options.points);
    CsvOptions csv = options.csv();
    csv.reads_ids = false;  // labels number the rows
    CsvReader reader(options.points, csv);
    for (std::uint64_t id = 0; reader.next(); ++id) {
      if (id == 0) rows.begin(reader.kept_names());
      if (!std::isnan(reader.point().x) && !std::isnan(reader.point().y))
        rows.add(id, facts.place(reader.point()), reader.kept());
    }
    return file.check();
  }
  rows.begin({});
  if (!options.points.empty()) {
    read_in_blocks(options.points, options.csv(), {}, [&](std::uint64_t first, const Block& block) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (block[i]) rows.add(first + i, facts.place(*block[i]), {});
      }
    });
  }
  for (std::size_t id = 0; id < options.random; ++id)
    rows.add(id, random_pixel(plane_of(options), static_cast<std::uint32_t>(id), options.rng_seed), {});
  if (options.mask.empty()) return;
  MaskRows mask(options.mask, options.threshold);
  std::vector<std::uint8_t> pixels;
  std::uint64_t id = 0;
  for (std::int64_t y = 0; y < mask.height(); ++y) {
    pixels.clear();
    mask.next(pixels);
    for (std::size_t x = 0; x < pixels.size(); ++x) {
      if (pixels[x] != 0) rows.add(id++, {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}, {});
    }
  }
}

PlaneFacts read_plane_mask(const std::string& path, MaskRows& rows, const std::function<bool()>& stops,
                           PlaneMask& mask) {
  const SteadyFile file(path);
  Hash hash;
  std::vector<std::uint8_t> pixels;
  while (mask.rows() < mask.grid().height()) {
    check_stop(stops);
    pixels.clear();
    rows.next(pixels);
    mask.add_rows(pixels.data(), 1);
    hash.add_text({reinterpret_cast<const char*>(pixels.data()), pixels.size()});
  }
  file.check();
  return {mask.id_end(), Units(), fmt::format("{} {:016x}", mask.id_end(), hash.value())};
}

}  // namespace vorocl::command
