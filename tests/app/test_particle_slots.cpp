// Which seed stands for which particle: slots that stay, and are given away again.
#define BOOST_TEST_MODULE particle_slots
#include <boost/test/unit_test.hpp>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "app/sources/particles.hpp"

using namespace vorocl::command;

BOOST_AUTO_TEST_CASE(slots_stay_and_are_given_away_after_a_frame) {
  ParticleSlots slots;
  const auto update = [&](const std::vector<std::uint32_t>& ids) {
    slots.update(ids);
    return slots.of_ids();
  };
  using Slots = std::vector<std::uint32_t>;
  BOOST_TEST(update({10, 20, 30}) == (Slots{0, 1, 2}));
  BOOST_TEST(update({10, 30, 40}) == (Slots{0, 2, 3}));  // slot 1 is still in the labels
  BOOST_TEST(update({10, 30, 40, 50}) == (Slots{0, 2, 3, 1}));
  BOOST_TEST(update({20, 40}) == (Slots{4, 3}));
  BOOST_TEST(update({20, 30, 40, 60}) == (Slots{4, 0, 3, 1}));
  for (std::uint32_t id = 100; id < 1000; id += 2) update({id, id + 1});
  BOOST_TEST(slots.size() <= 6u);
}

BOOST_AUTO_TEST_CASE(any_ids_have_the_slots_that_the_words_say) {
  std::mt19937 bits(1);
  ParticleSlots slots;
  std::map<std::uint32_t, std::uint32_t> taken;
  std::set<std::uint32_t> emptied;  // in a frame before
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < 60; ++id) {
      if (bits() % 4 != 0) ids.push_back(id * 1000);
    }
    slots.update(ids);
    const std::map<std::uint32_t, std::uint32_t> before = std::exchange(taken, {});
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const std::uint32_t slot = slots.of_ids().at(i);
      BOOST_REQUIRE(slot < slots.size());
      BOOST_REQUIRE(used.insert(slot).second);
      taken.emplace(ids[i], slot);
      if (const auto found = before.find(ids[i]); found != before.end()) {
        BOOST_REQUIRE(slot == found->second);
      } else {
        for (const auto& other : before) BOOST_REQUIRE(slot != other.second);
        if (!emptied.empty()) BOOST_REQUIRE(slot == *emptied.begin());
        emptied.erase(slot);
      }
    }
    for (const auto& [id, slot] : before) {
      if (taken.count(id) == 0) emptied.insert(slot);
    }
  }
}
