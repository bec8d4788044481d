// XYZ files, plain and extended.
#pragma once

#include <string>

#include "formats/trajectory/line_reader.hpp"
#include "formats/trajectory/particle_rows.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// Each frame is a line with the number of particles, a line of comment, and one row per particle: its kind,
/// x, y, z and maybe more. An extended file's comment holds key=value pairs, of which these matter: Lattice
/// (the nine components of the box's edges), Origin (its corner), pbc (which axes are periodic; all, without
/// it; the box grows on others) and Properties (what the columns are, among them pos and maybe id).
class Xyz : public TrajectoryReader {
 public:
  Xyz(LineReader lines, std::string value_column);
  bool next(Frame& frame) override;
  std::optional<std::uintmax_t> bytes_left() const override { return lines_.bytes_left(); }

 private:
  LineReader lines_;
  std::string value_column_;
  ParticleRows rows_;
};

}  // namespace vorocl::command
