// What a Seeds object holds.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/seeds_frame.hpp"
#include "runtime/buffer.hpp"
#include "runtime/internal.hpp"
#include "runtime/kernel.hpp"

namespace vorocl {

/// The position of a seed that is absent, or outside the grid: EMPTY of position.cl.
constexpr std::uint32_t absent_position = 0x80008000u;

/// The position of a seed in a pixel.
inline std::uint32_t pack(int x, int y) {
  return static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x);
}

/// Where the host has placed seeds.
struct Placement {
  std::vector<std::uint32_t> packed;  // by id; absent_position if absent or outside the grid
  std::vector<PlanePosition>
      in_the_plane;  // by id; none if all seeds lie in the pixels of a plane that has no period
};

struct SeedsState {
  SeedsState(const Device& device, const Grid& grid);

  Device device;
  Grid grid;
  cl::Buffer positions;       // of the present frame
  std::vector<bool> present;  // by id, as far as the host knows
  KernelSet kernels;

  std::size_t size() const { return present.size(); }

  /// The present frame.
  const std::shared_ptr<const SeedsFrame>& frame() const { return frame_; }

  /// Makes the next frame of seeds that the host has placed.
  void place(Placement&& placement, const std::optional<Domain>& domain = std::nullopt);

  /// Makes the next frame from the caller's buffers. `marks` may be null.
  void place(const cl::Buffer& points, std::size_t count, const cl::Buffer& marks);

  /// Makes the next frame, of seeds that a kernel places: room for so many, all present.
  void place_on_device(std::size_t count);

  /// Makes the next frame: the same seeds, which a kernel has moved.
  void moved();

  /// Takes the frame and the positions of another object, on the device.
  void copy_from(const SeedsState& other);

 private:
  /// The next frame of so many seeds, still without what is known of their points.
  SeedsFrame next_frame(std::size_t size, bool vanished) const;

  /// Makes room for the positions of the next frame. The present ones are not touched: if the move fails,
  /// they stay.
  const cl::Buffer& next_positions(std::size_t count);

  /// The next frame becomes the present one, with the positions in next_positions().
  void commit(std::shared_ptr<const SeedsFrame> frame, std::vector<bool> there) noexcept;

  /// A check that no frame remembers any more: a loop over frames makes two or three in all.
  std::shared_ptr<PointCheck> unused_check();

  std::shared_ptr<const SeedsFrame> frame_;
  cl::Buffer spare_;                                 // where the next positions go
  Upload<std::uint32_t> upload_;                     // of positions that the host has placed
  std::vector<std::shared_ptr<PointCheck>> checks_;  // those of frames that are remembered, and unused ones
};

}  // namespace vorocl
