#include "core/seeds_state.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
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

void check_weights(const Points& points) {
  if (points.weights() == nullptr) return;
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (std::isfinite(points.weights()[id]) || !points.is_present(id)) continue;
    throw Error("the weight of seed " + std::to_string(id) + " is " + std::to_string(points.weights()[id]) +
                "; weights must be finite");
  }
}

int coordinates_of(const PointBuffer& points) {
  return points.format == PointFormat::floats_xyz || points.format == PointFormat::doubles_xyz ? 3 : 2;
}

bool are_doubles(const PointBuffer& points) {
  return points.format == PointFormat::doubles_xy || points.format == PointFormat::doubles_xyz;
}

std::size_t bytes_of(const PointBuffer& points) {
  return points.count * static_cast<std::size_t>(coordinates_of(points)) *
         (are_doubles(points) ? sizeof(cl_double) : sizeof(cl_float));
}

void check_buffers(const Device& device, const PointBuffer& points) {
  check_count(points.count);
  const std::string number = std::to_string(points.count);
  check_foreign_buffer(device, points.points, bytes_of(points), "the buffer of " + number + " points",
                       Access::read);
  if (points.present() != nullptr) {
    check_foreign_buffer(device, points.present, points.count,
                         "the buffer that says which of " + number + " seeds are present", Access::read);
  }
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

/// Whether a kernel places points on a grid, as far as all of them lie in it: one that a diagram shows whole,
/// without images of seeds in the middle of pixels.
bool kernels_place(const Device& device, const Grid& grid) {
  if (!places_points(device) || !fits_in_a_diagram(grid)) return false;
  return has_voxels(grid) || kernels_go_round(grid, PixelGrid(Window(grid)));
}

/// The voxels of points that lie in a grid of them.
std::vector<std::uint32_t> voxels_of(const SeedsFrame& frame) {
  const Grid& grid = frame.grid;
  const VoxelBits bits(PixelGrid{Window(grid)});
  const auto pixel = [](const Axis& axis, double coordinate) {
    return static_cast<int>(axis.pixel(coordinate));
  };
  std::vector<std::uint32_t> voxels;
  voxels.reserve(frame.size + 1);  // one more is added when they are uploaded
  for (std::size_t id = 0; id < frame.size; ++id) {
    const Point at = grid.in_box(frame.given.point(grid, id));
    voxels.push_back(std::isnan(at.x)
                         ? absent_voxel
                         : bits.pack(pixel(grid.x(), at.x), pixel(grid.y(), at.y), pixel(grid.z(), at.z)));
  }
  return voxels;
}

/// The places of points that lie in a grid of voxels, as place_on_grid() makes them.
std::vector<cl_int4> places_of(const SeedsFrame& frame) {
  const Grid& grid = frame.grid;
  const auto along = [](const Axis& axis, double coordinate) {
    return static_cast<cl_int>(axis.rounded_position(coordinate) * fractions_of_pixel);
  };
  const cl_int4 absent = {{absent_coordinate, 0, 0, 0}};
  std::vector<cl_int4> places(frame.size + 1, absent);
  for (std::size_t id = 0; id < frame.size; ++id) {
    const Point at = grid.in_box(frame.given.point(grid, id));
    if (std::isnan(at.x)) continue;
    const cl_int z = grid.is_volume() ? along(grid.z(), at.z) : fractions_of_pixel / 2;
    places[id] = {{along(grid.x(), at.x), along(grid.y(), at.y), z, 0}};
  }
  return places;
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

void SeedsState::find_way_to(SeedsFrame& next) const {
  if (frame_->grid != next.grid) {
    next.way = {0, 0, next_number()};
  } else if (frame_->listed && next.listed) {
    next.way.last = greatest_way(next.grid, *frame_->listed, *next.listed);
    next.way.all += next.way.last;
  } else if (frame_->size > 0) {  // only the device knows
    next.way = {0, 0, next_number()};
    auto before = std::make_shared<SeedsFrame>(*frame_);
    before->before = nullptr;
    before->given = {};
    before->there = {};
    next.before = std::move(before);
  }
}

void SeedsState::commit(std::shared_ptr<const SeedsFrame> frame, std::vector<bool> there) noexcept {
  present = std::move(there);
  frame_ = std::move(frame);
}

void SeedsState::place(const Grid& grid, const Points& points) {
  check_count(points.size());
  if (grid.depth() > 1 && !points.have_z() && points.size() > 0) {
    throw Error("the grid is a volume, and the points have no z");
  }
  if (frame_->weights && points.weights() == nullptr) {
    throw Error(
        "the seeds have weights, and the points that they shall move to have none; give each a weight");
  }
  check_weights(points);
  const Snapping snapping(grid, options.outside);
  const std::shared_ptr<std::vector<double>> numbers = numbers_.take();
  const GivenPoints given = {numbers, points.have_z() ? 3 : 2};
  numbers->resize(points.size() * static_cast<std::size_t>(given.dimensions));
  std::vector<bool> there(points.size(), true);
  std::size_t absent = 0, beyond = 0;
  bool lost = there.size() < present.size();
  const auto dimensions = static_cast<std::size_t>(given.dimensions);
  constexpr std::size_t part = 512;  // points that lie in the first cache when they are looked at
  for (std::size_t first = 0; first < points.size(); first += part) {
    const std::size_t end = std::min(first + part, points.size());
    double* const here = numbers->data() + first * dimensions;
    double* to = here;
    for (std::size_t id = first; id < end; ++id, to += dimensions) {
      const bool is_present = points.is_present(id);
      const Point point = is_present ? points[id] : Point{std::numeric_limits<double>::quiet_NaN()};
      to[0] = point.x;
      to[1] = point.y;
      if (dimensions > 2) to[2] = point.z;
    }
    if (snapping.are_surely_inside(here, to, given.dimensions)) continue;
    for (std::size_t id = first; id < end; ++id) {
      const Snapping::Where where =
          points.is_present(id) ? snapping.find(id, point_on(grid, points, id)) : Snapping::Where::absent;
      beyond += where == Snapping::Where::outside ? 1 : 0;
      if (where != Snapping::Where::absent) continue;
      here[(id - first) * dimensions] = std::numeric_limits<double>::quiet_NaN();
      there[id] = false;
      ++absent;
      lost = lost || (id < present.size() && present[id]);
    }
  }
  SeedsFrame next = next_frame(grid, points.size(), lost);
  next.absent = absent;
  next.outside = beyond;
  next.given = given;
  if (points.weights() != nullptr) {
    next.weights =
        std::make_shared<const std::vector<double>>(points.weights(), points.weights() + points.size());
  }
  next.is_off_centre = options.snap == Snap::none;
  // The host looks whether voxels are crowded.
  if (beyond == 0 && (next.is_off_centre || !has_voxels(grid)) && kernels_place(device, grid)) {
    if (found_() == nullptr)
      found_ = allocate_with(device, std::vector<cl_uint>(4), "the check of the points");
    const std::size_t bytes = numbers->size() * sizeof(double);
    const auto place_from = [&](std::shared_ptr<const cl::Buffer> there_points) {
      return place_by_kernel(next, {std::move(there_points), points.size(), true, given.dimensions},
                             {{}, true}, found_);
    };
    if (bytes > 0 && shares_memory(device)) {
      upload_of_points_.start_where_they_are(device, numbers, [&] {
        return place_from(
            std::make_shared<const cl::Buffer>(buffer_at(device, numbers->data(), bytes, "the points")));
      });
    } else {
      const std::shared_ptr<const cl::Buffer> room = rooms_of_points_.take(device, bytes);
      upload_of_points_.start(device, *room, numbers);
      place_from(room);
    }
  } else if (has_voxels(grid)) {
    upload_positions(next, voxels_of(next));
  } else {
    const std::shared_ptr<std::vector<Place>> places = list_of_places();
    places->reserve(points.size());
    add_places(grid, given, points.size(), options.snap, *places);
    list_places(next, places);
  }
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::move(there));
}

cl::Event SeedsState::place_by_kernel(SeedsFrame& next, const PointsThere& points, const Absence& absence,
                                      const cl::Buffer& found) {
  find_way_to(next);
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(points.count);
  std::shared_ptr<cl::Buffer> places;
  if (next.is_off_centre)
    places = rooms_of_places_.take(
        device, (points.count + 1) * word * static_cast<std::size_t>(numbers_of_place(next.grid)));
  next.whole = std::make_shared<const Placement>(Placement{PixelGrid(Window(next.grid)), positions, places});
  return place_on_grid(device, kernels, next.grid, options.outside, points, absence, *positions,
                       places ? *places : cl::Buffer(), found);
}

void SeedsState::upload_positions(SeedsFrame& next, std::vector<std::uint32_t>&& packed) {
  find_way_to(next);
  const PixelGrid pixels{Window(next.grid)};
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(next.size);
  const bool are_voxels = has_voxels(next.grid),
             crowded = are_voxels && !next.are_points() && are_crowded(pixels, packed);
  std::shared_ptr<const cl::Buffer> places;
  if (are_voxels && next.is_off_centre)
    places = std::make_shared<const cl::Buffer>(allocate_with(device, places_of(next), "the seeds"));
  next.whole = std::make_shared<const Placement>(Placement{pixels, positions, places, crowded});
  packed.push_back(PackedPositions(pixels).empty);
  upload_.start(device, *positions, std::move(packed));
}

void SeedsState::list_places(SeedsFrame& next, std::shared_ptr<const std::vector<Place>> places) {
  next.listed = std::move(places);
  if (next.outside > 0 || !fits_in_a_diagram(next.grid) ||
      !kernels_go_round(next.grid, PixelGrid(Window(next.grid)))) {
    return find_way_to(next);
  }
  std::vector<std::uint32_t> packed;
  packed.reserve(next.size + 1);
  for (const Place& at : *next.listed) {
    packed.push_back(is_absent(at)
                         ? absent_position
                         : pack(static_cast<int>(pixel_of(at.x)), static_cast<int>(pixel_of(at.y))));
  }
  upload_positions(next, std::move(packed));
}

void SeedsState::place(const Grid& grid, std::shared_ptr<const std::vector<Place>> places, bool are_points) {
  const Snapping snapping(grid, options.outside);
  std::vector<bool> there(places->size(), true);
  bool lost = there.size() < present.size();
  std::size_t inside = 0, absent = 0;
  for (std::size_t id = 0; id < places->size(); ++id) {
    inside += snapping.is_inside((*places)[id]) ? 1 : 0;
    if (!is_absent((*places)[id])) continue;
    there[id] = false;
    ++absent;
    lost = lost || (id < present.size() && present[id]);
  }
  SeedsFrame next = next_frame(grid, places->size(), lost);
  next.absent = absent;
  next.outside = places->size() - inside - absent;
  next.is_off_centre = are_points;
  list_places(next, std::move(places));
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::move(there));
}

void SeedsState::place(const PointBuffer& points) {
  check_buffers(device, points);
  if (frame_->weights) throw Error("the seeds have weights, and points in buffers have none");
  const bool is_marked = points.present() != nullptr;
  const int dimensions = coordinates_of(points);
  if (grid().is_volume() && dimensions == 2 && points.count > 0)
    throw Error("the grid is a volume, and the points have no z");
  const auto place_on_host = [&] {
    if (points.count == 0) return place(grid(), Points(std::vector<Point>()));
    const auto caller = std::make_shared<const cl::Buffer>(points.points);
    const GivenPoints given = read_points(device, {caller, points.count, are_doubles(points), dimensions});
    const auto marks = is_marked ? download<std::uint8_t>(device, points.present, points.count)
                                 : std::vector<std::uint8_t>(points.count, 1);
    const double* const x = given.numbers->data();
    const std::ptrdiff_t stride = dimensions * static_cast<std::ptrdiff_t>(sizeof(double));
    place(grid(),
          Points(x, x + 1, dimensions == 3 ? x + 2 : nullptr, points.count, stride).marked(marks.data()));
  };
  if (!kernels_place(device, grid())) return place_on_host();

  // Which are present, only the device knows.
  const bool counts_there = is_marked || options.outside == Outside::absent;
  SeedsFrame next = next_frame(grid(), points.count, counts_there || points.count < size());
  next.counted_there = counts_there;
  next.is_off_centre = options.snap == Snap::none;
  const std::shared_ptr<PointCheck> check = unused_check();
  check->reset(Snapping(grid(), options.outside));
  const std::shared_ptr<cl::Buffer> copied = rooms_of_points_.take(device, bytes_of(points));
  if (points.count > 0) copy(device, points.points, *copied, bytes_of(points));
  next.there = {copied, points.count, are_doubles(points), dimensions};
  check->read_from(next.there);
  next.points = check;
  place_by_kernel(next, next.there, {points.present}, check->found());
  const bool may_be_outside = !grid().x().is_periodic() || !grid().y().is_periodic();
  if (options.outside == Outside::count && may_be_outside && !has_voxels(grid())) {
    if (check->bad_point()) throw BadPoint(*check->bad_point());
    if (check->outside() > 0) return place_on_host();
  }
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::vector<bool>(points.count, true));
}

void SeedsState::place_on_device(std::size_t count, std::shared_ptr<const cl::Buffer> positions) {
  SeedsFrame next = next_frame(grid(), count, count < size());
  next.whole =
      std::make_shared<const Placement>(Placement{PixelGrid(Window(grid())), std::move(positions), nullptr});
  find_way_to(next);
  commit(std::make_shared<const SeedsFrame>(std::move(next)), std::vector<bool>(count, true));
}

void SeedsState::place_marks(std::shared_ptr<Marks> marks) {
  const std::size_t count = marks->count(kernels);
  check_count(count);
  const std::shared_ptr<cl::Buffer> positions = room_for_positions(count);
  marks->list(kernels, PixelGrid(Window(grid())), *positions);
  place_on_device(count, positions);
  SeedsFrame marked = *frame_;
  marked.marks = std::move(marks);
  frame_ = std::make_shared<const SeedsFrame>(std::move(marked));
}

std::shared_ptr<cl::Buffer> Rooms::take(const Device& device, std::size_t bytes) {
  for (std::shared_ptr<cl::Buffer>& room : rooms_) {
    if (is_used(room)) continue;
    if (size_of(*room) < bytes) *room = allocate(device, bytes, "the seeds");
    return room;
  }
  rooms_.push_back(std::make_shared<cl::Buffer>(allocate(device, bytes, "the seeds")));
  return rooms_.back();
}

std::shared_ptr<cl::Buffer> SeedsState::room_for_positions(std::size_t count) {
  check_count(count);
  return rooms_of_positions_.take(device, (count + 1) * word);
}

std::shared_ptr<cl::Buffer> SeedsState::copy_to_move(const char* what) {
  const PixelGrid pixels{Window(grid())};
  refuse_weights(*frame_, what);
  const std::shared_ptr<const Placement> placement = frame_->place_in(grid(), pixels);
  refuse_seeds_beyond(*placement, *frame_, what);
  std::shared_ptr<cl::Buffer> positions = room_for_positions(size());
  copy(device, *placement->positions, *positions, (size() + 1) * sizeof(std::uint32_t));
  return positions;
}

void SeedsState::moved(const std::shared_ptr<cl::Buffer>& positions, double way) {
  SeedsFrame next = *frame_;
  next.whole = std::make_shared<const Placement>(Placement{PixelGrid(Window(grid())), positions, nullptr});
  next.given = {};
  next.there = {};
  next.marks = nullptr;
  next.listed = nullptr;
  next.is_off_centre = false;
  next.weights = nullptr;  // all were the same
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
  checks_.push_back(std::make_shared<PointCheck>(device));
  return checks_.back();
}

}  // namespace vorocl
