// The C functions that make, read and free objects.
#include "c_api.hpp"

#include <limits>
#include <optional>
#include <vector>

#include "opencl_error.hpp"

namespace vorocl {

namespace {
thread_local std::string last_message;
}

vorocl_status report_failure(vorocl_status status, const char* what, const char* more) noexcept {
  try {
    last_message = std::string(what) + more;
  } catch (const std::bad_alloc&) {
    last_message.clear();
  }
  return status;
}

}  // namespace vorocl

using namespace vorocl;

namespace {

/// As guarded(), for a body that makes an object.
template <typename T, typename Make>
vorocl_status make_object(T** object, const char* name, Make make) {
  return guarded([&] {
    given(object, name) = nullptr;
    *object = new T(make());
  });
}

Border to_border(vorocl_border border) {
  if (border == VOROCL_REFLECT) return Border::reflect;
  if (border == VOROCL_PERIODIC) return Border::periodic;
  refuse("border", border);
}

/// Checks a list of points before it is copied.
void check_points(const vorocl_point* points, std::size_t count) {
  if (count > 0) given(points, "points");
  if (count > Grid::max_pixels)
    throw Error(std::to_string(count) + " seeds are too many; at most 2^30 are possible");
}

cl::Buffer retained(cl_mem buffer) { return cl::Buffer(buffer, true); }

}  // namespace

const char* vorocl_error_message(void) { return last_message.c_str(); }
const char* vorocl_version(void) { return VOROCL_VERSION; }

// --- devices ---

vorocl_status vorocl_device_select(const char* request, vorocl_device** device) {
  return make_object(device, "device", [&] {
    const Device selected = Device::select(request == nullptr ? "" : request);
    return vorocl_device{selected, selected.name()};
  });
}

vorocl_status vorocl_device_adopt(cl_context context, cl_command_queue queue, vorocl_device** device) {
  return make_object(device, "device", [&] {
    given(context, "context");
    given(queue, "queue");
    const Device adopted(cl::Context(context, true), cl::CommandQueue(queue, true));
    return vorocl_device{adopted, adopted.name()};
  });
}

void vorocl_device_free(vorocl_device* device) { delete device; }

vorocl_status vorocl_device_name(const vorocl_device* device, const char** name) {
  return guarded([&] { given(name, "name") = given(device, "device").name.c_str(); });
}

vorocl_status vorocl_device_context(const vorocl_device* device, cl_context* context) {
  return guarded([&] { given(context, "context") = of(device).context()(); });
}

vorocl_status vorocl_device_queue(const vorocl_device* device, cl_command_queue* queue) {
  return guarded([&] { given(queue, "queue") = of(device).queue()(); });
}

vorocl_status vorocl_device_wait_for(const vorocl_device* device, size_t count, const cl_event* events) {
  return guarded([&] {
    if (count > 0) given(events, "events");
    std::vector<cl::Event> all;
    for (std::size_t i = 0; i < count; ++i) all.emplace_back(events[i], true);
    of(device).wait_for(all);
  });
}

vorocl_status vorocl_device_finish(const vorocl_device* device) {
  return guarded([&] { of(device).finish(); });
}

// --- seeds ---

vorocl_status vorocl_seeds_from_points(const vorocl_device* device, int64_t width, int64_t height,
                                       const vorocl_point* points, size_t count, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    check_points(points, count);
    std::vector<Point> list;
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) list.push_back({points[i].x, points[i].y});
    return vorocl_seeds{Seeds(of(device), Grid(width, height), list)};
  });
}

vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, int64_t width, int64_t height,
                                       cl_mem points, size_t count, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    given(points, "points");
    return vorocl_seeds{Seeds(of(device), Grid(width, height), retained(points), count)};
  });
}

vorocl_status vorocl_seeds_random(const vorocl_device* device, int64_t width, int64_t height, size_t count,
                                  uint64_t rng_seed, vorocl_seeds** seeds) {
  return make_object(seeds, "seeds", [&] {
    return vorocl_seeds{Seeds::random(of(device), Grid(width, height), count, rng_seed)};
  });
}

void vorocl_seeds_free(vorocl_seeds* seeds) { delete seeds; }

vorocl_status vorocl_seeds_count(const vorocl_seeds* seeds, size_t* count) {
  return guarded([&] { given(count, "count") = of(seeds).size(); });
}

vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points,
                                   const unsigned char* present, size_t count) {
  return guarded([&] {
    check_points(points, count);
    std::vector<std::optional<Point>> list(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (present == nullptr || present[i] != 0) list[i] = Point{points[i].x, points[i].y};
    }
    of(seeds).move_to(list);
  });
}

vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points, size_t count) {
  return guarded([&] {
    given(points, "points");
    of(seeds).move_to(retained(points), count);
  });
}

vorocl_status vorocl_random_step(vorocl_seeds* seeds, int most, vorocl_border border, uint64_t rng_seed,
                                 uint32_t frame) {
  return guarded([&] { random_step(of(seeds), most, to_border(border), rng_seed, frame); });
}

vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count) {
  return guarded([&] {
    if (count != of(seeds).size()) {
      throw Error("there are " + std::to_string(of(seeds).size()) + " seeds, and room for " +
                  std::to_string(count));
    }
    if (count > 0) given(points, "points");
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const std::optional<Point>& point : of(seeds).read()) {
      *points++ = point ? vorocl_point{point->x, point->y} : vorocl_point{none, none};
    }
  });
}

// --- diagrams ---

vorocl_status vorocl_diagram_create(const vorocl_device* device, int64_t width, int64_t height,
                                    vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    return vorocl_diagram{Diagram(of(device), Grid(width, height)), {}};
  });
}

vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, int64_t width, int64_t height,
                                         cl_mem labels, vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    given(labels, "labels");
    return vorocl_diagram{Diagram(of(device), Grid(width, height), retained(labels)), {}};
  });
}

void vorocl_diagram_free(vorocl_diagram* diagram) { delete diagram; }

vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels) {
  return guarded([&] { given(labels, "labels") = of(diagram).labels()(); });
}

vorocl_status vorocl_diagram_event(const vorocl_diagram* diagram, cl_event* event) {
  return guarded([&] { given(event, "event") = given(diagram, "diagram").report.event()(); });
}

vorocl_status vorocl_diagram_report(const vorocl_diagram* diagram, int* waves, double* milliseconds) {
  return guarded([&] {
    const Report& report = given(diagram, "diagram").report;
    if (waves != nullptr) *waves = report.waves();
    if (milliseconds != nullptr) *milliseconds = report.milliseconds();
  });
}

vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count) {
  return guarded([&] {
    const Diagram& from = of(diagram);
    const std::size_t pixels = from.grid().pixels();
    if (count != pixels) {
      throw Error("the diagram has " + std::to_string(pixels) + " pixels, and there is room for " +
                  std::to_string(count));
    }
    given(labels, "labels");
    from.wait();
    // Straight to where they go: Diagram::read() would need a second image on the host.
    check(clEnqueueReadBuffer(from.device().queue()(), from.labels()(), CL_TRUE, 0, pixels * sizeof(uint32_t),
                              labels, 0, nullptr, nullptr),
          "reading the labels");
  });
}

vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram) {
  return guarded([&] { of(diagram).wait(); });
}

vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent) {
  return guarded([&] { given(percent, "percent") = similarity(of(a), of(b)); });
}
