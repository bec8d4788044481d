#include "app/terminal/selected_device.hpp"

#include <unistd.h>

#include "app/terminal/console.hpp"

namespace vorocl::command {

Device select_device(const std::string& request) {
  Device device = Device::select(request);
  if (isatty(STDERR_FILENO) != 0) {
    device.on_compiling([] {
      print_note(
          "the driver compiles kernels, which takes some seconds, once; \"vorocl prepare\" has all compiled "
          "beforehand");
    });
  }
  return device;
}

}  // namespace vorocl::command
