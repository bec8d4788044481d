// Distance transforms of images: nearest marks and distances against each pixel's comparison with every mark
// in whole numbers on the host, ties included.
#define BOOST_TEST_MODULE distance_transform
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <new>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "list_length.hpp"
#include "masks/items.hpp"
#include "masks/mask_engine.hpp"
#include "vorocl/distance_transform.hpp"

using namespace vorocl;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Sides = std::array<int, 3>;
using Periods = std::array<bool, 3>;

const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

struct Shape3 {
  Sides sides;
  Periods periods = {false, false, false};
  std::array<std::int64_t, 3> spacing = {1, 1, 1};
  double unit = 1;

  std::size_t pixels() const {
    std::size_t count = 1;
    for (const int side : sides) count *= static_cast<std::size_t>(side);
    return count;
  }
  Grid grid() const {
    const auto axis = [&](std::size_t i) { return periods[i] ? Axis(sides[i]).periodic() : Axis(sides[i]); };
    return Grid(axis(0), axis(1), axis(2));
  }
  PixelSize size() const {
    const auto length = [&](std::size_t i) { return static_cast<double>(spacing[i]) * unit; };
    return {length(0), length(1), length(2)};
  }
  Sides at(std::size_t place) const {
    const auto i = static_cast<int>(place);
    return {i % sides[0], i / sides[0] % sides[1], i / sides[0] / sides[1]};
  }
  std::int64_t square(std::size_t a, std::size_t b) const {
    const Sides from = at(a), to = at(b);
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      std::int64_t way = std::abs(from[i] - to[i]);
      if (periods[i]) way = std::min(way, sides[i] - way);
      sum += way * way * spacing[i] * spacing[i];
    }
    return sum;
  }
};

std::ostream& operator<<(std::ostream& out, const Shape3& shape) {
  out << shape.sides[0] << 'x' << shape.sides[1] << 'x' << shape.sides[2] << " periodic " << shape.periods[0]
      << shape.periods[1] << shape.periods[2] << " sizes";
  for (const std::int64_t length : shape.spacing) out << ' ' << static_cast<double>(length) * shape.unit;
  return out;
}

/// Memory that begins with a line of a cache.
template <typename T>
struct Lines {
  using value_type = T;
  Lines() = default;
  template <typename Other>
  Lines(const Lines<Other>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(operator new(count * sizeof(T), line)); }
  void deallocate(T* memory, std::size_t) { operator delete(memory, line); }
  friend bool operator==(const Lines&, const Lines&) { return true; }
  friend bool operator!=(const Lines&, const Lines&) { return false; }

 private:
  static constexpr std::align_val_t line{128};
};

/// All that a transform writes.
struct Results {
  explicit Results(std::size_t pixels, std::size_t axes)
      : doubles(pixels),
        floats(pixels),
        indices(axes * pixels),
        places(pixels),
        ranks(pixels),
        values(pixels) {}

  std::vector<double, Lines<double>> doubles;
  std::vector<float, Lines<float>> floats;
  std::vector<std::uint32_t, Lines<std::uint32_t>> indices, places, ranks;
  Bytes values;
};

Results run(const Shape3& shape, const Bytes& image, const TransformOptions& options = {},
            const Device& device = test_device()) {
  const Grid grid = shape.grid();
  DistanceTransform transform(device, grid, shape.size());
  Results results(image.size(), grid.is_volume() ? 3 : 2);
  TransformTargets targets;
  targets.distances = {results.doubles.data(), PixelType::float64};
  targets.indices = {results.indices.data(), PixelType::uint32};
  targets.places = {results.places.data(), PixelType::uint32};
  targets.ranks = {results.ranks.data(), PixelType::uint32};
  targets.values = {results.values.data(), PixelType::uint8};
  transform.run({image.data(), PixelType::uint8}, targets, options);
  const bool any = std::any_of(image.begin(), image.end(), [&](std::uint8_t value) {
    return (value == 0) == (options.marked == Marked::zeros);
  });
  BOOST_TEST(transform.found() == any);
  TransformTargets floats;
  floats.distances = {results.floats.data(), PixelType::float32};
  transform.run({image.data(), PixelType::uint8}, floats, options);
  return results;
}

void check_against_brute_force(const Shape3& shape, const Bytes& image, const TransformOptions& options = {},
                               const Device& device = test_device()) {
  std::vector<std::size_t> marks;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if ((image[i] == 0) == (options.marked == Marked::zeros)) marks.push_back(i);
  }
  const Results got = run(shape, image, options, device);
  std::size_t wrong_marks = 0, wrong_distances = 0;
  const std::size_t axes = got.indices.size() / image.size();
  for (std::size_t i = 0; i < image.size(); ++i) {
    std::int64_t least = -1;
    std::uint32_t place = no_label, rank = no_label;
    for (std::size_t j = 0; j < marks.size(); ++j) {
      const std::int64_t square = shape.square(i, marks[j]);
      if (least >= 0 && square >= least) continue;
      least = square;
      place = static_cast<std::uint32_t>(marks[j]);
      rank = static_cast<std::uint32_t>(j);
    }
    double distance = std::sqrt(static_cast<double>(least)) * shape.unit;
    if (least < 0 || distance > options.farthest * (shape.unit == 1 ? 1 : 1 + 1e-15)) {
      place = rank = no_label;
      distance = std::numeric_limits<double>::infinity();
    }
    const bool is_none = place == no_label;
    bool same =
        got.places[i] == place && got.ranks[i] == rank && got.values[i] == (is_none ? 0 : image[place]);
    const Sides at = shape.at(is_none ? 0 : place);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto index = static_cast<std::uint32_t>(at[axes - 1 - axis]);
      same = same && got.indices[axis * image.size() + i] == (is_none ? no_label : index);
    }
    wrong_marks += same ? 0 : 1;
    // To the bit where a pixel's size is 1.
    const double within = shape.size().x == 1 && shape.unit == 1 ? 0 : 4.5e-16 * distance;
    const bool is_same = is_none
                             ? std::isinf(got.doubles[i]) && std::isinf(got.floats[i])
                             : std::abs(got.doubles[i] - distance) <= within &&
                                   std::abs(static_cast<double>(got.floats[i]) - distance) <= 2e-7 * distance;
    wrong_distances += is_same ? 0 : 1;
  }
  BOOST_TEST(wrong_marks == 0u, shape << ", " << marks.size() << " marks: " << wrong_marks << " wrong");
  BOOST_TEST(wrong_distances == 0u,
             shape << ", " << marks.size() << " marks: " << wrong_distances << " distances");
}

/// Images of one shape: none, one, all and random marks; lines, blocks, a ball and its outside, a
/// checkerboard.
std::vector<Bytes> images_of(const Shape3& shape, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::vector<Bytes> images;
  const auto add = [&](const std::function<bool(const Sides&)>& is_marked) {
    Bytes image(shape.pixels());
    for (std::size_t i = 0; i < image.size(); ++i)
      image[i] = static_cast<std::uint8_t>(is_marked(shape.at(i)) ? 0 : 1 + rng() % 3);
    images.push_back(std::move(image));
  };
  const auto random = [&](unsigned one_in) {
    return [&rng, one_in](const Sides&) { return rng() % one_in == 0; };
  };
  const auto square = [&](const Sides& at) {
    int sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (2 * at[i] - shape.sides[i]) * (2 * at[i] - shape.sides[i]);
    return sum;
  };
  const int reach = *std::max_element(shape.sides.begin(), shape.sides.end());
  add([](const Sides&) { return false; });
  add([](const Sides&) { return true; });
  add([&](const Sides& at) { return at == shape.at(shape.pixels() - 1); });
  add([&](const Sides& at) { return at == shape.at(rng() % 1 + shape.pixels() / 2); });
  for (const unsigned one_in : {2u, 8u, 60u, 600u}) add(random(one_in));
  add([](const Sides& at) { return (at[0] + at[1] + at[2]) % 2 == 0; });
  add([](const Sides& at) { return at[0] == at[1]; });
  add([&](const Sides& at) { return at[1] == shape.sides[1] / 2 && at[0] % 2 == 0; });
  add([&](const Sides& at) { return square(at) > reach * reach / 2; });
  add([&](const Sides& at) { return square(at) < reach * reach / 5; });
  add([](const Sides& at) { return at[0] / 5 % 2 == 0 && at[1] / 7 % 2 == 0 && at[2] / 3 % 2 == 0; });
  return images;
}

void check_all_images(const Shape3& shape, unsigned rng_seed = 1, const Device& device = test_device()) {
  for (const Bytes& image : images_of(shape, rng_seed)) check_against_brute_force(shape, image, {}, device);
}

/// A device whose kernels work in groups of so many items.
Device in_groups_of(std::size_t items) {
  Tuning tuning = test_device().tuning();
  tuning.shape = Shape::group;
  tuning.patch_items = items;
  return test_device().with_tuning(tuning);
}

Device in_vectors() {
  Tuning tuning = test_device().tuning();
  tuning.shape = Shape::vector;
  return test_device().with_tuning(tuning);
}

/// A device whose kernels give up comparing 16 lines together at once, as they do where these differ much.
Device lane_by_lane() { return with_lists(test_device(), ListLength::two_entries); }

}  // namespace

BOOST_AUTO_TEST_CASE(planes_and_volumes_with_sides_that_are_no_multiples_of_a_strip) {
  for (const Sides& sides :
       {Sides{1, 1, 1}, Sides{17, 1, 1}, Sides{1, 40, 1}, Sides{1, 1, 9}, Sides{16, 16, 1}, Sides{75, 41, 1},
        Sides{33, 64, 1}, Sides{1, 20, 20}, Sides{20, 1, 20}, Sides{18, 13, 11}, Sides{16, 20, 34}}) {
    check_all_images({sides});
  }
}

BOOST_AUTO_TEST_CASE(any_axes_may_be_periodic) {
  for (const Periods& periods : {Periods{true, false, false}, Periods{false, true, false},
                                 Periods{false, false, true}, Periods{true, true, true}}) {
    check_all_images({{35, 30, 1}, periods});
    check_all_images({{19, 12, 14}, periods});
    check_all_images({{4, 3, 5}, periods, {2, 1, 3}});
  }
  // Squares of ways take nearly 32 bits, and those beyond half a period more.
  const Shape3 shape = {{58, 33, 1}, {false, true, false}, {1000, 1000, 1}};
  Bytes image(shape.pixels(), 1);
  image[17 * 58] = image[31 * 58 + 17] = 0;
  check_against_brute_force(shape, image);
}

BOOST_AUTO_TEST_CASE(sizes_of_pixels_are_any) {
  check_all_images({{30, 25, 1}, {}, {16, 1, 1}});
  check_all_images({{30, 25, 1}, {}, {1, 7, 1}});
  check_all_images({{18, 13, 11}, {}, {13, 13, 40}, 0.005});  // 0.065, 0.065, 0.2
  check_all_images({{18, 13, 11}, {true, false, true}, {3, 1, 2}, 0.1});
  check_all_images({{12, 13, 11}, {}, {1000, 999, 1}});  // keys of 64 bits alone
  check_all_images({{12, 13, 11}, {false, true, true}, {1000, 999, 501}});
  const double root = std::sqrt(2.0);
  Results rounded(1200, 2);
  DistanceTransform transform(test_device(), Grid(40, 30), {1, root, 1});
  TransformTargets targets;
  targets.places = {rounded.places.data(), PixelType::uint32};
  targets.distances = {rounded.doubles.data(), PixelType::float64};
  const Bytes image = images_of({{40, 30, 1}}, 1)[7];
  transform.run({image.data(), PixelType::uint8}, targets);
  for (std::size_t i = 0; i < image.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < image.size(); ++j) {
      if (image[j] != 0) continue;
      const double dx = static_cast<double>(i % 40) - static_cast<double>(j % 40);
      const double dy = (static_cast<double>(i / 40) - static_cast<double>(j / 40)) * root;
      least = std::min(least, std::sqrt(dx * dx + dy * dy));
    }
    BOOST_TEST(std::abs(rounded.doubles[i] - least) <= 1e-6 * least);
  }
}

BOOST_AUTO_TEST_CASE(lanes_that_differ_much_are_taken_one_by_one) {
  const Device device = lane_by_lane();
  check_all_images({{35, 40, 1}}, 2, device);
  check_all_images({{20, 18, 22}}, 2, device);
  check_all_images({{20, 18, 22}, {true, true, true}, {2, 1, 3}}, 2, device);
  check_all_images({{12, 13, 11}, {false, true, false}, {1000, 999, 501}}, 2, device);
}

// Keys of 32 bits hold so much less the longer an axis is: some strips are left to those of 64.
BOOST_AUTO_TEST_CASE(long_axes_have_distances_of_any_length) {
  for (const bool periodic : {false, true}) {
    const Shape3 tall = {{17, 20000, 1}, {false, periodic, false}};
    Bytes image(tall.pixels(), 1);
    std::vector<int> rows = {9, 700, 701, 19990};
    for (const int row : rows) image[static_cast<std::size_t>(row) * 17 + 3] = 0;
    const Results got = run(tall, image);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      std::int64_t least = std::int64_t{1} << 62;
      std::size_t nearest = 0;
      for (const int row : rows) {
        const std::size_t place = static_cast<std::size_t>(row) * 17 + 3;
        const std::int64_t square = tall.square(i, place);
        if (square < least) nearest = place;
        least = std::min(least, square);
      }
      wrong += got.places[i] != nearest || got.doubles[i] != std::sqrt(static_cast<double>(least)) ? 1 : 0;
    }
    BOOST_TEST(wrong == 0u);
  }
  const Shape3 wide = {{32768, 3, 1}, {true, false, false}};
  Bytes image(wide.pixels(), 0);
  image[40000] = 1;
  const Results got = run(wide, image, {Marked::non_zeros});
  BOOST_TEST(got.doubles[40000 + 16384] == 16384);
  BOOST_TEST(got.places[0] == 40000u);
  BOOST_TEST(got.ranks[70000] == 0u);
}

// Along z strips of a row are taken together, and of long lines one by one. Some are left to keys of 64 bits.
BOOST_AUTO_TEST_CASE(volumes_have_any_number_of_strips) {
  for (const int width : {64, 75, 130}) check_all_images({{width, 9, 8}}, 3);
  check_all_images({{90, 7, 6}, {true, true, true}}, 4);
  for (const int depth : {900, 1100}) {
    const Shape3 shape = {{120, 2, depth}, {false, false, depth > 1000}, {13, 1, 1}};
    Bytes image(shape.pixels(), 1);
    for (const int x : {0, 3})
      image[static_cast<std::size_t>(depth / 2 + x) * 240 + static_cast<std::size_t>(x)] = 0;
    check_against_brute_force(shape, image);
  }
}

// Results of more than 2^22 pixels go past the caches, line by line, where rows are whole lines.
BOOST_AUTO_TEST_CASE(images_are_larger_than_caches) {
  for (const Sides& sides : {Sides{2064, 2050, 1}, Sides{2050, 2064, 1}, Sides{272, 130, 121}}) {
    const Shape3 shape = {sides};
    Bytes image(shape.pixels(), 1);
    for (const std::size_t mark : {image.size() / 3, image.size() / 2 + 777}) image[mark] = 0;
    check_against_brute_force(shape, image);
  }
}

BOOST_AUTO_TEST_CASE(groups_have_any_number_of_items) {
  for (const std::size_t items : {32, 64, 128, 256}) {
    check_all_images({{37, 150, 1}, {true, items > 64, false}, {3, 2, 1}}, 7, in_groups_of(items));
    check_all_images({{10, 9, 70}, {false, false, items > 64}, {1, 2, 3}}, 7, in_groups_of(items));
  }
}

// Between two crowds of marks that mirror each other lie hundreds of places, whose sites the items of a line
// share; and where two crowds are as near, the one that comes first counts, be it that of a later image.
BOOST_AUTO_TEST_CASE(groups_share_gaps_of_any_length) {
  std::mt19937 rng(3);
  for (const bool is_periodic : {false, true}) {
    for (const Shape3& shape : {Shape3{{20, 700, 1}, {false, is_periodic, false}},
                                Shape3{{5, 3, 402}, {false, false, is_periodic}, {2, 1, 3}}}) {
      const std::size_t axis = shape.sides[2] > 1 ? 2 : 1;
      const int size = shape.sides[axis];
      std::vector<bool> has_marks(static_cast<std::size_t>(size));
      for (int i = 100; i < 170; ++i) {
        has_marks[static_cast<std::size_t>(i)] = has_marks[static_cast<std::size_t>(size - i)] =
            rng() % 8 == 0;
      }
      Bytes image(shape.pixels());
      for (std::size_t i = 0; i < image.size(); ++i) {
        image[i] = !(has_marks[static_cast<std::size_t>(shape.at(i)[axis])] && shape.at(i)[0] % 4 == 1);
      }
      check_against_brute_force(shape, image, {}, in_groups_of(64));
    }
  }
}

// Lines of one band and of several, of 64 places each; lengths that are rounded; squared distances of 32 and
// of 64 bits.
BOOST_AUTO_TEST_CASE(groups_and_vectors_write_the_same_bits) {
  const Device groups = in_groups_of(64), vectors = in_vectors();
  const double third = 1.0 / 3;
  for (const Shape3& shape :
       {Shape3{{1, 5000, 1}}, Shape3{{5000, 1, 1}, {true, false, false}}, Shape3{{3, 3, 1000}},
        Shape3{{64, 64, 1}}, Shape3{{130, 65, 1}, {}, {2, 3, 1}, third},
        Shape3{{200, 300, 1}, {true, true, false}},
        Shape3{{40, 67, 129}, {false, true, true}, {1, 3, 2}, third},
        Shape3{{300, 400, 1}, {}, {999, 1000, 1}, 0.1},
        Shape3{{90, 5, 70}, {true, false, false}, {7, 1, 2}}}) {
    for (const Bytes& image : images_of(shape, 11)) {
      for (const double farthest : {std::numeric_limits<double>::infinity(), 5 * shape.unit}) {
        const TransformOptions options = {Marked::zeros, farthest};
        const Results a = run(shape, image, options, groups), b = run(shape, image, options, vectors);
        BOOST_TEST((a.doubles == b.doubles && a.floats == b.floats), shape);
        BOOST_TEST((a.indices == b.indices && a.places == b.places && a.ranks == b.ranks), shape);
        BOOST_TEST((a.values == b.values), shape);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_farthest_distance_takes_in_what_is_as_far) {
  const Shape3 shape = {{30, 21, 1}};
  for (const double farthest : {0.0, 0.5, 1.0, std::sqrt(13.0), 7.0}) {
    check_against_brute_force(shape, images_of(shape, 3)[6], {Marked::zeros, farthest});
    check_against_brute_force(shape, images_of(shape, 3)[6], {Marked::non_zeros, farthest});
    check_against_brute_force({{18, 13, 11}, {}, {13, 13, 40}, 0.005}, images_of({{18, 13, 11}}, 3)[6],
                              {Marked::zeros, 0.065 * farthest});
  }
}

BOOST_AUTO_TEST_CASE(values_grow_by_whole_pixels_whatever_their_lengths) {
  const std::size_t width = 70;
  const double pi = std::acos(-1.0);
  for (const PixelSize& size :
       {PixelSize{0.65, 0.65, 1}, {0.7, 2.1, 1}, {0.1, 0.3, 1}, {1, pi, 1}, {pi, 1, 1}}) {
    DistanceTransform transform(test_device(), Grid(static_cast<int>(width), 2), size);
    Bytes image(2 * width, 0), values(2 * width);
    image[0] = 9;
    TransformTargets targets;
    targets.values = {values.data(), PixelType::uint8};
    for (std::size_t pixels = 0; pixels < width; ++pixels) {
      const double farthest = static_cast<double>(pixels) * size.x;
      transform.run({image.data(), PixelType::uint8}, targets, {Marked::non_zeros, farthest});
      const auto grown = static_cast<std::size_t>(
          std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width), 9));
      BOOST_TEST(grown == pixels + 1);
    }
  }
}

/// Lengths that are no whole numbers are rounded, for comparisons, to far less than distances differ by.
BOOST_AUTO_TEST_CASE(lengths_of_any_ratio_find_the_nearest) {
  std::mt19937 random(4);
  for (const auto& [grid, size] : {std::pair{Grid(1000, 2), PixelSize{1.2246, 999.9, 1}},
                                   {Grid(3, 900), {300.1, 0.3337, 1}},
                                   {Grid(40, 9, 200), {7.77, 313.1, 0.5013}},
                                   {Grid(300, 300), {1.337, 100.3, 1}},
                                   {Grid(16385, 30), {30.01, 1.0003, 1}}}) {
    const std::size_t pixels = grid.pixels(), width = static_cast<std::size_t>(grid.width()),
                      height = static_cast<std::size_t>(grid.height());
    Bytes image(pixels, 1);
    for (int zeros = 0; zeros < 12; ++zeros) image[random() % pixels] = 0;
    std::vector<double> distances(pixels);
    DistanceTransform transform(test_device(), grid, size);
    TransformTargets targets;
    targets.distances = {distances.data(), PixelType::float64};
    transform.run({image.data(), PixelType::uint8}, targets, {Marked::zeros});
    const auto place_of = [&](std::size_t i) {
      return Point{double(i % width) * size.x, double(i / width % height) * size.y,
                   double(i / width / height) * size.z};
    };
    std::vector<Point> zeros;
    for (std::size_t i = 0; i < pixels; ++i) {
      if (image[i] == 0) zeros.push_back(place_of(i));
    }
    double worst = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const Point p = place_of(i);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Point& zero : zeros)
        nearest = std::min(nearest, std::hypot(zero.x - p.x, zero.y - p.y, zero.z - p.z));
      worst = std::max(worst, nearest == 0 ? distances[i] : distances[i] / nearest - 1);
    }
    double most = 64;  // pixels of the longest side, or the next power of two
    while (most < double(std::max({grid.width(), grid.height(), grid.depth()}))) most *= 2;
    const Point last = place_of(pixels - 1);
    const double least = std::min({size.x, size.y, size.z}), longest = std::hypot(last.x, last.y, last.z);
    BOOST_TEST(worst < most * longest * longest / (least * least) * 0x1p-62 + 1e-14);
  }
  // Where that would be more than 1 %.
  check_error(
      [] {
        DistanceTransform(test_device(), Grid(32768, 300), {999.9, 1.0003, 1});
      },
      {"1.0003 and 999.9", "too far apart", "32768 x 300"});
}

/// Behind the end of a short row of long pixels no mark is near enough for keys of 32 bits, and what a lane
/// there finds is read: here where memory holds anything.
BOOST_AUTO_TEST_CASE(lanes_behind_a_row_find_marks_too) {
  std::mt19937 random(3);
  for (int i = 0; i < 400; ++i) {
    // It is left in memory that is used again.
    const std::vector<std::uint32_t> anything(10000 + 500 * static_cast<std::size_t>(i % 100), 0xffff1647);
    std::vector<std::vector<std::uint32_t>>(50, anything);
    const Grid grid(1 + i % 4, 10, 30);
    DistanceTransform transform(test_device(), grid, {10, 0.065, 1});
    std::vector<std::int64_t> image(grid.pixels()), values(grid.pixels());
    for (auto& pixel : image) pixel = random() % 20 == 0 ? 7 : 0;
    TransformTargets targets;
    targets.values = {values.data(), PixelType::uint64};
    transform.run({image.data(), PixelType::uint64}, targets, {Marked::non_zeros});
    BOOST_TEST(std::count(values.begin(), values.end(), 7) == static_cast<std::ptrdiff_t>(values.size()));
  }
}

namespace {

/// No number is no mark of an image's, but no zero either.
template <typename T>
void check_nan(PixelType type) {
  for (const int width : {1, 15, 16, 17, 40}) {
    const auto row = static_cast<std::size_t>(width);
    std::vector<T> image(3 * row, std::numeric_limits<T>::quiet_NaN());
    image[row] = -std::numeric_limits<T>::infinity();
    std::vector<std::uint32_t> ranks(3 * row);
    TransformTargets targets;
    targets.ranks = {ranks.data(), PixelType::uint32};
    DistanceTransform transform(test_device(), Grid(width, 3));
    transform.run({image.data(), type}, targets, {Marked::non_zeros});
    BOOST_TEST(static_cast<std::size_t>(std::count(ranks.begin(), ranks.end(), 0u)) == ranks.size());
    transform.run({image.data(), type}, targets, {Marked::zeros});
    BOOST_TEST(!transform.found());
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_number_is_no_data) {
  check_nan<float>(PixelType::float32);
  check_nan<double>(PixelType::float64);
}

namespace {

template <typename T>
void check_type(PixelType type, T zero, T other) {
  const Shape3 shape = {{37, 19, 1}};
  const Bytes bytes = images_of(shape, 4)[6];
  const Results expected = run(shape, bytes);
  std::vector<T> image(bytes.size()), values(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) image[i] = bytes[i] == 0 ? zero : other;
  std::vector<std::uint32_t, Lines<std::uint32_t>> places(bytes.size());
  TransformTargets targets;
  targets.places = {places.data(), PixelType::uint32};
  targets.values = {values.data(), type};
  DistanceTransform transform(test_device(), shape.grid());
  transform.run({image.data(), type}, targets);
  BOOST_TEST((places == expected.places));
  BOOST_TEST(std::all_of(values.begin(), values.end(), [&](T value) { return value == zero; }));
  transform.run({image.data(), type}, targets, {Marked::non_zeros});
  BOOST_TEST((places == run(shape, bytes, {Marked::non_zeros}).places));
  BOOST_TEST(std::all_of(values.begin(), values.end(), [&](T value) { return value == other; }));
}

}  // namespace

BOOST_AUTO_TEST_CASE(images_have_pixels_of_any_type) {
  check_type<std::uint8_t>(PixelType::uint8, 0, 128);
  check_type<std::uint16_t>(PixelType::uint16, 0, 0x8000);
  check_type<std::uint32_t>(PixelType::uint32, 0, 0x80000000u);
  check_type<std::uint64_t>(PixelType::uint64, 0, 0x100000000u);
  check_type<float>(PixelType::float32, -0.0F, 1e-40F);
  check_type<double>(PixelType::float64, -0.0, -1e-310);
}

// Labels grow in their own image, too.
BOOST_AUTO_TEST_CASE(images_and_targets_may_be_buffers) {
  const Shape3 shape = {{23, 17, 5}};
  const Bytes bytes = images_of(shape, 5)[6];
  std::vector<cl_uint> image(bytes.size());
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = bytes[i] == 0 ? static_cast<cl_uint>(i) + 1 : 0;
  const Results expected = run(shape, bytes);
  const auto buffer_of = [](std::vector<cl_uint> values) {
    return cl::Buffer(test_device().context(), CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                      values.size() * sizeof(cl_uint), values.data());
  };
  const cl::Buffer from = buffer_of(image), squares = buffer_of(image);
  TransformTargets targets;
  targets.values = {from, PixelType::uint32};
  targets.distances = {squares, PixelType::uint32};
  DistanceTransform transform(test_device(), shape.grid());
  const Report report = transform.run({from, PixelType::uint32}, targets, {Marked::non_zeros});
  report.event().wait();
  std::vector<cl_uint> values(image.size()), distances(image.size());
  test_device().queue().enqueueReadBuffer(from, CL_TRUE, 0, values.size() * sizeof(cl_uint), values.data());
  test_device().queue().enqueueReadBuffer(squares, CL_TRUE, 0, values.size() * sizeof(cl_uint),
                                          distances.data());
  for (std::size_t i = 0; i < image.size(); ++i) {
    BOOST_REQUIRE_EQUAL(values[i], expected.places[i] + 1);
    BOOST_REQUIRE_EQUAL(distances[i], shape.square(i, expected.places[i]));
  }
}

BOOST_AUTO_TEST_CASE(bad_arguments_are_named) {
  const Device& device = test_device();
  std::vector<double> doubles(12);
  Bytes image(12);
  DistanceTransform transform(device, Grid(4, 3));
  TransformTargets targets;
  const auto run_it = [&](const TransformTargets& to, const TransformOptions& options = {}) {
    return [&transform, &image, to, options] {
      transform.run({image.data(), PixelType::uint8}, to, options);
    };
  };
  check_error(run_it(targets), {"no target is wanted"});
  targets.values = {doubles.data(), PixelType::float64};
  check_error(run_it(targets), {"the image of values", "type"});
  targets = {};
  targets.distances = {doubles.data(), PixelType::uint16};
  check_error(run_it(targets), {"the image of distances", "type"});
  targets.distances = {doubles.data(), PixelType::float64};
  check_error(run_it(targets, {Marked::zeros, -1}), {"farthest"});
  check_error(run_it(targets, {Marked::zeros, std::nan("")}), {"farthest"});
  check_error(
      [&] {
        transform.run({static_cast<void*>(nullptr), PixelType::uint8}, targets);
      },
      {"the image is null"});
  check_error(
      [&] {
        DistanceTransform(device, Grid(4, 3), {0.065, 1, 1}).run({image.data(), PixelType::uint8}, [] {
          TransformTargets squares;
          static std::vector<std::uint32_t> values(12);
          squares.distances = {values.data(), PixelType::uint32};
          return squares;
        }());
      },
      {"whole numbers"});
  check_error([&] { DistanceTransform(device, Grid(4, 3), {0, 1, 1}); }, {"length 0", "positive"});
  for (const double size : {1e-310, 1e-200, 1e155, 1e308})
    check_error([&] { DistanceTransform(device, Grid(4, 3), {size, size, size}); }, {"1e-140 to 1e+140"});
  check_error([&] { DistanceTransform(device, Grid(4, 3), {1, 2000, 1}); }, {"1000 times"});
  check_error([&] { DistanceTransform(device, Grid(40000, 1)); }, {"40000 x 1", "32768"});
  check_error([&] { DistanceTransform(device, Grid(2, 2, 20000)); }, {"16384"});
  check_error([&] { DistanceTransform(device, Grid(4, 3, Axes::xy).tilted(1)); }, {"tilted"});
  DistanceTransform moved = std::move(transform);
  BOOST_TEST(moved.grid().width() == 4);
  check_error([&] { transform.found(); }, {"moved from"});
}

// Seeds of masks by both metrics, whose diagrams this engine makes where the exact engine has the vector
// shape.
BOOST_AUTO_TEST_CASE(work_items_have_a_byte_per_pixel_or_there_is_one_for_each_unit) {
  // Each one remembers a column.
  const Grid grid(512, 16384);
  const Device device = test_device();
  const ImageShape shape(grid);
  MaskEngine engine(device, shape, {}, whole_sizes({}, shape.sides()));
  Marks marks(device, shape);
  NearestTargets targets;
  targets.distances = cl::Buffer(device.context(), CL_MEM_READ_WRITE, shape.pixels() * sizeof(float));
  KernelSet kernels;
  const cl::Buffer zeros(device.context(), CL_MEM_READ_WRITE, shape.pixels());
  marks.mark(kernels, zeros, PixelType::uint8, Marked::zeros);
  MaskWorkspace room;
  WorkingMemory memory(device, "a test", 0);
  engine.run(kernels, marks, targets, room, memory);
  device.finish();
  if (device.tuning().shape == Shape::group) return;  // which has no such memory
  constexpr std::size_t most_of_column = 600;         // per pixel
  BOOST_TEST(room.keys.getInfo<CL_MEM_SIZE>() + room.ints.getInfo<CL_MEM_SIZE>() <=
             std::max(shape.pixels(), units_of(device) * most_of_column * 16384));
}

BOOST_AUTO_TEST_CASE(exact_diagrams_of_masks_have_the_labels_of_their_pixels_as_seeds) {
  for (const Grid& grid :
       {Grid(67, 41), Grid(35, 30, Axes::x), Grid(19, 44, Axes::y), Grid(33, 40, Axes::xy)}) {
    const Shape3 shape = {{static_cast<int>(grid.width()), static_cast<int>(grid.height()), 1}};
    for (const Bytes& image : images_of(shape, 8)) {
      std::vector<Pixel> pixels;
      for (std::size_t i = 0; i < image.size(); ++i) {
        if (image[i] != 0) pixels.push_back({shape.at(i)[0], shape.at(i)[1]});
      }
      const Seeds seeds = Seeds::from_mask(test_device(), grid, image);
      BOOST_TEST(seeds.size() == pixels.size());
      for (const Metric metric : both_metrics) {
        Diagram diagram(test_device(), grid);
        exact_diagram(seeds, diagram, {metric});
        const std::size_t wrong = count_differences(diagram.read(), brute_force(grid, pixels, metric));
        BOOST_TEST(wrong == 0u, shape << ' ' << name_of(metric) << ", " << pixels.size() << " seeds");
        exact_diagram(seeds, diagram, {metric});
        BOOST_TEST(count_differences(diagram.read(), brute_force(grid, pixels, metric)) == wrong);
      }
    }
  }
}

// Of seeds on one voxel the lowest id owns it; one is absent.
BOOST_AUTO_TEST_CASE(crowded_seeds_of_volumes_have_the_labels_of_their_voxels) {
  const Grid plain(72, 80, 64),
      spaced(Axis(72).periodic(), Axis(80).spaced(3), Axis(64).spaced(2).periodic());
  for (const Grid& grid : {plain, spaced}) {
    std::mt19937 rng(9);
    const auto below = [&](unsigned end) { return static_cast<unsigned>(rng() % end); };
    std::vector<Point> points;
    Bytes mask(grid.pixels());
    std::vector<std::uint32_t> ids(grid.pixels(), no_label);
    for (std::uint32_t id = 0; id < 9000; ++id) {
      const unsigned x = below(72), y = below(80), z = id % 900 == 0 ? below(64) : 20;
      points.push_back({x + 0.5, y + 0.5, z + 0.5});
      const std::size_t place = (std::size_t{z} * 80 + y) * 72 + x;
      if (id == 7) points.back().y = -5;
      if (id == 7) continue;
      mask[place] = 1;
      ids[place] = std::min(ids[place], id);
    }
    ids.erase(std::remove(ids.begin(), ids.end(), no_label), ids.end());  // by the ranks of the mask
    Diagram diagram(test_device(), grid), of_mask(test_device(), grid), by_vectors(in_vectors(), grid);
    const Seeds seeds(test_device(), grid, points, {Outside::absent, Snap::to_pixels});
    exact_diagram(seeds, diagram);
    exact_diagram(Seeds::from_mask(test_device(), grid, mask), of_mask);
    Labels expected = of_mask.read();
    exact_diagram(Seeds::from_mask(in_vectors(), grid, mask), by_vectors);
    BOOST_TEST(count_differences(by_vectors.read(), expected) == 0u);
    for (std::uint32_t& label : expected) label = ids[label];
    BOOST_TEST(count_differences(diagram.read(), expected) == 0u);
    exact_diagram(seeds, diagram);  // with working memory that is there
    BOOST_TEST(count_differences(diagram.read(), expected) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(random_shapes_and_images) {
  const unsigned rounds = long_tests ? 200 : 4;
  std::mt19937 rng(long_tests ? std::random_device()() : 6);
  for (unsigned round = 0; round < rounds; ++round) {
    Shape3 shape = {{}};
    const bool is_plane = rng() % 2 == 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const unsigned most = is_plane ? (i == 2 ? 1 : 70) : 24;
      shape.sides[i] = static_cast<int>(1 + rng() % most);
      shape.periods[i] = rng() % 3 == 0;
      shape.spacing[i] = rng() % 2 == 0 ? 1 : 1 + rng() % (rng() % 4 == 0 ? 1000 : 16);
    }
    BOOST_TEST_CONTEXT(shape) { check_all_images(shape, round); }
  }
}
