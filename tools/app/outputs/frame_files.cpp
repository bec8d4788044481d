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

FrameFiles::FrameFiles(const FileRequest& request) : request_(request) {
  if (request.is_long_table()) {
    table_.emplace(request.path);
    *table_ << "frame,timestep," << request.kind.table()->columns << "\n";
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
  const OutputFile file = files_->file(frame);
  request_.kind.write(file, measures);
  if (collection_) listed_.push_back({time, fs::path(file.path()).filename().string()});
}

void FrameFiles::finish() {
  if (table_) table_->finish();
  if (collection_) write_pvd(*collection_, listed_);
}

}  // namespace vorocl::command
