// Grids: their limits.
#define BOOST_TEST_MODULE grid
#include "fixture.hpp"

using namespace vorocl;

BOOST_AUTO_TEST_CASE(limits) {
  BOOST_TEST(Grid(32768, 32768).pixels() == std::size_t{1} << 30);
  BOOST_TEST(Grid(3, 7).longest_side() == 7);
  BOOST_TEST(Grid(32000, 1, Periodic::x).width() == 32000);
  check_error([] { Grid(32001, 1, Periodic::x); }, {"width is 32001", "32000"});
  check_error([] { Grid(0, 5); }, {"width is 0", "32768"});
  check_error([] { Grid(5, -1); }, {"height is -1", "32768"});
  check_error([] { Grid(32769, 1); }, {"width is 32769"});
  check_error([] { Grid(1, 1LL << 40); }, {"height is 1099511627776"});
}
