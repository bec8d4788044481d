// The files that a diagram and its measures go to, apart from pictures: which there are, and how each is
// written.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/outputs/measures.hpp"

namespace vorocl::command {

/// One kind of file, and the option that asks for it.
struct FileKind {
  std::string option;  // "--labels"
  std::string about;   // what the file holds, for the help
  std::vector<std::string> extensions;
  void (*write)(const std::string& path, Analysis& analysis);
};

/// Labels by id: .npy, .tif or .vti.
const FileKind& labels_kind();
/// A row a cell, a row a pair of cells that touch: .csv. The manual page explains the columns.
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

/// Adds the option of each; the requests must stay where they are. If `numbered`, the path is a pattern for a
/// file a frame.
void add_file_options(CLI::App& app, std::vector<FileRequest>& requests, bool numbered = false);

}  // namespace vorocl::command
