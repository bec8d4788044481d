#include "app/outputs/frame_journal.hpp"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "formats/files.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

FrameJournal::FrameJournal(const std::string& path, const std::string& run) : Journal(path, run) {
  if (!steps().empty()) last_ = entry_of(steps().back());
}

FrameJournal::Entry FrameJournal::entry_of(const std::string& line) const {
  Entry entry;
  std::istringstream text(line);
  std::string is_last;
  text >> entry.frame >> entry.seeds >> is_last;
  entry.is_last = is_last == "last";
  for (std::size_t bytes = 0; text >> bytes;) entry.tables.push_back(bytes);
  if (line_of(entry) != line || entry.frame < 0) refuse_damage();
  return entry;
}

std::string FrameJournal::line_of(const Entry& entry) {
  std::string line = fmt::format("{} {} {}", entry.frame, entry.seeds, entry.is_last ? "last" : "more");
  for (const std::size_t bytes : entry.tables) line += fmt::format(" {}", bytes);
  return line;
}

void FrameJournal::begin(const std::vector<std::string>& tables) {
  std::vector<std::string> parts;
  for (const std::string& path : tables) {
    const OutputFile table(path);
    table.require_file("--resume");
    parts.push_back(table.part_path());
  }
  Journal::begin(parts, steps());
}

std::unique_ptr<GrowingFile> FrameJournal::open_table(const std::string& path) {
  std::optional<Kept> kept;
  if (is_there()) kept.emplace();
  if (last_) {
    if (tables_.size() >= last_->tables.size()) refuse_damage();
    kept = Kept{last_->tables[tables_.size()], last_->is_last};
  }
  std::unique_ptr<GrowingFile> table;
  open([&] { table = std::make_unique<GrowingFile>(OutputFile(path), kept); });
  tables_.push_back(table.get());
  return table;
}

void FrameJournal::complete(int frame, std::uint64_t seeds) {
  Entry entry;
  entry.frame = frame;
  entry.seeds = seeds;
  for (GrowingFile* const table : tables_) entry.tables.push_back(table->sync());
  append({line_of(entry)});
  last_ = std::move(entry);
}

void FrameJournal::finish() {
  if (!last_ || last_->is_last) return;
  last_->is_last = true;
  append({line_of(*last_)});
}

bool is_new(const FrameJournal* journal) { return journal == nullptr || journal->last_frame() < 0; }

std::unique_ptr<GrowingFile> open_table(const std::string& path, FrameJournal* journal) {
  return journal != nullptr ? journal->open_table(path) : std::make_unique<GrowingFile>(OutputFile(path));
}

std::unique_ptr<GrowingFile> open_table(const std::string& path, const std::string& header,
                                        FrameJournal* journal) {
  auto table = open_table(path, journal);
  if (is_new(journal)) *table << header << "\n";
  return table;
}

}  // namespace vorocl::command
