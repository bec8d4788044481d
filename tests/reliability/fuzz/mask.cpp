// Masks: images of all kinds that are read.
#include "formats/images/pictures.hpp"
#include "fuzz.hpp"

using namespace vorocl;
using namespace vorocl::command;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = input_file(data, size, ".png");
  read_or_refuse([&] {
    const Mask mask = read_mask(path);
    require(mask.pixels.size() == mask.size.pixels());
  });
  return 0;
}
