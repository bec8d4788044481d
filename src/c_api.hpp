// What all C functions share: the objects behind their handles, and exceptions turned into a status.
#pragma once

#include <new>
#include <string>

#include "vorocl/vorocl.h"
#include "vorocl/vorocl.hpp"

struct vorocl_device {
  vorocl::Device device;
  std::string name;
};

struct vorocl_seeds {
  vorocl::Seeds seeds;
};

struct vorocl_diagram {
  vorocl::Diagram diagram;
  vorocl::Report report;  // of the last engine
};

namespace vorocl {

struct NullArgument {
  const char* name;
};

/// Keeps the message for vorocl_error_message(), and returns the status.
vorocl_status report_failure(vorocl_status status, const char* what, const char* more = "") noexcept;

/// Runs a function's body; no exception leaves it, for its caller may be C.
template <typename Body>
vorocl_status guarded(Body body) noexcept {
  try {
    body();
    return VOROCL_SUCCESS;
  } catch (const NullArgument& argument) {
    return report_failure(VOROCL_NULL_ARGUMENT, argument.name, " is NULL");
  } catch (const std::bad_alloc&) {
    return report_failure(VOROCL_OUT_OF_HOST_MEMORY, "out of host memory");
  } catch (const std::exception& error) {
    return report_failure(VOROCL_ERROR, error.what());
  }
}

/// What a pointer that must not be NULL points to.
template <typename T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw NullArgument{name};
  return *pointer;
}

inline const Device& of(const vorocl_device* device) { return given(device, "device").device; }
inline const Seeds& of(const vorocl_seeds* seeds) { return given(seeds, "seeds").seeds; }
inline Seeds& of(vorocl_seeds* seeds) { return given(seeds, "seeds").seeds; }
inline const Diagram& of(const vorocl_diagram* diagram) { return given(diagram, "diagram").diagram; }

/// For a choice that is none of its constants.
[[noreturn]] inline void refuse(const char* what, int value) {
  throw Error(std::string(what) + " " + std::to_string(value) + " is unknown");
}

}  // namespace vorocl
