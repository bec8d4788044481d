// The kinds of files that trajectories are read from.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/trajectory/line_reader.hpp"
#include "formats/trajectory/particle_rows.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// Of text, with the rows of a frame one after the other.
class TextTrajectory : public TrajectoryReader {
 public:
  TextTrajectory(LineReader lines, std::string value_column, Wanted wanted)
      : lines_(std::move(lines)), value_column_(std::move(value_column)), rows_(wanted) {}
  std::optional<std::uintmax_t> bytes_left() const override { return lines_.bytes_left(); }

 protected:
  LineReader lines_;
  std::string value_column_;
  ParticleRows rows_;
};

/// LAMMPS text dumps of the styles atom and custom.
///
/// Each frame is a few sections, "ITEM: NAME" with lines after it, of which ATOMS is the last. The columns'
/// names follow in that line; positions are x y, scaled xs ys, unwrapped xu yu, or both, xsu ysu.
class LammpsDump : public TextTrajectory {
 public:
  using TextTrajectory::TextTrajectory;
  bool next(Frame& frame) override;

 private:
  struct Header {
    std::optional<std::int64_t> timestep;
    std::optional<ParticleCount> count;
    std::optional<SimulationBox> box;
  };

  /// The frame's sections up to the line ITEM: ATOMS; returns the columns there.
  std::string_view read_header(Header& header);
  /// The box from the present line, ITEM: BOX BOUNDS, of which the rest is the title, and the three after it.
  SimulationBox read_box(std::string_view title, std::size_t frame_line);
  void next_value(std::size_t frame_line);
};

/// XYZ files, plain and extended.
///
/// Each frame is a line with the number of particles, a line of comment, and one row per particle: its kind,
/// x, y, z and maybe more. An extended file's comment holds key=value pairs, of which these matter: Timestep,
/// Lattice (the nine components of the box's edges), Origin (its corner), pbc (which axes are periodic; all,
/// without it; the box grows on others) and Properties (what the columns are, among them pos and maybe id).
class Xyz : public TextTrajectory {
 public:
  using TextTrajectory::TextTrajectory;
  bool next(Frame& frame) override;
};

}  // namespace vorocl::command
