// Labels or distances as a Zarr array (version 2): a folder with a file for each tile, compressed by zlib.
//
// Nothing in the folder needs a temporary name: the folder has one until it is complete, and a tile that is
// not known to be whole is written anew.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>

#include "formats/files.hpp"
#include "formats/output_file.hpp"
#include "formats/planes/plane_file.hpp"
#include "formats/values.hpp"
#include "formats/workers.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

namespace fs = std::filesystem;

constexpr int zlib_level = 1;            // higher ones take several times as long, for a few per cent
constexpr std::size_t most_workers = 4;  // each has a tile in memory, and what becomes of it

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

/// Where a link leads, for it stays when what it leads to is replaced.
std::string target_of(const std::string& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code)) return path;
  const fs::path target = fs::canonical(path, code);
  if (code) throw Error("cannot write " + path + ": it is a link that leads nowhere");
  return target.string();
}

/// Whether a file of an array has this name: ".zarray", or a chunk's "row.column".
bool is_of_array(const std::string& name) {
  const std::size_t dot = name.find('.');
  const auto is_number = [](const std::string& text) {
    return parse_number<std::uint64_t>(text).has_value();
  };
  return name == ".zarray" ||
         (dot != std::string::npos && is_number(name.substr(0, dot)) && is_number(name.substr(dot + 1)));
}

/// Throws Error unless all that is in the folder is of one array, which may be replaced.
void require_array(const std::string& folder) {
  const std::string refusal = "cannot write " + folder + ": it is there, and ";
  if (!is_there(folder + "/.zarray")) throw Error(refusal + "is no Zarr array; remove it");
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (!is_of_array(name)) {
      throw Error(fmt::format("{}has {} beside a Zarr array's chunks; remove it", refusal, name));
    }
  }
  if (code) throw Error("cannot read " + folder + ": " + code.message());
}

class ZarrPlane : public PlaneFile {
 public:
  ZarrPlane(const std::string& path, const Tiling& tiling, PlaneValues values)
      : path_(target_of(path)),
        part_path_(path_ + ".part"),
        tiling_(tiling),
        values_(values),
        chunk_shape_(tile_shape(tiling)) {
    if (!is_there(path_)) {
      OutputFile{path_};  // for its reasons where nothing can be made there
    } else {
      require_array(path_);
    }
    if (!is_there(part_path_)) require_space(path_, bytes_of_values(tiling_) / greatest_compression);
  }

  ~ZarrPlane() override {
    workers_.reset();  // what still writes into the folder
    std::error_code ignored;
    if (stays_ || folder_.empty()) return;
    // A second signal's handler may be at it too: what it takes away first ends a removal.
    constexpr int most_tries = 1000;
    for (int tries = 0; is_there(folder_) && tries < most_tries; ++tries) fs::remove_all(folder_, ignored);
  }

  void open() override {
    name_.emplace(random_path_beside(path_), TemporaryName::Kind::folder);
    folder_ = name_->path();
    make_folder();
  }

  void open_part(const std::optional<KeptTiles>& kept) override {
    stays_ = true;
    // Where a run ended between two renames, the folder has its name already.
    folder_ = kept && kept->is_complete && !is_there(part_path_) ? path_ : part_path_;
    const bool begins = !kept || (kept->tiles.empty() && !is_there(folder_));
    if (begins) make_folder();
    if (!kept) return;
    for (const WrittenTile& tile : kept->tiles) {
      if (!is_there(chunk(tile.number))) {
        throw Error(chunk(tile.number) + " is missing");
      }
    }
    if (folder_ != path_) write_metadata();
  }

  std::string part_path() const override { return part_path_; }

  void join() override {
    stays_ = true;
    folder_ = part_path();
  }

  WrittenTile write(const TileLabels& tile) override {
    // Compressing takes longer than making the tile.
    if (!workers_) workers_.emplace(most_workers);
    workers_->add([values = padded(tile, values_, chunk_shape_), path = chunk(tile.number)] {
      const auto bytes = static_cast<uLong>(values.size() * sizeof no_label);
      uLongf size = compressBound(bytes);
      std::vector<Bytef> compressed(size);
      if (compress2(compressed.data(), &size, reinterpret_cast<const Bytef*>(values.data()), bytes,
                    zlib_level) != Z_OK) {
        throw std::bad_alloc();  // all else that could go wrong is a wrong call
      }
      write_file(path, compressed.data(), size);
    });
    return {tile.number, 0};
  }

  void sync() override {
    if (workers_) workers_->wait();
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool done = folder >= 0 && syncfs(folder) == 0;
    const Error error = failed("writing", path_);
    if (folder >= 0) close(folder);
    if (!done) throw error;
  }

  void finish() override {
    sync();
    if (folder_ == path_) return;
    // A folder cannot take the place of another one that has files: that one goes aside first.
    const bool replaces = is_there(path_);
    const std::string replaced = random_path_beside(path_);
    if (replaces && rename(path_.c_str(), replaced.c_str()) != 0) throw failed("replacing", path_);
    if (rename(folder_.c_str(), path_.c_str()) != 0) {
      const Error error = failed("writing", path_);
      if (replaces) static_cast<void>(rename(replaced.c_str(), path_.c_str()) == 0);  // the error says enough
      throw error;
    }
    folder_.clear();
    name_.reset();
    if (!replaces) return;
    const TemporaryName name(replaced, TemporaryName::Kind::folder);
    std::error_code ignored;
    fs::remove_all(replaced, ignored);
  }

 private:
  void make_folder() {
    if (mkdir(folder_.c_str(), 0777) != 0) throw failed("making", folder_);
    write_metadata();
  }

  void write_metadata() const {
    const bool are_labels = values_ == PlaneValues::labels;
    const std::string text = fmt::format(
        R"({{
    "chunks": [{}, {}],
    "compressor": {{"id": "zlib", "level": {}}},
    "dtype": "{}",
    "fill_value": {},
    "filters": null,
    "order": "C",
    "shape": [{}, {}],
    "zarr_format": 2
}}
)",
        chunk_shape_.height, chunk_shape_.width, zlib_level, are_labels ? "<u4" : "<f4",
        are_labels ? std::to_string(no_label) : "\"Infinity\"", tiling_.window().height(),
        tiling_.window().width());
    write_file(folder_ + "/.zarray", text.data(), text.size());
  }

  /// The file of a tile: "row.column".
  std::string chunk(std::uint64_t number) const {
    return fmt::format("{}/{}.{}", folder_, number / tiling_.columns(), number % tiling_.columns());
  }

  static void write_file(const std::string& path, const void* bytes, std::size_t count) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0) throw failed("writing", path);
    const bool is_written = write_all(file, static_cast<const char*>(bytes), count);
    const Error error = failed("writing", path);
    if (close(file) != 0 || !is_written) throw error;
  }

  std::string path_, part_path_;
  Tiling tiling_;
  PlaneValues values_;
  TileShape chunk_shape_;
  std::string folder_;  // while it is written; empty: before, and afterwards
  std::optional<TemporaryName> name_;
  bool stays_ = false;
  std::optional<Workers> workers_;
};

}  // namespace

std::unique_ptr<PlaneFile> zarr_plane(const std::string& path, const Tiling& tiling, PlaneValues values) {
  return std::make_unique<ZarrPlane>(path, tiling, values);
}

}  // namespace vorocl::command
