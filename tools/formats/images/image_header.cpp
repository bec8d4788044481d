#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// The bytes of a file, which may end anywhere: behind the end there are zeros.
class FileBytes {
 public:
  explicit FileBytes(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  std::size_t size() const { return bytes_.size(); }
  std::uint8_t at(std::size_t place) const { return place < bytes_.size() ? bytes_[place] : 0; }
  bool starts_with(std::string_view text) const {
    return bytes_.size() >= text.size() &&
           std::equal(text.begin(), text.end(), bytes_.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  }
  std::uint32_t big_endian(std::size_t place, std::size_t count) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | at(place + i);
    return value;
  }
  std::uint32_t little_endian(std::size_t place, std::size_t count) const {
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | at(place + i);
    return value;
  }

 private:
  const std::vector<std::uint8_t>& bytes_;
};

bool is_png(const FileBytes& bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

/// IHDR, always the first chunk: width, height, bit depth, colour type.
ImageHeader read_png(const FileBytes& bytes) {
  const std::uint8_t color_type = bytes.at(25);
  const std::uint64_t channels = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
  return {bytes.big_endian(16, 4), bytes.big_endian(20, 4), bytes.at(24) * channels, true, false, true};
}

bool is_bmp(const FileBytes& bytes) { return bytes.starts_with("BM"); }

/// The file header of 14 bytes, then one of two: with sides of 2 bytes, or of 4 and signed.
ImageHeader read_bmp(const FileBytes& bytes) {
  constexpr std::size_t info = 14, old_size = 12;
  if (bytes.little_endian(info, 4) == old_size) {
    return {bytes.little_endian(info + 4, 2), bytes.little_endian(info + 6, 2),
            bytes.little_endian(info + 10, 2), false};
  }
  constexpr std::uint32_t by_run_length_8 = 1, by_run_length_4 = 2;
  const std::uint32_t method = bytes.little_endian(info + 16, 4);
  const auto side = [&](std::size_t place) {
    return std::abs(std::int64_t{static_cast<std::int32_t>(bytes.little_endian(place, 4))});
  };
  return {side(info + 4), side(info + 8), bytes.little_endian(info + 14, 2),
          method == by_run_length_8 || method == by_run_length_4};
}

bool is_jpeg(const FileBytes& bytes) { return bytes.starts_with("\xff\xd8\xff"); }

/// The first marker that starts a frame (SOF), behind those of tables and comments. Behind the start of a
/// scan (SOS) the marker of the end must come, for OpenCV shows what there is. (Coded data never holds it.)
ImageHeader read_jpeg(const std::string& path, const FileBytes& bytes) {
  ImageHeader header;
  for (std::size_t place = 2; place + 9 < bytes.size();) {
    const std::uint8_t marker = bytes.at(place + 1);
    if (bytes.at(place) != 0xff) break;
    if (marker == 0xff) {  // a byte that fills up
      ++place;
      continue;
    }
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame)
      header = {bytes.big_endian(place + 7, 2), bytes.big_endian(place + 5, 2), 8, true, true, true};
    if (marker == 0xda) {
      while (bytes.big_endian(place, 2) != 0xffd9 && place < bytes.size()) ++place;
      if (place < bytes.size()) return header;
      break;
    }
    place += 2 + bytes.big_endian(place + 2, 2);
  }
  throw Error(path + " is damaged: its end is missing, or a marker before that");
}

bool is_pnm(const FileBytes& bytes) {
  return bytes.at(0) == 'P' && bytes.at(1) >= '1' && bytes.at(1) <= '6' && std::isspace(bytes.at(2)) != 0;
}

/// P1 to P3: numbers as text, each of a digit and a blank at least (bits need no blank); P4 to P6: binary.
ImageHeader read_pnm(const FileBytes& bytes) {
  const int kind = bytes.at(1) - '0';
  std::size_t place = 2;
  const auto number = [&]() -> std::int64_t {
    while (place < bytes.size() && (std::isspace(bytes.at(place)) != 0 || bytes.at(place) == '#')) {
      if (bytes.at(place) == '#') {
        while (place < bytes.size() && bytes.at(place) != '\n') ++place;
      } else {
        ++place;
      }
    }
    std::int64_t value = 0;
    for (; std::isdigit(bytes.at(place)) != 0; ++place) {
      value = std::min<std::int64_t>(10 * value + bytes.at(place) - '0', INT32_MAX);
    }
    return value;
  };
  ImageHeader header;
  header.is_compressed = false;
  header.width = number();
  header.height = number();
  header.is_plain = true;
  const std::uint64_t samples = kind == 3 || kind == 6 ? 3 : 1;
  if (kind == 4) {
    header.bits_per_pixel = 1;
  } else if (kind == 1) {
    header.bits_per_pixel = 8;
  } else {
    const bool is_wide = kind <= 3 || number() > 255;
    header.bits_per_pixel = (is_wide ? 16 : 8) * samples;
  }
  return header;
}

}  // namespace

void check_is_image(const std::string& path, const std::vector<std::uint8_t>& first_bytes) {
  const FileBytes bytes(first_bytes);
  if (is_png(bytes) || is_jpeg(bytes) || is_bmp(bytes) || is_tiff(first_bytes) || is_pnm(bytes)) return;
  throw Error(path + " is no image that can be read: it is neither a PNG, JPEG, BMP, TIFF nor PNM file");
}

ImageHeader read_image_header(const std::string& path, const std::vector<std::uint8_t>& content) {
  const FileBytes bytes(content);
  if (is_png(bytes)) return read_png(bytes);
  if (is_jpeg(bytes)) return read_jpeg(path, bytes);
  if (is_bmp(bytes)) return read_bmp(bytes);
  return is_pnm(bytes) ? read_pnm(bytes) : read_tiff_header(path);
}

Size diagram_size(const std::string& path, std::int64_t width, std::int64_t height) {
  try {
    return {width, height};
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

void check_pixels(const std::string& path, const ImageHeader& header, std::uint64_t file_bytes) {
  const double bits = static_cast<double>(header.width) * static_cast<double>(header.height) *
                      static_cast<double>(header.bits_per_pixel);
  // No other method in use comes near Deflate on pictures.
  const double packed =
      std::floor(std::floor(bits / 8) / static_cast<double>(header.is_compressed ? greatest_compression : 1));
  if (header.width > 0 && header.height > 0 && packed <= static_cast<double>(file_bytes)) return;
  throw Error(fmt::format("{} is no image that can be read: its {} bytes cannot hold {} x {} pixels", path,
                          file_bytes, header.width, header.height));
}

}  // namespace vorocl::command
