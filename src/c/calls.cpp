#include "calls.hpp"

#include <new>
#include <optional>

namespace vorocl {

namespace {

struct IndexedPoint {
  std::size_t index;
  Point point;
};

thread_local std::string last_message;
thread_local std::optional<IndexedPoint> last_bad_point;

vorocl_status failure(vorocl_status status, const char* what, const char* more = "") noexcept {
  try {
    last_message = std::string(what) + more;
  } catch (const std::bad_alloc&) {
    last_message.clear();
  }
  return status;
}

vorocl_status status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::bad_argument:
      return VOROCL_BAD_ARGUMENT;
    case ErrorKind::bad_point:
      return VOROCL_BAD_POINT;
    case ErrorKind::device_memory:
      return VOROCL_OUT_OF_DEVICE_MEMORY;
    case ErrorKind::host_memory:
      return VOROCL_OUT_OF_HOST_MEMORY;
    case ErrorKind::device:
      return VOROCL_DEVICE_ERROR;
    case ErrorKind::kernel_build:
      return VOROCL_KERNEL_BUILD_ERROR;
    case ErrorKind::file:
      return VOROCL_FILE_ERROR;
  }
  return VOROCL_DEVICE_ERROR;
}

}  // namespace

vorocl_status report_failure() noexcept {
  try {
    throw;
  } catch (const NullArgument& argument) {
    return failure(VOROCL_NULL_ARGUMENT, argument.name, " is NULL");
  } catch (const BadPoint& error) {
    last_bad_point = IndexedPoint{error.index(), error.point()};
    return failure(VOROCL_BAD_POINT, error.what());
  } catch (const Error& error) {
    return failure(status_of(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return failure(VOROCL_OUT_OF_HOST_MEMORY, "out of host memory");
  } catch (const std::exception& error) {
    return failure(VOROCL_DEVICE_ERROR, error.what());
  }
}

void check_count(std::size_t there, const char* what, std::size_t count) {
  if (count != there) {
    throw Error("there are " + std::to_string(there) + " " + what + ", and the count that was given is " +
                std::to_string(count));
  }
}

void refuse(const char* what, int value) {
  throw Error(std::string(what) + " " + std::to_string(value) + " is unknown");
}

Metric to_metric(vorocl_metric metric) {
  if (metric == VOROCL_EUCLIDEAN) return Metric::euclidean;
  if (metric == VOROCL_MANHATTAN) return Metric::manhattan;
  if (metric == VOROCL_GREAT_CIRCLE) return Metric::great_circle;
  refuse("metric", metric);
}

Snap to_snap(vorocl_snap snap) {
  if (snap == VOROCL_SNAP_TO_PIXELS) return Snap::to_pixels;
  if (snap == VOROCL_SNAP_NONE) return Snap::none;
  refuse("choice for points within a pixel", snap);
}

vorocl_point to_c(const Point& point) { return {point.x, point.y, point.z}; }

}  // namespace vorocl

using namespace vorocl;

const char* vorocl_error_message(void) { return last_message.c_str(); }

vorocl_status vorocl_bad_point(size_t* index, vorocl_point* point) {
  return guarded([&] {
    if (!last_bad_point) throw Error("no call of this thread has failed with a bad point");
    store(index, last_bad_point->index);
    store(point, to_c(last_bad_point->point));
  });
}

const char* vorocl_version(void) { return VOROCL_VERSION; }
