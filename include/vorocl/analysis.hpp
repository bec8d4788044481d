// Analysis of diagrams: takes the headers of all measurements.
#pragma once

#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/distance_errors.hpp"
#include "vorocl/exact_cells.hpp"
#include "vorocl/fields.hpp"
