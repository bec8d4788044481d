// The C functions of diagrams.
#include <vector>

#include "calls.hpp"

using namespace vorocl;

vorocl_status vorocl_diagram_create(const vorocl_device* device, vorocl_window window,
                                    vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    return vorocl_diagram{Diagram(of(device), to_window(window)), {}};
  });
}

vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, vorocl_window window, cl_mem labels,
                                         vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    given(labels, "labels");
    return vorocl_diagram{Diagram(of(device), to_window(window), retained(labels)), {}};
  });
}

void vorocl_diagram_free(vorocl_diagram* diagram) { delete diagram; }

vorocl_status vorocl_diagram_window(const vorocl_diagram* diagram, vorocl_window* window) {
  return answer(window, "window", [&] { return to_c(of(diagram).window()); });
}

vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels) {
  return answer(labels, "labels", [&] { return of(diagram).labels()(); });
}

vorocl_status vorocl_diagram_metric(const vorocl_diagram* diagram, vorocl_metric* metric) {
  return answer(metric, "metric", [&] { return static_cast<vorocl_metric>(of(diagram).metric()); });
}

vorocl_status vorocl_diagram_method(const vorocl_diagram* diagram, const char** name) {
  return answer(name, "name", [&] { return of(diagram).method().c_str(); });
}

namespace {

template <typename Labels>
void write(vorocl_diagram& diagram, const Labels& labels, const vorocl_seeds* seeds, vorocl_metric metric) {
  if (seeds == nullptr) {
    diagram.diagram.write(labels);
  } else {
    diagram.diagram.write(labels, of(seeds), to_metric(metric));
  }
}

}  // namespace

vorocl_status vorocl_diagram_write(vorocl_diagram* diagram, const uint32_t* labels, size_t count,
                                   const vorocl_seeds* seeds, vorocl_metric metric) {
  return guarded([&] {
    const std::size_t pixels = of(diagram).window().pixels();
    const uint32_t* const first = &given(labels, "labels");
    diagram->report = {};
    check_count(pixels, "pixels", count);
    write(*diagram, std::vector<uint32_t>(first, first + count), seeds, metric);
  });
}

vorocl_status vorocl_diagram_write_buffer(vorocl_diagram* diagram, cl_mem labels, const vorocl_seeds* seeds,
                                          vorocl_metric metric) {
  return guarded([&] {
    given(labels, "labels");
    given(diagram, "diagram").report = {};
    write(*diagram, retained(labels), seeds, metric);
  });
}

vorocl_status vorocl_diagram_event(const vorocl_diagram* diagram, cl_event* event) {
  return answer(event, "event", [&] { return given(diagram, "diagram").report.event()(); });
}

vorocl_status vorocl_diagram_report(const vorocl_diagram* diagram, int* waves, double* milliseconds,
                                    double* host_milliseconds) {
  return guarded([&] {
    const Report& report = given(diagram, "diagram").report;
    if (milliseconds != nullptr) *milliseconds = report.milliseconds();  // the only one that waits
    store(waves, report.waves());
    store(host_milliseconds, report.host_milliseconds());
  });
}

vorocl_status vorocl_diagram_snapped(const vorocl_diagram* diagram, int* snapped) {
  return answer(snapped, "snapped", [&] { return given(diagram, "diagram").report.snapped() ? 1 : 0; });
}

vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count) {
  return guarded([&] {
    check_count(of(diagram).window().pixels(), "pixels", count);
    of(diagram).read(&given(labels, "labels"));
  });
}

vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram) {
  return guarded([&] { of(diagram).wait(); });
}
