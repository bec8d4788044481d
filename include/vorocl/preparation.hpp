// Programs made beforehand, once per user and machine, so that no later run waits for a compiler.
#pragma once

#include <cstddef>
#include <string>

#include "vorocl/device.hpp"
#include "vorocl/export.h"

namespace vorocl {

/// What one of several processes prepares: part `index` of `count`. Drivers compile in one thread at a time,
/// but in as many processes as there are.
struct PreparationPart {
  std::size_t index = 0;
  std::size_t count = 1;
};

/// The most parts that a preparation can be divided into.
VOROCL_API std::size_t most_preparation_parts();

/// Runs all methods and measures on small and large diagrams, so that the driver compiles and caches their
/// kernels: of planes by both metrics, with no periodic axis, with a periodic x and with both; of volumes,
/// with no periodic axis and with all; with weights, and tilted boxes, by the Euclidean metric. With PoCL it
/// then keeps the binaries in binaries_folder(), where later processes find them and build nothing. Kernels
/// of other options, such as spaced axes, are compiled when they are first used, as without a preparation.
///
/// Takes four to five minutes of a processor for all parts, and some seconds if all is there. Returns how
/// many binaries are kept for the part. Throws Error if `part` has no such index, or a binary cannot be
/// written. Waits.
VOROCL_API std::size_t prepare_programs(const Device& device, const PreparationPart& part = {});

/// Where binaries are kept: $XDG_CACHE_HOME/vorocl/binaries, or ~/.cache/vorocl/binaries, a folder of the
/// user's alone. Empty where there is none, or VOROCL_BINARY_CACHE is 0: no binary is read or written then.
VOROCL_API std::string binaries_folder();

}  // namespace vorocl
