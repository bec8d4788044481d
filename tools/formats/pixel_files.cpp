#include "formats/pixel_files.hpp"

#include <cstdint>

#include "formats/files.hpp"
#include "formats/npy.hpp"
#include "formats/tiff.hpp"
#include "formats/vtk.hpp"

namespace vorocl::command {

template <typename T>
void write_pixels(const OutputFile& file, const std::string& name, const Raster& raster,
                  const std::vector<T>& values) {
  const std::string extension = extension_of(file.path());
  if (extension == ".npy") {
    write_npy(file, raster.grid, values);
  } else if (extension == ".vti") {
    write_vti(file, name, raster, values);
  } else if constexpr (sizeof(T) == 4) {
    check_extension(file.path(), {".npy", ".tif", ".tiff", ".vti"});
    write_tiff(file, raster.grid, values);
  } else {
    check_extension(file.path(), {".npy", ".vti"});
  }
}

template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint8_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint32_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&, const std::vector<float>&);

}  // namespace vorocl::command
