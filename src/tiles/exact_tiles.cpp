#include <cstdint>
#include <map>
#include <utility>

#include "core/diagram_state.hpp"
#include "core/seeds_state.hpp"
#include "runtime/buffer.hpp"
#include "runtime/process.hpp"
#include "tiles/plane_cells.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/fields.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

namespace {

/// What tiles of one size are made with. All have their labels in one buffer.
struct TileMaker {
  TileMaker(const Device& device, const Window& tile, const cl::Buffer& labels)
      : seeds(Internal::no_seeds(device, tile.grid())), diagram(device, tile, labels) {}

  /// The next tile of this size. Its measures count pixels where it shows them: PlaneCells brings them round.
  void show(const Window& tile) {
    DiagramState& state = Internal::state(diagram);
    state.contents.reset();
    state.window = tile;
    state.grid = PixelGrid(tile).without_periods();
  }

  Seeds seeds;
  Diagram diagram;
};

/// Pixels of a tile on the device that the host may read, while the object lives.
template <typename T>
class Mapped {
 public:
  /// Enqueues that they are mapped. Of a null buffer there are none.
  Mapped(const Device& device, const cl::Buffer& buffer, std::size_t count)
      : queue_(device.queue()), buffer_(buffer) {
    if (buffer() == nullptr) return;
    cl_int status = CL_SUCCESS;
    pixels_ = clEnqueueMapBuffer(queue_(), buffer(), CL_FALSE, CL_MAP_READ, 0, count * sizeof(T), 0, nullptr,
                                 &mapped_(), &status);
    check(status, "mapping the pixels of a tile");
  }
  ~Mapped() {
    // If this fails, so does the next command that uses the buffer, which says so.
    if (pixels_ != nullptr && process_number() == process_)
      clEnqueueUnmapMemObject(queue_(), buffer_(), pixels_, 0, nullptr, nullptr);
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;

  /// Waits for them.
  const T* wait() const {
    if (pixels_ == nullptr) return nullptr;
    check(clWaitForEvents(1, &mapped_()), "waiting for the pixels of a tile");
    return static_cast<const T*>(pixels_);
  }

 private:
  cl::CommandQueue queue_;
  cl::Buffer buffer_;
  std::int64_t process_ = process_number();  // a forked child leaves them mapped
  cl::Event mapped_;
  void* pixels_ = nullptr;
};

/// A tile whose labels are enqueued, and what else is asked for.
struct MadeTile {
  std::uint64_t number;
  Window tile;
  cl::Buffer labels, distances;
  TileMeasures measures;
};

/// Makes one tile after the other. What they have goes to two buffers in turn.
class TileEngine {
 public:
  TileEngine(const Device& device, const SeedSource& seeds, const Tiling& tiling, const TileOptions& options)
      : device_(device), seeds_(seeds), tiling_(tiling), options_(options) {
    if (seeds.grid() != tiling.window().grid())
      throw Error("the seeds are of another grid than the tiles; make both for the same one");
    if (options.metric == Metric::great_circle)
      throw Error("tiles know no great circles; exact_diagram() does, window by window");
    labels_ = allocate(device, largest_bytes(), "the labels of a tile");
    if (options.cells) Internal::result(*options.cells).begin(seeds.id_end(), tiling);
  }

  MadeTile enqueue(std::uint64_t number) {
    const Window tile = tiling_.tile(number);
    // While the device makes the tile before.
    seeds_.find_near(tile, options_.metric, near_);
    std::unique_ptr<TileMaker>& maker = makers_[{tile.width(), tile.height()}];
    if (!maker) maker = std::make_unique<TileMaker>(device_, tile, labels_);
    maker->show(tile);
    place(maker->seeds);
    upload_ids();
    exact_diagram(maker->seeds, maker->diagram, {options_.metric});
    MadeTile made = {number, tile, name_labels(maker->diagram), {}, {}};
    if (options_.distances) {
      Field<float>& field = distances_[next_];
      distance_field(maker->diagram, field);
      made.distances = field.values();
    }
    if (options_.cells) made.measures = measure(*maker);
    next_ = 1 - next_;
    return made;
  }

  const Device& device() const { return device_; }

  void add_measures(const MadeTile& made, const std::uint32_t* labels) const {
    if (options_.cells) {
      Internal::result(*options_.cells).add({made.number, made.tile, labels}, made.measures);
    }
  }

 private:
  /// Of the labels of the largest tile, which is the first one.
  std::size_t largest_bytes() const { return tiling_.tile(0).pixels() * sizeof(cl_uint); }

  void place(Seeds& seeds) const {
    SeedsState& state = Internal::state(seeds);
    const auto places = state.list_of_places();
    for (const PlaneSeed& seed : near_) places->push_back(place_of(seed));
    state.place(seeds.grid(), places, seeds_.snap() == Snap::none);
  }

  void upload_ids() {
    std::vector<cl_uint> ids;
    ids.reserve(near_.size() + 1);
    for (const PlaneSeed& seed : near_) ids.push_back(seed.id);
    ids.push_back(no_label);
    const std::size_t bytes = ids.size() * sizeof(cl_uint);
    if (ids_() == nullptr || size_of(ids_) < bytes)
      ids_ = allocate(device_, bytes, "the ids of a tile's seeds");
    upload_.start(device_, ids_, std::move(ids));
  }

  cl::Buffer name_labels(const Diagram& diagram) {
    cl::Buffer& named = named_[next_];
    if (named() == nullptr) named = allocate_mappable(device_, largest_bytes(), "the labels of a tile");
    const PixelGrid& grid = Internal::state(diagram).grid;
    kernels_.get(device_, "core/tiles.cl", "name_labels", grid)
        .over_grid(diagram.labels(), ids_, static_cast<cl_uint>(near_.size()), grid.width(), grid.height(),
                   named);
    return named;
  }

  TileMeasures measure(const TileMaker& maker) {
    cell_sums(maker.diagram, sums_);
    cell_shapes(maker.diagram, shapes_);
    adjacency(maker.diagram, pairs_);
    return {near_, sums_.read(), shapes_.read(), pairs_.read_pairs()};
  }

  Device device_;
  const SeedSource& seeds_;
  const Tiling& tiling_;
  TileOptions options_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<TileMaker>> makers_;  // by size: four
  std::vector<PlaneSeed> near_;  // the tile that is being made
  KernelSet kernels_;
  cl::Buffer ids_;
  Upload<cl_uint> upload_;
  cl::Buffer labels_;  // as the engine makes them
  cl::Buffer named_[2];
  Field<float> distances_[2];
  int next_ = 0;
  CellSumsResult sums_;
  CellShapesResult shapes_;
  AdjacencyResult pairs_;
};

/// All tiles in their order.
NextTile every_tile(const Tiling& tiling) {
  return [number = std::uint64_t{0}, count = tiling.count()]() mutable {
    return number < count ? std::optional<std::uint64_t>(number++) : std::nullopt;
  };
}

}  // namespace

void exact_tiles(const Device& device, const SeedSource& seeds, const Tiling& tiling,
                 const std::function<void(const TileLabels&)>& use, const TileOptions& options) {
  exact_tiles(device, seeds, tiling, every_tile(tiling), use, options);
}

void exact_tiles(const Device& device, const SeedSource& seeds, const Tiling& tiling, const NextTile& next,
                 const std::function<void(const TileLabels&)>& use, const TileOptions& options) {
  TileEngine engine(device, seeds, tiling, options);
  struct Waiting {
    Waiting(MadeTile&& tile, const Device& by)
        : made(std::move(tile)),
          labels(by, made.labels, made.tile.pixels()),
          distances(by, made.distances, made.tile.pixels()) {}

    MadeTile made;
    Mapped<std::uint32_t> labels;
    Mapped<float> distances;
  };
  std::unique_ptr<Waiting> waiting;
  const auto hand_over = [&] {
    if (!waiting) return;
    const std::uint32_t* const labels = waiting->labels.wait();
    engine.add_measures(waiting->made, labels);
    use({waiting->made.number, waiting->made.tile, labels, waiting->distances.wait()});
  };
  while (const std::optional<std::uint64_t> number = next()) {
    auto made = std::make_unique<Waiting>(engine.enqueue(*number), engine.device());
    check(clFlush(device.queue()()), "starting the commands of a tile");
    hand_over();
    waiting = std::move(made);
  }
  hand_over();
}

}  // namespace vorocl
