#include <dirent.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <ctime>

#include "formats/output_file.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// A signal handler can neither lock nor free: names are copied into memory that is always there.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<bool> holds_name{false};
  TemporaryName::Kind kind{};
  char name[PATH_MAX];
};

constexpr std::size_t slots = 64;  // a run has some ten outputs
Slot all[slots];
std::atomic<bool> run_ends{false};

std::size_t take_slot() {
  for (std::size_t i = 0; i < slots; ++i) {
    if (!all[i].taken.exchange(true)) return i;
  }
  throw Error("too many files are written at once");
}

/// Removes the files in a folder. readdir() may lock and allocate: the system itself is asked.
void remove_files_in(const char* folder) noexcept {
  const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return;
  alignas(dirent64) char entries[4096];
  for (bool some = true; some;) {
    some = false;
    lseek(descriptor, 0, SEEK_SET);
    for (long bytes = 0; (bytes = syscall(SYS_getdents64, descriptor, entries, sizeof entries)) > 0;) {
      for (long at = 0; at < bytes;) {
        const auto* const entry = reinterpret_cast<const dirent64*>(entries + at);
        some = unlinkat(descriptor, entry->d_name, 0) == 0 || some;
        at += entry->d_reclen;
      }
    }
  }
  close(descriptor);
}

}  // namespace

TemporaryName::TemporaryName(const std::string& path, Kind kind) : path_(path) {
  if (path.size() >= PATH_MAX) throw Error(path + ": this path is too long");
  slot_ = take_slot();
  std::memcpy(all[slot_].name, path.c_str(), path.size() + 1);
  all[slot_].kind = kind;
  all[slot_].holds_name = true;
  while (run_ends) pause();  // what is made now, nobody would remove
}

TemporaryName::~TemporaryName() {
  all[slot_].holds_name = false;
  all[slot_].taken = false;
}

void remove_temporary_files() noexcept {
  run_ends = true;
  // Another thread may have a name, and be about to make the file.
  constexpr timespec meanwhile = {0, 2000000};
  nanosleep(&meanwhile, nullptr);
  for (const Slot& slot : all) {
    if (!slot.holds_name) continue;
    unlink(slot.name);
    if (slot.kind == TemporaryName::Kind::folder) remove_files_in(slot.name);
  }
  for (const Slot& slot : all) {
    if (!slot.holds_name) continue;
    // Other threads may still write into a folder of ours.
    constexpr int most_tries = 1000;
    for (int tries = 0; rmdir(slot.name) != 0 && errno == ENOTEMPTY && tries < most_tries; ++tries) {
      if (slot.kind != TemporaryName::Kind::folder) break;
      remove_files_in(slot.name);
    }
  }
}

}  // namespace vorocl::command
