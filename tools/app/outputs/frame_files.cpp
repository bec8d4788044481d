#include "app/outputs/frame_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <tuple>
#include <utility>

#include "formats/files.hpp"
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

}  // namespace

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

FrameFiles::FrameFiles(const FileRequest& request) : request_(request) {
  if (request.is_long_table()) {
    table_ = std::make_unique<GrowingFile>(OutputFile(request.path));
    return;
  }
  files_.emplace(request.path);
  const std::string collection = collection_path(request);
  if (!collection.empty()) collection_.emplace(collection);
}

void FrameFiles::add(int frame, std::int64_t time, Measures& measures) {
  if (table_) {
    add_header(frame, measures.view().units);
    request_.kind.table()->add_rows(*table_, fmt::format("{},{},", frame, time), measures);
    return;
  }
  request_.kind.write(files_->file(frame), measures);
  list(frame, time);
}

void FrameFiles::add_header(int frame, const Units& units) {
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
  const std::string px = Units().of_area();
  throw Error(
      fmt::format("frame {} is measured in other units than the frames before, because its box has "
                  "another shape, and {} is one table; begin again with one per frame, such as {}/%05d.csv{}",
                  frame, request_.path, request_.kind.option.substr(2),
                  units.of_area() == px ? "" : ", or with --units px"));
}

void FrameFiles::pass(int frame, std::int64_t time) {
  std::error_code ignored;
  if (files_ && fs::exists(files_->path(frame), ignored)) list(frame, time);
}

void FrameFiles::list(int frame, std::int64_t time) {
  if (collection_) listed_.push_back({time, fs::path(files_->path(frame)).filename().string()});
}

void FrameFiles::finish() {
  if (table_) table_->finish();
  if (collection_) write_pvd(*collection_, listed_);
}

FrameStatistics::FrameStatistics(const std::string& path)
    : file_(std::make_unique<GrowingFile>(OutputFile(path))) {}

void FrameStatistics::pass(Measures& measures) { last_labels_ = measures.labels_in_picture(); }

void FrameStatistics::read(Measures& measures) {
  measures.statistics();
  measures.pixels();
  measures.neighbours();
  measures.labels();
}

void FrameStatistics::add(int frame, std::int64_t time, double milliseconds, const std::optional<Box>& box,
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

}  // namespace vorocl::command
