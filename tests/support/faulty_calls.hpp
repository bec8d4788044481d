// OpenCL calls defined once more: each asks call_fails(), and fails or passes on to the loader's own.
// faulty_calls.cpp has those with which the library works.
#pragma once

#include <dlfcn.h>

#include "vorocl/opencl.hpp"

namespace vorocl {

/// Whether this call is to fail. Who links faulty_calls.cpp defines it.
bool call_fails(const char* name);

/// The loader's definition of a call.
template <typename Function>
Function* loaders(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace vorocl

#define VOROCL_FAULTY extern "C" __attribute__((visibility("default")))

/// A call that returns its error code.
#define VOROCL_FAULTY_CALL(name, parameters, arguments)                      \
  VOROCL_FAULTY cl_int CL_API_CALL name parameters {                         \
    static const auto next = vorocl::loaders<cl_int parameters>(#name);      \
    return vorocl::call_fails(#name) ? CL_OUT_OF_RESOURCES : next arguments; \
  }

/// A call that returns an object, and its error code through a pointer.
#define VOROCL_FAULTY_MAKER(type, name, parameters, arguments)        \
  VOROCL_FAULTY type CL_API_CALL name parameters {                    \
    static const auto next = vorocl::loaders<type parameters>(#name); \
    if (!vorocl::call_fails(#name)) return next arguments;            \
    *code = CL_MEM_OBJECT_ALLOCATION_FAILURE;                         \
    return nullptr;                                                   \
  }
