#include "vorocl/exact_cells.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "exact_cells/sites.hpp"
#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "runtime/has_doubles.hpp"
#include "runtime/stopwatch.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"

namespace vorocl {

namespace {

constexpr const char* cells_file = "exact_cells/cells.cl";
constexpr const char* large_cells_file = "exact_cells/large_cells.cl";
constexpr cl_uchar touches_border = 1, certified = 2;  // of measure.cl

/// Of the lists of a polygon with room for so many edges: POLYGON_MEMORY of polygon.cl.
std::size_t bytes_of_polygon(std::size_t room) { return 7 * (room + 8) * sizeof(cl_double); }

/// The edges of all cells, and on the sides of the rectangle: a planar graph with a node more for each side
/// has fewer than three edges per node, and each is an edge of two cells. On a torus it is the same without
/// sides.
std::size_t most_edges(std::size_t sites) { return 6 * sites + 24; }

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
  Sites sites;  // without its lists, which the device has
  cl_uint site_count = 0;
  cl_int top_level = 0;
  KernelSet kernels;

  cl::Buffer places, boxes, levels, ids;
  Upload<cl_int> upload_of_places, upload_of_boxes;
  Upload<cl_uint> upload_of_levels, upload_of_ids;

  cl::Buffer areas, centroids, perimeters, neighbours, flags;  // by cell
  cl::Buffer begins, counters, large, scratch;                 // see measure.cl
  cl::Buffer queue;                                            // at last the site of each cell
  cl::Buffer offsets;                                          // at first the number of edges, by cell
  cl::Buffer lengths;                                          // at first the edges as they were found
  cl::Buffer vertices, edge_neighbours;                        // edges by cell
  bool is_settled = false, is_listed = false;
  std::size_t edges = 0;  // once they are listed

  bool empty() const { return !is_made; }

  /// Enqueues all but what settle() and list() do. Returns the first command and the last one.
  std::pair<cl::Event, cl::Event> start(const Device& on, Sites&& of);

  /// Cuts the cells that had no room. Waits.
  void settle();

  /// Puts the edges in order. Waits.
  void list();

  Kernel& kernel(const char* file, const char* name) {
    return kernels.get(*device, file, name, PixelGrid(1, 1));
  }

  /// Launches a kernel that takes the sites (SITE_PARAMETERS of search.cl) first.
  template <typename... More>
  cl::Event over_sites(const char* file, const char* name, std::size_t items, const More&... more) {
    return kernel(file, name)
        .over_items(items, site_count, places, boxes, levels, top_level, sites.rectangle, sites.periods,
                    sites.lattice, more...);
  }

  /// As above, of MEASURE_PARAMETERS of measure.cl.
  template <typename... More>
  cl::Event measure(const char* file, const char* name, std::size_t items, const More&... more) {
    return over_sites(file, name, items, ids, origin(), sites.step, areas, centroids, perimeters, offsets,
                      neighbours, flags, begins, lengths, static_cast<cl_uint>(most_edges(site_count)),
                      counters, queue, more...);
  }

  cl_double2 origin() const { return {{sites.origin.x, sites.origin.y}}; }
};

std::pair<cl::Event, cl::Event> ExactCellsState::start(const Device& on, Sites&& of) {
  const auto room = [&on](cl::Buffer& buffer, std::size_t count, std::size_t bytes) {
    make_room(buffer, on, count * bytes);
  };
  is_settled = is_listed = false;
  site_count = of.count();
  top_level = of.top_level();
  room(places, of.places.size(), sizeof(cl_int));
  room(boxes, of.boxes.size(), sizeof(cl_int));
  room(levels, of.levels.size(), sizeof(cl_uint));
  room(ids, of.ids.size(), sizeof(cl_uint));
  for (cl::Buffer* const numbers : {&areas, &perimeters}) room(*numbers, cells, sizeof(cl_double));
  room(neighbours, cells, sizeof(cl_uint));
  room(offsets, cells + 1, sizeof(cl_uint));
  room(centroids, cells, sizeof(cl_double2));
  room(flags, cells, 1);
  room(begins, site_count, sizeof(cl_uint));
  room(queue, cells, sizeof(cl_uint));
  static_assert(sizeof(cl_double) == sizeof(cl_uint2));
  room(lengths, most_edges(site_count), sizeof(cl_double));
  room(counters, 2, sizeof(cl_uint));
  upload_of_places.start(on, places, std::move(of.places));
  upload_of_boxes.start(on, boxes, std::move(of.boxes));
  upload_of_levels.start(on, levels, std::move(of.levels));
  upload_of_ids.start(on, ids, std::move(of.ids));
  sites = std::move(of);
  device = on;
  const cl::Event first = fill(on, counters, cl_uint{0}, 2);
  const cl::Event cleared = kernel(cells_file, "clear_cells")
                                .over_items(cells, static_cast<cl_uint>(cells), areas, centroids, perimeters,
                                            offsets, neighbours, flags);
  const std::size_t of_item = device->tuning().shape == Shape::vector ? std::size_t{FAN} : 1;
  const cl::Event last =
      measure(cells_file, "cut_cells", (site_count + of_item - 1) / of_item, static_cast<cl_uint>(of_item));
  return {first, site_count > 0 ? last : cells > 0 ? cleared : first};
}

void ExactCellsState::settle() {
  if (is_settled) return;
  constexpr std::size_t most_scratch = std::size_t{1} << 26;
  const std::size_t most = 9 * std::size_t{site_count} + 16;  // edges of a cell, with all images of the sites
  std::size_t left = download<cl_uint>(*device, counters, 2).back();
  is_made = false;  // if anything fails from here on: the queue and its length are written over
  for (std::size_t room = 1024; left > 0; room *= 16) {
    room = std::min(room, most / 8 * 8);
    const std::size_t batch = std::clamp<std::size_t>(most_scratch / bytes_of_polygon(room), 1, left);
    make_room(scratch, *device, batch * bytes_of_polygon(room));
    make_room(large, *device, left * sizeof(cl_uint));
    copy(*device, queue, large, left * sizeof(cl_uint));
    check(clEnqueueFillBuffer(device->queue()(), counters(), "\0\0\0", sizeof(cl_uint), sizeof(cl_uint),
                              sizeof(cl_uint), 0, nullptr, nullptr),
          "filling a buffer");
    for (std::size_t from = 0; from < left; from += batch) {
      const std::size_t to = std::min(from + batch, left);
      measure(large_cells_file, "cut_large_cells", to - from, large, static_cast<cl_uint>(from),
              static_cast<cl_uint>(to), scratch, static_cast<cl_int>(room));
    }
    left = download<cl_uint>(*device, counters, 2).back();
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
  make_room(vertices, *device, sum * sizeof(cl_double2));
  is_made = false;  // if anything fails from here on: counts and found edges are written over
  upload(*device, offsets, begin_of);
  over_sites(cells_file, "place_edges", site_count, ids, begins, lengths, offsets, edge_neighbours, vertices,
             queue);
  over_sites(cells_file, "measure_edges", cells, static_cast<cl_uint>(cells), queue, origin(), sites.step,
             offsets, vertices, lengths);
  edges = sum;
  is_listed = is_made = true;
}

// --- ExactCellsResult ---

ExactCellsResult::ExactCellsResult() = default;
ExactCellsResult::~ExactCellsResult() = default;
ExactCellsResult::ExactCellsResult(ExactCellsResult&& other) noexcept = default;
ExactCellsResult& ExactCellsResult::operator=(ExactCellsResult&& other) noexcept = default;

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
  const auto centroids = download<cl_double2>(device, state_->centroids, size());
  const auto perimeters = download<cl_double>(device, state_->perimeters, size());
  const auto neighbours = download<cl_uint>(device, state_->neighbours, size());
  const auto flags = download<cl_uchar>(device, state_->flags, size());
  std::vector<ExactCell> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    cells.push_back({areas[id],
                     {centroids[id].s[0], centroids[id].s[1]},
                     perimeters[id],
                     neighbours[id],
                     (flags[id] & touches_border) != 0,
                     (flags[id] & certified) != 0});
  }
  return cells;
}

ExactPolygons ExactCellsResult::read_polygons() const {
  if (size() == 0) return {{0}, {}, {}, {}};
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

namespace {

/// Calls with each cell and each of its edges: where it begins and ends.
template <typename Edge>
void each_edge(const ExactPolygons& polygons, Edge edge) {
  for (std::uint32_t cell = 0; cell + 1 < polygons.offsets.size(); ++cell) {
    const std::size_t begin = polygons.offsets[cell], end = polygons.offsets[cell + 1];
    for (std::size_t i = begin; i < end; ++i) {
      edge(cell, i, polygons.vertices[i], polygons.vertices[i + 1 < end ? i + 1 : begin]);
    }
  }
}

/// Of the two edges that a cell shares with itself, the one on its right or, if both are level, upper side.
bool is_first_of_two(const Point& from, const Point& to) {
  return to.y > from.y || (to.y == from.y && to.x < from.x);
}

}  // namespace

std::vector<ExactPair> ExactCellsResult::read_pairs() const {
  const ExactPolygons polygons = read_polygons();
  std::vector<ExactPair> pairs;
  pairs.reserve(polygons.vertices.size() / 2);
  each_edge(polygons, [&](std::uint32_t a, std::size_t i, const Point& from, const Point& to) {
    const std::uint32_t b = polygons.neighbours[i];
    if (b == no_label || b < a || (b == a && !is_first_of_two(from, to))) return;
    pairs.push_back({a, b, polygons.lengths[i], {(from.x + to.x) / 2, (from.y + to.y) / 2}});
  });
  std::sort(pairs.begin(), pairs.end(), [](const ExactPair& p, const ExactPair& q) {
    return std::tie(p.a, p.b, p.midpoint.x, p.midpoint.y) < std::tie(q.a, q.b, q.midpoint.x, q.midpoint.y);
  });
  return pairs;
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
  const cl_int4& sides = state_->sites.rectangle;
  found.rectangle_area =
      (sides.s[2] - sides.s[0]) * state_->sites.step * ((sides.s[3] - sides.s[1]) * state_->sites.step);
  const ExactPolygons polygons = read_polygons();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> there, back;
  each_edge(polygons, [&](std::uint32_t cell, std::size_t i, const Point&, const Point&) {
    const std::uint32_t other = polygons.neighbours[i];
    if (other == no_label) return;
    there.emplace_back(cell, other);
    back.emplace_back(other, cell);
  });
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> not_mutual;
  std::set_difference(there.begin(), there.end(), back.begin(), back.end(), std::back_inserter(not_mutual));
  found.not_mutual = not_mutual.size();
  return found;
}

Report exact_cells(const Seeds& seeds, ExactCellsResult& result) {
  refuse_volume(seeds.grid(), "polygons of exact cells");
  const Stopwatch stopwatch;
  FirstLaunches first_launches;
  ExactCellsState& state = Internal::result(result);
  state.is_made = false;
  const Device& device = seeds.device();
  require_doubles(device);
  state.cells = seeds.size();
  const auto [first, last] = state.start(device, sites_of(seeds.grid(), seeds.read()));
  check(clFlush(device.queue()()), "starting a measurement");
  state.is_made = true;
  return Internal::report(0, first, last, stopwatch.milliseconds(), first_launches.take());
}

}  // namespace vorocl
