// The kinds of files that a diagram and its measures are written to (pictures are in painter.hpp), and how
// each is written.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "app/outputs/measures.hpp"
#include "app/outputs/output_files.hpp"
#include "app/outputs/table_rows.hpp"

namespace vorocl::command {

/// What a table says of a diagram: the names of its columns, as Units::header() takes them, and its rows,
/// each with `first` before it.
struct TableKind {
  std::vector<std::string> columns;
  std::function<void(GrowingFile& table, const std::string& first, Measures& measures)> add_rows;
  bool of_cells = false;  ///< rows end with the columns that are kept of the input
};

/// One kind of file, and the option that asks for it.
struct FileKind {
  std::string option;  // "--labels"
  std::string about;   // what the file holds, for the help
  std::vector<std::string> extensions;

  /// Reads what write() and add_rows() make the file of, from the device.
  std::function<void(Measures& measures)> read;

  std::variant<void (*)(const OutputFile& file, Measures& measures), TableKind> content;

  /// The kind of table that the file is; null: none.
  const TableKind* table() const { return std::get_if<TableKind>(&content); }

  /// Writes the file of one diagram. Throws Error if that fails.
  void write(const OutputFile& file, Measures& measures) const;
};

/// Labels by id: .npy, .tif or .vti.
FileKind labels_kind();
enum class CellsOf { planes, volumes, both, globe, tiles };

/// A cell as its row in a table, in the units of that; what it does not have is unknown.
struct CellValues {
  static constexpr double unknown = RowText::unknown;
  double id = 0;
  Point seed;
  double area = 0, perimeter = 0, neighbours = 0, touches_border = 0, largest_distance = unknown;
  Point centroid = {unknown, unknown, unknown};
  Extent extent = {unknown, unknown, unknown, unknown, unknown, unknown};
};

/// What is read of all cells of a diagram where columns need it; of exact cells shapes are those of vertices.
enum CellPart : unsigned { in_any = 0, of_sums = 1, of_shape = 2, of_perimeter = 4, of_neighbours = 8 };

struct CellColumn {
  std::string name;
  CellsOf of;
  CellPart part;
  double (*value)(const CellValues& cell);
};

std::vector<CellColumn> cell_columns_of(const std::vector<std::string>& names);

/// Adds the values of a row, with what is kept of the input.
void add_cell(RowText& text, const std::vector<CellColumn>& columns, const CellValues& cell,
              const CsvFields* kept);

/// The first line of a table of cells.
std::string header_of_cells(const std::vector<std::string>& columns, const Units& units,
                            const CsvFields& kept);

/// The columns that a table of such cells can have, in their order.
std::vector<std::string> cell_columns(CellsOf cells);
/// Those that were chosen, or all. Throws UsageError for one that such cells do not have.
std::vector<std::string> chosen_columns(const std::vector<std::string>& chosen, CellsOf cells);
/// One row per cell with these of the columns, one row per pair of cells that touch: .csv. The manual page
/// explains the columns.
FileKind cells_kind(const std::vector<std::string>& columns = cell_columns(CellsOf::planes));
FileKind adjacency_kind();
/// Distances to the nearest seed in pixels, float: .npy, .tif or .vti.
FileKind distance_kind();
/// The pixels at the borders of the cells: .npy, .png or .vti.
FileKind border_kind();

/// Polygons or polyhedra of exact cells: see polygon_files.hpp.
FileKind polygons_kind();

/// A file that the command line may ask for.
struct FileRequest {
  FileKind kind;
  std::string path;                       // empty: not asked for
  std::vector<std::string> columns = {};  // of cells, as they were chosen; none: all

  /// Whether the file is one table of all frames: its name has no place for a number.
  bool is_long_table() const { return kind.table() != nullptr && path.find('%') == std::string::npos; }
};

/// The same of a plane, a volume or the globe, with its formats and columns. Borders are of planes alone.
/// Throws as chosen_columns().
FileRequest of_grid(FileRequest request, CellsOf cells);

/// The same of exact cells: tables of them and of the edges or faces between two, a <= b, and polygons. A
/// pair has the middle of its edge, or the image of b behind its face, of the points as rows of cells have
/// them. Throws as chosen_columns(), and UsageError for a file of polygons that is to have polyhedra, or the
/// other way round.
FileRequest of_exact_cells(FileRequest request, bool is_volume);

/// Throws UsageError, with the options that would do, if none of the files is asked for.
void check_any(const std::vector<FileRequest>& files);

/// A file that is asked for, to be written later.
struct RequestedOutput {
  FileRequest request;
  OutputFile file;
};

/// After check_outputs(). Throws UsageError if none is asked for, Error if one cannot be made there.
std::vector<RequestedOutput> open_outputs(const std::vector<FileRequest>& files, const SeedOptions& seeds);

/// As check_outputs() takes it, for one diagram.
RequestedFile requested(const FileRequest& request);
std::vector<RequestedFile> requested(const std::vector<FileRequest>& requests);

/// The same for many frames: the path is a pattern for one file per frame, but for that of a long table.
RequestedFile requested_of_frames(const FileRequest& request);

}  // namespace vorocl::command
