// Which cells of a diagram touch: the Delaunay neighbours in raster form.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct AdjacencyState;

/// Two cells that share a pixel edge.
struct CellPair {
  std::uint32_t a = 0, b = 0;  ///< their ids, a < b
  std::uint32_t length = 0;    ///< the pixel edges they share

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
  AdjacencyResult();
  ~AdjacencyResult();
  AdjacencyResult(AdjacencyResult&& other) noexcept;
  AdjacencyResult& operator=(AdjacencyResult&& other) noexcept;

  /// How many pairs of cells share a pixel edge.
  std::size_t pairs() const;

  /// uint32 a, b, length of each pair, sorted by a and then b; each pair once, a < b.
  const cl::Buffer& pair_list() const;

  const cl::Buffer& neighbours() const;  ///< uint32 per cell: the cells it shares an edge with
  const cl::Buffer& perimeters() const;  ///< uint32 per cell: the pixel edges it shares with them

  std::vector<CellPair> read_pairs() const;
  std::vector<std::uint32_t> read_neighbours() const;
  std::vector<std::uint32_t> read_perimeters() const;

 private:
  friend struct Internal;
  std::unique_ptr<AdjacencyState> state_;
};

/// Finds the pairs of cells that share a pixel edge, and the length of their common border. Pixels without a
/// label belong to no cell, and the grid's edge is no border.
///
/// On an exact Euclidean diagram these are the edges of the Delaunay triangulation, but for cells that touch
/// along less than a few pixels. Cost: a walk along the cells' borders, which inserts each border into a hash
/// table on the device, and sorting the pairs; about 100 bytes of device memory per seed. Waits. Throws Error
/// if seeds and diagram do not fit together or the device has too little memory, BadPoint if the seeds had
/// one.
VOROCL_API void adjacency(const Seeds& seeds, const Diagram& diagram, AdjacencyResult& result);

/// The pixel corners where three or more cells meet: the vertices of the diagram. Corners on the grid's edge
/// do not count. Waits. Throws as Diagram::wait().
VOROCL_API std::size_t count_vertices(const Diagram& diagram);

}  // namespace vorocl
