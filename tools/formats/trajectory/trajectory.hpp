// Trajectories of particles: LAMMPS text dumps and (extended) XYZ files, read frame by frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/raster.hpp"
#include "formats/values.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The rectangle that a frame fills, in data units, with what is known of z.
struct Box : Bounds {
  bool periodic_x = false, periodic_y = false, periodic_z = false;
  /// How far the copy of the box above it (at greater y) is shifted in x. Only where both axes are periodic:
  /// the box is then the rectangle that has the same particles.
  double tilt = 0;
  /// Sides that give way to particles: shrink-wrapped ones. Beyond the others there is nothing.
  bool open_x0 = false, open_y0 = false, open_x1 = false, open_y1 = false;
  /// By how many degrees the file's box is turned in its plane; here it is turned back, with its particles.
  double turned = 0;
  /// Of a volume, how far the copy at greater z is shifted in x and y, where those axes are periodic.
  double xz = 0, yz = 0;
};

/// One state of the particles, in canonical form: it does not depend on the order of the file's rows nor on
/// its kind of coordinates. Unless a volume is wanted the third dimension is left out: particles are seen
/// along z.
struct Frame {
  std::optional<std::int64_t> timestep;  ///< none in an XYZ that does not say it
  std::optional<Box> box;                ///< none in an XYZ without a lattice
  std::vector<std::uint32_t> ids;        ///< ascending; the rows' numbers from 0 where the file has no ids
  /// In data units, in the order of the ids. On a periodic axis a position is wrapped into [x0, x1);
  /// elsewhere the box holds it, grown where the file's box is no wall.
  std::vector<Point> positions;
  std::vector<double> z;  ///< of a volume, likewise; else empty
  double z_span = 0;      ///< how far the particles lie apart along z; 0 where the file has no z
  ColumnValues values;    ///< of the value column, in the order of the ids; empty without one
};

/// Reads one frame at a time: memory does not grow with the number of frames.
class TrajectoryReader {
 public:
  virtual ~TrajectoryReader() = default;

  /// The next frame; false after the last. Throws Error "FILE:LINE: what" for anything that cannot be
  /// trusted, a last frame that is cut off too, after the frames before it were given; after that the reader
  /// is of no further use. (A cut within the very last field is not noticed: the last line of a whole file
  /// may lack its line feed.)
  virtual bool next(Frame& frame) = 0;

  /// How much of the file is still to be read; none where that is not known (a pipe).
  virtual std::optional<std::uintmax_t> bytes_left() const = 0;
};

/// What of a frame is to be read.
enum class Wanted {
  all,
  depth,   ///< z_span alone: the rest may be that of a plane or of a volume
  volume,  ///< all, with z
  box,  ///< and no particles where it does not depend on them: their rows are passed over, whatever they hold
  box_of_volume  ///< the same with z
};

/// A reader for the file, whose kind its first line tells, and for the values of one of its columns: a name
/// in a LAMMPS dump, a property in an extended XYZ, with [1], [2], ... behind it where it has several
/// columns. Throws Error if the file cannot be read or is of no kind that is known.
std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path,
                                                  const std::string& value_column = "",
                                                  Wanted wanted = Wanted::all);

}  // namespace vorocl::command
