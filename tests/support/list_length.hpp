// The exact engine with short lists of candidates inside: what overflows may cost time, never a pixel.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/device_state.hpp"

namespace vorocl {

enum class ListLength { full, two_entries };

constexpr ListLength both_lengths[] = {ListLength::full, ListLength::two_entries};
inline const char* name_of(ListLength lists) {
  return lists == ListLength::full ? "full lists" : "short lists";
}

/// The build options by which nearly every list overflows (kernels/exact, kernels/masks).
/// tools/checks/kernels.sh reads them here.
constexpr const char* short_lists =
    "-DMOST_RANKED=2 -DMOST_OF_PART=2 "
    "-DMOST_IN_LIST=24 -DMOST_OF_KEYS=4 -DMOST_BLOCKS=24 -DMOST_STAMPS=600 "
    "-DMOST_SEEDS=64 -DMOST_NODES=64 -DMOST_COMPARISONS=0";

/// A device whose exact engine has lists of this length, on the same queue and with the same tuning. Short
/// lists are for groups of all sizes: none has more items than the tuning says.
inline Device with_lists(const Device& device, ListLength lists) {
  if (lists == ListLength::full) return device;
  // With programs of their own. Never destroyed: at the end of the process a driver may be gone before.
  static auto& devices = *new std::map<std::pair<cl_command_queue, std::size_t>, Device>;
  const Tuning& tuning = device.tuning();
  const std::size_t most = std::max(tuning.patch_items, tuning.group_width * tuning.group_height);
  const auto [found, is_new] =
      devices.try_emplace({device.queue()(), most}, device.context(), device.queue());
  if (is_new) {
    DeviceState& state = Internal::state(found->second);
    state.build_options = short_lists;
    state.limits.items = std::min(state.limits.items, most);
  }
  return found->second.with_tuning(tuning);
}

}  // namespace vorocl
