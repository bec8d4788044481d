// The device that a command works on.
#pragma once

#include <string>

#include "vorocl/device.hpp"

namespace vorocl::command {

/// As Device::select(). On a terminal, a run that waits for the driver's compiler says so.
Device select_device(const std::string& request);

}  // namespace vorocl::command
