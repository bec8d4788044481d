#include "app/outputs/plane_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/outputs/plane_summary.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"

namespace vorocl::command {

namespace {

/// Beside the first file that is asked for.
std::string journal_of(const PlaneWriterOptions& options) {
  for (const RequestedFile& file : requested_files(options)) {
    if (!file.path.empty()) return journal_path(file.path);
  }
  return "";
}

std::unique_ptr<TileJournal> open_journal(const PlaneWriterOptions& options, const std::string& run) {
  check_journal(options);
  return options.resume ? std::make_unique<TileJournal>(journal_of(options), run) : nullptr;
}

}  // namespace

std::vector<RequestedFile> requested_files(const PlaneWriterOptions& options) {
  return {{"--labels", options.labels, plane_extensions()},
          {"--distance", options.distances, plane_extensions()},
          {"-o", options.picture, picture_extensions()},
          {"--cells", options.cells, {".csv"}},
          {"--adjacency", options.adjacency, {".csv"}}};
}

void check_journal(const PlaneWriterOptions& options) {
  if (!options.resume) refuse_journal(journal_of(options));
}

std::vector<std::unique_ptr<PlaneFile>> plane_files(const PlaneWriterOptions& options, const Tiling& tiling,
                                                    const std::optional<Georeference>& georeference) {
  std::vector<std::unique_ptr<PlaneFile>> files;
  if (!options.labels.empty())
    files.push_back(plane_file(options.labels, tiling, PlaneValues::labels, georeference));
  if (!options.distances.empty())
    files.push_back(plane_file(options.distances, tiling, PlaneValues::distances, georeference));
  if (!options.picture.empty()) files.push_back(plane_map(options.picture, tiling));
  return files;
}

PlaneWriter::PlaneWriter(const PlaneWriterOptions& options, const Tiling& tiling,
                         const std::optional<Georeference>& georeference, const std::string& run)
    : tiling_(tiling),
      journal_(open_journal(options, run)),
      files_(plane_files(options, tiling, georeference)),
      tables_(options.cells, options.adjacency, tiling.window().pixels()) {
  if (!journal_) return;
  for (const RequestedFile& file : requested_files(options)) {
    if (!file.path.empty() && extension_of(file.path) == ".csv")
      OutputFile(file.path).require_file("--resume");
  }
}

std::vector<std::string> PlaneWriter::part_paths() const {
  std::vector<std::string> paths;
  for (const auto& file : files_) paths.push_back(file->part_path());
  if (tables_.is_asked_for()) paths.push_back(tables_.part_path());
  return paths;
}

void PlaneWriter::begin(const std::string& seeds) {
  if (!journal_) {
    for (const auto& file : files_) file->open();
    return;
  }
  const bool is_complete = journal_->is_complete();
  journal_->begin(part_paths(), seeds);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::optional<KeptTiles> kept = journal_->kept(i);
    journal_->open([&] { files_[i]->open_part(kept); });
  }
  if (tables_.is_asked_for()) {
    journal_->open([&] { tables_.open_part(journal_->kept_sums(), is_complete); });
  }
  made_before_.insert(journal_->tiles().begin(), journal_->tiles().end());
  complete_ = made_before_.size();
}

std::optional<std::uint64_t> PlaneWriter::next() {
  while (made_before_.count(next_) > 0) ++next_;
  return next_ < tiling_.count() ? std::optional(next_++) : std::nullopt;
}

void PlaneWriter::add(const TileLabels& tile) {
  TileJournal::Entry entry;
  entry.number = tile.number;
  for (const auto& file : files_) entry.bytes.push_back(file->write(tile).bytes);
  if (!journal_) return;
  entries_.push_back(std::move(entry));
  if (stopwatch_.seconds() >= next_checkpoint_) checkpoint();
}

void PlaneWriter::add(const std::vector<TileJournal::Entry>& entries, const std::vector<char>& sums) {
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  if (PlaneCells* const cells = tables_.recent()) cells->add(sums);
}

void PlaneWriter::checkpoint() {
  if (!journal_ || entries_.empty()) return;
  const double begin = stopwatch_.seconds();
  for (const auto& file : files_) file->sync();
  journal_->complete(entries_, tables_.sync());
  complete_ += entries_.size();
  entries_.clear();
  const double end = stopwatch_.seconds();
  next_checkpoint_ = end + time_between_checkpoints * (end - begin);
}

std::string PlaneWriter::kept() const {
  if (!journal_) return "nothing stays of the tiles before that; with --resume a run can go on";
  return fmt::format("{} of {} tiles are complete and kept in {} and {}; run the same command again to go on",
                     complete_, tiling_.count(), fmt::join(part_paths(), ", "), journal_->path());
}

void PlaneWriter::finish(const Units& units, const EachSeed& seeds) {
  checkpoint();
  if (journal_) journal_->finish();
  for (const auto& file : files_) file->finish();
  tables_.finish(units, seeds);
  if (journal_) journal_->remove();
}

}  // namespace vorocl::command
