#include "app/outputs/output_files.hpp"

#include <climits>

#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/numbered_files.hpp"

namespace vorocl::command {

void check_outputs(const std::vector<RequestedFile>& files, const SeedOptions& seeds,
                   const std::vector<RequestedFile>& other_inputs) {
  std::vector<RequestedFile> inputs = {
      {"--points", seeds.points, {}}, {"--mask", seeds.mask, {}}, {"--trajectory", seeds.trajectory, {}}};
  inputs.insert(inputs.end(), other_inputs.begin(), other_inputs.end());
  for (const RequestedFile& file : files) {
    if (file.path.empty()) continue;
    as_usage([&] {
      if (file.path.size() >= PATH_MAX) throw Error(file.option + ": the name has more than 4095 characters");
      check_extension(file.path, file.extensions);
      if (file.numbered) NumberedName(file.path);
    });
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (const RequestedFile& input : inputs) {
      if (may_be_one_file(files[i].path, input.path)) {
        throw UsageError(files[i].path + ": " + files[i].option + " would replace the file that " +
                         input.option + " reads");
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (may_be_one_file(files[i].path, files[j].path)) {
        throw UsageError(files[i].path + ": " + files[j].option + " and " + files[i].option +
                         " cannot write one file");
      }
    }
  }
}

std::optional<OutputFile> open_output(const std::string& path) {
  return path.empty() ? std::nullopt : std::optional<OutputFile>(path);
}

void print_empty_cells(std::size_t empty, std::size_t cells, std::size_t seeds, const std::string& pixel) {
  if (cells < seeds) {
    print("of these seeds: {} with a cell, {} inside and {} outside that own no {}\n", cells - empty, empty,
          seeds - cells, pixel);
  } else if (empty > 0) {
    print("{} of {} seeds own no {}\n", empty, seeds, pixel);
  }
}

void print_unlabelled(std::size_t voxels, std::size_t seeds) {
  if (voxels == 0) return;
  print("{} without a label: {}\n", counted(voxels, "voxel"),
        seeds == 0 ? "there are no seeds" : "no wave reached them");
}

void print_written(const std::vector<RequestedFile>& files) {
  for (const RequestedFile& file : files) {
    if (!file.path.empty()) print("wrote {}\n", printable(file.path));
  }
}

}  // namespace vorocl::command
