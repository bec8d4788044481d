#include "core/seeds_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "core/snapping.hpp"
#include "core/window_places.hpp"
#include "globe/globe.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "core/place_sizes.cl"
#include "exact/sizes.cl"

namespace vorocl {

namespace {

/// The greatest of the shorter ways round between pixels of an axis.
class Farthest {
 public:
  explicit Farthest(const Axis& axis) : period_(axis.is_periodic() ? axis.pixels() : 0) {}

  void add(std::int64_t way) { greatest_ = std::max(greatest_, std::abs(shorter_way(way, period_))); }
  std::int64_t greatest() const { return greatest_; }

 private:
  std::int64_t period_, greatest_ = 0;
};

/// The same in a tilted grid, of ways along the axis where they are longer.
class FarthestIfTilted {
 public:
  explicit FarthestIfTilted(const Grid& grid) : grid_(grid), shifts_(grid.shifts()) {}

  /// A way in pixels.
  void add(std::int64_t x, std::int64_t y, std::int64_t z) {
    // So far away the image is that lies nearest along z, and of these along y and then x.
    std::int64_t least = std::max({grid_.width(), grid_.height(), grid_.depth()}) * fractions_of_pixel;
    each_image(grid_.z(), in_fractions(z), least, [&](std::int64_t turns_z, std::int64_t along_z) {
      const std::int64_t y_there = in_fractions(y) + turns_z * shifts_.yz;
      each_image(grid_.y(), y_there, least, [&](std::int64_t turns_y, std::int64_t along_y) {
        const std::int64_t x_there = in_fractions(x) + turns_z * shifts_.xz + turns_y * shifts_.xy;
        const std::int64_t along_x = shorter_way(x_there, period_of(grid_.x()));
        least = std::min(least, std::max({std::abs(along_x), std::abs(along_y), std::abs(along_z)}));
      });
    });
    greatest_ = std::max(greatest_, least);
  }
  double greatest() const { return static_cast<double>(greatest_) / fractions_of_pixel; }

 private:
  static std::int64_t period_of(const Axis& axis) {
    return axis.is_periodic() ? in_fractions(axis.pixels()) : 0;
  }

  /// Calls a function with whole periods and the ways with them, those that are no longer than the least one.
  template <typename Use>
  static void each_image(const Axis& axis, std::int64_t way, const std::int64_t& least, Use use) {
    const std::int64_t period = period_of(axis);
    if (period == 0) return use(0, way);
    const std::int64_t nearest = (shorter_way(way, period) - way) / period;
    for (const int side : {1, -1}) {
      for (std::int64_t turns = nearest + (side < 0 ? side : 0); std::abs(way + turns * period) <= least;
           turns += side) {
        use(turns, way + turns * period);
      }
    }
  }

  Grid grid_;
  Grid::Shifts shifts_;
  std::int64_t greatest_ = 0;
};

double way_of_voxels(const SeedsFrame& earlier, const SeedsFrame& now) {
  FarthestIfTilted farthest(now.grid);
  const std::vector<std::optional<Point>> from = earlier.read_positions(), to = now.read_positions();
  const auto way = [](double a, double b) {
    return static_cast<std::int64_t>(std::floor(b) - std::floor(a));
  };
  for (std::size_t id = 0; id < std::min(from.size(), to.size()); ++id) {
    if (from[id] && to[id])
      farthest.add(way(from[id]->x, to[id]->x), way(from[id]->y, to[id]->y), way(from[id]->z, to[id]->z));
  }
  return farthest.greatest();
}

double way_on_device(const SeedsFrame& earlier, const SeedsFrame& now) {
  const std::size_t count = std::min(earlier.size, now.size);
  const cl::Buffer greatest = allocate(now.device, sizeof(cl_uint), "the way of the seeds");
  fill(now.device, greatest, cl_uint{0}, 1);
  const PixelGrid& grid = now.whole->grid;
  Kernel(now.device, "core/seeds.cl", "find_greatest_way", grid)
      .over_items(count, *earlier.whole->positions, *now.whole->positions, static_cast<cl_uint>(count),
                  cl_int4{{grid.width(), grid.height(), grid.depth(), 0}}, greatest);
  return download<cl_uint>(now.device, greatest, 1).front();
}

}  // namespace

// --- PointCheck ---

PointCheck::PointCheck(const Device& device)
    : device_(device), found_(allocate(device, sizeof(cl_uint4), "the check of the points")) {}

void PointCheck::reset(const Snapping& snapping) {
  const std::lock_guard<std::mutex> lock(mutex_);
  cl_uint4 none = {};
  none.s[FOUND_BAD] = no_label;
  fill(device_, found_, none, 1);
  snapping_ = snapping;
  points_ = {};
  known_ = false;
  bad_point_.reset();
}

void PointCheck::read() const {
  if (known_) return;
  const cl_uint4 found = download<cl_uint4>(device_, found_, 1).front();
  if (const cl_uint id = found.s[FOUND_BAD]; id != no_label)
    bad_point_.emplace(snapping_->bad(id, read_points(device_, points_).point(snapping_->grid(), id)));
  absent_ = found.s[FOUND_ABSENT];
  outside_ = found.s[FOUND_OUTSIDE];
  known_ = true;
}

const std::optional<BadPoint>& PointCheck::bad_point() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  read();
  return bad_point_;
}

std::size_t PointCheck::absent() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  read();
  return absent_;
}

std::size_t PointCheck::outside() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  read();
  return outside_;
}

// --- SeedsFrame ---

double greatest_way(const Grid& grid, const std::vector<Place>& from, const std::vector<Place>& to) {
  const auto each_way = [&](auto use) {
    for (std::size_t id = 0; id < std::min(from.size(), to.size()); ++id) {
      const Place &a = from[id], &b = to[id];
      if (!is_absent(a) && !is_absent(b)) use(pixel_of(b.x) - pixel_of(a.x), pixel_of(b.y) - pixel_of(a.y));
    }
  };
  if (grid.is_tilted()) {
    FarthestIfTilted farthest(grid);
    each_way([&](std::int64_t along_x, std::int64_t along_y) { farthest.add(along_x, along_y, 0); });
    return farthest.greatest();
  }
  Farthest x(grid.x()), y(grid.y());
  each_way([&](std::int64_t along_x, std::int64_t along_y) { x.add(along_x), y.add(along_y); });
  return static_cast<double>(std::max(x.greatest(), y.greatest()));
}

std::size_t SeedsFrame::alive() const { return size - absent - (counted_there ? points->absent() : 0); }

void SeedsFrame::check() const {
  if (points && points->bad_point()) throw BadPoint(*points->bad_point());
}

double SeedsFrame::way_from(const SeedsFrame& earlier) const {
  // A seed that was absent between may have gone any way.
  const bool known = earlier.owner == owner && earlier.way.stretch == way.stretch && earlier.losses == losses;
  if (known) return way.all - earlier.way.all;
  if (earlier.grid != grid || !device.same_as(earlier.device)) {
    return static_cast<double>(std::max({grid.width(), grid.height(), grid.depth()}));
  }
  if (has_voxels(grid) && grid.is_tilted()) return way_of_voxels(earlier, *this);
  const bool on_device = whole && earlier.whole && !(listed && earlier.listed) && !grid.is_tilted();
  return on_device ? way_on_device(earlier, *this) : greatest_way(grid, *earlier.places(), *places());
}

namespace {

/// The places of seeds at the centres of their voxels.
cl::Buffer places_at_centres(const SeedsFrame& frame) {
  std::vector<cl_int4> places(frame.size + 1, {{absent_coordinate, 0, 0, 0}});
  const std::vector<std::optional<Point>> positions = frame.read_positions();
  const auto in_units = [](double at) { return static_cast<cl_int>(at * fractions_of_pixel); };
  for (std::size_t id = 0; id < frame.size; ++id) {
    if (const std::optional<Point>& at = positions[id])
      places[id] = {{in_units(at->x), in_units(at->y), in_units(at->z), 0}};
  }
  return allocate_with(frame.device, places, "the seeds");
}

}  // namespace

double SeedsFrame::way_of_last_move() const { return before ? way_from(*before) : way.last; }

std::vector<std::optional<Point>> SeedsFrame::read_positions() const {
  std::vector<std::optional<Point>> positions(size);
  if (!has_voxels(grid)) {
    const auto at = places();
    for (std::size_t id = 0; id < size; ++id) {
      if (!is_absent((*at)[id])) positions[id] = in_pixels((*at)[id]);
    }
    return positions;
  }
  if (whole->places) {
    const auto places = download<cl_int4>(device, *whole->places, size);
    const auto along = [](cl_int at) { return static_cast<double>(at) / fractions_of_pixel; };
    for (std::size_t id = 0; id < size; ++id) {
      const auto& [x, y, z, unused] = places[id].s;
      if (x != absent_coordinate) positions[id] = {along(x), along(y), along(z)};
    }
    return positions;
  }
  const VoxelBits bits(whole->grid);
  const std::vector<std::uint32_t> voxels = download<std::uint32_t>(device, *whole->positions, size);
  for (std::size_t id = 0; id < size; ++id) {
    if (voxels[id] == absent_voxel) continue;
    const auto [x, y, z] = bits.unpack(voxels[id]);
    positions[id] = {x + 0.5, y + 0.5, z + 0.5};
  }
  return positions;
}

std::vector<std::optional<Point>> SeedsFrame::read_given() const {
  std::vector<std::optional<Point>> points = read_positions();
  const GivenPoints as_given = there.points ? read_points(device, there) : given;
  for (std::size_t id = 0; id < size; ++id) {
    if (points[id]) points[id] = as_given.numbers ? as_given.point(grid, id) : grid.point(*points[id]);
  }
  return points;
}

// --- placements ---

/// One kind of placements, by the window that they are seen from.
template <typename T>
class Remembered {
 public:
  template <typename Make>
  std::shared_ptr<const T> get(const Window& window, const PixelGrid& shown, Make make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto is_gone = [](const Known& known) { return known.placement.expired(); };
    known_.erase(std::remove_if(known_.begin(), known_.end(), is_gone), known_.end());
    for (const Known& known : known_) {
      if (known.window == window && known.shown == shown) {
        if (std::shared_ptr<const T> placement = known.placement.lock()) return placement;
      }
    }
    std::shared_ptr<const T> placement = make();
    known_.push_back({window, shown, placement});
    return placement;
  }

 private:
  struct Known {
    Window window;
    PixelGrid shown;
    std::weak_ptr<const T> placement;  // of diagrams and results: a frame may see many windows
  };
  std::mutex mutex_;
  std::vector<Known> known_;
};

/// Something of a frame that is made when it is first asked for.
template <typename T>
class MadeOnce {
 public:
  template <typename Make>
  std::shared_ptr<const T> get(Make make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!made_) made_ = make();
    return made_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const T> made_;
};

class Placements {
 public:
  Remembered<Placement> of_pixels;
  Remembered<PointPlacement> of_points;
  MadeOnce<std::vector<Place>> places;
  MadeOnce<GlobeSeeds> on_globe;
  MadeOnce<Lags> lags;
};

// --- weights ---

namespace {

/// The side of a pixel in the units of the data.
double side_of(const Axis& axis) { return (axis.to() - axis.from()) / static_cast<double>(axis.pixels()); }

/// Of a pixel of a grid, or of a voxel's faces, in the units of the data; 0 if it is none of a square or
/// cube, whose sides may differ as whole numbers of pixels make them.
double square_of(const Grid& grid) {
  constexpr double rounded = 1.01;
  const double x = side_of(grid.x()), y = side_of(grid.y()), z = grid.is_volume() ? side_of(grid.z()) : x;
  if (grid.is_spaced() || std::max({x, y, z}) > rounded * std::min({x, y, z})) return 0;
  return grid.is_volume() ? (x * y + y * z + z * x) / 3 : x * y;
}

/// A number that no squared distance from a pixel of a grid to a seed in it is above, in pixels.
double most_distance(const Grid& grid) {
  const auto along = [](const Axis& axis) { return std::pow(static_cast<double>(axis.pixels()), 2); };
  return along(grid.x()) + along(grid.y()) + along(grid.z());
}

/// The lags of a frame's seeds; none if all weights are the same.
std::vector<cl_int> lags_of(const SeedsFrame& frame) {
  const Grid& grid = frame.grid;
  double greatest = -std::numeric_limits<double>::infinity(), least = -greatest;
  const auto each = [&](auto use) {
    for (std::size_t id = 0; id < frame.size; ++id) {
      if (!std::isnan(frame.given.point(grid, id).x)) use(id, (*frame.weights)[id]);
    }
  };
  each([&](std::size_t, double weight) {
    greatest = std::max(greatest, weight);
    least = std::min(least, weight);
  });
  if (least >= greatest) return {};
  const double square = square_of(grid);
  if (square == 0) {
    std::ostringstream text;
    text << "weights are squares in the units of the data, and diagrams of weighted seeds need pixels that "
            "are "
         << (grid.is_volume() ? "cubes" : "squares") << " there; these are " << side_of(grid.x()) << " x "
         << side_of(grid.y());
    if (grid.is_volume()) text << " x " << side_of(grid.z());
    throw Error(text.str() + (grid.is_spaced() ? ", and spaced" : ""));
  }
  constexpr double unit = 1 << LAG_BITS, most = std::numeric_limits<cl_int>::max();
  std::vector<cl_int> lags(frame.size, 0);
  each([&](std::size_t id, double weight) {
    const double lag = std::nearbyint((greatest - weight) / square * unit);
    // A seed that is so far behind owns no pixel.
    if (lag > most && (frame.outside > 0 || most_distance(grid) * unit >= most)) {
      throw Error("the weight of seed " + std::to_string(id) + " lies " + std::to_string(lag / unit) +
                  " squared pixels below the greatest one; in a grid of " + size_text(grid) +
                  " weights may differ by at most " + std::to_string(1 << (31 - LAG_BITS)));
    }
    lags[id] = static_cast<cl_int>(std::min(lag, most));
  });
  return lags;
}

}  // namespace

std::shared_ptr<Placements> no_placements() { return std::make_shared<Placements>(); }

void add_places(const Grid& grid, const GivenPoints& points, std::size_t count, Snap snap,
                std::vector<Place>& places) {
  const Snapping snapping(grid, Outside::count);
  for (std::size_t id = 0; id < count; ++id) {
    const Point at = points.point(grid, id);
    places.push_back(std::isnan(at.x) ? absent_place : snapping(id, at, snap));
  }
}

std::shared_ptr<const std::vector<Place>> SeedsFrame::places() const {
  if (listed) return listed;
  refuse_volume(grid, "a list of points (x, y)");
  check();
  return placements->places.get([&] {
    std::vector<Place> places;
    places.reserve(size);
    if (given.numbers) {
      add_places(grid, given, size, is_off_centre ? Snap::none : Snap::to_pixels, places);
    } else if (whole->places) {
      for (const cl_int2& at : download<cl_int2>(device, *whole->places, size))
        places.push_back(at.s[0] == absent_coordinate ? absent_place : Place{at.s[0], at.s[1]});
    } else {
      for (const std::uint32_t position : download<std::uint32_t>(device, *whole->positions, size)) {
        places.push_back(position == absent_position
                             ? absent_place
                             : Place{centre_of(position & 0xffff), centre_of(position >> 16)});
      }
    }
    return std::make_shared<const std::vector<Place>>(std::move(places));
  });
}

std::shared_ptr<const Lags> SeedsFrame::lags() const {
  if (!weights) return nullptr;
  const std::shared_ptr<const Lags> made = placements->lags.get([this] {
    Lags lags{lags_of(*this), {}};
    if (!lags.of_seeds.empty()) lags.there = allocate_with(device, lags.of_seeds, "the weights");
    return std::make_shared<const Lags>(std::move(lags));
  });
  return made->of_seeds.empty() ? nullptr : made;
}

std::shared_ptr<const GlobeSeeds> SeedsFrame::on_globe() const {
  return placements->on_globe.get([this] { return seeds_on_globe(*this); });
}

std::shared_ptr<const Placement> SeedsFrame::place_in(const Window& window, const PixelGrid& shown) const {
  if (whole && window.is_whole() && shown == PixelGrid(window)) return whole;
  return placements->of_pixels.get(window, shown,
                                   [&] { return place_in_window(device, window, shown, *places()); });
}

std::shared_ptr<const PointPlacement> SeedsFrame::place_points_in(const Window& window,
                                                                  const PixelGrid& shown) const {
  return placements->of_points.get(window, shown, [&] {
    if (has_voxels(grid) && !tilts_fit(grid)) {
      throw Error(
          "the grid of " + size_text(grid) +
          " is tilted, and so flat that the images of its seeds are too many for diagrams; exact cells "
          "take it");
    }
    if (whole && kernels_go_round(window, shown)) {
      if (whole->places) return placed_points(window, shown, *whole->places, size);
      if (has_voxels(grid)) return placed_points(window, shown, places_at_centres(*this), size);
    }
    return place_points(device, window, shown, *places(), are_points(), lags().get());
  });
}

void refuse_weights(const SeedsFrame& frame, const std::string& what) {
  if (frame.lags())
    throw Error("the seeds have weights, which " + what + " does not know; exact Euclidean diagrams do");
}

void refuse_seeds_beyond(const Placement& placement, const SeedsFrame& frame, const char* what) {
  refuse_tilted(frame.grid, what);
  if (!placement.goes_beyond) return;
  if (placement.outside > 0) {
    throw Error(std::to_string(placement.outside) + " of " + std::to_string(frame.size) +
                " seeds lie outside the diagram's window, which " + what +
                " cannot take; only diagrams of the method exact do");
  }
  throw Error("the diagram's window is not the whole of its grid, with periods of at most 32,000 pixels: " +
              std::string(what) + " cannot take that; only diagrams of the method exact do");
}

}  // namespace vorocl
