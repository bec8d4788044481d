// The kinds of files that a diagram and its measures are written to (pictures are in painter.hpp), and how
// each is written.
#pragma once

#include <string>
#include <vector>

#include "app/outputs/measures.hpp"
#include "app/outputs/output_files.hpp"

namespace vorocl::command {

/// One kind of file, and the option that asks for it.
struct FileKind {
  std::string option;  // "--labels"
  std::string about;   // what the file holds, for the help
  std::vector<std::string> extensions;
  void (*write)(const OutputFile& file, Measures& measures);
};

/// Labels by id: .npy, .tif or .vti.
const FileKind& labels_kind();
/// One row per cell, one row per pair of cells that touch: .csv. The manual page explains the columns.
const FileKind& cells_kind();
const FileKind& adjacency_kind();
/// Distances to the nearest seed in pixels, float: .npy, .tif or .vti.
const FileKind& distance_kind();
/// The pixels at the borders of the cells: .npy, .png or .vti.
const FileKind& border_kind();

/// A file that the command line may ask for.
struct FileRequest {
  FileKind kind;
  std::string path;  // empty: not asked for
};

/// As check_outputs() takes it. If `numbered`, the path is a pattern for one file per frame.
RequestedFile requested(const FileRequest& request, bool numbered = false);

}  // namespace vorocl::command
