#include "formats/planes/placed_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

PlacedFile::PlacedFile(const std::string& path, std::uint64_t bytes, std::string header)
    : output_(path), bytes_(bytes), header_(std::move(header)) {
  output_.require_file("a plane");
  // A part that is there has taken its space.
  if (access(part_path().c_str(), F_OK) != 0) require_space(path, bytes_);
}

void PlacedFile::open() {
  file_ = std::make_unique<GrowingFile>(output_);
  begin();
}

void PlacedFile::open_part(const std::optional<KeptTiles>& kept) {
  std::optional<Kept> same;
  // A run that ended before it had its space has left what it had.
  if (kept) same = Kept{kept->tiles.empty() ? 0 : static_cast<std::size_t>(bytes_), kept->is_complete};
  file_ = std::make_unique<GrowingFile>(output_, same);
  begin();
}

void PlacedFile::join() {
  file_ = std::make_unique<GrowingFile>(output_, Kept{static_cast<std::size_t>(bytes_), false});
}

void PlacedFile::begin() {
  if (file_->is_finished()) return;
  int code = EINTR;
  while (code == EINTR) code = posix_fallocate(file_->descriptor(), 0, static_cast<off_t>(bytes_));
  if (code == 0) return write_at(0, header_.data(), header_.size());
  file_.reset();
  throw Error("no " + std::to_string(bytes_) + " bytes can be reserved for " + output_.path() + ": " +
              reason(code));
}

void PlacedFile::write_at(std::uint64_t place, const void* bytes, std::size_t count) {
  if (file_->is_finished()) return;
  if (write_all_at(file_->descriptor(), static_cast<const char*>(bytes), count, place)) return;
  throw failed("writing", output_.path());
}

void PlacedFile::read_at(std::uint64_t place, void* bytes, std::size_t count) {
  char* const first = static_cast<char*>(bytes);
  for (std::size_t done = 0; done < count;) {
    const ssize_t more =
        pread(file_->descriptor(), first + done, count - done, static_cast<off_t>(place + done));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) throw Error("reading " + output_.path() + " failed: " + reason(more < 0 ? errno : EIO));
    done += static_cast<std::size_t>(more);
  }
}

}  // namespace vorocl::command
