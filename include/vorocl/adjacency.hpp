// Which cells of a diagram touch: the Delaunay neighbours in raster form.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

struct AdjacencyState;
struct VerticesState;

/// Two cells that share a pixel edge, in a volume a voxel face.
struct CellPair {
  std::uint32_t a = 0, b = 0;  ///< their ids, a < b
  std::uint32_t length = 0;    ///< the pixel edges they share; in a volume the faces, an area

  friend bool operator==(const CellPair& p, const CellPair& q) {
    return p.a == q.a && p.b == q.b && p.length == q.length;
  }
};

/// What adjacency() found, on the device. Finding it again allocates nothing unless there is more of it.
/// Empty before the first time, and after it was moved from or adjacency() threw: then its buffers are null.
///
/// Threads: one thread at a time.
///
/// Lifetime: a result keeps its device. Its buffers are valid until the next measurement into it.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API AdjacencyResult {
 public:
  /// How many pairs of cells share a pixel edge. Waits. Throws BadPoint if the frame of the seeds had one; so
  /// do all of these. 0 while the result is empty.
  std::size_t pairs() const;

  /// uint32 a, b, length of each pair, sorted by a and then b; each pair once, a < b. Waits, as the size of
  /// the list is the device's.
  const cl::Buffer& pair_list() const;

  /// uint32 per cell: the cells it shares an edge with. Waits, as the device says whether all were found.
  const cl::Buffer& neighbours() const;

  /// uint32 per cell: the pixel edges it shares with them; in a volume the faces, its surface. Waits
  /// likewise.
  const cl::Buffer& perimeters() const;

  std::vector<CellPair> read_pairs() const;
  std::vector<std::uint32_t> read_neighbours() const;
  std::vector<std::uint32_t> read_perimeters() const;

 private:
  friend struct Internal;
  OwnState<AdjacencyState> state_;
};

/// Finds the pairs of cells that share a pixel edge, and the length of their common border. Pixels without a
/// label, or with that of an absent seed, belong to no cell, and the window's edge is no border. Where the
/// first row of a tilted grid follows the last one, pixels lie between pixels: one there is taken to share an
/// edge with the one that it has more in common with. In a volume the same is said of voxels and their faces,
/// and of the first slice, too.
///
/// On an exact Euclidean diagram these are the edges of the Delaunay triangulation. Cells that touch along
/// less than a few pixels may be missing. Cost: a walk along the cells' borders, which inserts each border
/// into a short list of its cell or a hash table on the device, and sorting the pairs; about 200 bytes of
/// device memory per seed, in a volume 300; twice that where cells are large. Enqueues and returns. Where
/// cells in many pieces have more neighbours than the table holds, reading the result finds them again in a
/// larger one; it throws Error if the diagram has been filled or written since. Throws Error if the diagram
/// knows no seeds (see Diagram::write()) or the device has too little memory.
VOROCL_API Report adjacency(const Diagram& diagram, AdjacencyResult& result);

/// What vertices() found, on the device; as AdjacencyResult.
class VOROCL_API VerticesResult {
 public:
  /// How many there are; 0 while the result is empty. Waits. Throws BadPoint if the frame of the seeds had
  /// one.
  std::size_t count() const;

  /// Their positions, in pixels from the window's first one, in row-major order. As count().
  std::vector<Point> read() const;

 private:
  friend struct Internal;
  OwnState<VerticesState> state_;
};

/// The pixel corners where three or more cells meet: the vertices of the diagram. Corners on the window's
/// edge do not count, but where it shows a whole period: those across its end are at its right and its lower
/// edge. Labels alone are looked at. Memory: a bit per pixel. Enqueues and returns. Throws Error if the
/// diagram is a volume or the device has too little memory.
VOROCL_API Report vertices(const Diagram& diagram, VerticesResult& result);

}  // namespace vorocl
