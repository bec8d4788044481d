// The rows of a frame, one per particle, in both kinds of trajectory files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/id_order.hpp"
#include "formats/trajectory/line_reader.hpp"
#include "formats/trajectory/simulation_box.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// The number of particles that a frame says it has, and the line that says so.
struct ParticleCount {
  std::size_t value = 0;
  std::size_t line = 0;
};

/// The count in the present line. Throws Error if it is none, or more than there can be seeds.
ParticleCount parse_count(const LineReader& lines);

/// Which fields of a row matter; the others are not looked at.
struct RowLayout {
  std::size_t fields = 0;
  bool may_have_more = false;  ///< whether a row may have more fields than these
  std::size_t x = 0;
  std::size_t y = 0;
  std::optional<std::size_t> z;
  std::optional<std::size_t> id;  ///< where there is none, the row's number from 0 is the id
  bool scaled = false;            ///< x, y and z are in lengths of the box's edges
  std::optional<std::size_t> value;
};

/// A value of each particle, which may have several columns.
struct Property {
  std::string_view name;
  std::size_t columns = 1;
};

/// Where the column is among those of the file: NAME, or NAME[1], NAME[2], ... where a property has several.
/// None if its name is empty. Throws Error, which lists what there is, if it is not there.
std::optional<std::size_t> find_value_column(const LineReader& lines, const std::vector<Property>& properties,
                                             const std::string& column);

/// Reads the rows of one frame after another into the same memory.
class ParticleRows {
 public:
  explicit ParticleRows(Wanted wanted) : wanted_(wanted) {}

  /// Reads as many rows as the count says, from the next line on, and makes the frame's ids, positions,
  /// values and box of them; without a box the positions are taken as they are (and are not scaled). Throws
  /// Error for a row that cannot be read, an id that comes twice, a particle outside a wall, and a file that
  /// ends too early; before any reading if what is left of the file cannot hold the rows. The frame is as it
  /// was then. Where the box alone is wanted, and does not grow, the rows are passed over.
  void read(LineReader& lines, const RowLayout& layout, const ParticleCount& count,
            std::optional<SimulationBox>& box, Frame& frame);

 private:
  void clear();
  void add(const LineReader& lines, const RowLayout& layout, const ParticleCount& count,
           std::optional<SimulationBox>& box);
  void sort(const LineReader& lines, std::size_t first_line);
  template <typename T>
  void give(std::vector<T>& of_rows, std::vector<T>& of_frame) const;

  bool is_volume() const { return wanted_ == Wanted::volume || wanted_ == Wanted::box_of_volume; }

  Wanted wanted_;
  // Of the rows so far, in the order of the file.
  std::vector<std::uint32_t> ids_;
  std::vector<Point> positions_;
  std::vector<double> z_;  // of a volume
  ColumnReader values_;
  double lowest_z_ = 0, highest_z_ = 0;
  std::vector<std::string_view> fields_;  // of the present row
  std::vector<IdAndRow> order_, spare_;   // the rows by id; empty: as they are
};

/// The error for a file that ends before the frame that starts at a line is complete.
Error cut_off(const LineReader& lines, std::size_t frame_line);

}  // namespace vorocl::command
