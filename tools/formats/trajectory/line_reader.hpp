// The lines of a text file, one at a time, with their numbers for what is wrong in them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/values.hpp"
#include "vorocl/error.hpp"

struct archive;   // libarchive's
struct gzFile_s;  // zlib's

namespace vorocl::command {

/// Reads large blocks and hands out views into them. Works on pipes too, and reads what
/// gzip, bzip2, xz and zstd have packed.
class LineReader {
 public:
  /// Throws Error if the file cannot be read.
  explicit LineReader(const std::string& path);

  /// Goes to the next line; false at the end of the file. Throws Error for a line of more than a mebibyte, so
  /// that a file that is no text cannot fill the memory.
  bool next();

  /// The same, past lines that are blank.
  bool next_filled();

  /// Passes over so many lines; false if the file ends before. Throws as next().
  bool skip(std::size_t count);

  /// Lets next() give the present line once more.
  void unread() { repeat_ = true; }

  /// The present line without its line feed (a carriage return may stay: it counts as a blank everywhere).
  /// Valid until next().
  std::string_view line() const { return line_; }

  /// Its number from 1; the last line's at the end of the file.
  std::size_t number() const { return number_; }

  bool is_compressed() const;

  /// How much of the file comes after the present line, as it is stored; none where that is not known (a
  /// pipe).
  std::optional<std::uintmax_t> bytes_left() const;

  /// "FILE:LINE: what" for the present line, or for another one.
  Error error(const std::string& what) const;
  Error error_at(std::size_t number, const std::string& what) const;

 private:
  Error damaged() const;
  void read_block();
  void set_line(std::size_t length);

  struct Packed;
  struct Close {
    void operator()(gzFile_s* file) const;
    void operator()(archive* unpacker) const;
  };

  std::string path_;
  std::unique_ptr<gzFile_s, Close> file_;  // undoes what gzip did
  std::shared_ptr<Packed> packed_;         // which the next one reads; null, as that: nothing else is packed
  std::unique_ptr<archive, Close> unpacker_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  // of what is not handed out yet
  std::size_t end_ = 0;
  std::uintmax_t bytes_read_ = 0;
  bool at_end_ = false;
  bool repeat_ = false;
  bool broken_off_ = false;  // whether the present line ends with the file and not with a line feed
  std::string_view line_;
  std::size_t number_ = 0;
};

/// Takes the first field, up to a blank, off the text; empty if there is none.
std::string_view take_field(std::string_view& text);

/// All fields of the text, in the place of those that the list has.
void split_fields(std::string_view text, std::vector<std::string_view>& fields);

/// Throws Error unless nothing is left of the line.
void check_end(const LineReader& lines, std::string_view rest);

/// A piece of the file as an error shows it: in quotes, one short line of printable characters.
std::string shown(std::string_view text);

/// The number that a field is. Throws Error, which shows the field and says what it should be ("a finite x"),
/// if it is no finite number.
template <typename T>
T number_in(const LineReader& lines, std::string_view field, std::string_view what) {
  if (field.empty()) throw lines.error(std::string(what) + " is missing here");
  const std::optional<T> number = parse_number<T>(field);
  if (!number || !std::isfinite(static_cast<double>(*number))) {
    throw lines.error(shown(field) + " is not " + std::string(what));
  }
  return *number;
}

}  // namespace vorocl::command
