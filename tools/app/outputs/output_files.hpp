// What can be said of the files that a command line asks for before there is anything to write.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/output_file.hpp"

namespace vorocl::command {

/// An option and the file that it asks for.
struct RequestedFile {
  std::string option;
  std::string path;  // empty: not asked for
  std::vector<std::string> extensions;
  bool numbered = false;  // the path is a pattern for one file per frame, round or wave
};

/// Throws UsageError for a name that ends in none of its extensions, a pattern without its place for a
/// number, two options that would write one file, and one that would replace a file which the seeds, or other
/// options, read.
void check_outputs(const std::vector<RequestedFile>& files, const SeedOptions& seeds,
                   const std::vector<RequestedFile>& other_inputs = {});

/// The file, to be written later, if it is asked for. Throws Error if it cannot be made there.
std::optional<OutputFile> open_output(const std::string& path);

/// Says on standard output how many of the seeds have no cell, if some do: `empty` of the `cells` that count,
/// and the seeds outside that are none of these.
void print_empty_cells(std::size_t empty, std::size_t cells, std::size_t seeds,
                       const std::string& pixel = "pixel");

/// Says on standard output how many voxels no method reached; nothing if there are none.
void print_unlabelled(std::size_t voxels, std::size_t seeds);

/// Says on standard output which files were written.
void print_written(const std::vector<RequestedFile>& files);

}  // namespace vorocl::command
