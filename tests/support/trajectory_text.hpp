// What the tests of trajectories share: dumps of a few lines, and reading all of a file.
#pragma once

#include <string>
#include <vector>

#include "formats/trajectory/trajectory.hpp"
#include "temporary_folder.hpp"

namespace vorocl::command {

/// Adds the frames to the list one by one, so that those before an Error are there.
inline void read_frames(const std::string& path, std::vector<Frame>& frames,
                        const std::string& value_column = "", Wanted wanted = Wanted::all) {
  const auto reader = open_trajectory(path, value_column, wanted);
  Frame frame;
  while (reader->next(frame)) frames.push_back(frame);
}

inline std::vector<Frame> frames_of(const std::string& text, const std::string& value_column = "",
                                    Wanted wanted = Wanted::all) {
  const TemporaryFolder folder;
  std::vector<Frame> frames;
  read_frames(folder.file("trajectory", text), frames, value_column, wanted);
  return frames;
}

/// One frame of a LAMMPS dump.
inline std::string dump(const std::string& box, const std::string& columns,
                        const std::vector<std::string>& rows,
                        const std::string& start = "ITEM: TIMESTEP\n0\n") {
  std::string text = start + "ITEM: NUMBER OF ATOMS\n" + std::to_string(rows.size()) + "\nITEM: BOX BOUNDS " +
                     box + "\nITEM: ATOMS " + columns + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

/// The lines after "ITEM: BOX BOUNDS " of a box of 10 x 10.
const std::string periodic_box = "pp pp pp\n0 10\n0 10\n-0.5 0.5";
const std::string walled_box = "ff ff pp\n0 10\n0 10\n-0.5 0.5";

}  // namespace vorocl::command
