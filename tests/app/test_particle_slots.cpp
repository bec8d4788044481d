// Which seed stands for which particle: slots that stay, and are given away again.
#define BOOST_TEST_MODULE particle_slots
#include <boost/test/unit_test.hpp>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "app/sources/particles.hpp"

using namespace vorocl::command;
using vorocl::Point;

namespace {

/// Places that follow each other in the plane.
std::vector<Point> in_a_row(std::size_t count) {
  std::vector<Point> places;
  while (places.size() < count) places.push_back({static_cast<double>(places.size()), 0});
  return places;
}

}  // namespace

BOOST_AUTO_TEST_CASE(slots_stay_and_are_given_away_after_a_frame) {
  ParticleSlots slots;
  const auto update = [&](const std::vector<std::uint32_t>& ids) {
    slots.update(ids, in_a_row(ids.size()));
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

BOOST_AUTO_TEST_CASE(newcomers_have_slots_in_the_order_of_the_plane) {
  using Slots = std::vector<std::uint32_t>;
  ParticleSlots slots;
  slots.update({10, 20, 30, 40}, {{7, 40}, {5, 3}, {4, 15.5}, {4, 16}});
  BOOST_TEST(slots.of_ids() == (Slots{3, 1, 0, 2}));
  slots.update({10, 15, 25, 40}, {{0, 0}, {90, 20}, {80, 20}, {1, 0}});  // two stay, and two are new
  BOOST_TEST(slots.of_ids() == (Slots{3, 5, 4, 2}));
  slots.update({10, 15, 25, 35, 40, 45}, {{0, 0}, {0, 0}, {0, 0}, {2, 2}, {0, 0}, {-2, -2}});
  BOOST_TEST(slots.of_ids() == (Slots{3, 5, 4, 1, 2, 0}));  // at one place by id
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
    slots.update(ids, in_a_row(ids.size()));
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
