#include "vorocl/distance_transform.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "masks/mask_engine.hpp"
#include "runtime/buffer.hpp"
#include "runtime/has_doubles.hpp"
#include "runtime/stopwatch.hpp"

namespace vorocl {

struct DistanceTransformState {
  DistanceTransformState(const Device& device_of_images, const Grid& grid_of_images,
                         const PixelSize& size_of_pixel)
      : device(device_of_images),
        grid(grid_of_images),
        shape(grid_of_images),
        whole(whole_sizes(size_of_pixel, shape.sides())),
        engine(device, shape, size_of_pixel, whole),
        marks(device, shape) {}

  Device device;
  Grid grid;
  ImageShape shape;
  WholeSizes whole;
  MaskEngine engine;
  MaskWorkspace workspace;
  WorkingMemory memory = {device, "a distance transform's working memory", 0};
  Marks marks;
  KernelSet kernels;
  bool has_image = false;
};

namespace {

/// The sizes of a grid's pixels, times the spacing of each axis.
PixelSize spaced(const Grid& grid, const PixelSize& size) {
  return {size.x * grid.x().spacing(), size.y * grid.y().spacing(),
          grid.depth() > 1 ? size.z * grid.z().spacing() : size.x * grid.x().spacing()};
}

/// Images in buffers: the caller's, or ones that stand for the host's memory.
class ImageBuffers {
 public:
  explicit ImageBuffers(const Device& device) : device_(device), shares_(shares_memory(device)) {}

  cl::Buffer source(const ImageSource& image, std::size_t bytes) {
    if (image.buffer()() != nullptr) {
      check_foreign_buffer(device_, image.buffer(), bytes, "the buffer of the image", Access::read);
      return image.buffer();
    }
    if (image.host() == nullptr) throw Error("the image is null");
    is_on_host_ = true;
    // Kernels read it alone.
    if (shares_) return buffer_at(device_, const_cast<void*>(image.host()), bytes, "an image");
    return allocate_with(device_, image.host(), bytes, "an image");
  }

  /// Null if it is not wanted.
  cl::Buffer target(const ImageTarget& image, const char* name, std::size_t pixels,
                    std::initializer_list<PixelType> types) {
    if (!image.is_wanted()) return {};
    const std::string text = std::string("the image of ") + name;
    if (std::find(types.begin(), types.end(), image.type()) == types.end())
      throw Error(text + " cannot have pixels of this type");
    const std::size_t bytes = pixels * bytes_of(image.type());
    cl::Buffer buffer = image.buffer();
    if (buffer() != nullptr) {
      check_foreign_buffer(device_, buffer, bytes, "the buffer of " + text, Access::read_and_write);
    } else {
      is_on_host_ = true;
      buffer = shares_ ? buffer_at(device_, image.host(), bytes, text) : allocate(device_, bytes, text);
      on_host_.push_back({buffer, image.host(), bytes});
    }
    ++count_;
    return buffer;
  }

  std::size_t targets() const { return count_; }
  bool is_on_host() const { return is_on_host_; }

  /// Waits, and brings the host's targets there.
  void finish() const {
    device_.finish();
    for (const auto& [buffer, memory, bytes] : on_host_) {
      shares_ ? synchronise(device_, buffer, bytes)
              : download(device_, buffer, bytes, static_cast<unsigned char*>(memory));
    }
  }

 private:
  struct OnHost {
    cl::Buffer buffer;
    void* memory;
    std::size_t bytes;
  };

  Device device_;
  bool shares_, is_on_host_ = false;
  std::size_t count_ = 0;
  std::vector<OnHost> on_host_;
};

void check_squares(const DistanceTransformState& state) {
  const auto [x, y, z] = state.whole.squares;
  const auto most = [](int side, std::int64_t square) {
    return std::int64_t{side - 1} * (side - 1) * square;
  };
  if (state.whole.unit != 1) {
    throw Error(
        "the squares of distances are whole numbers only if the sizes of a pixel are; ask for float64");
  }
  if (most(state.shape.width, x) + most(state.shape.height, y) + most(state.shape.depth, z) >= no_label) {
    throw Error("the squares of distances in an image of " + size_text(state.grid) +
                " may not fit in 32 bits; ask for float64");
  }
}

}  // namespace

DistanceTransform::DistanceTransform(const Device& device, const Grid& grid, const PixelSize& size)
    : state_(make_state<DistanceTransformState>(device, grid, spaced(grid, size))) {}

DistanceTransformState& DistanceTransform::state() const {
  if (!state_) throw Error("this transform was moved from; use the one it was moved to");
  return *state_;
}

const Device& DistanceTransform::device() const { return state().device; }
const Grid& DistanceTransform::grid() const { return state().grid; }

Report DistanceTransform::run(const ImageSource& image, const TransformTargets& targets,
                              const TransformOptions& options) {
  DistanceTransformState& state = this->state();
  const Stopwatch stopwatch;
  FirstLaunches first_launches;
  state.has_image = false;
  if (!(options.farthest >= 0)) throw Error("the farthest distance must be 0 or more");
  const std::size_t pixels = state.shape.pixels(), axes = state.shape.is_volume ? 3 : 2;
  ImageBuffers buffers(state.device);
  NearestTargets to;
  to.image = buffers.source(image, pixels * bytes_of(image.type()));
  to.type_of_distances = targets.distances.type();
  to.distances = buffers.target(targets.distances, "distances", pixels,
                                {PixelType::float32, PixelType::float64, PixelType::uint32});
  to.indices = buffers.target(targets.indices, "indices", axes * pixels, {PixelType::uint32});
  to.places = buffers.target(targets.places, "places", pixels, {PixelType::uint32});
  to.ranks = buffers.target(targets.ranks, "ranks", pixels, {PixelType::uint32});
  to.type_of_values = image.type();
  to.values = buffers.target(targets.values, "values", pixels, {image.type()});
  if (buffers.targets() == 0) throw Error("no target is wanted of the transform");
  if (to.distances() != nullptr && to.type_of_distances == PixelType::uint32) check_squares(state);
  if (to.distances() != nullptr && to.type_of_distances == PixelType::float64 && !has_doubles(state.device)) {
    throw Error("distances of float64 need double precision (cl_khr_fp64), which " + state.device.name() +
                    " does not have; ask for float32",
                ErrorKind::device);
  }
  to.farthest = options.farthest;
  return with_host_memory(state.device, [&] {
    const cl::Event first = state.marks.mark(state.kernels, to.image, image.type(), options.marked);
    if (to.ranks() != nullptr) state.marks.rank(state.kernels);
    const cl::Event last =
        state.engine.run(state.kernels, state.marks, to, state.workspace, state.memory).last;
    check(clFlush(state.device.queue()()), "starting a distance transform");
    if (buffers.is_on_host()) buffers.finish();
    state.has_image = true;
    return Internal::report(0, first, last, stopwatch.milliseconds(), first_launches.take());
  });
}

bool DistanceTransform::found() const {
  return state().has_image && state().marks.count(state().kernels) > 0;
}

}  // namespace vorocl
