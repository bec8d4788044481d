#include "formats/tiff.hpp"

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <type_traits>

#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using File = std::unique_ptr<TIFF, Close>;

File open(const std::string& path, const char* mode) {
  // The library would print to stderr; here the exceptions say what went wrong.
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  return File(TIFFOpen(path.c_str(), mode));
}

template <typename T>
T field(const File& file, ttag_t tag) {
  T value{};
  TIFFGetFieldDefaulted(file.get(), tag, &value);
  return value;
}

/// Signed or not: the bits are the same.
bool holds_labels(const File& file) {
  const auto format = field<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT);
  return field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE) == 32 &&
         field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL) == 1 &&
         (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT) && TIFFIsTiled(file.get()) == 0;
}

}  // namespace

LabelImage read_tiff_labels(const std::string& path) {
  open_to_read(path);  // for its reasons where the file cannot be read at all
  const File file = open(path, "r");
  if (!file) throw Error(path + " is no TIFF file");
  if (!holds_labels(file))
    throw Error(path + " holds no labels: these are one 32-bit integer per pixel, in strips");
  const auto width = field<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH);
  const auto height = field<std::uint32_t>(file, TIFFTAG_IMAGELENGTH);
  LabelImage image{Grid(width, height), {}};
  image.labels.resize(image.grid.pixels());
  for (std::uint32_t row = 0; row < height; ++row) {
    if (TIFFReadScanline(file.get(), &image.labels[static_cast<std::size_t>(row) * width], row) != 1) {
      throw Error(path + " is damaged: its row " + std::to_string(row) + " cannot be read");
    }
  }
  return image;
}

template <typename T>
void write_tiff(const std::string& path, const Grid& grid, const std::vector<T>& values) {
  static_assert(sizeof(T) == 4, "one 32-bit sample per pixel");
  constexpr std::size_t room_for_tags = 1 << 20;
  const bool big = values.size() * sizeof(T) + room_for_tags > 0xffffffffu;
  File file = open(path, big ? "w8" : "w");
  if (!file) throw Error("cannot write " + path);
  const auto width = static_cast<std::uint32_t>(grid.width());
  const auto height = static_cast<std::uint32_t>(grid.height());
  TIFFSetField(file.get(), TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(file.get(), TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(file.get(), TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(file.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(file.get(), TIFFTAG_SAMPLEFORMAT,
               std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_INT);
  TIFFSetField(file.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(file.get(), TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  TIFFSetField(file.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(file.get(), 0));
  std::vector<T> scanline(width);  // the library takes a pointer that it might write to
  for (std::uint32_t row = 0; row < height; ++row) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row) * grid.width();
    scanline.assign(begin, begin + grid.width());
    if (TIFFWriteScanline(file.get(), scanline.data(), row) != 1) throw Error("writing " + path + " failed");
  }
  if (TIFFFlush(file.get()) != 1) throw Error("writing " + path + " failed");
}

template void write_tiff(const std::string&, const Grid&, const std::vector<std::uint32_t>&);
template void write_tiff(const std::string&, const Grid&, const std::vector<float>&);

}  // namespace vorocl::command
