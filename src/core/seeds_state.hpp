// What a Seeds object holds.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "core/seeds_frame.hpp"
#include "runtime/buffer.hpp"
#include "runtime/internal.hpp"
#include "runtime/kernel.hpp"

namespace vorocl {

/// Whether a frame still has what a pool shares with it. Another thread may have let go of it last.
template <typename T>
bool is_used(const std::shared_ptr<T>& shared) {
  if (shared.use_count() > 1) return true;
  std::atomic_thread_fence(std::memory_order_acquire);
  return false;
}

/// Lists that frames share: a loop over frames makes two or three in all, so that their memory is not taken
/// from the system anew each time.
template <typename T>
class Recycled {
 public:
  /// A list that no frame uses, with what it held.
  std::shared_ptr<std::vector<T>> take() {
    for (const std::shared_ptr<std::vector<T>>& list : lists_) {
      if (!is_used(list)) return list;
    }
    lists_.push_back(std::make_shared<std::vector<T>>());
    return lists_.back();
  }

 private:
  std::vector<std::shared_ptr<std::vector<T>>> lists_;
};

/// The same of buffers.
class Rooms {
 public:
  /// One of so many bytes, or more.
  std::shared_ptr<cl::Buffer> take(const Device& device, std::size_t bytes);

 private:
  std::vector<std::shared_ptr<cl::Buffer>> rooms_;
};

struct SeedsState {
  SeedsState(const Device& device, const Grid& grid, const SeedsOptions& options);

  Device device;
  SeedsOptions options;
  std::vector<bool> present;  // by id, as far as the host knows
  KernelSet kernels;

  const Grid& grid() const { return frame_->grid; }
  std::size_t size() const { return present.size(); }

  /// The present frame.
  const std::shared_ptr<const SeedsFrame>& frame() const { return frame_; }

  /// Makes the next frame of points on the host.
  void place(const Grid& grid, const Points& points);

  /// Makes the next frame of points in the caller's buffers.
  void place(const PointBuffer& points);

  /// Makes the next frame of seeds at these places, in the grid's periods. `are_points`: else in the middle
  /// of pixels.
  void place(const Grid& grid, std::shared_ptr<const std::vector<Place>> places, bool are_points);

  /// An empty list, with the memory of one that no frame remembers any more.
  std::shared_ptr<std::vector<Place>> list_of_places() {
    std::shared_ptr<std::vector<Place>> list = places_.take();
    list->clear();
    return list;
  }

  /// Makes the next frame, of so many seeds that a kernel places: all present.
  void place_on_device(std::size_t count, std::shared_ptr<const cl::Buffer> positions);

  /// Makes the next frame, of a seed for each of these marks.
  void place_marks(std::shared_ptr<Marks> marks);

  /// Room for the positions of so many seeds, and one more, that no frame uses.
  std::shared_ptr<cl::Buffer> room_for_positions(std::size_t count);

  /// The positions in a diagram of the whole grid, copied to where a kernel may move them. Throws Error if
  /// seeds lie outside the grid, for something ("random motion") that does not know them.
  std::shared_ptr<cl::Buffer> copy_to_move(const char* what);

  /// Makes the next frame: the same seeds, which a kernel has moved by at most `way` pixels along an axis.
  void moved(const std::shared_ptr<cl::Buffer>& positions, double way);

  /// Takes the frame of another object.
  void copy_from(const SeedsState& other);

 private:
  /// The next frame of so many seeds, still without what is known of their points.
  SeedsFrame next_frame(const Grid& grid, std::size_t size, bool lost) const;

  /// Notes how far the seeds went to the next frame, or that only the device knows.
  void find_way_to(SeedsFrame& next) const;

  /// The next frame becomes the present one.
  void commit(std::shared_ptr<const SeedsFrame> frame, std::vector<bool> there) noexcept;

  /// A check that no frame remembers any more: a loop over frames makes two or three in all.
  std::shared_ptr<PointCheck> unused_check();

  /// Gives the next frame places that the host has found, or positions in a diagram of all of its grid.
  void list_places(SeedsFrame& next, std::shared_ptr<const std::vector<Place>> places);
  void upload_positions(SeedsFrame& next, std::vector<std::uint32_t>&& packed);

  /// Enqueues a kernel that places the seeds of the next frame. All lie in its grid.
  cl::Event place_by_kernel(SeedsFrame& next, const PointsThere& points, const Absence& absence,
                            const cl::Buffer& found);

  std::shared_ptr<const SeedsFrame> frame_;
  Recycled<double> numbers_;
  Recycled<Place> places_;
  Upload<double> upload_of_points_;  // for kernels that place them
  Upload<std::uint32_t> upload_;     // of positions that the host has placed
  Rooms rooms_of_points_, rooms_of_positions_, rooms_of_places_;
  std::vector<std::shared_ptr<PointCheck>> checks_;
  cl::Buffer found_;  // of points that the host has checked, which nobody reads
};

}  // namespace vorocl
