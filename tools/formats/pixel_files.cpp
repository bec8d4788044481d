#include "formats/pixel_files.hpp"

#include <cstdint>

#include "formats/files.hpp"
#include "formats/npy.hpp"
#include "formats/tiff.hpp"
#include "formats/vtk.hpp"

namespace vorocl::command {

template <typename T>
void write_pixels(const std::string& path, const std::string& name, const Grid& grid,
                  const std::vector<T>& values) {
  const std::string extension = extension_of(path);
  if (extension == ".npy") {
    write_npy(path, grid, values);
  } else if (extension == ".vti") {
    write_vti(path, name, grid, values);
  } else if constexpr (sizeof(T) == 4) {
    check_extension(path, {".npy", ".tif", ".tiff", ".vti"});
    write_tiff(path, grid, values);
  } else {
    check_extension(path, {".npy", ".vti"});
  }
}

template void write_pixels(const std::string&, const std::string&, const Grid&,
                           const std::vector<std::uint8_t>&);
template void write_pixels(const std::string&, const std::string&, const Grid&,
                           const std::vector<std::uint32_t>&);
template void write_pixels(const std::string&, const std::string&, const Grid&, const std::vector<float>&);

}  // namespace vorocl::command
