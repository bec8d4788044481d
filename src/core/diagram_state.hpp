// What a Diagram holds besides its labels, and how an engine fills it.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <typeindex>
#include <vector>

#include "core/seeds_frame.hpp"
#include "runtime/buffer.hpp"
#include "runtime/internal.hpp"
#include "runtime/kernel.hpp"
#include "runtime/stopwatch.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// What the labels of a diagram are, once something has filled it.
struct DiagramContents {
  std::shared_ptr<const SeedsFrame> seeds;     // that they name; null: the caller wrote them, and named none
  std::shared_ptr<const Placement> placement;  // of these seeds, in the diagram's window; null likewise
  std::shared_ptr<const PointPlacement> points;  // where the labels are made of these places; else null
  Metric metric = Metric::euclidean;             // not known without seeds
  std::string method;                            // empty: the caller wrote them
  cl::Event last;                                // the command that finished them
  int age = 0;                                   // frames since they were last made from nothing
};

struct DiagramState {
  DiagramState(const Device& device, const Window& window, const cl::Buffer& labels);
  ~DiagramState();
  DiagramState(const DiagramState&) = delete;
  DiagramState& operator=(const DiagramState&) = delete;

  /// Where the labels are from now on: in the host's memory, or, if that is null or the device has another
  /// memory, in the device's. The diagram counts as never filled.
  void put_labels_at(std::uint32_t* memory);

  Device device;
  Window window;
  PixelGrid grid;  // its pixels
  cl::Buffer labels;
  std::optional<DiagramContents> contents;  // none: it counts as never filled

  /// How often labels were filled or written: a result asks whether they are still those that it measured,
  /// perhaps after the diagram is gone.
  std::shared_ptr<std::atomic<std::uint64_t>> fills = std::make_shared<std::atomic<std::uint64_t>>(0);

  KernelSet kernels;

  /// An engine's working memory, a struct of buffers, made empty at its first use and kept.
  template <typename Workspace>
  Workspace& workspace() {
    std::shared_ptr<void>& workspace = workspaces_[typeid(Workspace)];
    if (!workspace) workspace = std::make_shared<Workspace>();
    return *static_cast<Workspace*>(workspace.get());
  }

  WorkingMemory memory;  // of all workspaces, beside the labels
  void reserve(cl::Buffer& buffer, std::size_t bytes) { memory.reserve(buffer, bytes); }

  /// Where seeds lie in the window. Throws Error unless they have this device and its grid.
  std::shared_ptr<const Placement> place(const Seeds& seeds, Metric metric = Metric::euclidean) const;

  /// The same as places.
  std::shared_ptr<const PointPlacement> place_points(const SeedsFrame& frame, Metric metric) const;

  /// Waits for the queue. If the device fails, the diagram counts as never filled. Throws BadPoint if the
  /// frame that the labels are of had one.
  void wait();

  /// As wait(), and copies the labels to the host.
  void read(std::uint32_t* to);

 private:
  template <typename Then>
  void wait_and(Then then);

  /// Waits, because the device may still write to memory that is the caller's to free.
  void leave_host() noexcept;

  cl::Buffer own_labels_;          // where they are when they are not in the host's memory
  std::uint32_t* host_ = nullptr;  // where they are there
  std::map<std::type_index, std::shared_ptr<void>> workspaces_;
};

/// One run of an engine, as a transaction. It starts by taking away what the diagram holds; an engine then
/// checks its arguments, allocates and enqueues, and commits at the end. If it throws before, the diagram
/// counts as never filled.
class Filling {
 public:
  /// Throws Error unless seeds and diagram fit together, and for great circles by another method than
  /// "exact".
  Filling(const Seeds& seeds, Diagram& diagram, Metric metric, const char* method);

  const SeedsFrame& seeds() const { return *next_.seeds; }
  const Placement& placement() const { return *next_.placement; }

  Metric metric() const { return next_.metric; }

  /// Whether labels are made of the places of the seeds: of points, and where they go beyond the window.
  bool takes_places() const { return seeds().are_points() || placement().goes_beyond; }

  /// Takes these for what the labels are made of. The host waits if it has no list of the seeds and they go
  /// beyond the window.
  const PointPlacement& take_places();

  /// A kernel of the diagram for these seeds and this metric, on the diagram's device or that with another
  /// tuning.
  Kernel& kernel(const char* file, const char* name, Neighbourhood neighbourhood = Neighbourhood::moore);
  Kernel& kernel(const Device& device, const char* file, const char* name);

  /// What the diagram held before; none if it counted as never filled.
  const std::optional<DiagramContents>& previous() const { return previous_; }

  /// Says that the diagram holds the labels of the seeds, `age` frames after they were last made from
  /// nothing. Starts what was enqueued, and reports it.
  Report commit(int waves, const cl::Event& first, const cl::Event& last, int age = 0,
                const FloodStart& start = {});

 private:
  Stopwatch stopwatch_;
  FirstLaunches first_launches_;
  DiagramState& diagram_;
  std::optional<DiagramContents> previous_;
  DiagramContents next_;
};

}  // namespace vorocl
