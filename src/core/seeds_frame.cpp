#include "core/seeds_frame.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/snapping.hpp"
#include "core/window_places.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

double coordinate(std::uint32_t bits) {
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

/// The greatest of the shorter ways round between pixels of an axis.
class Farthest {
 public:
  explicit Farthest(const Axis& axis)
      : period_(static_cast<cl_uint>(axis.is_periodic() ? axis.pixels() : 0)) {}

  void add(cl_int from, cl_int to) {
    const auto a = static_cast<cl_uint>(from), b = static_cast<cl_uint>(to);
    cl_uint way = from < to ? b - a : a - b;
    if (period_ > 0) way = std::min(way, period_ - way);
    greatest_ = std::max(greatest_, way);
  }
  cl_uint greatest() const { return greatest_; }

 private:
  cl_uint period_, greatest_ = 0;
};

/// The same in a tilted grid, of ways along the axis where they are longer.
class FarthestIfTilted {
 public:
  explicit FarthestIfTilted(const Grid& grid) : images_(grid, fractions_of_pixel) {}

  void add(const PlanePosition& from, const PlanePosition& to) {
    const Region start = {0, 0, 0, 0};
    const Place way = {in_fractions(to.s[0]) - in_fractions(from.s[0]),
                       in_fractions(to.s[1]) - in_fractions(from.s[1])};
    std::int64_t least = std::max(images_.x, images_.y);
    each_place(start, images_, way, [&](const Place& image, bool) {
      least = std::min(least, std::max(std::abs(image.x), std::abs(image.y)));
    });
    greatest_ = std::max(greatest_, least);
  }
  double greatest() const { return static_cast<double>(greatest_) / fractions_of_pixel; }

 private:
  static std::int64_t in_fractions(cl_int pixels) { return std::int64_t{pixels} * fractions_of_pixel; }

  Images images_;
  std::int64_t greatest_ = 0;
};

double way_on_device(const SeedsFrame& earlier, const SeedsFrame& now) {
  const std::size_t count = std::min(earlier.size, now.size);
  const cl::Buffer greatest = allocate(now.device, sizeof(cl_uint), "the way of the seeds");
  fill(now.device, greatest, cl_uint{0}, 1);
  const PixelGrid& grid = now.whole->grid;
  const auto run = [&](const char* file, const auto&... sides) {
    Kernel(now.device, file, "find_greatest_way", grid)
        .over_items(count, *earlier.whole->positions, *now.whole->positions, static_cast<cl_uint>(count),
                    sides..., greatest);
  };
  grid.is_volume() ? run("volumes/seeds.cl", grid.width(), grid.height(), grid.depth())
                   : run("core/seeds.cl", grid.width(), grid.height());
  return download<cl_uint>(now.device, greatest, 1).front();
}

}  // namespace

// --- PointCheck ---

PointCheck::PointCheck(const Device& device, const Grid& grid)
    : device_(device), grid_(grid), found_(allocate(device, sizeof(cl_uint4), "the check of the points")) {}

void PointCheck::reset(const Grid& grid) {
  const std::lock_guard<std::mutex> lock(mutex_);
  grid_ = grid;
  fill(device_, found_, cl_uint4{{no_label, 0, 0, 0}}, 1);
  known_ = false;
  bad_point_.reset();
}

void PointCheck::read() const {
  if (known_) return;
  const cl_uint4 found = download<cl_uint4>(device_, found_, 1).front();
  if (found.s[0] != no_label) {
    bad_point_.emplace(
        Snapping::outside_the_grid(found.s[0], Point{coordinate(found.s[1]), coordinate(found.s[2])}, grid_));
  }
  absent_ = found.s[3];
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

// --- SeedsFrame ---

double greatest_way(const Grid& grid, const std::vector<PlanePosition>& from,
                    const std::vector<PlanePosition>& to, bool some_absent) {
  const std::size_t count = std::min(from.size(), to.size());
  const auto each_way = [&](auto use) {
    for (std::size_t id = 0; id < count; ++id) {
      if (some_absent && (is_absent(from[id]) || is_absent(to[id]))) continue;
      use(from[id], to[id]);
    }
  };
  if (grid.is_tilted()) {
    FarthestIfTilted farthest(grid);
    each_way([&](const PlanePosition& a, const PlanePosition& b) { farthest.add(a, b); });
    return farthest.greatest();
  }
  Farthest x(grid.x()), y(grid.y());
  each_way([&](const PlanePosition& a, const PlanePosition& b) {
    x.add(a.s[0], b.s[0]);
    y.add(a.s[1], b.s[1]);
  });
  return std::max(x.greatest(), y.greatest());
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
  if (pixels && earlier.pixels) return greatest_way(grid, *earlier.pixels, *pixels, true);
  if (whole && earlier.whole) return way_on_device(earlier, *this);
  return greatest_way(grid, earlier.read_pixels(), read_pixels(), true);
}

double SeedsFrame::way_of_last_move() const { return before ? way_from(*before) : way.last; }

std::vector<std::optional<Point>> SeedsFrame::read_positions() const {
  std::vector<std::optional<Point>> positions(size);
  if (!has_voxels(grid)) {
    const std::vector<PlanePosition> at = read_pixels();
    for (std::size_t id = 0; id < size; ++id) {
      if (!is_absent(at[id])) positions[id] = position(id, at[id]);
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

std::vector<PlanePosition> SeedsFrame::read_pixels() const {
  if (pixels) return *pixels;
  refuse_volume(grid, "a list of points (x, y)");
  check();
  std::vector<PlanePosition> read;
  read.reserve(size);
  for (const std::uint32_t position : download<std::uint32_t>(device, *whole->positions, size)) {
    read.push_back(position == absent_position ? PlanePosition{{absent_coordinate, 0}}
                                               : PlanePosition{{static_cast<cl_int>(position & 0xffff),
                                                                static_cast<cl_int>(position >> 16)}});
  }
  return read;
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

class Placements {
 public:
  Remembered<Placement> of_pixels;
  Remembered<PointPlacement> of_points;
};

std::shared_ptr<Placements> no_placements() { return std::make_shared<Placements>(); }

std::shared_ptr<const Placement> SeedsFrame::place_in(const Window& window, const PixelGrid& shown) const {
  if (whole && window.is_whole() && shown == whole->grid) return whole;
  return placements->of_pixels.get(window, shown,
                                   [&] { return place_in_window(device, window, shown, read_pixels()); });
}

std::shared_ptr<const PointPlacement> SeedsFrame::place_points_in(const Window& window,
                                                                  const PixelGrid& shown) const {
  return placements->of_points.get(window, shown,
                                   [&] { return place_points(device, window, shown, *pixels, *fractions); });
}

void refuse_outer_seeds(const Placement& placement, const SeedsFrame& frame, const char* what) {
  refuse_tilted_and_volumes(frame.grid, what);
  if (!placement.outer) return;
  const std::size_t outside = placement.outer->outside;
  if (outside > 0) {
    throw Error(std::to_string(outside) + " of " + std::to_string(frame.size) +
                " seeds lie outside the diagram's window, which " + what +
                " cannot take; only exact diagrams do");
  }
  throw Error("the diagram's window is not the whole of its grid, with periods of at most 32,000 pixels: " +
              std::string(what) + " cannot take that; only exact diagrams do");
}

}  // namespace vorocl
