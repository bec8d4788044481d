// The library's exceptions as Python's, which vorocl/_errors.py defines.
#include "module.hpp"

namespace vorocl::python {

namespace {

const char* name_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::bad_argument:
      return "BadArgument";
    case ErrorKind::bad_point:
      return "BadPoint";
    case ErrorKind::device_memory:
      return "DeviceMemoryError";
    case ErrorKind::host_memory:
      return "HostMemoryError";
    case ErrorKind::device:
      return "DeviceError";
    case ErrorKind::kernel_build:
      return "KernelBuildError";
    case ErrorKind::file:
      return "FileError";
  }
  return "Error";
}

template <typename... More>
void raise(const Error& error, More... more) {
  const nb::object type = nb::module_::import_("vorocl._errors").attr(name_of(error.kind()));
  PyErr_SetObject(type.ptr(), type(error.what(), more...).ptr());
}

}  // namespace

void bind_errors(nb::module_&) {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const BadPoint& error) {
      raise(error, error.index(), nb::make_tuple(error.point().x, error.point().y));
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace vorocl::python
