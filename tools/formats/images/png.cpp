#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

#include "formats/images/pictures.hpp"
#include "formats/workers.hpp"

namespace vorocl::command {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t strip_bytes = std::size_t{1} << 20;

void put(Bytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// Its length, its type, what it holds, and a sum of the last two.
void write_chunk(GrowingFile& file, std::string_view type, const Bytes& content) {
  Bytes chunk;
  chunk.reserve(content.size() + 12);
  put(chunk, static_cast<std::uint32_t>(content.size()));
  chunk.insert(chunk.end(), type.begin(), type.end());
  chunk.insert(chunk.end(), content.begin(), content.end());
  put(chunk, static_cast<std::uint32_t>(crc32_z(0, chunk.data() + 4, chunk.size() - 4)));
  file.write(chunk.data(), chunk.size());
}

/// A row as PNG has it: the number of the filter "up", and each value, red first, less that above it.
template <int channels>
void filter_row(const std::uint8_t* here, const std::uint8_t* above, Bytes& row) {
  row[0] = 2;
  for (std::size_t at = 1; at < row.size(); at += channels, here += channels, above += channels) {
    for (int i = 0; i < channels; ++i)
      row[at + i] = static_cast<std::uint8_t>(here[channels - 1 - i] - above[channels - 1 - i]);
  }
}

/// Some rows of a picture, compressed: a part of a stream of zlib's.
struct Strip {
  Bytes deflated;
  uLong sum = 1;  // of what was deflated, and its bytes
  std::size_t bytes = 0;
};

/// Row by row, so that a strip needs little memory, which takes time to get.
template <int channels>
Strip deflated(const cv::Mat& picture, int first, int end) {
  constexpr int quickly = 1, without_frame = -15, memory_level = 8;
  constexpr int strategy = channels == 1 ? Z_RLE : Z_DEFAULT_STRATEGY;  // grey ones are masks, of long runs
  z_stream stream = {};
  if (deflateInit2(&stream, quickly, Z_DEFLATED, without_frame, memory_level, strategy) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> ended(&stream, deflateEnd);
  Strip strip;
  const Bytes nothing(static_cast<std::size_t>(picture.cols) * channels);
  Bytes row(nothing.size() + 1), room(std::size_t{1} << 14);
  for (int y = first; y < end; ++y) {
    filter_row<channels>(picture.ptr(y), y > 0 ? picture.ptr(y - 1) : nothing.data(), row);
    strip.sum = adler32_z(strip.sum, row.data(), row.size());
    strip.bytes += row.size();
    stream.next_in = row.data();
    stream.avail_in = static_cast<uInt>(row.size());
    const int flush = y + 1 < end ? Z_NO_FLUSH : end < picture.rows ? Z_SYNC_FLUSH : Z_FINISH;
    do {
      stream.next_out = room.data();
      stream.avail_out = static_cast<uInt>(room.size());
      deflate(&stream, flush);
      strip.deflated.insert(strip.deflated.end(), room.data(), stream.next_out);
    } while (stream.avail_out == 0);
  }
  return strip;
}

}  // namespace

void write_png(const OutputFile& file, const cv::Mat& picture) {
  const bool is_grey = picture.channels() == 1;
  const std::size_t row_bytes = picture.total() * picture.elemSize() / static_cast<std::size_t>(picture.rows);
  const int strip_rows = static_cast<int>(std::clamp<std::size_t>(strip_bytes / row_bytes, 1, 1 << 15));
  const int count = (picture.rows + strip_rows - 1) / strip_rows;
  std::vector<Strip> strips(static_cast<std::size_t>(count));
  Workers workers(strips.size());
  for (int i = 0; i < count; ++i) {
    workers.add([&, i] {
      const int first = i * strip_rows, end = std::min(first + strip_rows, picture.rows);
      strips[static_cast<std::size_t>(i)] =
          is_grey ? deflated<1>(picture, first, end) : deflated<3>(picture, first, end);
    });
  }
  workers.wait();

  GrowingFile written(file);
  written << "\x89PNG\r\n\x1a\n";
  Bytes header;
  put(header, static_cast<std::uint32_t>(picture.cols));
  put(header, static_cast<std::uint32_t>(picture.rows));
  const std::uint8_t bits = 8, type = is_grey ? 0 : 2;
  header.insert(header.end(), {bits, type, 0, 0, 0});
  write_chunk(written, "IHDR", header);
  // The start and the end of zlib's stream are chunks of their own.
  write_chunk(written, "IDAT", {0x78, 0x01});
  uLong sum = 1;
  for (const Strip& strip : strips) {
    write_chunk(written, "IDAT", strip.deflated);
    sum = adler32_combine(sum, strip.sum, static_cast<z_off_t>(strip.bytes));
  }
  Bytes end;
  put(end, static_cast<std::uint32_t>(sum));
  write_chunk(written, "IDAT", end);
  write_chunk(written, "IEND", {});
  written.finish();
}

}  // namespace vorocl::command
