#include "formats/images/png.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <opencv2/core/mat.hpp>
#include <string_view>
#include <vector>

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

/// Rows as PNG has them: the number of the filter "up", and each value, red first, less that above it.
template <int channels>
Bytes filtered(const cv::Mat& picture, int first, int end) {
  const Bytes nothing(static_cast<std::size_t>(picture.cols) * channels, 0);
  Bytes rows((nothing.size() + 1) * static_cast<std::size_t>(end - first));
  std::uint8_t* to = rows.data();
  for (int y = first; y < end; ++y) {
    const std::uint8_t* here = picture.ptr(y);
    const std::uint8_t* above = y > 0 ? picture.ptr(y - 1) : nothing.data();
    *to++ = 2;
    for (int x = 0; x < picture.cols; ++x, here += channels, above += channels) {
      for (int i = channels - 1; i >= 0; --i) *to++ = static_cast<std::uint8_t>(here[i] - above[i]);
    }
  }
  return rows;
}

/// Some rows of a picture, compressed: a part of a stream of zlib's.
struct Strip {
  Bytes deflated;
  uLong sum = 0;  // of what was deflated, and its bytes
  std::size_t bytes = 0;
};

Strip deflated(Bytes&& rows, int strategy, bool is_last) {
  constexpr std::size_t flushed = 16;  // bytes at most that end a strip
  Strip strip{Bytes(compressBound(static_cast<uLong>(rows.size())) + flushed),
              adler32_z(1, rows.data(), rows.size()), rows.size()};
  constexpr int quickly = 1, without_frame = -15, memory_level = 8;
  z_stream stream = {};
  if (deflateInit2(&stream, quickly, Z_DEFLATED, without_frame, memory_level, strategy) != Z_OK)
    throw std::bad_alloc();
  stream.next_in = rows.data();
  stream.avail_in = static_cast<uInt>(rows.size());
  stream.next_out = strip.deflated.data();
  stream.avail_out = static_cast<uInt>(strip.deflated.size());
  deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  strip.deflated.resize(strip.deflated.size() - stream.avail_out);
  strip.deflated.shrink_to_fit();
  deflateEnd(&stream);
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
      // Grey ones are masks, of long runs.
      strips[static_cast<std::size_t>(i)] =
          is_grey ? deflated(filtered<1>(picture, first, end), Z_RLE, end == picture.rows)
                  : deflated(filtered<3>(picture, first, end), Z_DEFAULT_STRATEGY, end == picture.rows);
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
