// Points and labels of .npy files.
#include "formats/npy.hpp"

#include "formats/raster_files.hpp"
#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".npy");
  read_or_refuse([&] { require(!read_npy_points(path).empty()); });
  read_or_refuse([&] { require(!read_npy_points(path, true).empty()); });
  read_or_refuse([&] {
    const LabelImage image = read_labels(path);
    require(image.labels.size() == image.size.pixels() * static_cast<std::size_t>(image.depth));
  });
  return 0;
}
