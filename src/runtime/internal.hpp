// The way in, for the library's own sources, to what its public classes hold behind a pointer.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "runtime/first_launches.hpp"
#include "runtime/process.hpp"
#include "vorocl/device.hpp"
#include "vorocl/diagram.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

template <typename State, typename... Arguments>
OwnState<State> make_state(Arguments&&... arguments) {
  return {new State(std::forward<Arguments>(arguments)...), {[](State* state) { delete state; }}};
}

struct Internal {
  static DeviceState& state(const Device& device) { return *device.state_; }

  /// Throws Error if the object was moved from.
  static SeedsState& state(const Seeds& seeds) { return seeds.state(); }
  static DiagramState& state(const Diagram& diagram) { return diagram.state(); }

  static Report report(int waves, const cl::Event& first, const cl::Event& last, double host_milliseconds,
                       std::vector<FirstLaunch>&& first_launches, const FloodStart& start = {},
                       bool snapped = false) {
    return {waves,  first, last, host_milliseconds, start, std::move(first_launches), process_number(),
            snapped};
  }

  /// No seeds yet. Those that they are moved to are not snapped: see SeedsState::place().
  static Seeds no_seeds(const Device& device, const Grid& grid);

  /// Whether an axis has no scale, for its unit is the pixel.
  static bool is_in_pixels(const Axis& axis) { return axis.in_pixels_; }

  /// What a result holds; made at its first use.
  template <typename Result>
  static auto& result(Result& result) {
    if (!result.state_) result.state_ = make_state<typename decltype(result.state_)::element_type>();
    return *result.state_;
  }

  /// The same of a result that is not to be changed; null before its first use.
  template <typename Result>
  static const auto* held(const Result& result) {
    return result.state_.get();
  }
};

}  // namespace vorocl
