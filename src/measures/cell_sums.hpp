// What cell_sums() leaves on the device, which the statistics take.
#pragma once

#include "measures/measurement.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

struct CellSumsState : Measured {
  cl::Buffer area, sum_x, sum_y, sum_z;
  cl::Buffer home, home_sums, periods;  // while the sums are made: see cells.cl
};

}  // namespace vorocl
