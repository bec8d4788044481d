// The caller's own buffers and events: used without a copy, and refused before any work where they do not
// fit.
#define BOOST_TEST_MODULE callers_objects
#include <algorithm>
#include <memory>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

const Grid grid(50, 30);
const std::size_t bytes = grid.pixels() * sizeof(std::uint32_t);

cl::Buffer make_buffer(std::size_t size, cl_mem_flags flags = CL_MEM_READ_WRITE) {
  return cl::Buffer(test_device().context(), flags, size);
}

std::vector<std::uint32_t> content_of(const cl::Buffer& buffer, std::size_t first, std::size_t count) {
  std::vector<std::uint32_t> values(count);
  test_device().queue().enqueueReadBuffer(buffer, CL_TRUE, first * 4, count * 4, values.data());
  return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_go_to_the_callers_buffer) {
  const auto pixels = random_pixels(grid, 20, 3);
  const cl::Buffer labels = make_buffer(bytes);
  Diagram diagram(test_device(), grid, labels);
  BOOST_TEST(diagram.labels()() == labels());
  exact_diagram(Seeds(test_device(), grid, centres(pixels), to_centres), diagram);
  const auto ground_truth = brute_force(grid, pixels, Metric::euclidean);
  BOOST_TEST((diagram.read() == ground_truth));
  BOOST_TEST((content_of(labels, 0, grid.pixels()) == ground_truth));
}

// Aligned as numbers are, and no better: NumPy's arrays are.
BOOST_AUTO_TEST_CASE(labels_go_to_the_hosts_memory) {
  const auto pixels = random_pixels(grid, 20, 3), others = random_pixels(grid, 30, 4);
  const auto ground_truth = brute_force(grid, pixels, Metric::euclidean),
             other_truth = brute_force(grid, others, Metric::euclidean);
  const Seeds seeds(test_device(), grid, centres(pixels), to_centres),
      other_seeds(test_device(), grid, centres(others), to_centres);
  const std::uint32_t mark = 0xabcd1234;
  std::vector<std::uint32_t> memory(grid.pixels() + 2, mark), second = memory, elsewhere(grid.pixels());
  const auto holds = [&](const std::vector<std::uint32_t>& labels) {
    return memory.front() == mark && memory.back() == mark &&
           std::equal(labels.begin(), labels.end(), memory.begin() + 1);
  };
  Diagram diagram(test_device(), grid, memory.data() + 1);
  for (const Method& each : methods()) {
    each.run(seeds, diagram, {});
    diagram.read(memory.data() + 1);
    diagram.read(elsewhere.data());
    BOOST_TEST(holds(elsewhere), each.name);
    if (each.exact) BOOST_TEST(holds(ground_truth));
  }
  CellSumsResult sums;
  cell_sums(diagram, sums);
  std::uint64_t area = 0;
  for (const CellSums& cell : sums.read()) area += cell.area;
  BOOST_TEST(area == grid.pixels());

  // Then they go elsewhere, and this memory is the caller's alone.
  diagram.put_labels_at(second.data() + 1);
  check_error([&] { diagram.metric(); }, {"no method has filled it"});
  exact_diagram(other_seeds, diagram);
  diagram.read(second.data() + 1);
  BOOST_TEST(std::equal(other_truth.begin(), other_truth.end(), second.begin() + 1));
  diagram.put_labels_at(nullptr);
  exact_diagram(seeds, diagram);
  BOOST_TEST((diagram.read() == ground_truth));
  BOOST_TEST(std::equal(other_truth.begin(), other_truth.end(), second.begin() + 1));
  BOOST_TEST(holds(ground_truth));
  check_error([] { Diagram(test_device(), grid, static_cast<std::uint32_t*>(nullptr)); }, {"memory", "null"});
}

// Under the address sanitizer, a device that still writes is found.
BOOST_AUTO_TEST_CASE(memory_may_go_once_its_diagram_is_gone) {
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 20, 3)), to_centres);
  for (int i = 0; i < 20; ++i) {
    const auto memory = std::make_unique<std::uint32_t[]>(grid.pixels());
    Diagram diagram(test_device(), grid, memory.get());
    jump_flooding(seeds, diagram);
  }
}

BOOST_AUTO_TEST_CASE(a_larger_buffer_and_a_sub_buffer_keep_what_lies_outside) {
  const std::uint32_t mark = 0xabcd1234;
  const std::size_t before = 4096;  // of the sub-buffer: a multiple of every device's alignment
  const cl::Buffer whole = make_buffer(before + bytes + 400);
  test_device().queue().enqueueFillBuffer(whole, mark, 0, before + bytes + 400);
  const cl_buffer_region region = {before, bytes + 200};
  cl::Buffer parent = whole;
  const cl::Buffer part = parent.createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &region);

  Diagram diagram(test_device(), grid, part);
  BOOST_TEST(diagram.read().front() == mark);  // nothing is written before an engine runs
  for (int frame = 0; frame < 2; ++frame) {
    dynamic_jump_flooding(Seeds(test_device(), grid, {{3, 4}}, to_centres), diagram);
    BOOST_TEST((diagram.read() == std::vector<std::uint32_t>(grid.pixels(), 0)));
  }
  BOOST_TEST((content_of(whole, 0, before / 4) == std::vector<std::uint32_t>(before / 4, mark)));
  BOOST_TEST((content_of(whole, (before + bytes) / 4, 100) == std::vector<std::uint32_t>(100, mark)));
}

BOOST_AUTO_TEST_CASE(unfit_label_buffers_are_refused) {
  const auto over = [](const cl::Buffer& labels) { Diagram(test_device(), grid, labels); };
  check_error([&] { over(cl::Buffer()); }, {"labels", "null"});
  check_error([&] { over(make_buffer(bytes - 1)); }, {"5999 bytes", "6000 are needed"});
  check_error([&] { over(make_buffer(bytes, CL_MEM_READ_ONLY)); }, {"labels", "read-only"});
  check_error([&] { over(make_buffer(bytes, CL_MEM_WRITE_ONLY)); }, {"labels", "write-only"});
  const Device other = Device::select();
  check_error([&] { Diagram(other, grid, make_buffer(bytes)); }, {"another OpenCL context"});
}

BOOST_AUTO_TEST_CASE(a_diagrams_own_labels_cannot_be_written_into_it) {
  Diagram diagram(test_device(), grid);
  check_error([&] { diagram.write(diagram.labels()); }, {"the diagram's own"});
  cl::Buffer whole = make_buffer(8192 + bytes);
  const auto part = [&](std::size_t first) {
    const cl_buffer_region region = {first, bytes};
    return whole.createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &region);
  };
  Diagram over_a_part(test_device(), grid, part(0));
  for (const cl::Buffer& overlapping : {part(4096), whole}) {
    try {
      over_a_part.write(overlapping);
      BOOST_ERROR("nothing was thrown");
    } catch (const Error& error) {
      BOOST_TEST((error.kind() == ErrorKind::bad_argument), error.what());
      BOOST_TEST(std::string(error.what()).find("overlap") != std::string::npos);
    }
  }
  const std::vector<std::uint32_t> labels(grid.pixels(), 7);
  const cl::Buffer beside = part(8192);
  test_device().queue().enqueueWriteBuffer(beside, CL_TRUE, 0, bytes, labels.data());
  over_a_part.write(beside);
  BOOST_TEST(over_a_part.read() == labels);
}

BOOST_AUTO_TEST_CASE(an_image_is_no_buffer) {
  const cl::ImageFormat format(CL_R, CL_UNSIGNED_INT32);
  cl_int code = CL_SUCCESS;
  const cl::Image2D image(test_device().context(), CL_MEM_READ_WRITE, format, 50, 30, 0, nullptr, &code);
  if (code != CL_SUCCESS) return;  // the device has no such images
  check_error([&] { Diagram(test_device(), grid, cl::Buffer(image(), true)); }, {"another kind"});
}

// What was read or measured once is not kept from being freed.
BOOST_AUTO_TEST_CASE(the_callers_buffers_are_held_no_longer_than_needed) {
  const auto holders = [](const cl::Buffer& buffer) { return buffer.getInfo<CL_MEM_REFERENCE_COUNT>(); };
  const std::vector<cl_float2> values = {{{7, 8}}, {{40, 20}}};
  const cl::Buffer points(test_device().queue(), values.begin(), values.end(), true);
  const cl::Buffer marks = make_buffer(2), labels = make_buffer(bytes);
  test_device().queue().enqueueFillBuffer(marks, cl_uchar{1}, 0, 2);
  const Seeds seeds(test_device(), grid, PointBuffer(points, 2, PointFormat::floats_xy, marks),
                    kept_on_device);
  CellSumsResult sums;
  Field<float> field;
  {
    Diagram diagram(test_device(), grid, labels);
    exact_diagram(seeds, diagram);
    cell_sums(diagram, sums);
    distance_field(diagram, field);
    diagram.wait();
  }
  BOOST_TEST(sums.read()[0].area + sums.read()[1].area == grid.pixels());
  BOOST_TEST(holders(points) == 1u);
  BOOST_TEST(holders(marks) == 1u);
  BOOST_TEST(holders(labels) == 1u);
}

BOOST_AUTO_TEST_CASE(write_only_points_are_refused) {
  check_error(
      [] { Seeds(test_device(), grid, PointBuffer(make_buffer(80, CL_MEM_WRITE_ONLY), 10), kept_on_device); },
      {"10 points", "write-only"});
}

BOOST_AUTO_TEST_CASE(the_device_waits_for_the_callers_events) {
  // The points come when the user event is set, long after all is enqueued.
  const Device& device = test_device();
  const cl::CommandQueue other_queue(device.context(), device.cl_device());
  const std::vector<cl_float2> values = {{{7, 8}}, {{40, 20}}};
  const cl::Buffer points = make_buffer(sizeof(cl_float2) * 2);
  device.queue().enqueueFillBuffer(points, cl_float{-1}, 0, sizeof(cl_float2) * 2);
  device.finish();
  cl::UserEvent go(device.context());
  const std::vector<cl::Event> start = {go};
  cl::Event uploaded;
  other_queue.enqueueWriteBuffer(points, CL_FALSE, 0, sizeof(cl_float2) * 2, values.data(), &start,
                                 &uploaded);
  other_queue.flush();

  device.wait_for({});
  device.wait_for({uploaded});
  const Seeds seeds(device, grid, PointBuffer(points, 2), kept_on_device);
  Diagram diagram(device, grid);
  const Report report = jump_flooding(seeds, diagram);
  BOOST_TEST(report.event().getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() != CL_COMPLETE);
  go.setStatus(CL_COMPLETE);
  BOOST_TEST((diagram.read() == brute_force(grid, {{7, 8}, {40, 20}}, Metric::euclidean)));
}

BOOST_AUTO_TEST_CASE(unfit_events_are_refused) {
  check_error([] { test_device().wait_for({cl::Event()}); }, {"event", "null"});
  const cl::UserEvent foreign(Device::select().context());
  check_error([&] { test_device().wait_for({foreign}); }, {"event", "another OpenCL context"});
}
