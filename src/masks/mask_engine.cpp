#include "masks/mask_engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "masks/items.hpp"
#include "runtime/has_doubles.hpp"
// Last: it defines macros.
#include "masks/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t bytes_of_ints = STRIP * sizeof(cl_int);

int bits_of_numbers(int size) {
  int bits = 1;
  while (1 << bits < size) ++bits;
  return bits;
}

cl_long bits_of(double number) {
  cl_long bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits;
}

/// Ways along an axis from which on the part of a squared distance is `limit` or more.
int way_of_limit(std::int64_t limit, std::int64_t square) {
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(limit) / static_cast<double>(square))));
}

/// The costs along a line of so many places, as keys have them.
template <typename Key>
cl::Buffer costs_of(const Device& device, int size, std::int64_t square, std::int64_t limit, int bits) {
  std::vector<Key> costs;
  costs.reserve(static_cast<std::size_t>(COSTS(size)));
  for (std::int64_t way = -REACH_OF_COSTS(size); way <= REACH_OF_COSTS(size); ++way) {
    costs.push_back(static_cast<Key>(std::min(way * way * square, limit) << bits));
  }
  return allocate_with(device, costs, "the costs along an axis");
}

/// What DIVIDE takes for a side.
void set_division(int side, cl_uint& factor, cl_int& shift) {
  shift = 0;
  while (1 << shift < side) ++shift;
  factor =
      static_cast<cl_uint>(((std::uint64_t{1} << (31 + shift)) - 1) / static_cast<std::uint64_t>(side) + 1);
}

int wanted_of(const NearestTargets& targets) {
  int wanted = 0;
  if (targets.distances() != nullptr) {
    wanted |= targets.type_of_distances == PixelType::float64   ? WANTS_DOUBLES
              : targets.type_of_distances == PixelType::float32 ? WANTS_FLOATS
                                                                : WANTS_SQUARES;
  }
  if (targets.indices() != nullptr) wanted |= WANTS_INDICES;
  if (targets.places() != nullptr) wanted |= WANTS_PLACES;
  if (targets.ranks() != nullptr) wanted |= WANTS_RANKS;
  if (targets.values() != nullptr) wanted |= WANTS_VALUES;
  return wanted;
}

}  // namespace

MaskEngine::MaskEngine(const Device& device, const ImageShape& shape, const PixelSize& size,
                       const WholeSizes& whole, Metric metric)
    : device_(without_vectors(device)),
      shape_(shape),
      size_(size),
      whole_(whole),
      metric_(metric),
      nothing_(allocate(device, word, "the mask engine")) {
  const bool in_groups = device.tuning().shape == Shape::group;
  const auto most_square = [&](int side, std::int64_t square, bool is_periodic) {
    // Groups compare sites, too, whose images are nearer.
    const std::int64_t way = in_groups && is_periodic ? side + side / 2 : side - 1;
    return way * way * square;
  };
  const auto [x, y, z] = whole.squares;
  most_in_slice_ = most_square(shape.width, x, false) + most_square(shape.height, y, shape.periodic_y);
  most_ = most_in_slice_ + most_square(shape.depth, z, shape.periodic_z);
  if (in_groups) return;
  along_y_ = make_pass(shape.height, y, most_in_slice_, std::max(x, y));
  if (shape.depth > 1) {
    along_z_ = make_pass(shape.depth, z, most_, std::max({x, y, z}));
  }
}

MaskEngine::Pass MaskEngine::make_pass(int size, std::int64_t square, std::int64_t most,
                                       std::int64_t greatest_square) const {
  constexpr std::int64_t pixels_that_do = 16;
  Pass pass;
  pass.bits = bits_of_numbers(size);
  pass.limit = (std::int64_t{1} << (31 - pass.bits)) - 1;
  pass.far_limit = (std::int64_t{1} << (62 - pass.bits)) - 1;
  if (metric_ == Metric::manhattan) {
    pass.costs = nothing_;  // and no distance has more than 16 bits
    return pass;
  }
  pass.saturates = most >= pass.limit;
  pass.starts_far = pass.saturates && pass.limit < pixels_that_do * pixels_that_do * greatest_square;
  pass.costs = costs_of<cl_uint>(device_, size, square, pass.limit, pass.bits);
  if (pass.saturates) pass.far_costs = costs_of<cl_long>(device_, size, square, pass.far_limit, pass.bits);
  return pass;
}

int MaskEngine::strips_at_once() const {
  const bool is_short = std::max(shape_.height, shape_.depth) <= LONGEST_AT_ONCE;
  return shape_.depth > 1 && is_short ? std::min(MOST_AT_ONCE, STRIPS_OF(shape_.width)) : 1;
}

int MaskEngine::carried_for(const NearestTargets& targets) const {
  if (targets.labels() != nullptr) return CARRIES_LABELS;
  const int wanted = wanted_of(targets);
  const bool is_unit = size_.x == 1 && size_.y == 1 && (size_.z == 1 || shape_.depth == 1);
  // Distances along lengths that are not whole are those of offsets.
  const bool of_squares = is_unit || (wanted == WANTS_SQUARES && !std::isfinite(targets.farthest));
  const bool distances_alone = (wanted & ~(WANTS_SQUARES | WANTS_FLOATS | WANTS_DOUBLES)) == 0;
  return distances_alone && of_squares ? CARRIES_NOTHING : CARRIES_PLACES;
}

cl::Buffer MaskEngine::images_of(const NearestTargets& targets, int carried, bool is_far) const {
  images_t images = {};
  images.square_x = whole_.squares[0];
  images.square_y = whole_.squares[1];
  images.square_z = whole_.squares[2];
  images.limit_y = is_far ? along_y_.far_limit : along_y_.limit;
  images.limit_z = is_far ? along_z_.far_limit : along_z_.limit;
  images.length_x = bits_of(size_.x);
  images.length_y = bits_of(size_.y);
  images.length_z = bits_of(size_.z);
  images.is_unit = size_.x == 1 && size_.y == 1 && (size_.z == 1 || shape_.depth == 1);
  images.limits_lengths = !images.is_unit && std::isfinite(targets.farthest) && has_doubles(device_);
  // A distance that differs by rounding alone is not farther.
  constexpr double within = 4 * std::numeric_limits<double>::epsilon();
  images.longest_length = bits_of(targets.farthest * (1 + within));
  images.farthest =
      whole_.most_within(images.limits_lengths ? std::numeric_limits<double>::infinity() : targets.farthest);
  images.float_x = static_cast<cl_float>(size_.x);
  images.float_y = static_cast<cl_float>(size_.y);
  images.float_z = static_cast<cl_float>(size_.z);
  images.width = shape_.width;
  images.height = shape_.height;
  images.depth = shape_.depth;
  images.longest = std::max(shape_.height, shape_.depth);
  images.strips_at_once = strips_at_once();
  images.period_x = shape_.periodic_x ? shape_.width : 0;
  images.period_y = shape_.periodic_y ? shape_.height : 0;
  images.period_z = shape_.periodic_z ? shape_.depth : 0;
  images.bits_y = along_y_.bits;
  images.bits_z = along_z_.bits;
  images.saturates_y = !is_far && along_y_.saturates;
  images.saturates_z = !is_far && along_z_.saturates;
  images.most_x_of_y = way_of_limit(along_y_.limit, whole_.squares[0]);
  images.most_x_of_z = way_of_limit(along_z_.limit, whole_.squares[0]);
  images.most_y_of_z = way_of_limit(along_z_.limit, whole_.squares[1]);
  images.is_volume = shape_.is_volume;
  images.wanted = wanted_of(targets);
  images.carried = carried;
  set_division(shape_.width, images.factor_of_width, images.shift_of_width);
  set_division(shape_.height, images.factor_of_height, images.shift_of_height);
  images.bytes_of_value = static_cast<cl_int>(bytes_of(targets.type_of_values));
  return allocate_with(device_, &images, sizeof images, "the sizes of an image");
}

template <typename Run>
Commands MaskEngine::run_pass(KernelSet& kernels, const Pass& pass, const char* name, const cl::Buffer& flags,
                              std::size_t strips, Run run) {
  const cl::Event first = pass.starts_far
                              ? fill(device_, flags, cl_uchar{1}, strips)
                              : run(mask_kernel(kernels, device_, name, {metric_}), pass.costs, false);
  if (!pass.saturates) return {first, first};
  const cl::Event last =
      run(mask_kernel(kernels, device_, name, {metric_, Neighbourhood::moore, Extent::far}), pass.far_costs,
          true);
  return {first, last};
}

template <typename... Arguments>
cl::Event MaskEngine::run_last(Kernel& kernel, std::size_t count, const NearestTargets& targets,
                               const Marks& marks, const Arguments&... arguments) const {
  return kernel.over_items(count, arguments..., given(targets.distances), given(targets.indices),
                           given(targets.places), given(targets.ranks), given(marks.starts),
                           given(targets.values), given(targets.image), given(targets.labels));
}

Commands MaskEngine::run_in_groups(KernelSet& kernels, const Marks& marks, const NearestTargets& targets,
                                   MaskWorkspace& room, WorkingMemory& memory) {
  const std::size_t pixels = shape_.pixels();
  memory.reserve(room.columns, pixels * sizeof(cl_ushort));
  memory.reserve(room.between, pixels * word);
  const cl::Buffer images = images_of(targets, carried_for(targets), false);
  // The two greatest numbers say that there is no mark.
  const bool is_far = most_ >= std::numeric_limits<cl_uint>::max() - 1;
  const auto kernel = [&](const char* name) -> Kernel& {
    return mask_kernel(kernels, device_, name,
                       {metric_, Neighbourhood::moore, is_far ? Extent::far : Extent::grid});
  };
  const auto along = [&](const char* name, int size, const auto&... buffers) {
    const std::size_t width = static_cast<std::size_t>(shape_.width),
                      others = pixels / width / static_cast<std::size_t>(size),
                      groups = STRIPS_OF(width) * static_cast<std::size_t>(BANDS_OF(size)) * others;
    const std::size_t items = std::min<std::size_t>(device_.tuning().patch_items, MOST_OF_BAND);
    kernel(name).in_groups_of(items).over_items(groups * items, images, buffers...);
  };
  const cl::Event first =
      kernel("nearest_columns").over_items(pixels, images, marks.bits, marks.counts, room.columns);
  along("nearest_along_y", shape_.height, room.columns, room.between);
  // What rows have is needed no longer: there is room for slices.
  if (shape_.depth > 1) along("nearest_along_z", shape_.depth, room.between, room.columns);
  return {first, run_last(kernel("store_targets"), pixels, targets, marks, images, room.between, room.columns,
                          marks.bits)};
}

Commands MaskEngine::run(KernelSet& kernels, const Marks& marks, const NearestTargets& targets,
                         MaskWorkspace& room, WorkingMemory& memory) {
  if (device_.tuning().shape == Shape::group) return run_in_groups(kernels, marks, targets, room, memory);
  const auto width = static_cast<std::size_t>(shape_.width), height = static_cast<std::size_t>(shape_.height);
  const auto depth = static_cast<std::size_t>(shape_.depth);
  const std::size_t strips = static_cast<std::size_t>(STRIPS_OF(shape_.width)),
                    longest = std::max(height, depth);
  const bool is_volume = depth > 1, saturates = along_y_.saturates || along_z_.saturates;
  // All work-items together have a byte per pixel to work in, or there is one for each unit.
  const std::size_t at_once = static_cast<std::size_t>(strips_at_once()),
                    keys_of_item = VECTORS_OF_KEYS(longest, at_once) * STRIP *
                                   (saturates ? sizeof(cl_long) : sizeof(cl_uint)),
                    ints_of_item = VECTORS_OF_INTS(longest, at_once) * bytes_of_ints;
  const std::size_t most_items =
      std::clamp(shape_.pixels() / (keys_of_item + ints_of_item), units_of(device_), items_of(device_));
  const std::size_t items_of_slices = std::min(most_items, depth),
                    items_of_strips = std::min(most_items, strips);
  const std::size_t items = std::min(most_items, is_volume ? longest : strips);
  memory.reserve(room.keys, items * keys_of_item);
  memory.reserve(room.ints, items * ints_of_item);
  memory.reserve(room.flags, strips * (is_volume ? longest : 1));
  const std::size_t of_columns = strips * SHORTS_OF_STRIP(height) * sizeof(cl_ushort);
  memory.reserve(room.columns, of_columns * (is_volume ? items_of_slices : 1));
  const int carried = carried_for(targets);
  const cl::Buffer near = images_of(targets, carried, false),
                   far = saturates ? images_of(targets, carried, true) : nothing_;
  if (!is_volume) {
    const cl::Event first = mask_kernel(kernels, device_, "nearest_in_rows")
                                .in_groups_of(1)
                                .over_items(std::min(most_items, height), near, marks.bits, marks.counts,
                                            room.columns, given(targets.labels));
    const Commands in_strips = run_pass(
        kernels, along_y_, "nearest_in_strips", room.flags, strips,
        [&](Kernel& kernel, const cl::Buffer& costs, bool is_far) {
          return run_last(kernel.in_groups_of(1), items_of_strips, targets, marks, is_far ? far : near, costs,
                          room.keys, room.ints, room.flags, marks.bits, marks.counts, room.columns);
        });
    return {first, in_strips.last};
  }
  // What is known in the slices stands in a target until the last pass, if one has room.
  const auto holds = [](PixelType type) { return static_cast<cl_int>(bytes_of(type) / sizeof(cl_uint)); };
  cl::Buffer between;
  cl_int step = 1;
  if (targets.distances() != nullptr) {
    between = targets.distances;
    step = holds(targets.type_of_distances);
  } else if (targets.indices() != nullptr) {
    between = targets.indices;
  } else if (targets.places() != nullptr) {
    between = targets.places;
  } else if (targets.ranks() != nullptr) {
    between = targets.ranks;
  } else if (targets.values() != targets.image() && holds(targets.type_of_values) > 0) {
    between = targets.values;
    step = holds(targets.type_of_values);
  } else {
    memory.reserve(room.between, width * height * depth * word);
    between = room.between;
  }
  memory.reserve(room.slices, depth * word);
  const Commands in_slices = run_pass(kernels, along_y_, "nearest_in_slices", room.flags, strips * depth,
                                      [&](Kernel& kernel, const cl::Buffer& costs, bool is_far) {
                                        return kernel.in_groups_of(1).over_items(
                                            items_of_slices, is_far ? far : near, costs, room.keys, room.ints,
                                            room.flags, marks.bits, marks.counts, room.columns, room.slices,
                                            between, step, given(targets.labels));
                                      });
  const Commands along_z =
      run_pass(kernels, along_z_, "nearest_along_z", room.flags, strips * height,
               [&](Kernel& kernel, const cl::Buffer& costs, bool is_far) {
                 return run_last(kernel.in_groups_of(1), std::min(most_items, height), targets, marks,
                                 is_far ? far : near, costs, room.keys, room.ints, room.flags, marks.bits,
                                 room.slices, between, step);
               });
  return {in_slices.first, along_z.last};
}

}  // namespace vorocl
