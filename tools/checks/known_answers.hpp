// Small diagrams whose labels are known: what a device and its driver must get right before anything else
// counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// Where seeds are. Each scene is there for kernels, or branches of them, that the others do not reach.
enum class Scene {
  scattered,    // 300 on 61 x 47 pixels, three frames
  window,       // 300 that fill a plane of three by three such grids: most are outside
  ring,         // in the middle of it all seeds are as near
  blocks,       // full ones: nearly all seeds are hidden by others
  few,          // far apart: most bins are empty
  long_period,  // of more than 16,000 pixels
  full_size,    // 16,384 on 2048 x 2048 pixels, two frames
  points,       // 300 between the centres of 61 x 47 pixels, three frames
  volume,       // 900 between the centres of 61 x 47 x 21 voxels, three frames; half of them close together
  mask,         // the pixels of `ring`, as those of a mask
};

/// The diagrams of known_frames(), made one after the other by a method with its default options.
struct KnownAnswer {
  std::string method;
  Metric metric;
  Axes periodic;
  Scene scene;
  std::uint64_t hash;  // of the labels of all frames, as Hash has it
};

/// Every method in both metrics, with and without periodic axes; the exact one in all scenes but that of full
/// size, which is for jfa and djfa. Volumes and masks are Euclidean. The test known_answers computes the
/// hashes anew: by brute force or a k-d tree, or by a reference of flooding on the host.
const std::vector<KnownAnswer>& known_answers();

Grid known_grid(const KnownAnswer& answer);

/// The frames of the scene, in some of which seeds share a pixel, and how far one moves along an axis, at
/// most. Points are whole numbers of 1/4096 pixel.
std::vector<std::vector<Point>> known_frames(const KnownAnswer& answer);
constexpr int known_displacement = 2;

/// "djfa, manhattan, periodic".
std::string to_string(const KnownAnswer& answer);

/// Makes them on a device, and names those that it gets wrong, with the reason where it makes none: all, or
/// the one of this name.
std::vector<std::string> wrong_answers(const Device& device, const std::string& only = "");

}  // namespace vorocl::command
