#include "formats/trajectory/line_reader.hpp"

#include <archive.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>

#include "formats/files.hpp"

namespace vorocl::command {

namespace {

constexpr std::size_t block_bytes = 1 << 20;
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
constexpr std::array<std::string_view, 3> starts_of_packed = {
    "BZh",
    "\375"
    "7zX",
    "(\265/\375"};  // which libarchive knows for sure

}  // namespace

struct LineReader::Packed {
  /// What libarchive asks for.
  static la_ssize_t read(archive*, void* data, const void** bytes) {
    auto& packed = *static_cast<Packed*>(data);
    *bytes = packed.block.data();
    return gzread(packed.file, packed.block.data(), static_cast<unsigned>(packed.block.size()));
  }

  gzFile_s* file;
  std::array<char, 1 << 16> block;
};

LineReader::LineReader(const std::string& path) : path_(path), buffer_(block_bytes) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) file_.reset(gzopen(path.c_str(), "rb"));
  if (!file_) {
    open_to_read(path);  // for its reasons
    throw Error("cannot read " + path);
  }
  std::string start;
  for (int byte = 0; start.size() < 4 && (byte = gzgetc(file_.get())) != -1;)
    start += static_cast<char>(byte);
  for (auto byte = start.rbegin(); byte != start.rend(); ++byte)
    gzungetc(static_cast<unsigned char>(*byte), file_.get());
  if (std::none_of(starts_of_packed.begin(), starts_of_packed.end(),
                   [&](std::string_view magic) { return start.rfind(magic, 0) == 0; })) {
    return;
  }
  packed_ = std::make_shared<Packed>(Packed{file_.get(), {}});
  unpacker_.reset(archive_read_new());
  archive* const unpacker = unpacker_.get();
  archive_entry* whole = nullptr;
  if (unpacker == nullptr) throw std::bad_alloc();
  archive_read_support_filter_bzip2(unpacker);
  archive_read_support_filter_xz(unpacker);
  archive_read_support_filter_zstd(unpacker);
  archive_read_support_format_raw(unpacker);
  if (archive_read_open(unpacker, packed_.get(), nullptr, Packed::read, nullptr) != ARCHIVE_OK ||
      archive_read_next_header(unpacker, &whole) != ARCHIVE_OK) {
    throw damaged();
  }
}

void LineReader::Close::operator()(gzFile_s* file) const { gzclose(file); }
void LineReader::Close::operator()(archive* unpacker) const { archive_read_free(unpacker); }

bool LineReader::is_compressed() const { return unpacker_ || gzdirect(file_.get()) == 0; }

bool LineReader::next() {
  if (repeat_) {
    repeat_ = false;
    return true;
  }
  std::size_t searched = 0;
  for (;;) {
    const char* const rest = buffer_.data() + begin_;
    const std::size_t length = end_ - begin_;
    if (const void* const feed = std::memchr(rest + searched, '\n', length - searched)) {
      set_line(static_cast<std::size_t>(static_cast<const char*>(feed) - rest));
      ++begin_;
      return true;
    }
    if (at_end_) {
      if (length == 0) return false;
      set_line(length);
      broken_off_ = true;
      return true;
    }
    searched = length;
    read_block();
  }
}

void LineReader::set_line(std::size_t length) {
  line_ = std::string_view(buffer_.data() + begin_, length);
  begin_ += length;
  ++number_;
  if (number_ == 1 && line_.substr(0, byte_order_mark.size()) == byte_order_mark) {
    line_.remove_prefix(byte_order_mark.size());
  }
}

void LineReader::read_block() {
  if (end_ - begin_ == buffer_.size()) {
    throw error_at(number_ + 1,
                   "the line is longer than a mebibyte; this is no text file of points or particles");
  }
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const auto room = static_cast<unsigned>(buffer_.size() - end_);
  char* const to = buffer_.data() + end_;
  const la_ssize_t read =
      unpacker_ ? archive_read_data(unpacker_.get(), to, room) : gzread(file_.get(), to, room);
  const auto count = static_cast<std::size_t>(std::max<la_ssize_t>(read, 0));
  end_ += count;
  bytes_read_ += count;
  int code = Z_OK;
  gzerror(file_.get(), &code);
  if (code == Z_ERRNO) throw error_at(number_ + 1, "reading failed; is the disk or the connection in order?");
  if (code != Z_OK || read < 0) throw damaged();
  at_end_ = count < room;
}

bool LineReader::skip(std::size_t count) {
  while (count > 0 && next()) --count;
  return count == 0;
}

bool LineReader::next_filled() {
  while (next()) {
    if (!trimmed(line_).empty()) return true;
  }
  return false;
}

std::optional<std::uintmax_t> LineReader::bytes_left() const {
  // Asked anew each time: a simulation may still be writing the file.
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path_, code);
  if (code) return std::nullopt;
  const std::uintmax_t position =
      is_compressed() ? static_cast<std::uintmax_t>(gzoffset(file_.get())) : bytes_read_ - (end_ - begin_);
  return size > position ? size - position : 0;
}

Error LineReader::error(const std::string& what) const {
  const char* const hint = broken_off_ ? " (the file ends in this line: it seems cut off)" : "";
  return error_at(std::max<std::size_t>(number_, 1), what + hint);
}

Error LineReader::damaged() const {
  return error_at(number_ + 1, "what is packed in it is damaged, or cut off");
}

Error LineReader::error_at(std::size_t number, const std::string& what) const {
  std::string text = path_ + ":" + std::to_string(number) + ": " + what;
  std::replace(text.begin(), text.end(), '\0', '?');  // at which what() would end
  return Error(text);
}

std::string_view take_field(std::string_view& text) {
  const char* const end = text.data() + text.size();
  const char* const start = std::find_if_not(text.data(), end, is_blank);
  const char* const stop = std::find_if(start, end, is_blank);
  text = std::string_view(stop, static_cast<std::size_t>(end - stop));
  return std::string_view(start, static_cast<std::size_t>(stop - start));
}

void split_fields(std::string_view text, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::string_view field = take_field(text); !field.empty(); field = take_field(text)) {
    fields.push_back(field);
  }
}

void check_end(const LineReader& lines, std::string_view rest) {
  const std::string_view more = trimmed(rest);
  if (!more.empty()) throw lines.error(shown(more) + " is more than belongs in this line");
}

std::string shown(std::string_view text) {
  std::string piece(text.substr(0, 40));
  std::replace_if(
      piece.begin(), piece.end(), [](unsigned char c) { return c < ' '; }, '?');
  return '"' + piece + (text.size() > piece.size() ? "..." : "") + '"';
}

}  // namespace vorocl::command
