#include <tiffio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "formats/files.hpp"
#include "formats/image_rows.hpp"
#include "formats/numbers.hpp"
#include "formats/planes/geotiff.hpp"
#include "formats/raster_files.hpp"
#include "formats/values.hpp"
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
  std::vector<std::uint8_t> start(4);
  open_to_read(path).read(reinterpret_cast<char*>(start.data()), 4);  // its reasons where it cannot be read
  keep_library_quiet();
  File file(TIFFOpen(path.c_str(), "r"));
  if (!file)
    throw Error(path + (is_tiff(start) ? " is a damaged TIFF file; it seems cut off" : " is no TIFF file"));
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

ImageHeader header_of(const File& file) {
  const auto samples = field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL);
  const std::uint64_t bits = std::uint64_t{field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE)} * samples;
  return {field<std::uint32_t>(file, TIFFTAG_IMAGEWIDTH),
          field<std::uint32_t>(file, TIFFTAG_IMAGELENGTH),
          bits,
          field<std::uint16_t>(file, TIFFTAG_COMPRESSION) != COMPRESSION_NONE,
          false,
          false,
          read_geotags(file.get())};
}

/// Of the numbers that samples are; "" for other samples. Whole ones may have less bits than a byte.
std::string type_of_samples(const File& file) {
  const auto bits = field<std::uint16_t>(file, TIFFTAG_BITSPERSAMPLE);
  const auto format = field<std::uint16_t>(file, TIFFTAG_SAMPLEFORMAT);
  if (format == SAMPLEFORMAT_COMPLEXINT || format == SAMPLEFORMAT_COMPLEXIEEEFP) return "";
  const char kind = format == SAMPLEFORMAT_INT ? 'i' : format == SAMPLEFORMAT_IEEEFP ? 'f' : 'u';
  const bool is_part = kind == 'u' && (bits == 1 || bits == 2 || bits == 4) &&
                       field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL) == 1;
  if (is_part) return "u1";
  return bits % 8 == 0 && number_type(kind, bits / 8u) != nullptr ? kind + std::to_string(bits / 8) : "";
}

std::optional<double> no_data_of(const File& file, const std::string& type) {
  const std::optional<double> value = read_no_data(file.get());
  return value && type == "f4" ? static_cast<double>(static_cast<float>(*value)) : value;
}

int count_pages(const File& file) {
  int pages = 1;
  while (TIFFReadDirectory(file.get()) == 1) {  // smaller copies of a page are none
    if ((field<std::uint32_t>(file, TIFFTAG_SUBFILETYPE) & FILETYPE_REDUCEDIMAGE) == 0) ++pages;
  }
  TIFFSetDirectory(file.get(), 0);
  return pages;
}

/// Throws Error if the file cannot hold what OpenCV makes room for: a tile, or all rows that a strip claims,
/// also where the image has fewer. What takes no more than a few megabytes may be claimed.
void check_claimed_block(const std::string& path, const File& file, ImageHeader block) {
  constexpr double few_pixels = 1 << 24;
  const auto rows_of_strip = field<std::uint32_t>(file, TIFFTAG_ROWSPERSTRIP);
  if (TIFFIsTiled(file.get()) != 0) {
    block.width = field<std::uint32_t>(file, TIFFTAG_TILEWIDTH);
    block.height = field<std::uint32_t>(file, TIFFTAG_TILELENGTH);
  } else if (rows_of_strip <= INT32_MAX) {  // more says that there is one strip
    block.height = rows_of_strip;
  }
  if (static_cast<double>(block.width) * static_cast<double>(block.height) > few_pixels)
    check_pixels(path, block, std::filesystem::file_size(path));
}

/// Blocks are tiles, or strips; samples of a pixel are together, or in a block for each band.
class TiffRows : public ImageRows {
 public:
  TiffRows(const ImageInfo& info, File file, const std::string& path)
      : ImageRows(info),
        path_(path),
        file_(std::move(file)),
        is_tiled_(TIFFIsTiled(file_.get()) != 0),
        bits_(field<std::uint16_t>(file_, TIFFTAG_BITSPERSAMPLE)),
        width_(static_cast<std::uint32_t>(info.width)) {
    const bool is_separate = field<std::uint16_t>(file_, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
    planes_ = is_separate ? info.bands : 1;
    const auto height = static_cast<std::uint32_t>(info.height);
    block_width_ = is_tiled_ ? field<std::uint32_t>(file_, TIFFTAG_TILEWIDTH) : width_;
    block_height_ = is_tiled_ ? field<std::uint32_t>(file_, TIFFTAG_TILELENGTH)
                              : std::min(height, field<std::uint32_t>(file_, TIFFTAG_ROWSPERSTRIP));
    const auto bytes = [](tmsize_t size) { return static_cast<std::size_t>(std::max<tmsize_t>(size, 0)); };
    block_bytes_ = bytes(is_tiled_ ? TIFFTileSize(file_.get()) : TIFFStripSize(file_.get()));
    row_bytes_ = bytes(is_tiled_ ? TIFFTileRowSize(file_.get()) : TIFFScanlineSize(file_.get()));
    const std::uint64_t needed = (std::uint64_t{block_width_} * info.bands / planes_ * bits_ + 7) / 8;
    ImageHeader block = header_of(file_);
    block.width = block_width_;
    block.height = block_height_;
    check_pixels(path, block, std::filesystem::file_size(path));
    if (row_bytes_ < needed || block_bytes_ / block_height_ < needed) throw Error(path + " is damaged");
    across_ = (width_ + block_width_ - 1) / block_width_;
    blocks_.resize(planes_ * across_ * block_bytes_);
  }

  void next(std::vector<double>& row) override {
    if (row_ % block_height_ == 0) read_blocks();
    const std::size_t bands = info().bands, together = bands / planes_;
    row.resize(width_ * bands);
    for (std::size_t block = 0; block < planes_ * across_; ++block) {
      const char* const bytes = blocks_.data() + block * block_bytes_ + (row_ % block_height_) * row_bytes_;
      const std::size_t plane = block / across_, x = block % across_ * block_width_;
      const std::size_t count = std::min<std::size_t>(block_width_, width_ - x) * together;
      if (planes_ == 1) {
        read_samples(bytes, count, &row[x * bands]);
        continue;
      }
      samples_.resize(count);
      read_samples(bytes, count, samples_.data());
      for (std::size_t i = 0; i < count; ++i) row[(x + i) * bands + plane] = samples_[i];
    }
    ++row_;
  }

 private:
  void read_blocks() {
    for (std::size_t block = 0; block < planes_ * across_; ++block) {
      char* const room = blocks_.data() + block * block_bytes_;
      const auto plane = static_cast<std::uint16_t>(block / across_);
      const auto x = static_cast<std::uint32_t>(block % across_ * block_width_);
      const auto size = static_cast<tmsize_t>(block_bytes_);
      const tmsize_t read =
          is_tiled_
              ? TIFFReadEncodedTile(file_.get(), TIFFComputeTile(file_.get(), x, row_, 0, plane), room, size)
              : TIFFReadEncodedStrip(file_.get(), TIFFComputeStrip(file_.get(), row_, plane), room, size);
      if (read < 0) throw Error(path_ + " is damaged: its row " + std::to_string(row_) + " cannot be read");
    }
  }

  void read_samples(const char* bytes, std::size_t count, double* numbers) const {
    if (bits_ >= 8) return number_type(info().type[0], bits_ / 8u)->read(bytes, count, numbers);
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned byte = static_cast<unsigned char>(bytes[i * bits_ / 8]);
      numbers[i] = byte >> (8 - bits_ - i * bits_ % 8) & ((1u << bits_) - 1);
    }
  }

  std::string path_;
  File file_;
  bool is_tiled_;
  unsigned bits_;
  std::uint32_t width_, row_ = 0, block_width_, block_height_;
  std::size_t planes_, across_, block_bytes_, row_bytes_;
  std::vector<char> blocks_;
  std::vector<double> samples_;
};

}  // namespace

bool is_tiff(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < 4) return false;
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), 4);
  using namespace std::string_view_literals;
  return start == "II*\0"sv || start == "II+\0"sv || start == "MM\0*"sv || start == "MM\0+"sv;
}

ImageHeader read_tiff_header(const std::string& path) { return header_of(open_tiff(path)); }

std::unique_ptr<ImageRows> open_tiff_image(const std::string& path) {
  File file = open_tiff(path);
  const ImageHeader header = header_of(file);
  check_pixels(path, header, std::filesystem::file_size(path));
  std::uint16_t colors = PHOTOMETRIC_MINISBLACK, others = 0;
  TIFFGetField(file.get(), TIFFTAG_PHOTOMETRIC, &colors);
  ImageInfo info;
  info.type = type_of_samples(file);
  if (info.type.empty() || (colors != PHOTOMETRIC_MINISBLACK && colors != PHOTOMETRIC_MINISWHITE &&
                            colors != PHOTOMETRIC_RGB && colors != PHOTOMETRIC_MASK)) {
    check_claimed_block(path, file, header);
    return nullptr;
  }
  info.width = header.width;
  info.height = header.height;
  info.bands = field<std::uint16_t>(file, TIFFTAG_SAMPLESPERPIXEL);
  const std::uint16_t* kinds = nullptr;
  if (TIFFGetField(file.get(), TIFFTAG_EXTRASAMPLES, &others, &kinds) == 1 && others > 0)
    info.has_alpha = kinds[others - 1] != EXTRASAMPLE_UNSPECIFIED;
  info.no_data = no_data_of(file, info.type);
  info.is_white_zero = colors == PHOTOMETRIC_MINISWHITE;
  info.is_lossy = field<std::uint16_t>(file, TIFFTAG_COMPRESSION) == COMPRESSION_JPEG;
  info.pages = count_pages(file);
  info.geotags = header.geotags;
  return std::make_unique<TiffRows>(info, std::move(file), path);
}

template <typename T>
void write_tiff(const OutputFile& output, const Raster& raster, const std::vector<T>& values) {
  static_assert(sizeof(T) == 4, "one 32-bit sample per pixel");
  constexpr std::size_t room_for_tags = 1 << 20;
  const bool big = values.size() * sizeof(T) + room_for_tags > 0xffffffffu;
  output.require_file("a TIFF file");
  GrowingFile grown(output);
  const auto require = [&](bool done) {
    if (!done) throw failed("writing", output.path());
  };
  File file = create_tiff(grown, big ? "w8" : "w");
  require(file != nullptr);
  const auto width = static_cast<std::uint32_t>(raster.size.width());
  const auto height = static_cast<std::uint32_t>(raster.size.height());
  TIFFSetField(file.get(), TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(file.get(), TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(file.get(), TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(file.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(file.get(), TIFFTAG_SAMPLEFORMAT,
               std::is_floating_point_v<T> ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_INT);
  TIFFSetField(file.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(file.get(), TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  TIFFSetField(file.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(file.get(), 0));
  if (raster.georeference) {
    require(write_georeference(file.get(), *raster.georeference, width, height,
                               std::is_floating_point_v<T> ? "inf" : "-1"));
  }
  std::vector<T> scanline(width);  // the library takes a pointer that it might write to
  for (std::uint32_t row = 0; row < height; ++row) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row) * raster.size.width();
    scanline.assign(begin, begin + raster.size.width());
    require(TIFFWriteScanline(file.get(), scanline.data(), row) == 1);
  }
  require(TIFFFlush(file.get()) == 1);
  file.reset();
  grown.finish();
}

template void write_tiff(const OutputFile&, const Raster&, const std::vector<std::uint32_t>&);
template void write_tiff(const OutputFile&, const Raster&, const std::vector<float>&);

}  // namespace vorocl::command
