// Files that points are written to, by the extension of their name: .csv or .npy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// Points with their ids, which are their indices if `ids` is empty: a .csv file with the columns id, x and
/// y, or a .npy array of shape (N, 2) without the ids. Throws Error for another extension, or if the file
/// cannot be written.
void write_points(const OutputFile& file, const std::vector<Point>& points,
                  const std::vector<std::uint32_t>& ids);

}  // namespace vorocl::command
