// The C functions of diagrams.
#include "calls.hpp"

using namespace vorocl;

vorocl_status vorocl_diagram_create(const vorocl_device* device, vorocl_grid grid, vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    return vorocl_diagram{Diagram(of(device), to_grid(grid)), {}};
  });
}

vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, vorocl_grid grid, cl_mem labels,
                                         vorocl_diagram** diagram) {
  return make_object(diagram, "diagram", [&] {
    given(labels, "labels");
    return vorocl_diagram{Diagram(of(device), to_grid(grid), retained(labels)), {}};
  });
}

void vorocl_diagram_free(vorocl_diagram* diagram) { delete diagram; }

vorocl_status vorocl_diagram_grid(const vorocl_diagram* diagram, vorocl_grid* grid) {
  return answer(grid, "grid", [&] { return to_c(of(diagram).grid()); });
}

vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels) {
  return answer(labels, "labels", [&] { return of(diagram).labels()(); });
}

vorocl_status vorocl_diagram_write(vorocl_diagram* diagram, const uint32_t* labels, size_t count) {
  return guarded([&] {
    check_count(of(diagram).grid().pixels(), "pixels", count);
    const uint32_t* const first = &given(labels, "labels");
    diagram->report = {};
    diagram->diagram.write({first, first + count});
  });
}

vorocl_status vorocl_diagram_write_buffer(vorocl_diagram* diagram, cl_mem labels) {
  return guarded([&] {
    given(labels, "labels");
    given(diagram, "diagram").report = {};
    diagram->diagram.write(retained(labels));
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

vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count) {
  return guarded([&] {
    check_count(of(diagram).grid().pixels(), "pixels", count);
    of(diagram).read(&given(labels, "labels"));
  });
}

vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram) {
  return guarded([&] { of(diagram).wait(); });
}

vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent) {
  return answer(percent, "percent", [&] { return similarity(of(a), of(b)); });
}

vorocl_status vorocl_changed_pixels(const vorocl_diagram* a, const vorocl_diagram* b, size_t* pixels) {
  return answer(pixels, "pixels", [&] { return changed_pixels(of(a), of(b)); });
}

vorocl_status vorocl_count_vertices(const vorocl_diagram* diagram, size_t* vertices) {
  return answer(vertices, "vertices", [&] { return count_vertices(of(diagram)); });
}
