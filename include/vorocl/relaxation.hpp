// Lloyd relaxation: seeds move to the centroids of their cells until the diagram is centroidal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/seeds.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl {

/// What relax() did.
struct Relaxation {
  /// Of the diagram at the start and after each round: the sum of the squared distances of all pixels to
  /// their seeds, in square pixels, in a spaced grid in squares of its unit: see energy(). With a density the
  /// sum of density times squared distance.
  std::vector<double> energies;
  std::vector<std::size_t> moved;  ///< the seeds that each round moved: one entry less than the energies
  bool converged = false;          ///< no seed would move by the tolerance or more

  int rounds() const { return static_cast<int>(energies.size()) - 1; }
};

struct RelaxOptions {
  /// In pixels along an axis: a round that would move all seeds by less ends the relaxation. Snapped seeds
  /// move by whole pixels, so that for every tolerance of at most 1 they end where no seed would move.
  double tolerance = 1.0 / 64;

  /// How dense the seeds shall be: a value of at least 0 for each pixel, row-major as the labels; empty: all
  /// pixels weigh alike. A seed goes to the centroid of its cell where each pixel weighs as much as its
  /// density (Secord 2002, "Weighted Voronoi stippling"). Weights are whole numbers of 1/65535 of the
  /// greatest density, to which densities are rounded, so that sums are exact. Seeds whose cells weigh
  /// nothing stay.
  ///
  /// Many seeds come to lie as densely as the square root of the density (Gersho 1979; Du, Faber & Gunzburger
  /// 1999): give its square for seeds as dense as it is.
  std::vector<float> density = {};

  /// Whether a seed goes to the centroid of its polygon, in a volume of its polyhedron, as exact_cells() cuts
  /// it in the units of the data. Seeds lie anywhere then, in volumes too, and so their cells become as even
  /// as those of Lloyd's algorithm on polygons where there are four pixels or more for each seed: these are
  /// of the diagrams, the energies and the tolerance. There is no density.
  bool exact = false;
};

/// Called with the diagram at the start (0 rounds so far) and after each round. Returns whether to go on.
using RelaxationObserver =
    std::function<bool(const Seeds& seeds, const Diagram& diagram, const Relaxation& so_far)>;

/// The sum of the squared Euclidean distances of all pixels with a label to their seeds, in square pixels: a
/// whole number where seeds are whole pixels, exact up to 2^53. Of other seeds the sum of each block of
/// pixels is cut down to 1/4096, so that it is less than 1/4096 per block too small. Waits. Throws Error if
/// the diagram knows no seeds, or some lie outside its window or across the ends of its periods, and BadPoint
/// if they had a bad point.
VOROCL_API double energy(const Diagram& diagram);

/// Lloyd's algorithm on pixels (Lloyd 1982; Du, Faber & Gunzburger 1999, "Centroidal Voronoi tessellations").
/// A round moves every seed to its cell's centroid and lets the engine fill the diagram again; seeds with
/// empty cells stay. A seed goes to the position nearest to the centroid that is a whole number of 1/4096
/// pixel; seeds of Seeds::random() and Seeds::from_mask() begin at the centres of their pixels. Seeds of
/// points with Snap::to_pixels go to the pixel nearest to the centroid (if two are, and the seed is on one of
/// them, it stays): they soon stay where their cells are far from even (docs/relaxation.md). So do all seeds
/// of volumes and spaced planes, which go to the nearest voxel: a seed that lies in it stays. Ends after so
/// many rounds, when no seed would move by the tolerance, or when the observer says so. In the end the
/// diagram is that of the seeds.
///
/// The diagram may hold anything at the start.
///
/// With an exact Euclidean engine and snapped seeds the energy falls with every round, so the end is sure to
/// come; an approximate engine may make it rise now and then. Where seeds are snapped, those that come to
/// share a pixel leave the higher id without a cell. Waits in every round. Throws Error if `rounds` is
/// negative, the tolerance is not above 0, the density has another size than the diagram, a value that is
/// negative or not finite, or nothing but zeros, the seeds have weights or lie outside the grid, or the
/// diagram's window is not the whole grid, with periods of at most 32,000 pixels; of an exact relaxation if
/// there is a density, or seeds are snapped to pixels; and as the engine and exact_cells() do. Cost of a
/// density: 2 bytes of device memory per pixel and 96 per seed.
VOROCL_API Relaxation relax(Seeds& seeds, Diagram& diagram, const Simulation::Engine& engine, int rounds,
                            const RelaxationObserver& observer = {}, const RelaxOptions& options = {});

}  // namespace vorocl
