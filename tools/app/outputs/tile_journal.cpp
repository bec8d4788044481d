#include "app/outputs/tile_journal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <utility>

namespace vorocl::command {

namespace {

// The first words of lines. Tiles count from the line on that says how long the sums are that hold them.
const std::string seeds_word = "seeds ", tile_word = "tile", sums_word = "sums", last_line = "last";

std::string line_of(const TileJournal::Entry& entry) {
  return fmt::format("{} {} {}", tile_word, entry.number, fmt::join(entry.bytes, " "));
}

std::string line_of_sums(std::size_t bytes) { return fmt::format("{} {}", sums_word, bytes); }

}  // namespace

TileJournal::TileJournal(const std::string& path, const std::string& run) : Journal(path, run) {
  std::vector<Entry> entries;
  for (const std::string& line : steps()) {
    std::istringstream text(line);
    std::string word;
    text >> word;
    if (line.rfind(seeds_word, 0) == 0 && seeds_.empty()) {
      seeds_ = line;
    } else if (word == tile_word) {
      Entry entry;
      text >> entry.number;
      for (std::uint64_t bytes = 0; text >> bytes;) entry.bytes.push_back(bytes);
      if (line_of(entry) != line) refuse_damage();
      entries.push_back(std::move(entry));
    } else if (word == sums_word) {
      text >> bytes_of_sums_;
      if (line_of_sums(bytes_of_sums_) != line) refuse_damage();
      for (Entry& entry : entries) {
        tiles_.push_back(entry.number);
        entries_.push_back(std::move(entry));
      }
      entries.clear();
    } else if (line == last_line) {
      is_last_ = true;
    } else {
      refuse_damage();
    }
  }
}

void TileJournal::begin(const std::vector<std::string>& parts, const std::string& seeds) {
  const std::string here = seeds_word + seeds;
  if (is_there() && seeds_ != here) refuse_run('"' + seeds_ + '"', '"' + here + '"');
  std::vector<std::string> counting = is_there() ? steps() : std::vector{here};
  while (counting.back().rfind(tile_word, 0) == 0) counting.pop_back();  // no sums hold these
  Journal::begin(parts, counting);
}

std::optional<KeptTiles> TileJournal::kept(std::size_t output) const {
  if (!is_there()) return std::nullopt;
  KeptTiles kept;
  kept.is_complete = is_last_;
  for (const Entry& entry : entries_) {
    if (output >= entry.bytes.size()) refuse_damage();
    kept.tiles.push_back({entry.number, entry.bytes[output]});
  }
  return kept;
}

std::optional<Kept> TileJournal::kept_sums() const {
  if (!is_there()) return std::nullopt;
  return Kept{bytes_of_sums_, false};
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

}  // namespace vorocl::command
