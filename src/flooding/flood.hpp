// The waves of one diagram, enqueued one after the other: what all flooding engines are made of.
#pragma once

#include <optional>

#include "core/diagram_state.hpp"
#include "flooding/reaching_plan.hpp"

namespace vorocl {

/// The working memory of flooding: 9 bytes per pixel.
struct FloodWorkspace {
  cl::Buffer front, back;  // images of packed positions, which change places with every wave
  cl::Buffer seeded;       // a byte per pixel: whether it holds a seed
  cl::Buffer flag;         // one word, for kernels that report
  cl::Buffer found;        // two words: see measure_labels()
};

/// Throws Error if the diagram's window is not all of its grid, or seeds lie outside it.
void refuse_what_floods_cannot_take(const Filling& filling, const DiagramState& diagram);

/// Enqueues a last wave, over an image of packed positions, which writes the labels of the diagram. `ids` is
/// an image that nobody needs any more: it takes the seeds' ids, which the wave looks up.
cl::Event label_by_last_wave(Filling& filling, const DiagramState& diagram, const cl::Buffer& image,
                             const cl::Buffer& ids, const Wave& wave);

/// Between waves the diagram is an image of packed seed positions. Each wave reads the front image and writes
/// the back one, then they change places.
class Flood {
 public:
  /// Checks that seeds and diagram fit together and makes the working memory. Enqueues nothing.
  Flood(const Seeds& seeds, Diagram& diagram, Metric metric, const char* method);

  const SeedsFrame& seeds() const { return filling_.seeds(); }

  /// What the diagram held before.
  const std::optional<DiagramContents>& previous() const { return filling_.previous(); }

  /// A wave that keeps each pixel's own label.
  static constexpr Wave none = {0, Neighbourhood::von_neumann};

  /// Stamps the seeds on an empty image, and runs a first wave over it.
  void first_wave(const Wave& wave);

  /// Starts from the diagram's labels instead of a first wave: their seeds at their present positions.
  void advance_labels();

  /// How far the labels that the diagram holds are from where their seeds are now, in every eighth row.
  /// Waits.
  LabelDistances label_distances();

  void wave(const Wave& wave);

  /// Sets the number that last_change() gives to 0.
  void clear_last_change();

  /// A wave of step 1. If it changes a label, last_change() gives its `number`.
  void reporting_wave(Neighbourhood neighbourhood, int number);

  /// The number of the last reporting wave that changed a label. Waits for the device.
  int last_change();

  /// Runs a last wave and writes the ids of its labels into the diagram.
  void last_wave(const Wave& wave);

  /// Whether a pixel was left without a label. Waits.
  bool some_unlabelled();

  /// All waves of a plan, from the seeds alone; or from the diagram's labels.
  void run(const Plan& plan);
  void run_from_labels(const Plan& plan);

  /// Says that the diagram is filled: see Filling::commit().
  Report commit(std::size_t waves, int age = 0);

 private:
  void begins_with(const cl::Event& event);

  DiagramState& diagram_;
  Filling filling_;
  const PixelGrid& grid_;
  const cl::Buffer& positions_;
  cl_uint count_;  // of the seeds
  Metric metric_;
  FloodWorkspace& memory_;
  cl::Event first_event_, last_event_;
  FloodStart start_;
};

}  // namespace vorocl
