#include "app/outputs/tile_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <utility>

#include "formats/files.hpp"
#include "formats/output_file.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

const std::string title = "VoroCL journal", end_of_run = "steps";

/// For errors: what to remove of the run that a journal is of, which cannot go on.
std::string how_to_start_again(const std::string& journal) {
  return "remove " + journal + " and the .part files of its outputs to start again";
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// The lines of the journal before those of its steps.
std::vector<std::string> head_of(const std::string& run) {
  std::vector<std::string> head = {title};
  std::istringstream text(run);
  for (std::string line; std::getline(text, line);) head.push_back(line);
  head.push_back(end_of_run);
  return head;
}

/// The line with the checksum, in which it takes part.
std::string sealed(const std::string& line, Hash& hash) {
  hash.add_text(line);
  hash.add_text("\n");
  return fmt::format("{} {:016x}", line, hash.value());
}

/// These lines as the file has them.
std::string sealed_text(const std::vector<std::string>& lines, Hash& hash) {
  std::string text;
  for (const std::string& line : lines) text += sealed(line, hash) + "\n";
  return text;
}

/// The first line that the other lines do not have.
std::string first_not_in(const std::vector<std::string>& others, const std::vector<std::string>& lines) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return std::find(others.begin(), others.end(), line) == others.end();
  });
  return found == lines.end() ? "nothing" : "\"" + *found + "\"";
}

// The first words of lines. Tiles count from the line on that says how long the sums are that hold them.
const std::string seeds_word = "seeds ", tile_word = "tile", sums_word = "sums", last_line = "last";

std::string line_of(const TileJournal::Entry& entry) {
  return fmt::format("{} {} {}", tile_word, entry.number, fmt::join(entry.bytes, " "));
}

std::string line_of_sums(std::size_t bytes) { return fmt::format("{} {}", sums_word, bytes); }

}  // namespace

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool FileLock::take(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return errno != ENOENT;  // what reads or writes it says what is wrong
  struct stat locked = {}, named = {};
  const bool is_free = flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  const bool is_named = fstat(file, &locked) == 0 && stat(path.c_str(), &named) == 0 &&
                        locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = file;
  return is_free && is_named;
}

TileJournal::TileJournal(const std::string& path, const std::string& run)
    : path_(path), run_(run), is_there_(is_file(path)) {
  if (!is_there_) return;
  lock();
  read();
  read_tiles();
}

void TileJournal::lock() {
  if (!lock_.take(path_)) refuse_other();
}

void TileJournal::refuse_other() const { throw Error("another run is writing " + path_); }

void TileJournal::refuse(const std::string& what) const {
  throw Error(path_ + " is " + what + "; " + how_to_start_again(path_));
}

void TileJournal::read() {
  std::vector<std::string> there;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path_, ignored)) refuse("no journal of a run");
  std::ifstream file = open_to_read(path_);
  for (std::string line; std::getline(file, line) && !file.eof();) {  // the last one may be cut off
    there.push_back(line.substr(0, line.rfind(' ')));
    if (there.front() != title) break;
    if (sealed(there.back(), hash_) != line) refuse("damaged");
  }
  if (there.empty() || there.front() != title) refuse("no journal of a run");
  const std::vector<std::string> head = head_of(run_);
  const auto end = std::find(there.begin(), there.end(), end_of_run);
  const std::vector<std::string> head_there(there.begin(), end == there.end() ? end : end + 1);
  if (head_there != head) refuse_run(first_not_in(head, head_there), first_not_in(head_there, head));
  steps_.assign(end + 1, there.end());
}

void TileJournal::read_tiles() {
  std::vector<Entry> entries;
  for (const std::string& line : steps_) {
    std::istringstream text(line);
    std::string word;
    text >> word;
    if (line.rfind(seeds_word, 0) == 0 && seeds_.empty()) {
      seeds_ = line;
    } else if (word == tile_word) {
      Entry entry;
      text >> entry.number;
      for (std::uint64_t bytes = 0; text >> bytes;) entry.bytes.push_back(bytes);
      if (line_of(entry) != line) refuse("damaged");
      entries.push_back(std::move(entry));
    } else if (word == sums_word) {
      text >> bytes_of_sums_;
      if (line_of_sums(bytes_of_sums_) != line) refuse("damaged");
      std::move(entries.begin(), entries.end(), std::back_inserter(tiles_));
      entries.clear();
    } else if (line == last_line) {
      is_last_ = true;
    } else {
      refuse("damaged");
    }
  }
}

void TileJournal::refuse_run(const std::string& there, const std::string& here) const {
  throw Error(fmt::format("{} is of another run: there {}, here {}; give its options, or {}", path_, there,
                          here, how_to_start_again(path_)));
}

void TileJournal::begin(const std::vector<std::string>& parts, const std::string& seeds) {
  const std::string here = seeds_word + seeds;
  if (is_there_ && seeds_ != here) refuse_run('"' + seeds_ + '"', '"' + here + '"');
  if (!is_there_ && is_file(path_)) refuse_other();  // which has begun since
  for (const std::string& part : parts) {
    if (!is_there_ && is_file(part)) {
      throw Error(fmt::format(
          "{0} is there, and no {1} that says of which run it is; remove {0} to start again", part, path_));
    }
  }
  std::vector<std::string> counting = is_there_ ? steps_ : std::vector{here};
  while (counting.back().rfind(tile_word, 0) == 0) counting.pop_back();  // no sums hold these
  hash_ = {};
  std::string text = sealed_text(head_of(run_), hash_);
  text += sealed_text(counting, hash_);
  bytes_ = text.size();
  if (is_there_) return;
  GrowingFile journal{OutputFile(path_)};
  journal << text;
  journal.finish();
  lock();
}

std::optional<KeptTiles> TileJournal::kept(std::size_t output) const {
  if (!is_there_) return std::nullopt;
  KeptTiles kept;
  kept.is_complete = is_last_;
  for (const Entry& entry : tiles_) {
    if (output >= entry.bytes.size()) refuse("damaged");
    kept.tiles.push_back({entry.number, entry.bytes[output]});
  }
  return kept;
}

std::optional<Kept> TileJournal::kept_sums() const {
  if (!is_there_) return std::nullopt;
  return Kept{bytes_of_sums_, is_last_};
}

void TileJournal::complete(const std::vector<Entry>& entries, std::size_t bytes_of_sums) {
  std::vector<std::string> lines;
  lines.reserve(entries.size() + 1);
  for (const Entry& entry : entries) lines.push_back(line_of(entry));
  lines.push_back(line_of_sums(bytes_of_sums));
  append(lines);
}

void TileJournal::finish() {
  if (!is_last_) append({last_line});
  is_last_ = true;
}

void TileJournal::append(const std::vector<std::string>& lines) {
  Hash hash = hash_;
  const std::string text = sealed_text(lines, hash);
  if (truncate(path_.c_str(), static_cast<off_t>(bytes_)) != 0) throw failed("writing", path_);
  append_to_file(path_, text);
  hash_ = hash;
  bytes_ += text.size();
}

void TileJournal::open(const std::function<void()>& output) const {
  try {
    output();
  } catch (const Error& error) {
    if (!is_there_) throw;  // nothing was left
    throw Error(std::string(error.what()) + "; " + how_to_start_again(path_));
  }
}

void TileJournal::remove() {
  if (unlink(path_.c_str()) != 0) throw failed("removing", path_);
}

std::string journal_path(const std::string& output) { return output + ".journal"; }

void refuse_journal(const std::string& path) {
  if (!is_file(path)) return;
  throw Error(path + " says that a run with --resume can go on; give --resume, or " +
              how_to_start_again(path));
}

}  // namespace vorocl::command
