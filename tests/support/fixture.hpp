// What every test file shares: the Boost.Test set-up and the device that the tests run on.
#pragma once

#include <boost/test/unit_test.hpp>
#include <optional>
#include <string>
#include <vector>

#include "snapped_seeds.hpp"
#include "transformed.hpp"
#include "vorocl/vorocl.hpp"

namespace vorocl {

inline std::optional<Device>& device_of_tests() {
  static std::optional<Device> device;
  return device;
}

/// VOROCL_DEVICE, else the library's choice. The program's own argument can say in which shape the exact
/// engine works: `test_volumes -- group`, or vector.
inline Device select_test_device() {
  const Device device = Device::select();
  const auto& program = boost::unit_test::framework::master_test_suite();
  if (program.argc < 2) return device;
  const std::string shape = program.argv[1];
  BOOST_TEST_REQUIRE((shape == "vector" || shape == "group"), "there is no shape \"" << shape << "\"");
  Tuning tuning = device.tuning();
  tuning.shape = shape == "group" ? Shape::group : Shape::vector;
  return device.with_tuning(tuning);
}

/// The device of all tests of a program. One, so that kernels are built once.
inline const Device& test_device() {
  if (!device_of_tests()) device_of_tests() = select_test_device();
  return *device_of_tests();
}

/// Whether exact diagrams are asked of the device in a shape. A work-item of the vector shape has more memory
/// of its own than a GPU has for it.
inline bool takes(Shape shape) {
  cl_device_type type = 0;
  clGetDeviceInfo(test_device().cl_device()(), CL_DEVICE_TYPE, sizeof type, &type, nullptr);
  return shape == Shape::group || (type & CL_DEVICE_TYPE_CPU) != 0;
}

/// Leaves no work behind: PoCL crashes a process that exits while its threads still build or run a kernel.
struct FinishAtEnd {
  ~FinishAtEnd() {
    if (device_of_tests()) device_of_tests()->finish();
  }
};
BOOST_TEST_GLOBAL_FIXTURE(FinishAtEnd);

inline std::vector<Point> all_of(const std::vector<std::optional<Point>>& points) {
  return transformed(points, [](const std::optional<Point>& point) { return point.value(); });
}

/// The points of seeds that are all present.
inline std::vector<Point> points_of(const Seeds& seeds) { return all_of(seeds.read()); }

/// The centres of their pixels.
inline std::vector<Point> centres_of(const Seeds& seeds) { return all_of(seeds.read_pixels()); }

/// Checks that an Error is thrown whose text holds all of these parts.
template <typename Function>
void check_error(Function function, std::initializer_list<std::string> parts) {
  try {
    function();
    BOOST_ERROR("no Error was thrown");
  } catch (const Error& error) {
    for (const std::string& part : parts) {
      BOOST_TEST(std::string(error.what()).find(part) != std::string::npos,
                 "\"" << error.what() << "\" does not say \"" << part << "\"");
    }
  }
}

inline const char* name_of(Metric metric) { return metric == Metric::euclidean ? "euclidean" : "manhattan"; }
inline const char* name_of(Neighbourhood n) { return n == Neighbourhood::moore ? "moore" : "von Neumann"; }

constexpr Metric both_metrics[] = {Metric::euclidean, Metric::manhattan};

}  // namespace vorocl
