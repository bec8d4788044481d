// Labels as a tiled BigTIFF of unsigned integers, which GDAL and libtiff read as they are. (Those that render
// writes are signed for OpenCV's sake, which reads no tiles.)
#include <fmt/format.h>
#include <tiffio.h>
#include <unistd.h>

#include <algorithm>

#include "formats/files.hpp"
#include "formats/output_file.hpp"
#include "formats/planes/geotiff.hpp"
#include "formats/planes/plane_file.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr int level = 1;
constexpr int side_unit = 16;  // of tiles, by the format

/// The file as the library sees it. What an earlier run has written it can be told again, so that it knows
/// where all tiles are; nothing is copied then.
struct Content {
  int descriptor = -1;
  std::uint64_t place = 0, end = 0;
  bool is_written = true;  // what the library writes; else it is there already, or is to be dropped
};

struct Close {
  void operator()(TIFF* file) const { TIFFClose(file); }
};

Content& content_of(thandle_t handle) { return *static_cast<Content*>(handle); }

tmsize_t read_content(thandle_t handle, void* bytes, tmsize_t count) {
  Content& content = content_of(handle);
  const ssize_t done =
      pread(content.descriptor, bytes, static_cast<std::size_t>(count), static_cast<off_t>(content.place));
  if (done > 0) content.place += static_cast<std::uint64_t>(done);
  return done;
}

tmsize_t write_content(thandle_t handle, void* bytes, tmsize_t count) {
  Content& content = content_of(handle);
  if (content.is_written && !write_all_at(content.descriptor, static_cast<const char*>(bytes),
                                          static_cast<std::size_t>(count), content.place)) {
    return -1;
  }
  content.place += static_cast<std::uint64_t>(count);
  content.end = std::max(content.end, content.place);
  return count;
}

toff_t seek_in_content(thandle_t handle, toff_t offset, int whence) {
  Content& content = content_of(handle);
  return content.place = offset + (whence == SEEK_CUR ? content.place : whence == SEEK_END ? content.end : 0);
}

toff_t size_of_content(thandle_t handle) { return content_of(handle).end; }
int close_content(thandle_t) { return 0; }
int map_content(thandle_t, void**, toff_t*) { return 0; }
void unmap_content(thandle_t, void*, toff_t) {}

class TiffPlane : public PlaneFile {
 public:
  TiffPlane(const std::string& path, const Tiling& tiling, PlaneValues values,
            const std::optional<Georeference>& georeference)
      : output_(path), tiling_(tiling), values_(values), georeference_(georeference) {
    output_.require_file("a TIFF file");
    if (tiling.side() % side_unit != 0) {
      throw Error(fmt::format("{}: the sides of a TIFF file's tiles are multiples of {}, not {}", path,
                              side_unit, tiling.side()));
    }
    if (tiling.count() > 0xffffffffu) {
      throw Error(path + ": a TIFF file has at most 2^32 - 1 tiles; take larger ones");
    }
    require_space(path, bytes_of_values(tiling) / greatest_compression);
  }

  ~TiffPlane() override {
    content_.is_written = false;  // the library would complete the file
    file_.reset();
  }

  void open() override {
    grown_ = std::make_unique<GrowingFile>(output_);
    begin();
  }

  void open_part(const std::optional<KeptTiles>& kept) override {
    std::optional<Kept> same;
    if (kept) {
      same = Kept{0, kept->is_complete};
      for (const WrittenTile& tile : kept->tiles) same->bytes += tile.bytes;
      if (same->bytes > 0) same->bytes += header_bytes;
    }
    grown_ = std::make_unique<GrowingFile>(output_, same);
    if (grown_->is_finished()) return;
    content_.is_written = !same || same->bytes == 0;
    begin();
    if (!kept) return;
    for (const WrittenTile& tile : kept->tiles) {
      require(TIFFWriteRawTile(file_.get(), static_cast<std::uint32_t>(tile.number), nullptr,
                               static_cast<tmsize_t>(tile.bytes)) >= 0);
    }
    content_.is_written = true;
  }

  std::string part_path() const override { return output_.part_path(); }

  void join() override {
    throw Error(output_.path() +
                ": the tiles of a TIFF file follow each other, and so one process alone writes it; take "
                ".zarr or .npy");
  }

  WrittenTile write(const TileLabels& tile) override {
    std::vector<std::uint32_t> values = padded(tile, values_, tile_shape(tiling_, side_unit));
    const std::uint64_t begin = content_.end;
    require(TIFFWriteEncodedTile(file_.get(), static_cast<std::uint32_t>(tile.number), values.data(),
                                 static_cast<tmsize_t>(values.size() * sizeof no_label)) >= 0);
    return {tile.number, content_.end - begin};
  }

  void sync() override { grown_->sync(); }

  void finish() override {
    if (file_) require(TIFFFlush(file_.get()) == 1);
    content_.is_written = false;
    file_.reset();
    grown_->finish();
  }

 private:
  static constexpr std::size_t header_bytes = 16;  // of a BigTIFF, before the first tile

  void require(bool done) const {
    if (!done) throw failed("writing", output_.path());
  }

  void begin() {
    TIFFSetErrorHandler(nullptr);  // it would print to stderr; here exceptions say what went wrong
    TIFFSetWarningHandler(nullptr);
    content_.descriptor = grown_->descriptor();
    file_.reset(TIFFClientOpen(output_.path().c_str(), "w8", &content_, read_content, write_content,
                               seek_in_content, close_content, size_of_content, map_content, unmap_content));
    require(file_ != nullptr);
    TIFF* const file = file_.get();
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(tiling_.window().width()));
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(tiling_.window().height()));
    const TileShape tile = tile_shape(tiling_, side_unit);
    const bool are_labels = values_ == PlaneValues::labels;
    TIFFSetField(file, TIFFTAG_TILEWIDTH, static_cast<std::uint32_t>(tile.width));
    TIFFSetField(file, TIFFTAG_TILELENGTH, static_cast<std::uint32_t>(tile.height));
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 32);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, are_labels ? SAMPLEFORMAT_UINT : SAMPLEFORMAT_IEEEFP);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    TIFFSetField(file, TIFFTAG_ZIPQUALITY, level);
    if (!georeference_) return;
    const Window& window = tiling_.window();
    require(write_georeference(file, *georeference_, static_cast<double>(window.width()),
                               static_cast<double>(window.height()),
                               are_labels ? std::to_string(no_label).c_str() : "inf"));
  }

  OutputFile output_;
  Tiling tiling_;
  PlaneValues values_;
  std::optional<Georeference> georeference_;
  std::unique_ptr<GrowingFile> grown_;
  Content content_;
  std::unique_ptr<TIFF, Close> file_;
};

}  // namespace

std::unique_ptr<PlaneFile> tiff_plane(const std::string& path, const Tiling& tiling, PlaneValues values,
                                      const std::optional<Georeference>& georeference) {
  return std::make_unique<TiffPlane>(path, tiling, values, georeference);
}

}  // namespace vorocl::command
