#include "app/outputs/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <sstream>

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

Journal::Journal(const std::string& path, const std::string& run)
    : path_(path), run_(run), is_there_(is_file(path)) {
  if (!is_there_) return;
  lock();
  read();
}

void Journal::lock() {
  if (!lock_.take(path_)) refuse_other();
}

void Journal::refuse_other() const { throw Error("another run is writing " + path_); }

/// The lines of the file without their checksums.
std::vector<std::string> Journal::read_sealed_lines() {
  std::vector<std::string> lines;
  for (const std::string& there : read_lines(path_, "journal").whole) {
    lines.push_back(there.substr(0, there.rfind(' ')));
    if (lines.front() != title) break;
    if (sealed(lines.back(), hash_) != there) refuse_damage();
  }
  return lines;
}

void Journal::read() {
  const std::vector<std::string> there = read_sealed_lines(), head = head_of(run_);
  if (there.empty() || there.front() != title)
    throw Error(path_ + " is no journal of a run; " + how_to_start_again(path_));
  const auto end = std::find(there.begin(), there.end(), end_of_run);
  const std::vector<std::string> head_there(there.begin(), end == there.end() ? end : end + 1);
  if (head_there != head) refuse_run(first_not_in(head, head_there), first_not_in(head_there, head));
  steps_.assign(end + 1, there.end());
}

void Journal::refuse_run(const std::string& there, const std::string& here) const {
  throw Error(fmt::format("{} is of another run: there {}, here {}; give its options, or {}", path_, there,
                          here, how_to_start_again(path_)));
}

void Journal::refuse_damage() const { throw Error(path_ + " is damaged; " + how_to_start_again(path_)); }

void Journal::begin(const std::vector<std::string>& outputs, const std::vector<std::string>& steps) {
  if (!is_there_ && is_file(path_)) refuse_other();  // which has begun since
  for (const std::string& part : outputs) {
    if (!is_there_ && is_file(part)) {
      throw Error(fmt::format(
          "{0} is there, and no {1} that says of which run it is; remove {0} to start again", part, path_));
    }
  }
  hash_ = {};
  std::string text = sealed_text(head_of(run_), hash_);
  text += sealed_text(steps, hash_);
  bytes_ = text.size();
  if (is_there_) return;
  GrowingFile journal{OutputFile(path_)};
  journal << text;
  journal.finish();
  lock();
}

void Journal::append(const std::vector<std::string>& lines) {
  Hash hash = hash_;
  const std::string text = sealed_text(lines, hash);
  if (truncate(path_.c_str(), static_cast<off_t>(bytes_)) != 0) {
    throw Error("writing " + path_ + " failed: " + reason(errno));
  }
  append_to_file(path_, text);
  hash_ = hash;
  bytes_ += text.size();
}

void Journal::open(const std::function<void()>& output) const {
  try {
    output();
  } catch (const Error& error) {
    if (!is_there_) throw;  // nothing was left
    throw Error(std::string(error.what()) + "; " + how_to_start_again(path_));
  }
}

void Journal::remove() {
  if (unlink(path_.c_str()) != 0) throw Error("removing " + path_ + " failed: " + reason(errno));
}

std::string journal_path(const std::string& output) { return output + ".journal"; }

void refuse_journal(const std::string& path) {
  if (!is_file(path)) return;
  throw Error(path + " says that a run with --resume can go on; give --resume, or " +
              how_to_start_again(path));
}

}  // namespace vorocl::command
