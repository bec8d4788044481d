// Exact cells as tables and files of polygons or polyhedra take them: by the ids that files have.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/output_file.hpp"
#include "vorocl/exact_cells.hpp"

namespace vorocl::command {

/// What `made` holds, made by `make` when it is first asked for.
template <typename T, typename Make>
const T& once(std::optional<T>& made, const Make& make) {
  if (!made) made = make();
  return *made;
}

/// Along x, y and z.
using PeriodCounts = std::array<std::int32_t, 3>;

/// The vertices of a polygon, in their order, or of a polyhedron.
struct Vertices {
  const Point *first = nullptr, *behind = nullptr;
  const Point* begin() const { return first; }
  const Point* end() const { return behind; }
};

/// What is asked for is read once, when it is first asked for.
class ExactCellRows {
 public:
  /// Keeps a reference to the result, which must not change before all is read that is asked for. The seeds
  /// are those of the input. Waits; throws as the library, as do its functions.
  ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, Input input, const SeedOptions& options);

  /// The seeds that have rows, by id: those outside the rectangle only if their cells reach into it.
  const std::vector<std::uint32_t>& order() const { return order_; }

  std::uint32_t id_of(std::size_t seed) const {
    return input_.ids.empty() ? static_cast<std::uint32_t>(seed) : input_.ids.at(seed);
  }

  /// What its cell lies around: the point, or an image of it.
  const Point& point(std::size_t seed) const { return *points_[seed]; }
  const ExactCell& cell(std::size_t seed) const { return cells_[seed]; }
  Vertices vertices(std::size_t seed);
  void read_vertices() { is_volume() ? static_cast<void>(polyhedra()) : static_cast<void>(polygons()); }

  /// Of a plane.
  const std::vector<ExactPair>& pairs();
  /// Of a volume. The image of b behind each is one of the points as rows of cells have them.
  const std::vector<ExactFace>& faces();

  /// The cells as polygons or polyhedra: see polygon_files.hpp.
  void write_polygons(const OutputFile& file);

  const Input& input() const { return input_; }
  bool is_volume() const { return input_.view.is_volume(); }
  bool y_up() const { return y_up_; }
  std::size_t empty_cells() const;
  std::size_t uncertified() const;
  std::size_t pair_count() { return is_volume() ? faces().size() : pairs().size(); }
  double mean_area() const;
  double area_deviation() const;

 private:
  const ExactPolygons& polygons();
  const ExactPolyhedra& polyhedra();

  const ExactCellsResult& result_;
  Input input_;
  bool y_up_;
  std::optional<Crs> crs_;
  std::vector<std::optional<Point>> points_;
  std::vector<ExactCell> cells_;
  std::vector<PeriodCounts> periods_;  // from the seeds' points to the images that their cells lie around
  std::optional<std::vector<ExactPair>> pairs_;
  std::optional<std::vector<ExactFace>> faces_;
  std::optional<ExactPolygons> polygons_;
  std::optional<ExactPolyhedra> polyhedra_;
  std::vector<std::uint32_t> order_;
};

/// Throws UsageError for a file of polygons that is to have polyhedra, or the other way round.
void check_polygons(const std::string& path, bool of_volume);

}  // namespace vorocl::command
