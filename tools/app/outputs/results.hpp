// What --json says first of a diagram, whichever subcommand made it.
#pragma once

#include "app/sources/view.hpp"
#include "app/terminal/json.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/method.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// How a diagram of seeds was made, and how it stands in the data.
Json::Members json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view);

}  // namespace vorocl::command
