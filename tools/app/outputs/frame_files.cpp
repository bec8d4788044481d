#include "app/outputs/frame_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "formats/files.hpp"

namespace vorocl::command {

namespace fs = std::filesystem;

std::string collection_path(const FileRequest& request) {
  if (extension_of(request.path) != ".vti") return {};
  const fs::path pattern(request.path);
  const NumberedName stem(pattern.stem().string());
  std::string name = stem.before.substr(0, stem.before.find_last_not_of("-_.") + 1) + stem.after;
  if (name.empty()) name = request.kind.option.substr(2);
  return (pattern.parent_path() / (name + ".pvd")).string();
}

FrameFiles::FrameFiles(const FileRequest& request, FrameJournal* journal) : request_(request) {
  if (request.is_long_table()) {
    table_ = open_table(request.path, "frame,timestep," + request.kind.table()->columns, journal);
    return;
  }
  files_.emplace(request.path);
  const std::string collection = collection_path(request);
  if (!collection.empty()) collection_.emplace(collection);
}

void FrameFiles::add(int frame, std::int64_t time, Measures& measures) {
  if (table_) {
    request_.kind.table()->add_rows(*table_, fmt::format("{},{},", frame, time), measures);
    return;
  }
  request_.kind.write(files_->file(frame), measures);
  go_on_from(frame, time);
}

void FrameFiles::go_on_from(int frame, std::int64_t time) {
  if (collection_) listed_.push_back({time, fs::path(files_->path(frame)).filename().string()});
}

void FrameFiles::finish() {
  if (table_) table_->finish();
  if (collection_) write_pvd(*collection_, listed_);
}

}  // namespace vorocl::command
