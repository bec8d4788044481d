#include "vorocl/seeds.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "core/seeds_state.hpp"
#include "runtime/bad_point.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr std::size_t most_seeds = Grid::max_pixels;  // ids are uint32, and work-item ids must not wrap

/// A coordinate in its period, which begins at `first`; any one if there is no period.
std::int64_t wrapped(std::int64_t at, std::int64_t first, std::int64_t period) {
  if (period == 0) return at;
  const std::int64_t rest = (at - first) % period;
  return first + (rest < 0 ? rest + period : rest);
}

/// Snaps the caller's points to pixels.
class Snapping {
 public:
  /// Throws Error if the domain is not possible.
  Snapping(const Grid& grid, const std::optional<Domain>& domain) : grid_(grid) {
    if (!domain) return;
    check_domain(grid, *domain);
    first_ = {domain->x, domain->y};
    if (has_x(domain->periodic)) periods_[0] = domain->width;
    if (has_y(domain->periodic)) periods_[1] = domain->height;
  }

  PlanePosition operator()(std::size_t id, const Point& point) const {
    const PlanePosition at = {
        {along(id, point, point.x, grid_.width(), 0), along(id, point, point.y, grid_.height(), 1)}};
    if (grid_.periodic() != Periodic::none && !is_inside(grid_, at)) throw point_outside(grid_, id, point);
    return at;
  }

  PlanePosition operator()(std::size_t id, const std::optional<Point>& point) const {
    return point ? (*this)(id, *point) : PlanePosition{{absent_coordinate, 0}};
  }

  bool is_periodic() const { return periods_[0] != 0 || periods_[1] != 0; }

 private:
  cl_int along(std::size_t id, const Point& point, double coordinate, int pixels, std::size_t axis) const {
    constexpr double plane_side = 2147483648.0;  // 2^31
    // Written so that a NaN fails.
    if (!(coordinate >= pixels - plane_side && coordinate < plane_side)) throw point_too_far(id, point);
    const auto at = static_cast<std::int64_t>(std::floor(coordinate));
    return static_cast<cl_int>(wrapped(at, first_[axis], periods_[axis]));
  }

  Grid grid_;
  std::array<std::int64_t, 2> first_{}, periods_{};  // of the domain, along x and y
};

template <typename MaybePoint>
Placement snap_all(const Grid& grid, const std::vector<MaybePoint>& points,
                   const std::optional<Domain>& domain = std::nullopt) {
  const Snapping snap(grid, domain);
  Placement placement;
  placement.packed.reserve(points.size() + 1);  // one more is added when they are uploaded
  bool all_inside = true;
  for (const MaybePoint& point : points) {
    const PlanePosition at = snap(placement.packed.size(), point);
    const bool inside = is_inside(grid, at);
    placement.packed.push_back(inside ? pack(at.s[0], at.s[1]) : absent_position);
    all_inside = all_inside && (inside || is_absent(at));
  }
  if (all_inside && !snap.is_periodic()) return placement;
  placement.in_the_plane.reserve(points.size() + 1);  // likewise
  for (const MaybePoint& point : points)
    placement.in_the_plane.push_back(snap(placement.in_the_plane.size(), point));
  return placement;
}

void check_count(std::size_t count) {
  if (count > most_seeds) {
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
  }
}

void check_buffers(const Device& device, const cl::Buffer& points, std::size_t count,
                   const cl::Buffer& marks) {
  check_count(count);
  const std::string number = std::to_string(count);
  check_foreign_buffer(device, points, count * sizeof(cl_float2), "the buffer of " + number + " points",
                       Access::read);
  if (marks() != nullptr) {
    check_foreign_buffer(device, marks, count,
                         "the buffer that says which of " + number + " seeds are present", Access::read);
  }
}

std::uint64_t next_owner() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

// --- what a Seeds object holds ---

SeedsState::SeedsState(const Device& device_of_seeds, const Grid& grid_of_seeds)
    : device(device_of_seeds),
      grid(grid_of_seeds),
      frame_(std::make_shared<const SeedsFrame>(SeedsFrame{device, grid, 0, 0, next_owner()})) {}

SeedsFrame SeedsState::next_frame(std::size_t size, bool vanished) const {
  check_count(size);
  return {device, grid, size, 0, frame_->owner, frame_->vanishings + (vanished ? 1 : 0)};
}

const cl::Buffer& SeedsState::next_positions(std::size_t count) {
  const std::size_t bytes = (count + 1) * sizeof(std::uint32_t);
  if (spare_() == nullptr || size_of(spare_) < bytes) spare_ = allocate(device, bytes, "the seeds");
  return spare_;
}

void SeedsState::commit(std::shared_ptr<const SeedsFrame> frame, std::vector<bool> there) noexcept {
  std::swap(positions, spare_);
  present = std::move(there);
  frame_ = std::move(frame);
}

void SeedsState::place(Placement&& placement, const std::optional<Domain>& domain) {
  auto& [packed, in_the_plane] = placement;
  std::vector<bool> there(packed.size(), true);
  bool vanished = there.size() < present.size();
  if (!in_the_plane.empty() || std::find(packed.begin(), packed.end(), absent_position) != packed.end()) {
    for (std::size_t id = 0; id < there.size(); ++id) {
      there[id] = in_the_plane.empty() ? packed[id] != absent_position : !is_absent(in_the_plane[id]);
      vanished = vanished || (id < present.size() && present[id] && !there[id]);
    }
  }
  SeedsFrame next = next_frame(there.size(), vanished);
  next.absent = static_cast<std::size_t>(std::count(there.begin(), there.end(), false));
  next.outer = gather_outer_seeds(device, grid, domain, std::move(in_the_plane));
  auto made = std::make_shared<const SeedsFrame>(next);
  packed.push_back(absent_position);
  upload_.start(device, next_positions(there.size()), std::move(packed));
  commit(std::move(made), std::move(there));
}

void SeedsState::place(const cl::Buffer& points, std::size_t count, const cl::Buffer& marks) {
  check_buffers(device, points, count, marks);
  const bool marked = marks() != nullptr;
  SeedsFrame next = next_frame(count, marked || count < size());  // which are present, only the device knows
  const std::shared_ptr<PointCheck> check = unused_check();
  next.points = check;
  next.marked = marked;
  auto made = std::make_shared<const SeedsFrame>(next);
  std::vector<bool> there(count, true);
  check->reset();
  kernels.get(device, "core/seeds.cl", "snap_points", grid)
      .over_items(count + 1, points, marked ? marks : points, cl_int{marked}, next_positions(count),
                  static_cast<cl_uint>(count), grid.width(), grid.height(), check->found());
  kernels.get(device, "core/seeds.cl", "note_bad_point", grid).over_items(1, points, check->found());
  commit(std::move(made), std::move(there));
}

void SeedsState::place_on_device(std::size_t count) {
  auto made = std::make_shared<const SeedsFrame>(next_frame(count, count < size()));
  next_positions(count);
  commit(std::move(made), std::vector<bool>(count, true));
}

void SeedsState::moved() { frame_ = std::make_shared<const SeedsFrame>(*frame_); }

void SeedsState::copy_from(const SeedsState& other) {
  SeedsFrame copied = *other.frame();
  copied.owner = frame_->owner;
  const std::size_t bytes = (other.size() + 1) * sizeof(std::uint32_t);
  positions = allocate(device, bytes, "the seeds");
  copy(device, other.positions, positions, bytes);
  present = other.present;
  frame_ = std::make_shared<const SeedsFrame>(std::move(copied));
}

std::shared_ptr<PointCheck> SeedsState::unused_check() {
  for (const std::shared_ptr<PointCheck>& check : checks_) {
    if (check.use_count() == 1) return check;
  }
  checks_.push_back(std::make_shared<PointCheck>(device, grid));
  return checks_.back();
}

// --- Seeds ---

Seeds::Seeds(std::unique_ptr<SeedsState> state) : state_(std::move(state)) {}
Seeds::~Seeds() = default;
Seeds::Seeds(Seeds&& other) noexcept = default;
Seeds& Seeds::operator=(Seeds&& other) noexcept = default;

Seeds Internal::no_seeds(const Device& device, const Grid& grid) {
  return Seeds(std::make_unique<SeedsState>(device, grid));
}

SeedsState& Seeds::state() const {
  if (!state_)
    throw Error("these seeds were moved from, and have no points; use the ones they were moved to");
  return *state_;
}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points)
    : state_(std::make_unique<SeedsState>(device, grid)) {
  state_->place(snap_all(grid, points));
}

Seeds::Seeds(const Device& device, const Grid& grid, std::initializer_list<Point> points)
    : Seeds(device, grid, std::vector<Point>(points)) {}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<std::optional<Point>>& points)
    : state_(std::make_unique<SeedsState>(device, grid)) {
  state_->place(snap_all(grid, points));
}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points, const Domain& domain)
    : state_(std::make_unique<SeedsState>(device, grid)) {
  state_->place(snap_all(grid, points, domain), domain);
}

Seeds::Seeds(const Device& device, const Grid& grid, const std::vector<std::optional<Point>>& points,
             const Domain& domain)
    : state_(std::make_unique<SeedsState>(device, grid)) {
  state_->place(snap_all(grid, points, domain), domain);
}

Seeds::Seeds(const Device& device, const Grid& grid, const cl::Buffer& points, std::size_t count,
             const cl::Buffer& present)
    : state_(std::make_unique<SeedsState>(device, grid)) {
  state_->place(points, count, present);
}

Seeds Seeds::from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask) {
  if (mask.size() != grid.pixels()) {
    throw Error("the mask has " + std::to_string(mask.size()) + " pixels, the grid " +
                std::to_string(grid.pixels()));
  }
  std::vector<std::uint32_t> positions;
  std::size_t i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (mask[i++] != 0) positions.push_back(pack(x, y));
    }
  }
  auto state = std::make_unique<SeedsState>(device, grid);
  state->place({std::move(positions), {}});
  return Seeds(std::move(state));
}

Seeds Seeds::random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed) {
  auto state = std::make_unique<SeedsState>(device, grid);
  state->place_on_device(count);
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  Kernel(device, "core/seeds.cl", "random_positions", grid)
      .over_items(count + 1, state->positions, static_cast<cl_uint>(count), grid.width(), grid.height(), key);
  return Seeds(std::move(state));
}

Seeds Seeds::clone() const {
  auto copied = std::make_unique<SeedsState>(device(), grid());
  copied->copy_from(state());
  return Seeds(std::move(copied));
}

void Seeds::move_to(const std::vector<Point>& points) { state().place(snap_all(grid(), points)); }

void Seeds::move_to(std::initializer_list<Point> points) { move_to(std::vector<Point>(points)); }

void Seeds::move_to(const std::vector<std::optional<Point>>& points) {
  state().place(snap_all(grid(), points));
}

void Seeds::move_to(const std::vector<Point>& points, const Domain& domain) {
  state().place(snap_all(grid(), points, domain), domain);
}

void Seeds::move_to(const std::vector<std::optional<Point>>& points, const Domain& domain) {
  state().place(snap_all(grid(), points, domain), domain);
}

void Seeds::move_to(const cl::Buffer& points, std::size_t count, const cl::Buffer& present) {
  state().place(points, count, present);
}

const Device& Seeds::device() const { return state().device; }
const Grid& Seeds::grid() const { return state().grid; }
std::size_t Seeds::size() const { return state().size(); }
std::size_t Seeds::alive() const { return state().frame()->alive(); }

Periodic Seeds::periodic() const {
  const std::shared_ptr<const OuterSeeds>& outer = state().frame()->outer;
  return outer ? outer->periodic : grid().periodic();
}

std::size_t Seeds::outside() const {
  const std::shared_ptr<const OuterSeeds>& outer = state().frame()->outer;
  return outer ? outer->outside : 0;
}

const cl::Buffer& Seeds::positions() const { return state().positions; }
void Seeds::check() const { state().frame()->check(); }

std::vector<std::optional<Point>> Seeds::read() const {
  check();
  std::vector<std::optional<Point>> points;
  points.reserve(size());
  if (const auto& outer = state().frame()->outer) {
    for (const PlanePosition& at : download<PlanePosition>(device(), outer->seeds, size())) {
      points.push_back(is_absent(at) ? std::nullopt : std::optional<Point>({at.s[0] + 0.5, at.s[1] + 0.5}));
    }
    return points;
  }
  for (const std::uint32_t position : download<std::uint32_t>(device(), positions(), size())) {
    points.push_back(position == absent_position
                         ? std::nullopt
                         : std::optional<Point>({(position & 0xffff) + 0.5, (position >> 16) + 0.5}));
  }
  return points;
}

}  // namespace vorocl
