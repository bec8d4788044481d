#include "core/seeds_state.hpp"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include "core/snapping.hpp"
#include "masks/marks.hpp"

namespace vorocl {

namespace {

constexpr std::size_t most_seeds = Window::max_pixels;  // ids are uint32, and work-item ids must not wrap

void check_count(std::size_t count) {
  if (count > most_seeds) {
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
  }
}

std::size_t coordinates_of(const PointBuffer& points) {
  return points.format == PointFormat::floats_xyz || points.format == PointFormat::doubles_xyz ? 3 : 2;
}

bool are_doubles(const PointBuffer& points) {
  return points.format == PointFormat::doubles_xy || points.format == PointFormat::doubles_xyz;
}

void check_buffers(const Device& device, const PointBuffer& points) {
  check_count(points.count);
  const std::string number = std::to_string(points.count);
  const std::size_t bytes = are_doubles(points) ? sizeof(cl_double) : sizeof(cl_float);
  check_foreign_buffer(device, points.points, points.count * coordinates_of(points) * bytes,
                       "the buffer of " + number + " points", Access::read);
  if (points.present() != nullptr) {
    check_foreign_buffer(device, points.present, points.count,
                         "the buffer that says which of " + number + " seeds are present", Access::read);
  }
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

/// Whether the device snaps points to this axis as the host does.
bool device_snaps_to(const Axis& axis) {
  return axis == (axis.is_periodic() ? Axis(axis.pixels()).periodic() : Axis(axis.pixels()));
}

/// Calls `use` with a view of the points of a buffer, on the host. Waits.
template <typename Real, typename Use>
void read_points(const Device& device, const PointBuffer& from, const Use& use) {
  const std::size_t coordinates = coordinates_of(from);
  const auto values = download<Real>(device, from.points, from.count * coordinates);
  std::vector<cl_uchar> marks;
  if (from.present() != nullptr) marks = download<cl_uchar>(device, from.present, from.count);
  const Real* const x = values.data();
  const Real* const z = coordinates == 3 && from.count > 0 ? x + 2 : nullptr;
  const Points points(x, from.count > 0 ? x + 1 : x, z, from.count,
                      static_cast<std::ptrdiff_t>(coordinates * sizeof(Real)));
  use(marks.empty() ? points : points.marked(marks.data()));
}

/// The positions in a diagram of all of the grid, with the one behind them; empty if kernels cannot have them
/// alone, because seeds lie outside or go round the ends of long periods.
std::vector<std::uint32_t> packed_positions(const Window& window, std::size_t outside,
                                            const std::vector<PlanePosition>& pixels) {
  std::vector<std::uint32_t> packed;
  if (outside > 0 || !fits_in_a_diagram(window.grid()) || !kernels_go_round(window, PixelGrid(window)))
    return packed;
  packed.reserve(pixels.size() + 1);
  for (const PlanePosition& at : pixels)
    packed.push_back(is_absent(at) ? absent_position : pack(at.s[0], at.s[1]));
  packed.push_back(absent_position);
  return packed;
}

}  // namespace

SeedsState::SeedsState(const Device& device_of_seeds, const Grid& grid, const SeedsOptions& of_seeds)
    : device(device_of_seeds), options(of_seeds) {
  SeedsFrame none{device, grid};
  none.owner = next_number();
  none.placements = no_placements();
  frame_ = std::make_shared<const SeedsFrame>(std::move(none));
}

SeedsFrame SeedsState::next_frame(const Grid& grid, std::size_t size, bool lost) const {
  check_count(size);
  SeedsFrame next{device, grid, size};
  next.owner = frame_->owner;
  next.losses = frame_->losses + (lost ? 1 : 0);
  next.way = {0, frame_->way.all, frame_->way.stretch};
  next.placements = no_placements();
  return next;
}

void SeedsState::way_is_unknown(SeedsFrame& next) const {
  if (frame_->size == 0) return;
  next.way = {0, 0, next_number()};
  auto before = std::make_shared<SeedsFrame>(*frame_);
  before->before = nullptr;
  next.before = std::move(before);
}

void SeedsState::commit(std::shared_ptr<const SeedsFrame> frame, std::vector<bool> there) noexcept {
  present = std::move(there);
  frame_ = std::move(frame);
}

std::vector<std::uint32_t> SeedsState::snap_to_voxels(const Grid& grid, const Points& points,
                                                      std::vector<Point>& given) const {
  const PixelGrid size{Window(grid)};
  const VoxelBits bits(size);
  const auto pixel = [](const Axis& axis, double coordinate) {
    const double at = axis.pixel(coordinate);
    return at >= 0 && at < static_cast<double>(axis.pixels()) ? static_cast<int>(at) : -1;  // -1 for a NaN
  };
  std::vector<std::uint32_t> voxels;
  voxels.reserve(points.size() + 1);  // one more is added when they are uploaded
  for (std::size_t id = 0; id < points.size(); ++id) {
    voxels.push_back(absent_voxel);
    if (!points.is_present(id)) continue;
    const Point& point = given[id] = point_on(grid, points, id);
    const int x = pixel(grid.x(), point.x), y = pixel(grid.y(), point.y), z = pixel(grid.z(), point.z);
    if (x >= 0 && y >= 0 && z >= 0) {
      voxels.back() = bits.pack(x, y, z);
    } else if (options.outside != Outside::absent || !Snapping::is_finite(point)) {
      throw Snapping::outside_the_grid(id, point, grid);
    }
  }
  return voxels;
}

void SeedsState::place_in_volume(const Grid& grid, std::vector<std::uint32_t>&& voxels,
                                 std::shared_ptr<const std::vector<Point>> given) {
  check_count(voxels.size());
  std::vector<bool> there(voxels.size(), true);
  std::size_t absent = 0;
  bool lost = there.size() < present.size();
  for (std::size_t id = 0; id < voxels.size(); ++id) {
    if (voxels[id] != absent_voxel) continue;
    there[id] = false;
    ++absent;
    lost = lost || (id < present.size() && present[id]);
  }
  SeedsFrame next = next_frame(grid, voxels.size(), lost);
  next.absent = absent;
  next.is_off_centre = given && options.snap == Snap::none;
  next.given = std::move(given);
  way_is_unknown(next);
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(voxels.size());
  const PixelGrid volume{Window(grid)};
  next.whole =
      std::make_shared<const Placement>(Placement{volume, positions, nullptr, are_crowded(volume, voxels)});
  voxels.push_back(absent_voxel);
  upload_.start(device, *positions, std::move(voxels));
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::move(there));
}

void SeedsState::place(const Grid& grid, const Points& points) {
  check_count(points.size());
  if (grid.depth() > 1 && !points.have_z() && points.size() > 0) {
    throw Error("the grid is a volume, and the points have no z");
  }
  const std::shared_ptr<std::vector<Point>> given = points_.take();
  given->resize(points.size());
  if (has_voxels(grid)) {
    return place_in_volume(grid, snap_to_voxels(grid, points, *given), given);
  }
  const Snapping snapping(grid, options.outside);
  const std::shared_ptr<std::vector<PlanePosition>> pixels = pixels_.take();
  pixels->resize(points.size());
  for (std::size_t id = 0; id < points.size(); ++id) {
    PlanePosition& at = (*pixels)[id];
    if (points.is_present(id)) {
      (*given)[id] = point_on(grid, points, id);
      at = snapping(id, (*given)[id]);
    } else {
      at = {{absent_coordinate, 0}};
    }
  }
  std::shared_ptr<std::vector<Fraction>> fractions;
  if (options.snap == Snap::none) {
    fractions = fractions_.take();
    fractions->resize(points.size());
    for (std::size_t id = 0; id < points.size(); ++id) {
      if (!is_absent((*pixels)[id])) (*fractions)[id] = snapping.fraction((*given)[id], (*pixels)[id]);
    }
  }
  place(grid, pixels, given, fractions);
}

void SeedsState::place(const Grid& grid, std::shared_ptr<const std::vector<PlanePosition>> placed,
                       std::shared_ptr<const std::vector<Point>> given,
                       std::shared_ptr<const std::vector<Fraction>> fractions) {
  const std::vector<PlanePosition>& pixels = *placed;
  const Snapping snapping(grid, options.outside);
  std::vector<bool> there(pixels.size(), true);
  bool lost = there.size() < present.size();
  std::size_t inside = 0, absent = 0;
  for (const PlanePosition& at : pixels) inside += snapping.is_inside(at) ? 1 : 0;
  for (std::size_t id = 0; inside < pixels.size() && id < pixels.size(); ++id) {
    if (!is_absent(pixels[id])) continue;
    there[id] = false;
    ++absent;
    lost = lost || (id < present.size() && present[id]);
  }
  SeedsFrame next = next_frame(grid, pixels.size(), lost);
  next.absent = absent;
  next.outside = pixels.size() - inside - absent;
  next.given = std::move(given);
  next.is_off_centre = fractions != nullptr;
  next.fractions = std::move(fractions);
  if (grid.is_tilted() && !next.fractions) {
    const std::shared_ptr<std::vector<Fraction>> centres = fractions_.take();
    centres->resize(pixels.size(), centre_of_pixel);
    next.fractions = centres;
  }
  if (frame_->grid != grid) {
    next.way = {0, 0, next_number()};
  } else if (frame_->pixels) {
    next.way.last = greatest_way(grid, *frame_->pixels, pixels, absent > 0 || frame_->absent > 0);
    next.way.all += next.way.last;
  } else {
    way_is_unknown(next);
  }
  const Window window(grid);
  std::vector<std::uint32_t> packed = packed_positions(window, next.outside, pixels);
  next.pixels = std::move(placed);
  if (!packed.empty()) {
    const std::shared_ptr<cl::Buffer> positions = room_for_positions(there.size());
    next.whole = std::make_shared<const Placement>(Placement{PixelGrid(window), positions, nullptr});
    upload_.start(device, *positions, std::move(packed));
  }
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::move(there));
}

void SeedsState::place(const PointBuffer& points) {
  check_buffers(device, points);
  const Window window(grid());
  const bool on_the_device = points.format == PointFormat::floats_xy && options.outside != Outside::count &&
                             options.snap == Snap::to_pixels && !has_voxels(grid()) &&
                             device_snaps_to(grid().x()) && device_snaps_to(grid().y()) &&
                             fits_in_a_diagram(grid()) && kernels_go_round(window, PixelGrid(window));
  const auto place_them = [this](const Points& on_host) { place(grid(), on_host); };
  if (on_the_device) {
    place_on_the_device(points);
  } else if (are_doubles(points)) {
    read_points<cl_double>(device, points, place_them);
  } else {
    read_points<cl_float>(device, points, place_them);
  }
}

void SeedsState::place_on_the_device(const PointBuffer& points) {
  const bool marked = points.present() != nullptr;
  const bool counted = marked || options.outside == Outside::absent;
  const PixelGrid pixels{Window(grid())};
  // Which are present, only the device knows.
  SeedsFrame next = next_frame(grid(), points.count, counted || points.count < size());
  const std::shared_ptr<PointCheck> check = unused_check();
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(points.count);
  next.points = check;
  next.counted_there = counted;
  next.whole = std::make_shared<const Placement>(Placement{pixels, positions, nullptr});
  way_is_unknown(next);
  auto made = std::make_shared<const SeedsFrame>(std::move(next));
  std::vector<bool> there(points.count, true);
  check->reset(grid());
  kernels.get(device, "core/seeds.cl", "snap_points", pixels)
      .over_items(points.count + 1, points.points, marked ? points.present : points.points, cl_int{marked},
                  cl_int{options.outside == Outside::absent}, *positions, static_cast<cl_uint>(points.count),
                  pixels.width(), pixels.height(), check->found());
  kernels.get(device, "core/seeds.cl", "note_bad_point", pixels).over_items(1, points.points, check->found());
  commit(std::move(made), std::move(there));
}

void SeedsState::place_on_device(std::size_t count, std::shared_ptr<const cl::Buffer> positions) {
  SeedsFrame next = next_frame(grid(), count, count < size());
  next.whole =
      std::make_shared<const Placement>(Placement{PixelGrid(Window(grid())), std::move(positions), nullptr});
  way_is_unknown(next);
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::vector<bool>(count, true));
}

void SeedsState::place_marks(std::shared_ptr<const Marks> marks) {
  const std::size_t count = marks->count();
  check_count(count);
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(count);
  marks->list(kernels, PixelGrid(Window(grid())), *positions);
  place_on_device(count, positions);
  SeedsFrame marked = *frame_;
  marked.marks = std::move(marks);
  frame_ = std::make_shared<const SeedsFrame>(std::move(marked));
}

std::shared_ptr<cl::Buffer> SeedsState::room_for_positions(std::size_t count) {
  const std::size_t bytes = (count + 1) * sizeof(std::uint32_t);
  for (std::shared_ptr<cl::Buffer>& room : rooms_) {
    if (is_used(room)) continue;
    if (size_of(*room) < bytes) *room = allocate(device, bytes, "the seeds");
    return room;
  }
  rooms_.push_back(std::make_shared<cl::Buffer>(allocate(device, bytes, "the seeds")));
  return rooms_.back();
}

std::shared_ptr<cl::Buffer> SeedsState::copy_to_move(const char* what) {
  const PixelGrid pixels{Window(grid())};
  const std::shared_ptr<const Placement> placement = frame_->place_in(grid(), pixels);
  refuse_outer_seeds(*placement, *frame_, what);
  std::shared_ptr<cl::Buffer> positions = room_for_positions(size());
  copy(device, *placement->positions, *positions, (size() + 1) * sizeof(std::uint32_t));
  return positions;
}

void SeedsState::moved(const std::shared_ptr<cl::Buffer>& positions, double way) {
  SeedsFrame next = *frame_;
  next.whole = std::make_shared<const Placement>(Placement{PixelGrid(Window(grid())), positions, nullptr});
  next.given = nullptr;
  next.marks = nullptr;
  next.pixels = nullptr;
  next.fractions = nullptr;
  next.is_off_centre = false;
  next.before = nullptr;
  next.placements = no_placements();
  next.way.last = way;
  next.way.all += way;
  frame_ = std::make_shared<const SeedsFrame>(std::move(next));
}

void SeedsState::copy_from(const SeedsState& other) {
  SeedsFrame copied = *other.frame();
  copied.owner = frame_->owner;
  present = other.present;
  frame_ = std::make_shared<const SeedsFrame>(std::move(copied));
}

std::shared_ptr<PointCheck> SeedsState::unused_check() {
  for (const std::shared_ptr<PointCheck>& check : checks_) {
    if (!is_used(check)) return check;
  }
  checks_.push_back(std::make_shared<PointCheck>(device, grid()));
  return checks_.back();
}

}  // namespace vorocl
