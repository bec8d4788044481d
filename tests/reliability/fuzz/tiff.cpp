// Labels of TIFF files.
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".tif");
  read_or_refuse([&] {
    const LabelImage image = read_labels(path);
    require(image.labels.size() == image.size.pixels());
  });
  read_or_refuse([&] { read_mask(path); });
  return 0;
}
