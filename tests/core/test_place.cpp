// Placing points on the device, against the host's Axis.
#define BOOST_TEST_MODULE place
#include <cmath>
#include <limits>
#include <random>

#include "core/place.hpp"
#include "fixture.hpp"
#include "runtime/buffer.hpp"
#include "runtime/program.hpp"

using namespace vorocl;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The kernels' Axis, called for each coordinate.
class AxisOnDevice {
 public:
  explicit AxisOnDevice(int width)
      : program_(test_device().context(), with_includes("test.cl", R"(
#include "core/axis.cl"
#if VOROCL_WIDTH == 1
#define VECTOR coordinate
#define FIRST
#else
#define VECTOR (double_v)(coordinate, axis.from, axis.to, -coordinate)
#define FIRST .s0
#endif
kernel void show_spots(global const double* coordinates, uint count, double2 ends, int pixels, int kind,
                       global double2* spots, global double* periods) {
  const uint id = (uint)get_global_id(0);
  if (id >= count) return;
  const axis_t axis = axis_of(ends, pixels, kind);
  const double coordinate = coordinates[id];
  const double_v coordinates_here = VECTOR;
  spots_t found;
  find_spots(axis, coordinates_here, &found);
  spots[id] = (double2)(found.pixel FIRST, found.part FIRST);
  periods[id] = periods_beyond(axis, coordinates_here) FIRST;
})")) {
    const std::string options = "-cl-std=CL1.2 -DVOROCL_GUARD=16 -DVOROCL_WIDTH=" + std::to_string(width);
    check(program_.build(std::vector<cl::Device>{test_device().cl_device()}, options.c_str()), "building");
  }

  void expect_the_same(const Axis& axis, const std::vector<double>& coordinates) const {
    const Device& device = test_device();
    const std::size_t count = coordinates.size(), group = 64;
    const cl::Buffer given = allocate_with(device, coordinates, "coordinates"),
                     spots = allocate(device, count * sizeof(cl_double2), "spots"),
                     periods = allocate(device, count * sizeof(cl_double), "periods");
    cl::Kernel kernel(program_, "show_spots");
    check(kernel.setArg(0, given), "points");
    check(kernel.setArg(1, static_cast<cl_uint>(count)), "count");
    check(kernel.setArg(2, cl_double2{{axis.from(), axis.to()}}), "ends");
    check(kernel.setArg(3, static_cast<cl_int>(axis.pixels())), "pixels");
    check(kernel.setArg(4, kind_of(axis)), "kind");
    check(kernel.setArg(5, spots), "spots");
    check(kernel.setArg(6, periods), "periods");
    check(device.queue().enqueueNDRangeKernel(
              kernel, cl::NullRange, cl::NDRange((count + group - 1) / group * group), cl::NDRange(group)),
          "finding spots");
    const auto found = download<cl_double2>(device, spots, count);
    const auto beyond = download<double>(device, periods, count);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double at = coordinates[i], pixel = axis.pixel(at), position = axis.rounded_position(at);
      if (found[i].s[0] == pixel && pixel + found[i].s[1] / 4096 == position &&
          beyond[i] == axis.periods_beyond(at))
        continue;
      if (++wrong > 3) continue;
      BOOST_ERROR(std::hexfloat << at << " in " << axis.pixels() << " pixels from " << axis.from() << " to "
                                << axis.to() << ", " << axis.is_periodic() << axis.is_reversed()
                                << axis.is_closed() << ": pixel " << found[i].s[0] << ", not " << pixel
                                << ", and " << found[i].s[1] << " parts, not " << (position - pixel) * 4096
                                << ", and " << beyond[i] << " periods, not " << axis.periods_beyond(at));
    }
    BOOST_TEST(wrong == 0u);
  }

 private:
  cl::Program program_;
};

using Random = std::mt19937_64;

double uniform(Random& rng, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(rng);
}

/// An axis of any kind: of few pixels and up to 2^31 - 1, of units from pixels to what is nearly too long for
/// them.
Axis random_axis(Random& rng) {
  const auto pixels = static_cast<std::int64_t>(std::exp2(uniform(rng, 0, 31)) - 0.5) + 1;
  const auto made = [&] {
    if (rng() % 4 == 0) return Axis(pixels);
    const double from = rng() % 4 == 0 ? 0 : uniform(rng, -1, 1) * std::exp2(uniform(rng, -40, 40));
    if (rng() % 16 == 0) return Axis(pixels, from, from);
    if (rng() % 4 == 0)
      return Axis(pixels, from, from + static_cast<double>(pixels) * std::exp2(uniform(rng, -3, 3)));
    return Axis(pixels, from, from + std::exp2(uniform(rng, -200, 200)) + std::abs(from));
  };
  Axis axis = made();
  if (rng() % 2 == 0 && axis.from() < axis.to()) axis = axis.periodic();
  if (rng() % 2 == 0) axis = axis.reversed();
  if (rng() % 2 == 0) axis = axis.closed();
  return axis;
}

/// Coordinates in the axis, beside it, far away, at the ends of pixels and next to them, and denormal ones.
std::vector<double> coordinates_for(const Axis& axis, Random& rng, std::size_t count) {
  const double extent = axis.from() == axis.to() ? 1 : axis.to() - axis.from();
  std::vector<double> coordinates = {axis.from(),
                                     axis.to(),
                                     0,
                                     -0.0,
                                     std::numeric_limits<double>::denorm_min(),
                                     -std::numeric_limits<double>::denorm_min(),
                                     std::numeric_limits<double>::min(),
                                     -std::numeric_limits<double>::min() / 3,
                                     axis.from() - extent};
  while (coordinates.size() < count) {
    const auto pixel = static_cast<double>(rng() % static_cast<std::uint64_t>(axis.pixels() + 1));
    const double at[] = {axis.from() + uniform(rng, 0, 1) * extent,
                         axis.from() + uniform(rng, -3, 4) * extent,
                         axis.from() + uniform(rng, -1, 1) * std::exp2(uniform(rng, 0, 52)) * extent,
                         axis.coordinate(pixel),
                         axis.coordinate(pixel + static_cast<double>(2 * (rng() % 4096) + 1) / 8192),
                         uniform(rng, -1, 1) * std::exp2(uniform(rng, -1074, -1000))};
    const double chosen = at[rng() % 6];
    const double next[] = {chosen, std::nextafter(chosen, infinity), std::nextafter(chosen, -infinity)};
    const double coordinate = next[rng() % 3];
    if (std::isfinite(coordinate)) coordinates.push_back(coordinate);
  }
  return coordinates;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_coordinate_has_the_pixel_and_the_fraction_that_the_host_gives_it) {
  const AxisOnDevice alone(1), of_four(4);
  Random rng(44);
  for (int number = 0; number < 500; ++number) {
    const Axis axis = random_axis(rng);
    const std::vector<double> coordinates = coordinates_for(axis, rng, 2000);
    (number % 2 == 0 ? alone : of_four).expect_the_same(axis, coordinates);
  }
}

namespace {

/// Seeds placed by the host and by the device, as all that is read of them says.
struct Read {
  std::vector<std::optional<Point>> points, pixels;
  std::size_t alive, outside;
  double displacement;
  std::vector<std::uint32_t> labels;

  Read(const Seeds& seeds, const Grid& grid)
      : points(seeds.read()),
        pixels(seeds.read_pixels()),
        alive(seeds.alive()),
        outside(seeds.outside()),
        displacement(seeds.displacement()) {
    Diagram diagram(seeds.device(), grid);
    exact_diagram(seeds, diagram);
    labels = diagram.read();
  }
};

bool same(const std::vector<std::optional<Point>>& a, const std::vector<std::optional<Point>>& b) {
  const auto is_same = [](const std::optional<Point>& p, const std::optional<Point>& q) {
    return p.has_value() == q.has_value() && (!p || (p->x == q->x && p->y == q->y && p->z == q->z));
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

/// What is read of the seeds that a function makes, placed by the host and by the device.
template <typename Make>
void expect_the_same_on_both(const Grid& grid, Make make) {
  setenv("VOROCL_PLACE_ON", "host", 1);
  const Read on_host(make(test_device()), grid);
  unsetenv("VOROCL_PLACE_ON");
  for (const int width : {1, 4}) {
    Tuning tuning = test_device().tuning();
    tuning.vector_width = width;
    const Read on_device(make(test_device().with_tuning(tuning)), grid);
    BOOST_TEST(same(on_host.points, on_device.points));
    BOOST_TEST(same(on_host.pixels, on_device.pixels));
    BOOST_TEST(on_host.alive == on_device.alive);
    BOOST_TEST(on_host.outside == on_device.outside);
    BOOST_TEST(on_host.displacement == on_device.displacement);
    BOOST_TEST((on_host.labels == on_device.labels));
  }
}

std::vector<Point> points_on(const Grid& grid, Random& rng, std::size_t count, double beyond) {
  const auto along = [&](const Axis& axis) {
    const double extent = axis.to() - axis.from();
    return uniform(rng, axis.from() - beyond * extent, axis.to() + beyond * extent);
  };
  std::vector<Point> points(count);
  for (Point& point : points) point = {along(grid.x()), along(grid.y()), grid.z().from()};
  return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(seeds_are_placed_alike_by_the_device_and_by_the_host) {
  Random rng(45);
  const Grid grids[] = {Grid(90, 70), Grid(90, 70, Axes::x),
                        Grid(Axis(90, -1, 8.5).closed(), Axis(70, 2, 3).reversed()),
                        Grid(Axis(90, 0.1, 0.7).periodic(), Axis(70, -4, -1).reversed().periodic()),
                        Grid(Axis(90, 0, 9).periodic(), Axis(70, 0, 7).periodic()).tilted(2.3)};
  for (const Grid& grid : grids) {
    for (const double beyond : {0.0, 0.7}) {
      const std::vector<Point> before = points_on(grid, rng, 3000, beyond),
                               after = points_on(grid, rng, 2900, beyond);
      std::vector<std::uint8_t> marks(before.size());
      for (std::uint8_t& mark : marks) mark = static_cast<std::uint8_t>(rng() % 4);
      const auto floats = [](const std::vector<Point>& points) {
        return transformed(points, [](const Point& p) {
          return cl_float2{{static_cast<float>(p.x), static_cast<float>(p.y)}};
        });
      };
      const auto doubles = [](const std::vector<Point>& points) {
        return transformed(points, [](const Point& p) { return cl_double2{{p.x, p.y}}; });
      };
      const auto buffer = [](const auto& values) {
        return cl::Buffer(test_device().queue(), values.begin(), values.end(), true);
      };
      const cl::Buffer floats_before = buffer(floats(before)), floats_after = buffer(floats(after)),
                       doubles_before = buffer(doubles(before)), doubles_after = buffer(doubles(after)),
                       bytes = buffer(marks);
      for (const Outside outside : {Outside::count, Outside::absent}) {
        for (const Snap snap : {Snap::none, Snap::to_pixels}) {
          expect_the_same_on_both(grid, [&](const Device& device) {
            Seeds seeds(device, grid, Points(before).marked(marks.data()), SeedsOptions{outside, snap});
            seeds.move_to(Points(&after[0].x, &after[0].y, after.size(), sizeof(Point)));
            return seeds;
          });
          expect_the_same_on_both(grid, [&](const Device& device) {
            Seeds seeds(device, grid, {floats_before, before.size(), PointFormat::floats_xy},
                        SeedsOptions{outside, snap});
            seeds.move_to({doubles_after, after.size(), PointFormat::doubles_xy, bytes});
            return seeds;
          });
          expect_the_same_on_both(grid, [&](const Device& device) {
            Seeds seeds(device, grid, {doubles_before, before.size(), PointFormat::doubles_xy, bytes},
                        SeedsOptions{outside, snap});
            seeds.move_to({floats_after, after.size()});
            return seeds;
          });
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_of_volumes_are_placed_alike_by_the_device_and_by_the_host) {
  Random rng(46);
  for (const Grid& grid : {Grid(Axis(20, -1, 1), Axis(15, 0, 3).periodic(), Axis(9, 5, 6).closed()),
                           Grid(Axis(20), Axis(15), Axis(9).spaced(3))}) {
    std::vector<Point> points = points_on(grid, rng, 500, 0.2);
    for (Point& point : points) point.z = uniform(rng, grid.z().from() - 0.1, grid.z().to() + 0.1);
    for (const Snap snap : {Snap::to_pixels, Snap::none}) {
      expect_the_same_on_both(grid, [&](const Device& device) {
        return Seeds(device, grid, points, {Outside::absent, snap});
      });
    }
  }
}
