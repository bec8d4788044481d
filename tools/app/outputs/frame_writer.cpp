#include "app/outputs/frame_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <tuple>
#include <utility>

#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace fs = std::filesystem;

namespace {

/// Numbers of neighbours that have a column: what cells of even and of random seeds have, the first and the
/// last.
std::array<std::uint32_t, 2> columns_of_neighbours(bool is_volume) {
  return is_volume ? std::array<std::uint32_t, 2>{8, 22} : std::array<std::uint32_t, 2>{3, 9};
}

std::string header_of_statistics(bool is_volume) {
  std::string header =
      is_volume ? "frame,cells,empty_cells,mean_volume,volume_deviation,changed_voxels,milliseconds,"
                  "box_x0,box_y0,box_z0,box_x1,box_y1,box_z1,timestep"
                : "frame,cells,empty_cells,mean_area,area_deviation,changed_pixels,milliseconds,"
                  "box_x0,box_y0,box_x1,box_y1,timestep";
  const auto [least, most] = columns_of_neighbours(is_volume);
  for (std::uint32_t n = least; n <= most; ++n) header += fmt::format(",neighbours_{}", n);
  return header + "\n";
}

/// For each of those numbers the share of the cells that have it, of all that own pixels; each with a comma
/// before it.
std::string shares_of_neighbours(Measures& measures) {
  const auto [least, most] = columns_of_neighbours(measures.view().window.grid().is_volume());
  std::vector<std::size_t> counts(most + 1);
  std::size_t cells = 0;
  for (std::size_t label = 0; label < measures.pixels().size(); ++label) {
    if (measures.pixels()[label] == 0) continue;
    ++cells;
    const std::uint32_t neighbours = measures.neighbours()[label];
    if (neighbours <= most) ++counts[neighbours];
  }
  std::string shares;
  for (std::uint32_t n = least; n <= most; ++n) {
    shares += ',';
    if (cells > 0) shares += fmt::format("{}", static_cast<double>(counts[n]) / static_cast<double>(cells));
  }
  return shares;
}

std::string corners_of(const std::optional<Box>& box, bool is_volume) {
  if (!box) return is_volume ? ",,,,," : ",,,";
  return is_volume ? fmt::format("{},{},{},{},{},{}", box->x0, box->y0, box->z0, box->x1, box->y1, box->z1)
                   : fmt::format("{},{},{},{}", box->x0, box->y0, box->x1, box->y1);
}

/// The collection of .vti, .vtu or .vtp files of this kind: the pattern without its number, as l.pvd for
/// l_%05d.vti, or the option's name where nothing is left. Empty for other files. The path is a NumberedName.
std::string collection_path(const FileRequest& request) {
  const std::string extension = extension_of(request.path);
  if (extension != ".vti" && extension != ".vtu" && extension != ".vtp") return {};
  const NumberedName numbered(request.path);
  const fs::path before(numbered.before);
  const std::string stem = before.filename().string();
  const std::string name = stem.substr(0, stem.find_last_not_of("-_.") + 1) +
                           numbered.after.substr(0, numbered.after.size() - extension.size());
  return (before.parent_path() / ((name.empty() ? request.kind.option.substr(2) : name) + ".pvd")).string();
}

/// Says on standard error where a film's sides, which are even, are longer than those of its pictures.
void note_of_size(const Film& film, const cv::Size& picture) {
  const cv::Size size = film_size(picture);
  if (size == picture) return;
  print_note(
      fmt::format("{}: a film's sides are even, so {} x {} has become {} x {} by repeating the last {}",
                  film.path(), picture.width, picture.height, size.width, size.height,
                  picture.width % 2 == 0    ? "row"
                  : picture.height % 2 == 0 ? "column"
                                            : "row and column"));
}

}  // namespace

/// Files of one kind. Each numbered file is whole as soon as it is there. A long table has the columns frame
/// and timestep before its own, and grows under a temporary name until finish().
class FrameFiles {
 public:
  /// Throws Error if no file can be made there.
  explicit FrameFiles(const FileRequest& request) : request_(request) {
    if (request.is_long_table()) {
      table_ = std::make_unique<GrowingFile>(OutputFile(request.path));
      return;
    }
    files_.emplace(request.path);
    const std::string collection = collection_path(request);
    if (!collection.empty()) collection_.emplace(collection);
  }

  /// Reads what add() writes, from the device.
  void read(Measures& measures) const { request_.kind.read(measures); }

  /// Writes the file or the rows of a frame, which shows this time. Throws Error for rows in other units than
  /// those of the frames before.
  void add(int frame, std::int64_t time, Measures& measures) {
    has_frames_ = true;
    if (table_) {
      add_header(frame, measures.view().units);
      request_.kind.table()->add_rows(*table_, fmt::format("{},{},", frame, time), measures);
      return;
    }
    request_.kind.write(files_->file(frame), measures);
    list(frame, time);
  }

  /// Lists the file of a frame, if an earlier run has left one.
  void pass(int frame, std::int64_t time) {
    std::error_code ignored;
    if (files_ && fs::exists(files_->path(frame), ignored)) list(frame, time);
  }

  /// The table; null where there are numbered files.
  GrowingFile* table() const { return table_.get(); }

  /// Writes the collection, or gives the table its name, if a frame was added.
  void finish() {
    if (!has_frames_) return;
    if (table_) table_->finish();
    if (collection_) write_pvd(*collection_, listed_);
  }

 private:
  /// Writes the first line of the table, or checks that it is the same in these units. Throws as add().
  void add_header(int frame, const Units& units) {
    const std::vector<std::string>& columns = request_.kind.table()->columns;
    // And what the header does not say: a volume's distances may be in units of any spacing.
    std::string header = "frame,timestep," + units.header(columns), names = units.of_area();
    if (std::find(columns.begin(), columns.end(), "largest_distance") != columns.end())
      names += units.of_length();
    if (header_.empty()) {
      std::tie(header_, units_) = std::tie(header, names);
      *table_ << header;
    }
    if (header == header_ && names == units_) return;
    const char* const px = !units.are_of_data()   ? ""
                           : units.is_of_volume() ? ", or with --units px where the spacing stays the same"
                                                  : ", or with --units px";
    throw Error(fmt::format(
        "frame {} is measured in other units than the frames before, because its box has "
        "another shape, and {} is one table; begin again with one per frame, such as {}/%05d.csv{}",
        frame, request_.path, request_.kind.option.substr(2), px));
  }
  void list(int frame, std::int64_t time) {
    if (collection_) listed_.push_back({time, fs::path(files_->path(frame)).filename().string()});
  }

  FileRequest request_;
  std::optional<NumberedFiles> files_;
  std::unique_ptr<GrowingFile> table_;
  std::string header_, units_;  // of the table, as the first frame is measured; empty before it
  std::optional<OutputFile> collection_;
  std::vector<TimedFile> listed_;
  bool has_frames_ = false;
};

/// A table of the diagrams' statistics, one row per frame.
class FrameStatistics {
 public:
  /// Throws Error if the file cannot be made there.
  explicit FrameStatistics(const std::string& path)
      : file_(std::make_unique<GrowingFile>(OutputFile(path))) {}

  /// Reads what add() counts, from the device.
  static void read(Measures& measures) {
    measures.statistics();
    measures.pixels();
    measures.neighbours();
    measures.labels();
  }

  /// Every frame, in order; `milliseconds` is the device's time for its diagram, `time` and `box` the
  /// trajectory's.
  void add(int frame, std::int64_t time, double milliseconds, const std::optional<Box>& box,
           Measures& measures) {
    const bool is_volume = measures.view().is_volume();
    if (!std::exchange(has_header_, true)) *file_ << header_of_statistics(is_volume);
    const CellStatistics& statistics = measures.statistics();
    // Counted here and not on the device, where a particle's label may be another's in the next frame.
    const std::vector<std::uint32_t>& labels = measures.labels_in_picture();
    std::string changed;
    if (last_labels_.empty()) {
      last_labels_ = labels;
    } else {
      std::size_t count = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        count += labels[i] != last_labels_[i] ? 1 : 0;
        last_labels_[i] = labels[i];
      }
      changed = fmt::format("{}", count);
    }
    const std::string areas =
        statistics.cells > 0 ? fmt::format("{},{}", statistics.mean_area, statistics.area_deviation) : ",";
    *file_ << fmt::format("{},{},{},{},{},{:.6f},{},{}{}\n", frame, statistics.cells, statistics.empty_cells,
                          areas, changed, milliseconds, corners_of(box, is_volume), time,
                          shares_of_neighbours(measures));
  }

  /// The frame before the first one of the table.
  void pass(Measures& measures) { last_labels_ = measures.labels_in_picture(); }

  GrowingFile* table() const { return file_.get(); }

  void finish() { file_->finish(); }

 private:
  std::unique_ptr<GrowingFile> file_;
  bool has_header_ = false;
  std::vector<std::uint32_t> last_labels_;  // by id, in the picture of the frame before; empty: there is none
};

std::vector<RequestedFile> requested_files(const FrameWriterOptions& options) {
  std::vector<RequestedFile> files;
  for (const FileRequest& request : options.files) {
    files.push_back(requested_of_frames(request));
    files.push_back({request.kind.option, collection_path(request), {".pvd"}});
  }
  files.push_back({"--similarity", options.similarity_path, {".csv"}});
  files.push_back({"--statistics", options.statistics_path, {".csv"}});
  std::vector<std::string> extensions = picture_extensions;
  extensions.insert(extensions.begin(), film_extension);
  const bool is_film = extension_of(options.picture_path) == film_extension;
  files.push_back({"-o", options.picture_path, extensions, !is_film});
  return files;
}

namespace {
std::string none_of(const FrameRange& frames, int last, int every) {
  return fmt::format("--every {0} leaves out all frames from {1} to {2}: it writes 0, {0}, {3} and so on",
                     every, frames.first, last, 2LL * every);
}
}  // namespace

void check_every(const FrameRange& frames, int every) {
  if (frames.last && *frames.last / every * every < frames.first)
    throw UsageError(none_of(frames, *frames.last, every));
}

FrameWriter::FrameWriter(const FrameWriterOptions& options, bool with_errors)
    : options_(options), painter_(options.picture, true) {
  open_files();
  if (!options.similarity_path.empty()) {
    similarities_ = std::make_unique<GrowingFile>(OutputFile(options.similarity_path));
    *similarities_ << "frame,similarity" << (with_errors ? ",wrong_percent,largest_excess,mean_excess" : "")
                   << "\n";
  }
  if (!options.statistics_path.empty()) {
    statistics_ = std::make_unique<FrameStatistics>(options.statistics_path);
  }
  for (const auto& files : files_) {
    if (files->table() != nullptr) tables_.push_back(files->table());
  }
  if (similarities_) tables_.push_back(similarities_.get());
  if (statistics_) tables_.push_back(statistics_->table());
}

FrameWriter::~FrameWriter() = default;

void FrameWriter::open_files() {
  for (const FileRequest& request : options_.files) {
    if (!request.path.empty()) files_.push_back(std::make_unique<FrameFiles>(request));
  }
  if (extension_of(options_.picture_path) == film_extension) {
    film_.emplace(options_.picture_path, options_.frames_per_second);
  } else if (!options_.picture_path.empty()) {
    pictures_.emplace(options_.picture_path);
  }
}

bool FrameWriter::wants_images(int frame) const {
  return frame % options_.every == 0 && (film_ || pictures_ || !files_.empty());
}

void FrameWriter::add(FrameFacts facts, const std::shared_ptr<Measures>& measures) {
  if (measures) {
    read(facts.frame, *measures);
    measures->leave_device();
  }
  behind_.add([this, facts = std::move(facts), measures] { write(facts, measures.get()); });
}

void FrameWriter::read(int frame, Measures& measures) const {
  if (wants_images(frame)) {
    for (const auto& files : files_) files->read(measures);
    if (film_ || pictures_) painter_.read(measures);
  }
  if (statistics_) FrameStatistics::read(measures);
}

void FrameWriter::write(const FrameFacts& facts, Measures* measures) {
  if (facts.similarity && similarities_) write_similarity(facts.frame, *facts.similarity);
  if (wants_images(facts.frame)) write_images(facts, *measures);
  if (statistics_) statistics_->add(facts.frame, facts.time, facts.milliseconds, facts.box, *measures);
  mark_tables();
  ++complete_;
  if (wants_images(facts.frame)) ++frames_;
}

/// All have the rows of this frame, or none has.
void FrameWriter::mark_tables() {
  for (const auto step : {&GrowingFile::flush, &GrowingFile::mark}) {
    for (GrowingFile* const table : tables_) (table->*step)();
  }
}

bool FrameWriter::needs_diagram(int frame, int first) const {
  if (statistics_ && frame == first - 1) return true;  // which their first row is compared with
  return (film_ || pictures_) && wants_images(frame) && !painter_.is_independent();
}

void FrameWriter::pass(const FrameFacts& facts, Measures* measures) {
  if (wants_images(facts.frame)) {
    for (const auto& files : files_) files->pass(facts.frame, facts.time);
    if ((film_ || pictures_) && measures != nullptr) painter_.draw(*measures, facts.values);
  }
  if (statistics_ && measures != nullptr) statistics_->pass(*measures);
}

void FrameWriter::write_images(const FrameFacts& facts, Measures& measures) {
  for (const auto& files : files_) files->add(facts.frame, facts.time, measures);
  if (film_ || pictures_) {
    const cv::Mat picture = painter_.draw(measures, facts.values, facts.stamp);
    if (film_) {
      film_->add(picture);
      if (film_->pictures() == 1) note_of_size(*film_, picture.size());
    }
    if (pictures_) write_picture(pictures_->file(facts.frame), picture);
  }
}

void FrameWriter::write_similarity(int frame, const FrameSimilarity& similarity) {
  *similarities_ << fmt::format("{},{}", frame, similarity.percent);
  if (const std::optional<DistanceErrors>& errors = similarity.errors) {
    *similarities_ << fmt::format(",{},{},{}", errors->wrong_percent(), errors->largest_excess,
                                  errors->mean_excess);
  }
  *similarities_ << "\n";
}

std::string FrameWriter::progress() const {
  std::string text = fmt::format("; frames complete before that: {}", complete_);
  if (film_ || pictures_ || !files_.empty()) text += fmt::format(", written of them: {}", frames_);
  return text;
}

void FrameWriter::finish() {
  painter_.note_of_scale();
  std::exception_ptr first;
  const auto finish = [&first](auto& output) {
    try {
      output.finish();
    } catch (...) {
      if (!first) first = std::current_exception();
    }
  };
  for (const auto& files : files_) finish(*files);
  if (similarities_) finish(*similarities_);
  if (statistics_) finish(*statistics_);
  if (film_) finish(*film_);
  if (first) std::rethrow_exception(first);
}

void FrameWriter::end_run(const Trouble& trouble, const FrameRange& frames) {
  std::string late;
  try {
    if (complete_ > 0) finish();
  } catch (const Error& error) {
    if (trouble.text.empty()) throw;
    late = fmt::format("; {}", error.what());
  }
  if (trouble.text.empty()) {
    if (frames_ > 0 || (!film_ && !pictures_ && files_.empty())) return;
    throw Error(none_of(frames, frames.first + complete_ - 1, options_.every));
  }
  const std::string more =
      film_ || trouble.is_of_frame ? "" : how_to_continue(frames, complete_, !tables_.empty());
  throw Error(trouble.text + progress() + more + late);
}

}  // namespace vorocl::command
