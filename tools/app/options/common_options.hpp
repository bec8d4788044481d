// Options that most subcommands have.
#pragma once

#include <string>

#include "app/options/command_line.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

Option add_metric_option(Command& command, Metric& metric);
Option add_device_option(Command& command, std::string& request);
Option add_json_option(Command& command, bool& json);

}  // namespace vorocl::command
