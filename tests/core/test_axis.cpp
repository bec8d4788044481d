// The map from data units to pixels, against integers.
#define BOOST_TEST_MODULE axis
#include <cmath>
#include <limits>
#include <random>

#include "fixture.hpp"

using namespace vorocl;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

std::int64_t floor_of(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t quotient = numerator / denominator;
  return quotient - (numerator % denominator < 0 ? 1 : 0);
}

/// An axis whose ends are whole units of data, in which the oracle computes.
struct WholeAxis {
  std::int64_t pixels, from, to;
  bool periodic = false, reversed = false, closed = false;

  Axis axis() const {
    Axis made(pixels, static_cast<double>(from), static_cast<double>(to));
    if (periodic) made = made.periodic();
    if (reversed) made = made.reversed();
    if (closed) made = made.closed();
    return made;
  }

  std::int64_t brought_in(std::int64_t at) const {
    return periodic ? at - floor_of(at - from, to - from) * (to - from) : at;
  }

  std::int64_t pixel(std::int64_t at) const {
    std::int64_t found = floor_of((brought_in(at) - from) * pixels, to - from);
    if (closed && !periodic && at == to) found = pixels - 1;
    return reversed ? pixels - 1 - found : found;
  }
};

WholeAxis random_axis(std::mt19937& rng) {
  const auto below = [&](unsigned end) { return static_cast<std::int64_t>(rng() % end); };
  const std::int64_t from = below(100) - 50;
  return {1 + below(300), from, from + 1 + below(140), rng() % 2 == 0, rng() % 2 == 0, rng() % 2 == 0};
}

}  // namespace

BOOST_AUTO_TEST_CASE(pixels_are_those_of_integers) {
  std::mt19937 rng(3);
  for (int number = 0; number < 2000; ++number) {
    const WholeAxis whole = random_axis(rng);
    const Axis axis = whole.axis();
    BOOST_TEST_CONTEXT(whole.pixels << " pixels from " << whole.from << " to " << whole.to << ", "
                                    << whole.periodic << whole.reversed << whole.closed) {
      for (int i = 0; i < 40; ++i) {
        const std::int64_t at = i == 0   ? whole.from
                                : i == 1 ? whole.to
                                         : static_cast<std::int64_t>(rng() % 1000u) - 500;
        const auto coordinate = static_cast<double>(at);
        BOOST_TEST(axis.pixel(coordinate) == static_cast<double>(whole.pixel(at)));
        BOOST_TEST(axis.covers(coordinate) == (whole.periodic || (at >= whole.from && at <= whole.to)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(positions_are_rounded_once_and_stay_in_their_pixels) {
  std::mt19937 rng(5);
  for (int number = 0; number < 2000; ++number) {
    const WholeAxis whole = random_axis(rng);
    const Axis axis = whole.axis();
    const std::int64_t length = whole.to - whole.from;
    BOOST_TEST_CONTEXT(whole.pixels << " pixels from " << whole.from << " to " << whole.to << ", "
                                    << whole.periodic << whole.reversed << whole.closed) {
      for (int i = 0; i < 20; ++i) {
        const std::int64_t at = whole.from - 200 + static_cast<std::int64_t>(rng() % 400);
        const auto coordinate = static_cast<double>(at);
        // In units of 1 / length of a pixel.
        const std::int64_t along = (whole.brought_in(at) - whole.from) * whole.pixels;
        const std::int64_t position = whole.reversed ? whole.pixels * length - along : along;
        BOOST_TEST(std::abs(axis.position(coordinate) -
                            static_cast<double>(position) / static_cast<double>(length)) < 1e-9);
        const double parts = 4096 * axis.rounded_position(coordinate);
        BOOST_TEST(parts == std::floor(parts));
        BOOST_TEST(std::floor(parts / 4096) == axis.pixel(coordinate));
        // By half a part, or a whole one at a pixel's end, which is the next pixel's.
        const std::int64_t excess = std::abs(static_cast<std::int64_t>(parts) * length - 4096 * position);
        const bool is_last = static_cast<std::int64_t>(parts) - 4096 * whole.pixel(at) == 4095;
        BOOST_TEST((is_last ? excess : 2 * excess) <= length);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(pixels_are_units_unless_it_is_said_otherwise) {
  const Axis plain(10), periodic = Axis(10).periodic();
  BOOST_TEST(plain.from() == 0);
  BOOST_TEST(plain.to() == 10);
  BOOST_TEST(!plain.is_periodic());
  BOOST_TEST(!plain.is_reversed());
  for (int tenths = -250; tenths < 250; ++tenths) {
    const double pixel = static_cast<double>(floor_of(tenths, 10));
    BOOST_TEST(plain.pixel(tenths / 10.0) == pixel);
    BOOST_TEST(plain.reversed().pixel(tenths / 10.0) == 9 - pixel);
    const std::int64_t in_period = (tenths + 500) % 100;
    BOOST_TEST(periodic.pixel(tenths / 10.0) == static_cast<double>(in_period / 10));
    const double position = tenths / 10.0;
    BOOST_TEST(plain.position(position) == position);
    BOOST_TEST(plain.closed().position(position) == position);
    BOOST_TEST(plain.reversed().position(position) == 10 - position);
    BOOST_TEST(std::abs(periodic.position(position) - static_cast<double>(in_period) / 10) < 1e-12);
    BOOST_TEST(std::abs(periodic.reversed().position(position) - 10 + static_cast<double>(in_period) / 10) <
               1e-12);
  }
  BOOST_TEST(plain.closed().pixel(10) == 9);
  BOOST_TEST(plain.closed().pixel(std::nextafter(10.0, 11.0)) == 10);
  BOOST_TEST(plain.closed().reversed().pixel(10) == 0);
  for (const Axis& axis : {plain, periodic, plain.reversed()}) BOOST_TEST(std::isnan(axis.position(NAN)));
  BOOST_TEST((plain.position(INFINITY) == INFINITY && plain.reversed().position(INFINITY) == -INFINITY));
  BOOST_TEST(plain.coordinate(2.5) == 2.5);
  BOOST_TEST(plain.reversed().coordinate(2.5) == 7.5);
}

BOOST_AUTO_TEST_CASE(pixels_have_coordinates) {
  std::mt19937 rng(4);
  for (int number = 0; number < 2000; ++number) {
    const WholeAxis whole = random_axis(rng);
    const Axis axis = whole.axis();
    const double step = static_cast<double>(whole.to - whole.from) / static_cast<double>(whole.pixels);
    for (std::int64_t pixel = 0; pixel < whole.pixels; ++pixel) {
      const double centre = static_cast<double>(pixel) + 0.5;
      const double along = whole.reversed ? static_cast<double>(whole.pixels) - centre : centre;
      const double coordinate = axis.coordinate(centre);
      BOOST_REQUIRE(std::abs(coordinate - (static_cast<double>(whole.from) + along * step)) < 1e-11);
      BOOST_REQUIRE(axis.pixel(coordinate) == static_cast<double>(pixel));
    }
  }
}

BOOST_AUTO_TEST_CASE(one_coordinate_has_the_middle_pixel) {
  for (const std::int64_t pixels : {1, 2, 9}) {
    const Axis axis(pixels, 3, 3);
    const auto middle = static_cast<double>(pixels / 2), last = static_cast<double>(pixels - 1);
    BOOST_TEST(axis.pixel(3) == middle);
    BOOST_TEST(axis.closed().pixel(3) == middle);
    BOOST_TEST(axis.reversed().pixel(3) == last - middle);
    BOOST_TEST(axis.pixel(2.999) < 0);
    BOOST_TEST(axis.pixel(3.001) > last);
    BOOST_TEST(axis.covers(3));
    BOOST_TEST(!axis.covers(3.001));
  }
}

BOOST_AUTO_TEST_CASE(rounding_at_the_ends) {
  BOOST_TEST(Axis(1440, 0, 360).closed().pixel(std::nextafter(360.0, 0.0)) == 1439);
  BOOST_TEST(Axis(10, -2, -1).closed().pixel(-1.5) == 5);
  // 5.1 * 100 is a little less than 510, and 5.1 / 10 * 100 is 51: the order of operations matters.
  BOOST_TEST(Axis(100, 0, 10).pixel(5.1) == 50);
  const Axis round_the_world = Axis(360, -180, 180).periodic();
  BOOST_TEST(round_the_world.pixel(180) == 0);  // the period begins again
  BOOST_TEST(round_the_world.closed().pixel(180) == 0);
  BOOST_TEST(round_the_world.pixel(std::nextafter(-180.0, -181.0)) == 359);
  BOOST_TEST(round_the_world.reversed().pixel(180) == 359);
  const Axis unit = Axis(7).periodic();
  BOOST_TEST(unit.pixel(-std::numeric_limits<double>::min()) == 6);
  for (const double far : {1e15, 1e300, -1e300}) {
    for (const Axis& axis : {round_the_world, unit}) {
      BOOST_TEST(axis.pixel(far) >= 0);
      BOOST_TEST(axis.pixel(far) < static_cast<double>(axis.pixels()));
      BOOST_TEST(axis.covers(far));
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_has_no_pixel) {
  for (const Axis& axis : {Axis(7), Axis(7).periodic(), Axis(7).reversed(), Axis(7).closed(), Axis(7, -1, 1),
                           Axis(7, -1, 1).periodic(), Axis(7, 2, 2)}) {
    for (const double bad : {not_a_number, infinity, -infinity}) {
      BOOST_TEST(!std::isfinite(axis.pixel(bad)));
      BOOST_TEST(!axis.covers(bad));
    }
  }
}

BOOST_AUTO_TEST_CASE(axes_know_themselves) {
  const Axis axis(20, -1, 4);
  BOOST_TEST(axis.pixels() == 20);
  BOOST_TEST(axis.from() == -1);
  BOOST_TEST(axis.to() == 4);
  BOOST_TEST((axis == Axis(20, -1, 4)));
  BOOST_TEST((axis.reversed().reversed() == axis));
  for (const Axis& other : {Axis(21, -1, 4), Axis(20, -1, 5), Axis(20, 0, 4), axis.periodic(),
                            axis.reversed(), axis.closed(), Axis(20)}) {
    BOOST_TEST((other != axis));
  }
  BOOST_TEST(axis.periodic().reversed().is_periodic());
  BOOST_TEST(axis.reversed().periodic().is_reversed());
}

BOOST_AUTO_TEST_CASE(axes_without_a_scale_are_refused) {
  check_error([] { Axis(9, 0, not_a_number); }, {"from 0 to nan", "begin before it ends"});
  check_error([] { Axis(9, 1, 0); }, {"from 1 to 0", "begin before it ends"});
  check_error([] { Axis(9, -infinity, 0); }, {"from -inf to 0", "too long"});
  check_error([] { Axis(9, 0, 1e308); }, {"from 0 to 1e+308", "too long"});
  check_error([] { Axis(9, 0, 1e-320); }, {"too short"});
  check_error([] { Axis(9, 1, 1).periodic(); }, {"from 1 to 1", "no extent", "repeat"});
  check_error([] { Axis(0); }, {"0 pixels", "from 1 to 2147483647"});
  check_error([] { Axis(-1, 0, 1); }, {"-1 pixels"});
  check_error([] { Axis(2147483648, 0, 1); }, {"2147483648 pixels", "from 1 to 2147483647"});
  BOOST_TEST(Axis(2147483647).pixels() == Axis::max_pixels);
}
