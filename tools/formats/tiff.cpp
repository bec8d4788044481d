#include <tiffio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <type_traits>

#include "formats/files.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using File = std::unique_ptr<TIFF, Close>;

/// The library would print to stderr; here the exceptions say what went wrong.
void keep_library_quiet() {
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
}

File open_tiff(const std::string& path) {
  open_to_read(path);  // for its reasons where the file cannot be read at all
  keep_library_quiet();
  File file(TIFFOpen(path.c_str(), "r"));
  if (!file) throw Error(path + " is no TIFF file");
  return file;
}

/// Closes its own copy of the descriptor.
File create_tiff(const GrowingFile& file, const char* mode) {
  keep_library_quiet();
  return File(TIFFFdOpen(dup(file.descriptor()), file.path().c_str(), mode));
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

ImageHeader header_of(const File& file) {
  const auto samples = field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL);
  const std::uint64_t bits = std::uint64_t{field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE)} * samples;
  const auto colors = field<std::uint16_t>(file, TIFFTAG_PHOTOMETRIC);
  return {field<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH), field<std::uint32_t>(file, TIFFTAG_IMAGELENGTH),
          bits, field<std::uint16_t>(file, TIFFTAG_COMPRESSION) != COMPRESSION_NONE,
          samples <= 2 && (colors == PHOTOMETRIC_MINISBLACK || colors == PHOTOMETRIC_MINISWHITE)};
}

}  // namespace

bool is_tiff(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < 4) return false;
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), 4);
  using namespace std::string_view_literals;
  return start == "II*\0"sv || start == "II+\0"sv || start == "MM\0*"sv || start == "MM\0+"sv;
}

ImageHeader read_tiff_header(const std::string& path) { return header_of(open_tiff(path)); }

LabelImage read_tiff_labels(const std::string& path) {
  const File file = open_tiff(path);
  if (!holds_labels(file))
    throw Error(path + " holds no labels: these are one 32-bit integer per pixel, in strips");
  LabelImage image{checked_size(path, header_of(file), std::filesystem::file_size(path)), {}};
  image.labels.resize(image.size.pixels());
  const auto width = static_cast<std::size_t>(image.size.width());
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(image.size.height()); ++row) {
    if (TIFFReadScanline(file.get(), &image.labels[row * width], row) != 1) {
      throw Error(path + " is damaged: its row " + std::to_string(row) + " cannot be read");
    }
  }
  return image;
}

template <typename T>
void write_tiff(const OutputFile& output, const Size& size, const std::vector<T>& values) {
  static_assert(sizeof(T) == 4, "one 32-bit sample per pixel");
  constexpr std::size_t room_for_tags = 1 << 20;
  const bool big = values.size() * sizeof(T) + room_for_tags > 0xffffffffu;
  output.require_file("a TIFF file");
  GrowingFile grown(output);
  const auto require = [&](bool done) {
    if (!done) throw Error("writing " + output.path() + " failed: " + reason(errno));
  };
  File file = create_tiff(grown, big ? "w8" : "w");
  require(file != nullptr);
  const auto width = static_cast<std::uint32_t>(size.width());
  const auto height = static_cast<std::uint32_t>(size.height());
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
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row) * size.width();
    scanline.assign(begin, begin + size.width());
    require(TIFFWriteScanline(file.get(), scanline.data(), row) == 1);
  }
  require(TIFFFlush(file.get()) == 1);
  file.reset();
  grown.finish();
}

template void write_tiff(const OutputFile&, const Size&, const std::vector<std::uint32_t>&);
template void write_tiff(const OutputFile&, const Size&, const std::vector<float>&);

}  // namespace vorocl::command
