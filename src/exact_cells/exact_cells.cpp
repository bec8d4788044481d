#include "vorocl/exact_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

#include "core/seeds_state.hpp"
#include "exact_cells/sites.hpp"
#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "runtime/has_doubles.hpp"
#include "runtime/stopwatch.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"

namespace vorocl {

namespace {

constexpr cl_uchar touches_border = 1, certified = 2;  // of found.cl

/// What cells of planes and of volumes have of their own.
struct Kind {
  const char* cells_file;
  const char* large_cells_file;
  std::size_t dimensions;
  std::size_t bytes_of_edge;                        // as it is found
  std::size_t (*usual_edges)(std::size_t sites);    // found at first; of a plane there are never more
  std::size_t (*bytes_of_large)(std::size_t room);  // of a cell in global memory
};

/// The edges of all cells, and on the sides of the rectangle: a planar graph with a node more for each side
/// has fewer than three edges per node, and each is an edge of two cells. On a torus it is the same without
/// sides.
constexpr Kind plane_kind = {
    "exact_cells/cells.cl",
    "exact_cells/large_cells.cl",
    2,
    sizeof(cl_uint2),
    [](std::size_t sites) { return 6 * sites + 24; },
    [](std::size_t room) { return POLYGON_BYTES(room); },
};

/// Cells of random points have 15.5 faces in the mean.
constexpr Kind volume_kind = {
    "exact_cells/volumes/cells.cl",
    "exact_cells/volumes/large_cells.cl",
    3,
    sizeof(cl_uint4),
    [](std::size_t sites) { return 18 * sites + 4096; },
    [](std::size_t room) { return POLYHEDRON_BYTES(room); },
};

void require_doubles(const Device& device) {
  if (has_doubles(device)) return;
  throw Error("exact cells need double precision (cl_khr_fp64), which " + device.name() +
                  " does not have; use another device",
              ErrorKind::device);
}

}  // namespace

struct ExactCellsState {
  std::optional<Device> device;
  bool is_made = false;  // otherwise the result is empty
  std::size_t cells = 0;
  std::variant<PlaneSites, VolumeSites> sites;  // without their lists, which the device has
  cl_uint site_count = 0;
  cl_int top_level = 0;
  double step = 0;
  cl_double4 origin = {};
  KernelSet kernels;

  cl::Buffer places, boxes, shifts, levels, ids, lags, box_lags;
  std::array<Upload<cl_int>, 3> uploads_of_plane;
  std::array<Upload<cl_double>, 3> uploads_of_volume;
  Upload<cl_double> upload_of_lags, upload_of_box_lags;
  Upload<cl_uint> upload_of_levels, upload_of_ids;

  cl::Buffer areas, centroids, perimeters, neighbours, flags;  // by cell
  cl::Buffer begins, counters, large, scratch;                 // see found.cl
  cl::Buffer queue;                                            // at last the site of each cell of a plane
  cl::Buffer offsets;                                          // at first the number of edges, by cell
  cl::Buffer found;                                            // edges as they were found; then no more
  cl::Buffer vertices, edge_neighbours, lengths, images;       // edges by cell
  std::size_t room_for_edges = 0;
  bool is_settled = false, is_listed = false;
  std::size_t edges = 0;  // once they are listed

  bool empty() const { return !is_made; }
  bool is_volume() const { return std::holds_alternative<VolumeSites>(sites); }
  const Kind& kind() const { return is_volume() ? volume_kind : plane_kind; }

  /// Enqueues all but what settle() and list() do. Returns the first command and the last one.
  template <typename SitesOfKind>
  std::pair<cl::Event, cl::Event> start(const Device& on, SitesOfKind of);

  /// Cuts the cells that had no room. Waits.
  void settle();

  /// Puts the edges in order. Waits.
  void list();

  /// The polyhedra, of which the edges are listed. Waits.
  ExactPolyhedra outline();

  Kernel& kernel(const char* file, const char* name) {
    return kernels.get(*device, file, name, PixelGrid(1, 1));
  }

  auto& uploads(const PlaneSites&) { return uploads_of_plane; }
  auto& uploads(const VolumeSites&) { return uploads_of_volume; }

  template <typename T>
  void send(cl::Buffer& buffer, Upload<T>& upload, std::vector<T>&& values) {
    if (values.empty()) {
      buffer = cl::Buffer();
      return;
    }
    make_room(buffer, *device, values.size() * sizeof(T));
    upload.start(*device, buffer, std::move(values));
  }

  /// Launches a kernel that takes the sites (SITE_PARAMETERS of lanes.cl) first.
  template <typename... More>
  cl::Event over_sites(const char* file, const char* name, std::size_t items, const More&... more) {
    // On a CPU an item has much to do, and LLVM 18 (PoCL 6.0) fails where it makes vectors of items.
    const std::size_t items_of_group = device->tuning().shape == Shape::vector ? 1 : 0;
    return std::visit(
        [&](const auto& of) {
          return kernel(file, name)
              .in_groups_of(items_of_group)
              .over_items(items, site_count, places, boxes, levels, lags, box_lags, top_level, of.lower,
                          of.upper, of.reach, shifts, static_cast<cl_int>(of.images.size()), more...);
        },
        sites);
  }

  /// As above, of MEASURE_PARAMETERS of found.cl.
  template <typename... More>
  cl::Event measure(const char* file, const char* name, std::size_t items, const More&... more) {
    return over_sites(file, name, items, ids, origin, step, areas, centroids, perimeters, offsets, neighbours,
                      flags, begins, found, static_cast<cl_uint>(room_for_edges), counters, queue, more...);
  }

  /// Cuts all cells, as far as they have room in private memory: `run` enqueues a kernel over so many items,
  /// of so many sites each.
  template <typename Run>
  cl::Event cut_all(const Run& run) {
    const std::size_t of_item = device->tuning().shape == Shape::vector ? std::size_t{FAN} : 1;
    fill(*device, counters, cl_uint{0}, 2);
    return run((site_count + of_item - 1) / of_item, static_cast<cl_uint>(of_item));
  }

  /// Cuts the cells in the queue, in ever more global memory: `run` enqueues a kernel over so many items, of
  /// the cells in `large` from one up to another, with `scratch` for each. Waits.
  template <typename Run>
  void cut_large(const Run& run);
};

template <typename SitesOfKind>
std::pair<cl::Event, cl::Event> ExactCellsState::start(const Device& on, SitesOfKind of) {
  const auto room = [&on](cl::Buffer& buffer, std::size_t count, std::size_t bytes) {
    make_room(buffer, on, count * bytes);
  };
  device = on;
  is_settled = is_listed = false;
  site_count = of.count();
  top_level = of.top_level();
  step = of.step;
  origin = {{of.origin.x, of.origin.y, of.origin.z, 0}};
  auto& uploads_of_kind = uploads(of);
  send(places, uploads_of_kind[0], std::move(of.places));
  send(boxes, uploads_of_kind[1], std::move(of.boxes));
  send(shifts, uploads_of_kind[2], std::move(of.shifts));
  send(lags, upload_of_lags, std::move(of.lags));
  send(box_lags, upload_of_box_lags, std::move(of.box_lags));
  send(levels, upload_of_levels, std::move(of.levels));
  send(ids, upload_of_ids, std::move(of.ids));
  sites = std::move(of);
  room_for_edges = kind().usual_edges(site_count);
  for (cl::Buffer* const numbers : {&areas, &perimeters}) room(*numbers, cells, sizeof(cl_double));
  room(neighbours, cells, sizeof(cl_uint));
  room(offsets, cells + 1, sizeof(cl_uint));
  room(centroids, cells, kind().dimensions * sizeof(cl_double));
  room(flags, cells, 1);
  room(begins, site_count, sizeof(cl_uint));
  room(queue, cells, sizeof(cl_uint));
  if (lengths() == found()) lengths = cl::Buffer();  // of a plane: see list()
  room(found, room_for_edges, kind().bytes_of_edge);
  room(counters, 2, sizeof(cl_uint));
  const cl::Event first = fill(on, counters, cl_uint{0}, 2);
  if (cells == 0) return {first, first};
  // Cells of coincident points but the first, and of points that are not there, are empty.
  for (const cl::Buffer* const numbers : {&areas, &perimeters}) fill(on, *numbers, cl_double{0}, cells);
  for (const cl::Buffer* const counts : {&offsets, &neighbours}) fill(on, *counts, cl_uint{0}, cells);
  fill(on, centroids, std::numeric_limits<cl_double>::quiet_NaN(), kind().dimensions * cells);
  const cl::Event cleared = fill(on, flags, certified, cells);
  const cl::Event last = cut_all([this](std::size_t items, cl_uint of_item) {
    return measure(kind().cells_file, "cut_cells", items, of_item);
  });
  return {first, site_count > 0 ? last : cleared};
}

template <typename Run>
void ExactCellsState::cut_large(const Run& run) {
  constexpr std::size_t most_scratch = std::size_t{1} << 26, granularity = 64;
  // Edges of a cell, with all images of the sites; and a polyhedron has fewer than two vertices for each
  // face.
  const std::size_t most = (is_volume() ? 54 : 9) * std::size_t{site_count} + 64;
  std::size_t left = download<cl_uint>(*device, counters, 2).back();
  for (std::size_t room = 1024; left > 0; room *= 16) {
    room = std::min(room, (most + granularity - 1) / granularity * granularity);
    const std::size_t bytes = kind().bytes_of_large(room);
    const std::size_t batch = std::clamp<std::size_t>(most_scratch / bytes, 1, left);
    make_room(scratch, *device, batch * bytes);
    make_room(large, *device, left * sizeof(cl_uint));
    copy(*device, queue, large, left * sizeof(cl_uint));
    check(clEnqueueFillBuffer(device->queue()(), counters(), "\0\0\0", sizeof(cl_uint), sizeof(cl_uint),
                              sizeof(cl_uint), 0, nullptr, nullptr),
          "filling a buffer");
    for (std::size_t from = 0; from < left; from += batch) {
      const std::size_t to = std::min(from + batch, left);
      run(to - from, static_cast<cl_uint>(from), static_cast<cl_uint>(to), static_cast<cl_int>(room));
    }
    left = download<cl_uint>(*device, counters, 2).back();
  }
}

void ExactCellsState::settle() {
  if (is_settled) return;
  is_made = false;  // if anything fails from here on: the queue and its length are written over
  while (true) {
    cut_large([this](std::size_t items, cl_uint from, cl_uint to, cl_int room) {
      measure(kind().large_cells_file, "cut_large_cells", items, large, from, to, scratch, room);
    });
    const std::size_t all = download<cl_uint>(*device, counters, 2).front();
    if (all <= room_for_edges) break;
    room_for_edges = all;
    make_room(found, *device, all * kind().bytes_of_edge);
    cut_all([this](std::size_t items, cl_uint of_item) {
      return measure(kind().cells_file, "cut_cells", items, of_item);
    });
  }
  is_settled = is_made = true;
}

void ExactCellsState::list() {
  settle();
  if (is_listed) return;
  std::vector<cl_uint> begin_of = download<cl_uint>(*device, offsets, cells);
  begin_of.push_back(0);
  cl_uint sum = 0;
  for (cl_uint& entry : begin_of) {
    const cl_uint here = entry;
    entry = sum;
    sum += here;
  }
  make_room(edge_neighbours, *device, sum * sizeof(cl_uint));
  if (is_volume()) {
    make_room(lengths, *device, sum * sizeof(cl_double));
    make_room(images, *device, sum * sizeof(cl_ushort));
    vertices = cl::Buffer();
  } else {
    make_room(vertices, *device, sum * sizeof(cl_double2));
    lengths = found;  // a length takes the bytes of an edge that was found
  }
  is_made = false;  // if anything fails from here on: counts and found edges are written over
  upload(*device, offsets, begin_of);
  const char* const file = kind().cells_file;
  if (is_volume()) {
    kernel(file, "place_faces")
        .over_items(site_count, site_count, ids, begins, found, offsets, edge_neighbours, lengths, images);
  } else {
    over_sites(file, "place_edges", site_count, ids, begins, found, offsets, edge_neighbours, vertices,
               queue);
    over_sites(file, "measure_edges", cells, static_cast<cl_uint>(cells), queue, origin, step, offsets,
               vertices, lengths);
  }
  edges = sum;
  is_listed = is_made = true;
}

ExactPolyhedra ExactCellsState::outline() {
  constexpr std::size_t vertices_of_face = 2, corners_of_face = 6;  // see OUTLINE_PARAMETERS
  const cl::Buffer all_vertices =
      allocate(*device, vertices_of_face * edges * 3 * sizeof(cl_double), "the vertices of polyhedra");
  const cl::Buffer all_corners =
      allocate(*device, corners_of_face * edges * sizeof(cl_uint), "the corners of polyhedra");
  const cl::Buffer vertex_counts = allocate(*device, cells * sizeof(cl_uint), "the vertices of polyhedra");
  const cl::Buffer corner_counts = allocate(*device, edges * sizeof(cl_uint), "the corners of polyhedra");
  fill(*device, vertex_counts, cl_uint{0}, cells);
  const auto run = [&](const char* file, const char* name, std::size_t items, const auto&... more) {
    return over_sites(file, name, items, ids, origin, step, offsets, all_vertices, vertex_counts,
                      corner_counts, all_corners, counters, queue, more...);
  };
  cut_all([&](std::size_t items, cl_uint of_item) {
    return run(kind().cells_file, "outline_cells", items, of_item);
  });
  cut_large([&](std::size_t items, cl_uint from, cl_uint to, cl_int room) {
    run(kind().large_cells_file, "outline_large_cells", items, large, from, to, scratch, room);
  });
  ExactPolyhedra polyhedra;
  polyhedra.offsets = download<cl_uint>(*device, offsets, cells + 1);
  polyhedra.neighbours = download<cl_uint>(*device, edge_neighbours, edges);
  polyhedra.areas = download<cl_double>(*device, lengths, edges);
  const auto counts = download<cl_uint>(*device, vertex_counts, cells);
  const auto sizes = download<cl_uint>(*device, corner_counts, edges);
  const auto places_of_vertices = download<cl_double>(*device, all_vertices, vertices_of_face * edges * 3);
  const auto corners = download<cl_uint>(*device, all_corners, corners_of_face * edges);
  polyhedra.corner_offsets = polyhedra.vertex_offsets = {0};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::size_t first = polyhedra.vertices.size(), offset = polyhedra.offsets[cell];
    const cl_double* vertex = places_of_vertices.data() + 3 * vertices_of_face * offset;
    for (cl_uint i = 0; i < counts[cell]; ++i, vertex += 3)
      polyhedra.vertices.push_back({vertex[0], vertex[1], vertex[2]});
    polyhedra.vertex_offsets.push_back(polyhedra.vertices.size());
    const cl_uint* corner = corners.data() + corners_of_face * offset;
    for (std::size_t face = offset; face < polyhedra.offsets[cell + 1]; ++face) {
      for (cl_uint i = 0; i < sizes[face]; ++i) polyhedra.corners.push_back(first + *corner++);
      polyhedra.corner_offsets.push_back(polyhedra.corners.size());
    }
  }
  return polyhedra;
}

// --- ExactCellsResult ---

std::size_t ExactCellsResult::size() const { return state_ && !state_->empty() ? state_->cells : 0; }

const cl::Buffer& ExactCellsResult::areas() const { return settled(&ExactCellsState::areas); }
const cl::Buffer& ExactCellsResult::centroids() const { return settled(&ExactCellsState::centroids); }
const cl::Buffer& ExactCellsResult::perimeters() const { return settled(&ExactCellsState::perimeters); }
const cl::Buffer& ExactCellsResult::neighbours() const { return settled(&ExactCellsState::neighbours); }
const cl::Buffer& ExactCellsResult::flags() const { return settled(&ExactCellsState::flags); }
const cl::Buffer& ExactCellsResult::offsets() const { return listed(&ExactCellsState::offsets); }
const cl::Buffer& ExactCellsResult::vertices() const { return listed(&ExactCellsState::vertices); }
const cl::Buffer& ExactCellsResult::edge_neighbours() const {
  return listed(&ExactCellsState::edge_neighbours);
}
const cl::Buffer& ExactCellsResult::lengths() const { return listed(&ExactCellsState::lengths); }

const cl::Buffer& ExactCellsResult::settled(cl::Buffer ExactCellsState::*buffer) const {
  if (state_ && !state_->empty()) state_->settle();
  return buffer_of(state_, buffer);
}

const cl::Buffer& ExactCellsResult::listed(cl::Buffer ExactCellsState::*buffer) const {
  edges();
  return buffer_of(state_, buffer);
}

std::size_t ExactCellsResult::edges() const {
  if (!state_ || state_->empty()) return 0;
  state_->list();
  return state_->edges;
}

std::vector<ExactCell> ExactCellsResult::read() const {
  if (size() == 0) return {};
  state_->settle();
  const Device& device = *state_->device;
  const auto areas = download<cl_double>(device, state_->areas, size());
  const std::size_t dimensions = state_->kind().dimensions;
  const auto centroids = download<cl_double>(device, state_->centroids, dimensions * size());
  const auto perimeters = download<cl_double>(device, state_->perimeters, size());
  const auto neighbours = download<cl_uint>(device, state_->neighbours, size());
  const auto flags = download<cl_uchar>(device, state_->flags, size());
  std::vector<ExactCell> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const double* const centroid = centroids.data() + dimensions * id;
    cells.push_back({areas[id],
                     {centroid[0], centroid[1], dimensions > 2 ? centroid[2] : 0},
                     perimeters[id],
                     neighbours[id],
                     (flags[id] & touches_border) != 0,
                     (flags[id] & certified) != 0});
  }
  return cells;
}

namespace {

/// The state of a result that is not empty, null of one that is. Throws Error if it is of the other kind.
const ExactCellsState* state_of_kind(const ExactCellsState* state, bool is_volume) {
  if (state == nullptr || state->empty()) return nullptr;
  if (state->is_volume() == is_volume) return state;
  throw Error(
      is_volume
          ? "these cells are those of a plane: polygons, with edges; faces and polyhedra are of volumes"
          : "these cells are those of a volume: polyhedra, with faces; edges and polygons are of planes");
}

}  // namespace

ExactPolygons ExactCellsResult::read_polygons() const {
  if (state_of_kind(state_.get(), false) == nullptr || size() == 0) return {{0}, {}, {}, {}};
  const std::size_t count = edges();
  const Device& device = *state_->device;
  std::vector<Point> vertices;
  vertices.reserve(count);
  for (const cl_double2& vertex : download<cl_double2>(device, state_->vertices, count)) {
    vertices.push_back({vertex.s[0], vertex.s[1]});
  }
  return {download<cl_uint>(device, state_->offsets, size() + 1), std::move(vertices),
          download<cl_uint>(device, state_->edge_neighbours, count),
          download<cl_double>(device, state_->lengths, count)};
}

std::vector<ExactPair> ExactCellsResult::read_pairs() const {
  const ExactPolygons polygons = read_polygons();
  std::vector<ExactPair> pairs;
  pairs.reserve(polygons.vertices.size() / 2);
  std::vector<std::size_t> own;  // edges that a cell shares with itself
  for (std::uint32_t a = 0; a + 1 < polygons.offsets.size(); ++a) {
    const std::size_t first = pairs.size(), begin = polygons.offsets[a], end = polygons.offsets[a + 1];
    const auto ends = [&](std::size_t i) {
      return std::make_pair(polygons.vertices[i], polygons.vertices[i + 1 < end ? i + 1 : begin]);
    };
    const auto add = [&](std::size_t i) {
      const auto [from, to] = ends(i);
      pairs.push_back(
          {a, polygons.neighbours[i], polygons.lengths[i], {(from.x + to.x) / 2, (from.y + to.y) / 2}});
    };
    own.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t b = polygons.neighbours[i];
      if (b == a) own.push_back(i);
      if (b > a && b != no_label) add(i);
    }
    // Half of them are the other half, a period away, and come in the same order: of each two one on the
    // right or above.
    const std::size_t half = own.size() / 2;
    for (std::size_t i = 0; i < half; ++i) {
      const auto [from, to] = ends(own[i]);
      const bool is_meant = to.y > from.y || (to.y == from.y && to.x < from.x);
      add(own[is_meant ? i : i + half]);
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end(),
              [](const ExactPair& p, const ExactPair& q) {
                return std::tie(p.b, p.midpoint.x, p.midpoint.y) < std::tie(q.b, q.midpoint.x, q.midpoint.y);
              });
  }
  return pairs;
}

std::vector<ExactFace> ExactCellsResult::read_faces() const {
  if (state_of_kind(state_.get(), true) == nullptr || size() == 0) return {};
  const std::size_t count = edges();
  const Device& device = *state_->device;
  const auto offsets = download<cl_uint>(device, state_->offsets, size() + 1);
  const auto neighbours = download<cl_uint>(device, state_->edge_neighbours, count);
  const auto areas = download<cl_double>(device, state_->lengths, count);
  const auto images = download<cl_ushort>(device, state_->images, count);
  const VolumeSites& sites = std::get<VolumeSites>(state_->sites);
  const std::vector<PeriodCounts>& beyond = sites.beyond;
  std::vector<ExactFace> faces;
  faces.reserve(count / 2);
  for (std::uint32_t a = 0; a < size(); ++a) {
    const std::size_t first = faces.size();
    for (std::size_t i = offsets[a]; i < offsets[a + 1]; ++i) {
      const std::uint32_t b = neighbours[i];
      if (b == no_label || b < a) continue;
      PeriodCounts image = sites.images[images[i]];
      const PeriodCounts downwards = {image[2], image[1], image[0]};
      if (b == a && downwards < PeriodCounts{}) continue;
      for (std::size_t axis = 0; axis < 3 && !beyond.empty(); ++axis)
        image[axis] += beyond[a][axis] - beyond[b][axis];
      const auto number = [](std::int64_t periods) { return static_cast<std::int32_t>(periods); };
      const ExactFace face = {a, b, areas[i], {number(image[0]), number(image[1]), number(image[2])}};
      faces.push_back(face);
    }
    std::sort(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(),
              [](const ExactFace& p, const ExactFace& q) {
                return std::tie(p.b, p.image) < std::tie(q.b, q.image);
              });
  }
  return faces;
}

ExactPolyhedra ExactCellsResult::read_polyhedra() const {
  if (state_of_kind(state_.get(), true) == nullptr || size() == 0) return {{0}, {}, {}, {0}, {}, {0}, {}};
  state_->list();
  return state_->outline();
}

ExactCellsCheck ExactCellsResult::check() const {
  ExactCellsCheck found;
  if (!state_ || state_->empty()) return found;
  long double area = 0;
  for (const ExactCell& cell : read()) {
    area += cell.area;
    found.uncertified += cell.certified ? 0 : 1;
  }
  found.area = static_cast<double>(area);
  found.rectangle_area = std::visit([](const auto& sites) { return sites.size(); }, state_->sites);
  const std::size_t count = edges();
  const auto offsets = download<cl_uint>(*state_->device, state_->offsets, size() + 1);
  const auto neighbours = download<cl_uint>(*state_->device, state_->edge_neighbours, count);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> there, back;
  for (std::uint32_t cell = 0; cell < size(); ++cell) {
    for (std::size_t i = offsets[cell]; i < offsets[cell + 1]; ++i) {
      if (neighbours[i] == no_label) continue;
      there.emplace_back(cell, neighbours[i]);
      back.emplace_back(neighbours[i], cell);
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> not_mutual;
  std::set_difference(there.begin(), there.end(), back.begin(), back.end(), std::back_inserter(not_mutual));
  found.not_mutual = not_mutual.size();
  return found;
}

Report exact_cells(const Seeds& seeds, ExactCellsResult& result) {
  const Grid& grid = seeds.grid();
  if (grid.is_spaced()) throw Error("the grid has an axis that is spaced, which exact cells cannot take");
  const Stopwatch stopwatch;
  FirstLaunches first_launches;
  ExactCellsState& state = Internal::result(result);
  state.is_made = false;
  const Device& device = seeds.device();
  require_doubles(device);
  const std::vector<std::optional<Point>> points = seeds.read();
  const std::shared_ptr<const std::vector<double>> given = Internal::state(seeds).frame()->weights;
  const std::vector<double> weights = given ? *given : std::vector<double>();
  state.cells = points.size();
  const auto [first, last] = grid.is_volume()
                                 ? state.start(device, sites_of<VolumeSites>(grid, points, weights))
                                 : state.start(device, sites_of<PlaneSites>(grid, points, weights));
  check(clFlush(device.queue()()), "starting a measurement");
  state.is_made = true;
  return Internal::report(0, first, last, stopwatch.milliseconds(), first_launches.take());
}

}  // namespace vorocl
