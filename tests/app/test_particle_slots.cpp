// Which seed stands for which particle: slots that stay, and are given away again.
#define BOOST_TEST_MODULE particle_slots
#include <boost/test/unit_test.hpp>

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
