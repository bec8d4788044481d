#include "app/sources/particle_slots.hpp"

#include <utility>

namespace vorocl::command {

void ParticleSlots::update(const std::vector<std::uint32_t>& ids) {
  std::unordered_map<std::uint32_t, std::uint32_t> before = std::move(slots_);
  slots_.clear();
  slots_.reserve(ids.size());
  of_ids_.clear();
  for (const std::uint32_t id : ids) {
    std::uint32_t slot = 0;
    if (const auto found = before.find(id); found != before.end()) {
      slot = found->second;
      before.erase(found);
    } else if (!free_.empty()) {
      slot = *free_.begin();
      free_.erase(free_.begin());
    } else {
      slot = static_cast<std::uint32_t>(size_++);
    }
    slots_.emplace(id, slot);
    of_ids_.push_back(slot);
  }
  for (const auto& vanished : before) free_.insert(vanished.second);
}

}  // namespace vorocl::command
