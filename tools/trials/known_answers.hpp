// Small diagrams whose labels are known: what a device and its driver must get right before anything else
// counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The diagrams of known_frames(), made one after the other by a method with its default options.
struct KnownAnswer {
  std::string method;
  Metric metric;
  Periodic periodic;
  bool window;         // the seeds fill a plane of three by three grids: most are outside
  std::uint64_t hash;  // of the labels of all frames, as Hash has it
};

/// Every method in both metrics, with and without periodic axes, and the exact one in a window. The test
/// known_answers computes the hashes anew: by brute force, or by a reference of flooding on the host.
const std::vector<KnownAnswer>& known_answers();

/// 61 x 47 pixels.
Grid known_grid(const KnownAnswer& answer);

/// Three frames of 300 seeds, some of which share a pixel, and how far one moves along an axis, at most.
std::vector<std::vector<Point>> known_frames(const KnownAnswer& answer);
constexpr int known_displacement = 2;

/// "djfa, manhattan, periodic".
std::string to_string(const KnownAnswer& answer);

/// The hash of the labels that a device makes. Waits. Throws as the method.
std::uint64_t hash_on(const Device& device, const KnownAnswer& answer);

}  // namespace vorocl::command
