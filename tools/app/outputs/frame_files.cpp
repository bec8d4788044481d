#include "app/outputs/frame_files.hpp"

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

FrameFiles::FrameFiles(const FileRequest& request) : request_(request), files_(request.path) {
  const std::string collection = collection_path(request);
  if (!collection.empty()) collection_.emplace(collection);
}

void FrameFiles::add(int frame, std::int64_t time, Measures& measures) {
  const OutputFile file = files_.file(frame);
  request_.kind.write(file, measures);
  if (collection_) listed_.push_back({time, fs::path(file.path()).filename().string()});
}

void FrameFiles::finish() const {
  if (collection_) write_pvd(*collection_, listed_);
}

}  // namespace vorocl::command
