// The Voronoi cells of seeds as polygons, and in volumes as polyhedra, without pixels: areas, neighbours,
// vertices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct ExactCellsState;

/// What exact_cells() knows of a cell, in the units of the data. An empty cell has the area 0 and a centroid
/// of NaNs: that of an absent seed, of a seed that lies where one with a lower id does, of one outside the
/// rectangle whose cell does not reach into it, and of one whose weight is too small beside those around it.
///
/// A measure has one name in planes and volumes: the area of a volume's cell is its volume, its perimeter its
/// surface, and its edges are its faces; the rectangle is the box.
struct ExactCell {
  double area = 0;
  Point centroid;        ///< across a period's end it may lie outside the rectangle; in a plane z is 0
  double perimeter = 0;  ///< with the sides of the rectangle that bound it
  std::uint32_t neighbours =
      0;  ///< edges that it shares with cells; one with which it shares two counts twice
  bool touches_border = false;  ///< a side of the rectangle bounds it

  /// All decisions were certain, and all seeds that may bound it were looked at.
  bool certified = false;
};

/// An edge that two cells share, in the units of the data. Across the ends of periods two cells may share
/// several edges, and a cell may be its own neighbour.
struct ExactPair {
  std::uint32_t a = 0, b = 0;  ///< their ids, a <= b
  double length = 0;
  Point midpoint;  ///< as cell a has it
};

/// All cells as polygons: the edges of cell i are those from offsets[i] up to offsets[i + 1], none of an
/// empty cell. They go round it counter-clockwise, where y points up, from the lowest vertex on.
struct ExactPolygons {
  std::vector<std::uint32_t> offsets;     ///< one more than there are cells
  std::vector<Point> vertices;            ///< where each edge begins; across a period's end a cell is whole
  std::vector<std::uint32_t> neighbours;  ///< the cell behind each edge; no_label: a side of the rectangle
  std::vector<double> lengths;            ///< of each edge; none is 0
};

/// A face that two cells of a volume share, in the units of the data. Across the ends of periods two cells
/// may share several faces, and a cell may be its own neighbour.
struct ExactFace {
  std::uint32_t a = 0, b = 0;  ///< their ids, a <= b
  double area = 0;

  /// So many periods along x, y and z the image of b lies behind the face: seen from the point of a as it was
  /// given, that of b is image times the periods further away than its point says. So the face is normal to
  /// point b + image * periods - point a. Of a tilted grid the periods are the edges of its box, which lean.
  std::array<std::int32_t, 3> image = {};
};

/// All cells of a volume as polyhedra, in the units of the data. Cell i has the vertices from
/// vertex_offsets[i] up to vertex_offsets[i + 1], and the faces from offsets[i] up to offsets[i + 1], none if
/// it is empty; across a period's end it is whole. Face j has the corners from corner_offsets[j] up to
/// corner_offsets[j + 1], counter-clockwise as seen from outside: rows of `vertices`.
struct ExactPolyhedra {
  std::vector<std::uint32_t> offsets;         ///< one more than there are cells
  std::vector<std::uint32_t> neighbours;      ///< the cell behind each face; no_label: a side of the box
  std::vector<double> areas;                  ///< of each face; none is 0
  std::vector<std::uint64_t> corner_offsets;  ///< one more than there are faces
  std::vector<std::uint64_t> corners;
  std::vector<std::uint64_t> vertex_offsets;  ///< one more than there are cells
  std::vector<Point> vertices;
};

/// What must hold for the cells as a whole.
struct ExactCellsCheck {
  double area = 0;  ///< the sum of all cells
  double rectangle_area =
      0;  ///< of the rectangle, as it was rounded: what the sum must be if there is a cell
  std::size_t not_mutual = 0;   ///< edges with a cell that does not have that edge: must be 0
  std::size_t uncertified = 0;  ///< cells: must be 0
};

/// What exact_cells() found, on the device: buffers with one entry per seed, by id, and with one per edge.
/// Finding it again allocates nothing unless there is more of it. Empty before the first time, and after it
/// was moved from or exact_cells() threw: then its buffers are null.
///
/// Each of its functions waits: only then it is known whether cells had more edges than kernels have private
/// memory for, which are cut once more in global memory. The polygons, and faces, are put in order when they
/// are first asked for. All throw Error if the device has too little memory for that. The result may be empty
/// then.
///
/// Threads: one thread at a time.
///
/// Lifetime: a result keeps its device and a copy of the points. Its buffers are valid until the next
/// measurement into it.
class VOROCL_API ExactCellsResult {
 public:
  /// The cells, one per seed; 0 while the result is empty. Does not wait.
  std::size_t size() const;

  const cl::Buffer& areas() const;       ///< double per cell
  const cl::Buffer& centroids() const;   ///< two doubles per cell, in a volume three
  const cl::Buffer& perimeters() const;  ///< double per cell
  const cl::Buffer& neighbours() const;  ///< uint32 per cell
  const cl::Buffer& flags() const;       ///< byte per cell: 1 touches the border, 2 certified, 3 both

  std::size_t edges() const;                  ///< of all polygons; of a volume the faces of all cells
  const cl::Buffer& offsets() const;          ///< as in ExactPolygons: uint32 per cell, and one
  const cl::Buffer& vertices() const;         ///< double2 per edge; of a volume a null buffer
  const cl::Buffer& edge_neighbours() const;  ///< uint32 per edge
  const cl::Buffer& lengths() const;          ///< double per edge, of a volume the area of each face

  std::vector<ExactCell> read() const;

  /// Throws Error if the cells are those of a volume.
  ExactPolygons read_polygons() const;

  /// Each edge between two cells once, sorted by a and then b. Throws as read_polygons().
  std::vector<ExactPair> read_pairs() const;

  /// Each face between two cells once, sorted by a, b and the image. Throws Error if the cells are those of a
  /// plane.
  std::vector<ExactFace> read_faces() const;

  /// The cells are cut once more for that; about 1,200 bytes per cell of device memory while it lasts. Throws
  /// as read_faces().
  ExactPolyhedra read_polyhedra() const;

  /// Sums the areas, and looks for each edge on its other side.
  ExactCellsCheck check() const;

 private:
  friend struct Internal;
  const cl::Buffer& settled(cl::Buffer ExactCellsState::*buffer) const;
  const cl::Buffer& listed(cl::Buffer ExactCellsState::*buffer) const;
  OwnState<ExactCellsState> state_;
};

/// Cuts the rectangle of the seeds' grid, or the box of a volume, into their Euclidean Voronoi cells, without
/// a diagram: the grid's axes say where it begins and ends and which axes are periodic, its pixels do not
/// count. In a plane seeds outside it count as far as their cells reach into it.
///
/// Points are taken as they were given (as the centres of their pixels where they were made on the device),
/// and rounded to a power of two that is at most 2^-29 of the rectangle's longer side, or of what holds the
/// seeds outside too; in a volume it is at most 2^-39 of the longest side. So are the rectangle's sides.
/// Whole numbers, halves and so on stay as they are. Of these points the cells are exact: neighbours are
/// decided in whole numbers, and cells that touch in a point, or of a volume in an edge, are none. Vertices
/// are right to about 2^-50 of their distance from the seed, in a volume to 2^-36 where planes are almost
/// parallel. The same numbers come on every device that has fused multiply-add.
///
/// Of a grid that is tilted (Grid::tilted()) the cells are those of what repeats so, and points are rounded
/// to 2^-28 of the longer side, in a volume to 2^-38 of the longest. A box that is so flat beside its tilts
/// that more than 65,535 of its images may touch a cell is an Error.
///
/// Of points with weights (Points::weighted()) the cells are those of the power diagram, and a seed may lie
/// outside its cell. Weights are rounded to steps squared, or to 2^-53 of how far the greatest lies above
/// them. Of weighted points at one place the one with the greatest weight has the cell.
///
/// Each cell starts as the rectangle and is cut by bisectors, with the seeds that are near in a tree first,
/// farther ones of a plane by how deep they may cut, until no seed is nearer to one of its vertices than its
/// own: the security radius of Ray, Sokolov, Lefebvre and Levy ("Meshless Voronoi on the GPU", 2018), vertex
/// by vertex. Cost: the host sorts the points, in about 0.1 us each; the device takes 1.5 us per cell and
/// core (14 of 100,000 close together along a curve), in a volume 2.6 us. Memory: 115 bytes per seed, and 116
/// more where polygons are asked for; in a volume 380, and 220 more where faces are.
///
/// Enqueues and returns, after a wait where only the device has the points. Throws Error if the device has no
/// doubles (cl_khr_fp64) or too little memory, if the rectangle has no extent along an axis, or if the grid
/// has an axis that is spaced.
VOROCL_API Report exact_cells(const Seeds& seeds, ExactCellsResult& result);

}  // namespace vorocl
