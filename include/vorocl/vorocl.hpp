// VoroCL: raster Voronoi diagrams of seeds that stand still or move, in OpenCL. Takes all headers that need
// OpenCL alone; pictures are in vorocl/picture.hpp, which needs OpenCV.
#pragma once

#include "vorocl/analysis.hpp"
#include "vorocl/device.hpp"
#include "vorocl/diagram.hpp"
#include "vorocl/dynamic_jump_flooding.hpp"
#include "vorocl/error.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/method.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/plan.hpp"
#include "vorocl/points.hpp"
#include "vorocl/relaxation.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"
#include "vorocl/similarity.hpp"
#include "vorocl/simulation.hpp"
#include "vorocl/standard_flooding.hpp"
#include "vorocl/tiles.hpp"
#include "vorocl/version.hpp"
