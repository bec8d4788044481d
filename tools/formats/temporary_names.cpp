#include "formats/temporary_names.hpp"

#include <unistd.h>

#include <atomic>
#include <climits>
#include <cstring>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// A signal handler can neither lock nor free: names are copied into memory that is always there.
struct Slot {
  std::atomic<bool> taken{false};
  std::atomic<bool> holds_name{false};
  char name[PATH_MAX];
};

constexpr std::size_t slots = 64;  // a run has some ten outputs
Slot all[slots];

std::size_t take_slot() {
  for (std::size_t i = 0; i < slots; ++i) {
    if (!all[i].taken.exchange(true)) return i;
  }
  throw Error("too many files are written at once");
}

}  // namespace

TemporaryName::TemporaryName(const std::string& path) : path_(path) {
  if (path.size() >= PATH_MAX) throw Error(path + ": this path is too long");
  slot_ = take_slot();
  std::memcpy(all[slot_].name, path.c_str(), path.size() + 1);
  all[slot_].holds_name = true;
}

TemporaryName::~TemporaryName() {
  all[slot_].holds_name = false;
  all[slot_].taken = false;
}

void remove_temporary_files() noexcept {
  for (const Slot& slot : all) {
    if (slot.holds_name) unlink(slot.name);
  }
  for (const Slot& slot : all) {
    if (slot.holds_name) rmdir(slot.name);
  }
}

}  // namespace vorocl::command
