#include "formats/raster_files.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <memory>

#include "formats/files.hpp"
#include "formats/image_rows.hpp"
#include "formats/npy.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

LabelImage read_labels(const std::string& path) {
  check_extension(path, readable_label_extensions);
  const std::unique_ptr<ImageRows> rows = open_image(path);
  const ImageInfo& info = rows->info();
  if (info.type[0] == 'f' || info.bands > 1) {
    throw Error(path + " holds no labels: these are one whole number per pixel");
  }
  LabelImage image{diagram_size(path, info.width, info.height), {}, info.depth};
  image.labels.reserve(image.size.pixels() * static_cast<std::size_t>(info.depth));
  std::vector<double> row;
  for (std::int64_t i = 0; i < info.height * info.depth; ++i) {
    rows->next(row);
    for (const double number : row) {
      if (number < INT32_MIN || number > UINT32_MAX)
        throw Error(fmt::format("{} holds {}; labels have 32 bits", path, number));
      image.labels.push_back(static_cast<std::uint32_t>(static_cast<std::int64_t>(number)));
    }
  }
  return image;
}

void write_labels(const OutputFile& file, const Raster& raster, const std::vector<std::uint32_t>& labels) {
  write_pixels(file, "label", raster, labels);
}

template <typename T>
void write_pixels(const OutputFile& file, const std::string& name, const Raster& raster,
                  const std::vector<T>& values) {
  const std::string extension = extension_of(file.path());
  check_extension(file.path(), raster.is_volume() || sizeof(T) < 4 ? volume_extensions : label_extensions);
  if (extension == ".npy") {
    write_npy(file, raster, values);
  } else if (extension == ".vti") {
    write_vti(file, name, raster, values);
  } else if constexpr (sizeof(T) == 4) {
    write_tiff(file, raster, values);
  }
}

template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint8_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint32_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&, const std::vector<float>&);

}  // namespace vorocl::command
