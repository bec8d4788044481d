// What all C functions share: the objects behind their handles, exceptions turned into a status, and the
// checks of arguments that C++ does not need.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vorocl/vorocl.h"
#include "vorocl/vorocl.hpp"

struct vorocl_device {
  explicit vorocl_device(const vorocl::Device& of)
      : device(of), name(of.name()), platform_name(of.platform_name()), driver_version(of.driver_version()) {}

  vorocl::Device device;
  std::string name, platform_name, driver_version;
};

struct vorocl_seeds {
  vorocl::Seeds seeds;
};

struct vorocl_diagram {
  vorocl::Diagram diagram;
  vorocl::Report report;  // of the last method; that of nothing if it failed, or the caller wrote the labels
};

namespace vorocl {

struct NullArgument {
  const char* name;
};

/// Keeps what vorocl_error_message() and vorocl_bad_point() tell of the exception that is being handled, and
/// returns its status.
vorocl_status report_failure() noexcept;

/// Runs a function's body; no exception leaves it, for its caller may be C.
template <typename Body>
vorocl_status guarded(Body body) noexcept {
  try {
    body();
    return VOROCL_SUCCESS;
  } catch (...) {
    return report_failure();
  }
}

/// What a pointer that must not be NULL points to.
template <typename T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw NullArgument{name};
  return *pointer;
}

/// As guarded(), for a body that makes an object.
template <typename T, typename Make>
vorocl_status make_object(T** object, const char* name, Make make) {
  return guarded([&] {
    given(object, name) = nullptr;
    *object = new T(make());
  });
}

/// As guarded(), for a body that finds one thing.
template <typename T, typename Find>
vorocl_status answer(T* where, const char* name, Find find) {
  return guarded([&] {
    given(where, name);  // before anything is done
    *where = find();
  });
}

inline const Device& of(const vorocl_device* device) { return given(device, "device").device; }
inline const Seeds& of(const vorocl_seeds* seeds) { return given(seeds, "seeds").seeds; }
inline Seeds& of(vorocl_seeds* seeds) { return given(seeds, "seeds").seeds; }
inline const Diagram& of(const vorocl_diagram* diagram) { return given(diagram, "diagram").diagram; }

/// The caller's buffer as the C++ functions take it. NULL is a null buffer.
inline cl::Buffer retained(cl_mem buffer) { return cl::Buffer(buffer, true); }

/// For a function that gives several things. The caller may not want all.
template <typename T, typename Value>
void store(T* where, const Value& value) {
  if (where != nullptr) *where = value;
}

/// Throws Error unless the caller gave as many values (or room for as many) as there are.
void check_count(std::size_t there, const char* what, std::size_t count);

/// An element of a list. Throws Error if it has no such index.
template <typename T>
const T& at(const std::vector<T>& list, std::size_t index, const char* what) {
  if (index >= list.size()) {
    throw Error("there are " + std::to_string(list.size()) + " " + what + ", and no index " +
                std::to_string(index));
  }
  return list[index];
}

/// For a choice that is none of its constants.
[[noreturn]] void refuse(const char* what, int value);

Grid to_grid(const vorocl_grid& grid);
Window to_window(const vorocl_window& window);
vorocl_grid to_c(const Grid& grid);
vorocl_window to_c(const Window& window);

Metric to_metric(vorocl_metric metric);
Snap to_snap(vorocl_snap snap);
MethodOptions to_options(const vorocl_method_options* options);
vorocl_point to_c(const Point& point);

}  // namespace vorocl
