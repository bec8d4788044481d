// Which seed stands for which particle of a trajectory.
#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

namespace vorocl::command {

/// A seed's number must stay small and stay the same from frame to frame; a particle's id may be any, vanish
/// and come back. So each particle has a slot, the number of its seed, as long as it is there. A slot that
/// one frame has seen empty is given away again: no label names it any more, and the number of slots does not
/// grow with that of the frames.
class ParticleSlots {
 public:
  /// Goes on to a frame with these ids (each once). Newcomers get the lowest slots that are free.
  void update(const std::vector<std::uint32_t>& ids);

  /// The slots of the ids of the last update, in their order.
  const std::vector<std::uint32_t>& of_ids() const { return of_ids_; }

  /// The number of slots, those that are empty included.
  std::size_t size() const { return size_; }

 private:
  std::unordered_map<std::uint32_t, std::uint32_t> slots_;  // by id, of the particles that are there
  std::vector<std::uint32_t> of_ids_;
  std::set<std::uint32_t> free_;
  std::size_t size_ = 0;
};

}  // namespace vorocl::command
