// The status of a C function is the kind of the exception that C++ would throw.
#define BOOST_TEST_MODULE c_statuses
#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <string>

#include "c/calls.hpp"

using namespace vorocl;

namespace {
vorocl_status status_of(const std::exception_ptr& thrown) {
  return guarded([&] { std::rethrow_exception(thrown); });
}
}  // namespace

BOOST_AUTO_TEST_CASE(every_kind_of_error_has_its_status) {
  const std::pair<ErrorKind, vorocl_status> kinds[] = {
      {ErrorKind::bad_argument, VOROCL_BAD_ARGUMENT},
      {ErrorKind::bad_point, VOROCL_BAD_POINT},
      {ErrorKind::device_memory, VOROCL_OUT_OF_DEVICE_MEMORY},
      {ErrorKind::host_memory, VOROCL_OUT_OF_HOST_MEMORY},
      {ErrorKind::device, VOROCL_DEVICE_ERROR},
      {ErrorKind::kernel_build, VOROCL_KERNEL_BUILD_ERROR},
      {ErrorKind::file, VOROCL_FILE_ERROR},
  };
  for (const auto& [kind, status] : kinds) {
    const std::string message = "kind " + std::to_string(static_cast<int>(kind));
    BOOST_TEST(status_of(std::make_exception_ptr(Error(message, kind))) == status, message);
    BOOST_TEST(vorocl_error_message() == message);
  }
}

BOOST_AUTO_TEST_CASE(exceptions_of_the_standard_library) {
  BOOST_TEST(status_of(std::make_exception_ptr(std::bad_alloc())) == VOROCL_OUT_OF_HOST_MEMORY);
  BOOST_TEST(vorocl_error_message() == std::string("out of host memory"));
  BOOST_TEST(status_of(std::make_exception_ptr(std::runtime_error("a lock"))) == VOROCL_DEVICE_ERROR);
  BOOST_TEST(vorocl_error_message() == std::string("a lock"));
}

// The numbers are part of the binary interface.
static_assert(VOROCL_SUCCESS == 0 && VOROCL_BAD_ARGUMENT == 1 && VOROCL_NULL_ARGUMENT == 2 &&
              VOROCL_OUT_OF_HOST_MEMORY == 3 && VOROCL_BAD_POINT == 4 && VOROCL_OUT_OF_DEVICE_MEMORY == 5 &&
              VOROCL_DEVICE_ERROR == 6 && VOROCL_KERNEL_BUILD_ERROR == 7 && VOROCL_FILE_ERROR == 8);
