#include "app/outputs/journal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <sstream>
#include <utility>

#include "formats/files.hpp"
#include "formats/numbers.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

const std::string title = "VoroCL journal", end_of_run = "frames";

/// The lines of the journal before those of its frames.
std::vector<std::string> head_of(const std::string& run) {
  std::vector<std::string> head = {title};
  std::istringstream text(run);
  for (std::string line; std::getline(text, line);) head.push_back(line);
  head.push_back(end_of_run);
  return head;
}

/// The first line that the other lines do not have.
std::string first_not_in(const std::vector<std::string>& others, const std::vector<std::string>& lines) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return std::find(others.begin(), others.end(), line) == others.end();
  });
  return found == lines.end() ? "nothing" : "\"" + *found + "\"";
}

}  // namespace

Journal::Journal(const std::string& path, const std::string& run) : path_(path), run_(run) {
  std::error_code ignored;
  is_there_ = std::filesystem::exists(path_, ignored);
  if (is_there_) read();
}

void Journal::read() {
  const std::vector<std::string> there = read_lines(path_, "journal").whole, head = head_of(run_);
  if (there.empty() || there.front() != title) {
    throw Error(path_ + " is no journal of a run; " + how_to_start_again(path_));
  }
  const auto end = std::find(there.begin(), there.end(), end_of_run);
  const std::vector<std::string> head_there(there.begin(), end == there.end() ? end : end + 1);
  if (head_there != head) {
    throw Error(fmt::format("{} is of another run: there {}, here {}; give its options, or {}", path_,
                            first_not_in(head, head_there), first_not_in(head_there, head),
                            how_to_start_again(path_)));
  }
  if (there.size() > head.size()) last_ = entry_of(there.back());
}

Journal::Entry Journal::entry_of(const std::string& line) const {
  Entry entry;
  std::istringstream text(line);
  std::string is_last;
  text >> entry.frame >> entry.seeds >> is_last;
  entry.is_last = is_last == "last";
  for (std::size_t bytes = 0; text >> bytes;) entry.tables.push_back(bytes);
  if (line_of(entry) != line + "\n" || entry.frame < 0) {
    throw Error(path_ + " is damaged; " + how_to_start_again(path_));
  }
  return entry;
}

std::string Journal::line_of(const Entry& entry) {
  std::string line = fmt::format("{} {} {}", entry.frame, entry.seeds, entry.is_last ? "last" : "more");
  for (const std::size_t bytes : entry.tables) line += fmt::format(" {}", bytes);
  return line + "\n";
}

void Journal::begin(const std::vector<std::string>& tables) {
  for (const std::string& path : tables) {
    const OutputFile table(path);
    table.require_file("--resume");
    std::error_code ignored;
    if (!is_there_ && std::filesystem::exists(table.part_path(), ignored)) {
      throw Error(
          fmt::format("{0} is there, and no {1} that says of which run it is; remove {0} to start again",
                      table.part_path(), path_));
    }
  }
  GrowingFile journal{OutputFile(path_)};
  for (const std::string& line : head_of(run_)) journal << line << "\n";
  if (last_) journal << line_of(*last_);
  journal.finish();
}

std::unique_ptr<GrowingFile> Journal::open_table(const std::string& path) {
  std::optional<Kept> kept;
  if (is_there_) kept.emplace();
  if (last_) {
    if (tables_.size() >= last_->tables.size()) {
      throw Error(path_ + " is damaged: it lacks a table; " + how_to_start_again(path_));
    }
    kept = Kept{last_->tables[tables_.size()], last_->is_last};
  }
  try {
    auto table = std::make_unique<GrowingFile>(OutputFile(path), kept);
    tables_.push_back(table.get());
    return table;
  } catch (const Error& error) {
    if (!kept) throw;  // of a run that begins, nothing was left
    throw Error(std::string(error.what()) + "; " + how_to_start_again(path_));
  }
}

void Journal::complete(int frame, std::uint64_t seeds) {
  Entry entry;
  entry.frame = frame;
  entry.seeds = seeds;
  for (GrowingFile* const table : tables_) entry.tables.push_back(table->sync());
  append_to_file(path_, line_of(entry));
  last_ = std::move(entry);
}

void Journal::finish() {
  if (!last_ || last_->is_last) return;
  last_->is_last = true;
  append_to_file(path_, line_of(*last_));
}

void Journal::remove() {
  if (unlink(path_.c_str()) != 0) throw Error("removing " + path_ + " failed: " + reason(errno));
}

std::string how_to_start_again(const std::string& journal) {
  return "remove " + journal + " and the .part files of its tables to start again";
}

std::unique_ptr<GrowingFile> open_table(const std::string& path, const std::string& header,
                                        Journal* journal) {
  auto table =
      journal != nullptr ? journal->open_table(path) : std::make_unique<GrowingFile>(OutputFile(path));
  if (journal == nullptr || journal->last_frame() < 0) *table << header << "\n";
  return table;
}

}  // namespace vorocl::command
