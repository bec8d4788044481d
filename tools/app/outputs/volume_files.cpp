#include "app/outputs/volume_files.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "app/outputs/table_rows.hpp"
#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

void read_cells(Measures& measures) {
  measures.seeds();
  measures.sums();
  measures.pixels();  // behind the sums, which have them
  measures.shapes();
  measures.neighbours();
  measures.perimeters();
}

void add_cells(GrowingFile& table, const std::string& first, Measures& measures) {
  const Units& units = measures.view().units;
  add_rows(table, first, measures.cells(), [&](RowText& text, std::uint32_t label) {
    const CellSums& sums = measures.sums()[label];
    const CellShape& shape = measures.shapes()[label];
    const Point seed = units.position(*measures.seeds()[label]), centroid = units.position(sums.centroid());
    const auto side = [](int voxel) { return static_cast<double>(voxel); };
    const Extent box = units.extent({side(shape.left), side(shape.top), side(shape.right), side(shape.bottom),
                                     side(shape.front), side(shape.back)});
    const auto if_full = [&](double value) { return sums.area > 0 ? value : RowText::unknown; };
    const double farthest = units.length(measures.largest_distance(label));
    text.add(measures.id_of(label), seed.x, seed.y, seed.z, units.area(sums.area), if_full(centroid.x),
             if_full(centroid.y), if_full(centroid.z), if_full(box.left), if_full(box.top),
             if_full(box.front), if_full(box.right), if_full(box.bottom), if_full(box.back),
             units.border(measures.perimeters()[label]), measures.neighbours()[label], if_full(farthest),
             shape.touches_border ? 1 : 0);
    if (measures.kept() != nullptr) text.add(measures.kept()->fields[label]);
  });
}

void add_pairs(GrowingFile& table, const std::string& first, Measures& measures) {
  const Units& units = measures.view().units;
  add_rows(table, first, measures.pairs_by_id(), [&units](RowText& text, const CellPair& pair) {
    text.add(pair.a, pair.b, units.border(pair.length));
  });
}

void write_labels_of_volume(const OutputFile& file, Measures& measures) {
  write_voxels(file, "label", measures.view().voxels(), measures.labels_by_id());
}

void write_distances_of_volume(const OutputFile& file, Measures& measures) {
  const View& view = measures.view();
  write_voxels(file, "distance", view.voxels(), view.units.lengths(measures.distances()));
}

/// Labels by id, distances to the nearest seed, one row per cell, one row per pair of cells that touch.
const std::vector<FileKind>& kinds() {
  static const std::vector<FileKind> kinds = {
      {"--labels", "Labels of a volume: .npy (uint32) or .vti", volume_extensions(),
       [](Measures& measures) { measures.labels_by_id(); }, write_labels_of_volume},
      {"--distance", "Distances to the nearest seed in a volume: .npy (float32) or .vti", volume_extensions(),
       [](Measures& measures) { measures.distances(); }, write_distances_of_volume},
      {"--cells",
       "A .csv file with one row per cell of a volume",
       {".csv"},
       read_cells,
       TableKind{
           {"id", "x", "y", "z", "volume", "centroid_x", "centroid_y", "centroid_z", "left", "top", "front",
            "right", "bottom", "back", "surface", "neighbours", "largest_distance", "touches_border"},
           add_cells,
           true}},
      {"--adjacency",
       "A .csv file with one row per pair of cells of a volume that touch",
       {".csv"},
       [](Measures& measures) { measures.pairs(); },
       TableKind{{"a", "b", "area"}, add_pairs}}};
  return kinds;
}

}  // namespace

FileRequest of_volume(const FileRequest& of_plane) {
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&of_plane](const FileKind& any) {
    return any.option == of_plane.kind.option;
  });
  if (kind == kinds().end()) throw std::logic_error("volumes have no file " + of_plane.kind.option);
  return {*kind, of_plane.path};
}

}  // namespace vorocl::command
