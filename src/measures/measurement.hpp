// What the measures of a diagram share: what they remember of it, their results, and the blocks that their
// work-items walk through (see runs.cl).
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "core/diagram_state.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Makes the buffer of a result, unless there is one of this device that is large enough.
void make_room(cl::Buffer& buffer, const Device& device, std::size_t bytes);

/// A diagram as a measure sees it and its result remembers it: the seeds may move on, and the diagram may be
/// filled again or destroyed.
struct MeasuredDiagram {
  Device device;
  Window window;
  PixelGrid grid;                              // its pixels, periodic along axes that it shows whole
  std::shared_ptr<const SeedsFrame> seeds;     // null: the labels name none
  std::shared_ptr<const Placement> placement;  // null likewise
  Metric metric;
  std::shared_ptr<const PointPlacement> points = nullptr;  // where the labels are made of places

  // What kernels get of the seeds: SEED_PARAMETERS of seed_place.cl, and the options that they are built
  // for. Only where there are seeds.
  const cl::Buffer& positions() const { return points ? points->seeds : *placement->positions; }
  cl_uint count() const { return static_cast<cl_uint>(seeds->size); }
  cl_int4 size() const { return {{grid.width(), grid.height(), grid.depth(), 0}}; }
  cl_int8 lattice() const { return points ? points->lattice : cl_int8{}; }

  /// How many pixels further along x the first row follows the last one, where the window is periodic in y,
  /// and how many along x and y the first slice the last one, where it is in z. All are 0 unless the grid is
  /// tilted. Pixels of one row lie between those of the other, and the two that share most of an edge have
  /// it.
  cl_int4 shifts_in_pixels() const;
  bool is_shifted() const;

  /// The unit of distances: so many are a pixel.
  int units_of_pixel() const { return extent() == Extent::fractions ? fractions_of_pixel : 1; }

  /// A distance of the kernels', which is squared if Euclidean, in pixels.
  double in_pixels(double distance) const {
    const double units = units_of_pixel();
    return distance / (metric == Metric::euclidean ? units * units : units);
  }
  KernelOptions options() const { return {metric, Neighbourhood::moore, extent()}; }
  KernelOptions options_without_metric() const { return {{}, Neighbourhood::moore, extent()}; }

  /// Whether distances may take more than 32 bits.
  bool is_far() const { return extent() >= Extent::far; }

  /// Throws BadPoint if the seeds had one. May wait for the device.
  void check() const {
    if (seeds) seeds->check();
  }

 private:
  Extent extent() const {
    return !points ? Extent::grid : points->seeds_in_pixels ? Extent::far : Extent::fractions;
  }
};

/// The labels of the rows that follow the last ones in a tilted grid (kernels/measures/beyond.cl), in `room`;
/// the labels themselves, whose first row follows the last one of a plane, where nothing is shifted.
const cl::Buffer& rows_behind(const MeasuredDiagram& diagram, KernelSet& kernels, const cl::Buffer& labels,
                              cl::Buffer& room);

/// A diagram for a measure that looks at labels alone.
MeasuredDiagram labels_of(const Diagram& diagram);

/// A diagram for a measure that needs its seeds. Throws Error if it knows none, or is one of great circles
/// and the measure is not for these.
enum class OnGlobe { no, yes };
MeasuredDiagram cells_of(const Diagram& diagram, OnGlobe on_globe = OnGlobe::no);

/// What every result holds. It is empty before the first measurement and while one is being made: a
/// measurement that failed leaves it so.
struct Measured {
  std::optional<MeasuredDiagram> of;  // none: it is empty
  KernelSet kernels;

  bool empty() const { return !of; }

  /// The cells.
  std::size_t size() const { return of && of->seeds ? of->seeds->size : 0; }
};

/// One measurement into a result, which it empties: a measure then checks its arguments, allocates and
/// enqueues, and commits at the end.
template <typename State>
class Measuring {
 public:
  template <typename Result>
  explicit Measuring(Result& result) : state_(Internal::result(result)) {
    state_.of.reset();
  }

  State& state() { return state_; }

  /// Says that the result holds what was enqueued, of this diagram. Starts it, and reports it.
  Report commit(MeasuredDiagram&& of, const cl::Event& first, const cl::Event& last) {
    check(clFlush(of.device.queue()()), "starting a measurement");
    state_.of = std::move(of);
    return Internal::report(0, first, last, stopwatch_.milliseconds(), first_launches_.take());
  }

 private:
  Stopwatch stopwatch_;
  FirstLaunches first_launches_;
  State& state_;
};

/// A buffer of a result, null if it is empty.
template <typename State>
const cl::Buffer& buffer_of(const OwnState<State>& state, cl::Buffer State::*buffer) {
  static const cl::Buffer none;
  return state && !state->empty() ? (*state).*buffer : none;
}

/// The blocks of a grid, one per work-item.
class Blocks {
 public:
  Blocks(const Device& device, const PixelGrid& grid);

  /// A block has 2^bits pixels along each axis.
  cl_int4 bits() const { return bits_; }
  std::size_t count() const { return count_; }
  std::size_t pixels() const { return std::size_t{1} << (bits_.s[0] + bits_.s[1] + bits_.s[2]); }

  /// Enqueues a kernel that starts with take_block().
  template <typename... Arguments>
  cl::Event run(KernelSet& kernels, const char* file, const char* name, const KernelOptions& options,
                const Arguments&... arguments) const {
    return kernels.get(device_, file, name, grid_, options).over_items(count_, arguments...);
  }

 private:
  Device device_;
  PixelGrid grid_;
  cl_int4 bits_;
  std::size_t count_;
};

}  // namespace vorocl
