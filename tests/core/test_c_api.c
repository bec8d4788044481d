/* The C functions of devices, seeds, diagrams and methods, from C: each against a search of every pixel or a
   known value. Also built against an installed copy, through pkg-config. */
#include "test_c_api.h"

static const struct {
  const char* name;
  int exact, continues, outer_seeds, waves;
} some_methods[] = {{"standard-flooding", 0, 0, 0, -1},
                    {"jfa", 0, 0, 0, 6},
                    {"jfa+1", 0, 0, 0, 7},
                    {"jfa+2", 0, 0, 0, 8},
                    {"1+jfa", 0, 0, 0, 7},
                    {"djfa", 0, 1, 0, 6},
                    {"exact", 1, 0, 1, 0}};

static void test_devices(const vorocl_device* device) {
  vorocl_device_list* list = NULL;
  vorocl_device_description description;
  vorocl_device *adopted = NULL, *tuned = NULL;
  vorocl_tuning tuning, read;
  const char *name = NULL, *platform = NULL, *driver = NULL;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_device_id id = NULL, id_of_queue = NULL;
  size_t count = 0, selected = 0;
  OK(vorocl_device_name(device, &name));
  OK(vorocl_device_platform_name(device, &platform));
  OK(vorocl_device_driver_version(device, &driver));

  OK(vorocl_device_list_create(NULL, &list));
  OK(vorocl_device_list_count(list, &count));
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_device_list_get(list, i, &description));
    CHECK(strlen(description.type) > 0 && strncmp(description.opencl_version, "OpenCL ", 7) == 0);
    CHECK(description.global_memory >= description.max_allocation && description.compute_units > 0);
    if (!description.selected) continue;
    ++selected;
    CHECK(strcmp(description.name, name) == 0 && strcmp(description.platform, platform) == 0);
    CHECK(strcmp(description.driver_version, driver) == 0);
    CHECK(strlen(description.reason) > 0 && strlen(description.why_not) == 0);
  }
  CHECK(selected == 1);
  vorocl_device_list_free(list);
  OK(vorocl_device_list_create("no such device", &list));
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_device_list_get(list, i, &description));
    CHECK(!description.selected);
  }
  vorocl_device_list_free(list);

  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_device_id(device, &id));
  CHECK(clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof id_of_queue, &id_of_queue, NULL) == CL_SUCCESS);
  CHECK(id == id_of_queue);
  OK(vorocl_device_adopt(context, queue, &adopted));
  OK(vorocl_device_tuning(adopted, &tuning));
  CHECK(tuning.vector_width >= 1 && tuning.group_width * tuning.group_height >= 1);
  tuning.vector_width = tuning.vector_width == 1 ? 2 : 1;
  tuning.group_width = 3;
  tuning.group_height = 2;
  tuning.shape = tuning.shape == VOROCL_GROUP ? VOROCL_VECTOR : VOROCL_GROUP;
  tuning.patch_items = 128;
  OK(vorocl_device_with_tuning(adopted, &tuning, &tuned));
  vorocl_device_free(adopted);
  OK(vorocl_device_tuning(tuned, &read));
  CHECK(read.vector_width == tuning.vector_width && read.group_width == 3 && read.group_height == 2);
  CHECK(read.shape == tuning.shape && read.patch_items == 128);
  vorocl_device_free(tuned);
}

static void test_methods(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *exact = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_method_description method;
  uint32_t nearest[pixels], nearest_manhattan[pixels], by_name[pixels];
  size_t count = 0;
  int waves = -1;
  double percent = 0, milliseconds = -1, host_milliseconds = -1;
  cl_event event = NULL;
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  search_all(points, present, seed_count, VOROCL_MANHATTAN, nearest_manhattan);
  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, &seeds));
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_diagram_create(device, grid, &exact));
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);

  OK(vorocl_exact_diagram(seeds, exact, VOROCL_MANHATTAN));
  CHECK(has_labels(exact, nearest_manhattan));
  OK(vorocl_exact_diagram(seeds, exact, VOROCL_EUCLIDEAN));
  CHECK(has_labels(exact, nearest));

  OK(vorocl_method_count(&count));
  CHECK(count >= sizeof some_methods / sizeof *some_methods);
  count = sizeof some_methods / sizeof *some_methods;
  for (size_t i = 0; i < count; ++i) {
    OK(vorocl_method_get(i, &method));
    CHECK(strcmp(method.name, some_methods[i].name) == 0);
    CHECK(method.exact == some_methods[i].exact && method.continues == some_methods[i].continues);
    CHECK(method.outer_seeds == some_methods[i].outer_seeds);
    OK(vorocl_prepare(method.name, device, grid, seed_count, NULL));
    OK(vorocl_run(method.name, seeds, diagram, 0, &options));
    OK(vorocl_diagram_report(diagram, &waves, &milliseconds, &host_milliseconds));
    CHECK(some_methods[i].waves < 0 || waves == some_methods[i].waves);
    CHECK(milliseconds > 0 && host_milliseconds > 0);
    OK(vorocl_diagram_event(diagram, &event));
    CHECK(event != NULL && clWaitForEvents(1, &event) == CL_SUCCESS);
    OK(vorocl_similarity(diagram, exact, &percent));
    CHECK(method.exact ? percent == 100 : percent > 99);
  }

  /* Each by its own function, and by its options. */
  OK(vorocl_standard_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE));
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent > 99);
  for (vorocl_variant variant = VOROCL_JFA; variant <= VOROCL_ONE_PLUS_JFA; ++variant) {
    OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_DEFAULT_NEIGHBOURHOOD, variant));
    OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
    CHECK(waves == some_methods[1 + variant].waves);
    OK(vorocl_diagram_read(diagram, by_name, pixels));
    OK(vorocl_run(some_methods[1 + variant].name, seeds, diagram, 0, NULL));
    CHECK(has_labels(diagram, by_name));
  }
  options.neighbourhood = VOROCL_VON_NEUMANN;
  OK(vorocl_run("jfa", seeds, diagram, 0, &options));
  OK(vorocl_diagram_read(diagram, by_name, pixels));
  OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_VON_NEUMANN, VOROCL_JFA));
  CHECK(has_labels(diagram, by_name));
  OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA));
  CHECK(!has_labels(diagram, by_name)); /* von Neumann waves go wrong, as the paper shows */
  options.metric = VOROCL_MANHATTAN;
  OK(vorocl_run("exact", seeds, diagram, 0, &options));
  CHECK(has_labels(diagram, nearest_manhattan));

  OK(vorocl_device_finish(device));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(exact);
}

/* Four waves go on from labels that are there, six start from seeds alone: 200 seeds are 3.5 pixels apart. */
static void test_dynamic_jump_flooding(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *exact = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_point list[200];
  uint32_t nearest[pixels];
  cl_mem labels = NULL;
  cl_event event = NULL;
  int waves = -1;
  size_t changed = 1;
  double percent = 0, milliseconds = -1, host_milliseconds = -1;
  OK(vorocl_seeds_random(device, grid, 200, 7, &seeds));
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_diagram_create(device, grid, &exact));
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, 0, NULL));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);
  OK(vorocl_random_step(seeds, 2, VOROCL_PERIODIC, 7, 1));
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, 61, NULL));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6); /* as far as the grid */
  OK(vorocl_random_step(seeds, 2, VOROCL_REFLECT, 7, 2));
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, 2, NULL));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 4);
  OK(vorocl_exact_diagram(seeds, exact, VOROCL_EUCLIDEAN));
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent > 95);

  /* Right labels written into a diagram stay right, and are gone on from with the paper's plan. */
  options.reach = VOROCL_REACH_PAPER;
  OK(vorocl_seeds_read(seeds, list, 200));
  search_all(list, NULL, 200, VOROCL_EUCLIDEAN, nearest);
  CHECK(has_labels(exact, nearest));
  nearest[5] = VOROCL_NO_LABEL;
  OK(vorocl_diagram_write(diagram, nearest, pixels));
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 1);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_report(diagram, &waves, &milliseconds, NULL));
  CHECK(waves == 0 && milliseconds == 0);
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, 0, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 4);
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 0);
  OK(vorocl_diagram_labels(exact, &labels));
  OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_VON_NEUMANN, VOROCL_JFA));
  CHECK(!has_labels(diagram, nearest));
  OK(vorocl_diagram_write_buffer(diagram, labels));
  OK(vorocl_changed_pixels(diagram, exact, &changed));
  CHECK(changed == 0);

  /* The options reach the method. */
  options.extra_waves = 2;
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, 2, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);

  /* A call that fails has no report, and that of an earlier one is gone. */
  options.von_neumann_waves = 3;
  CHECK(vorocl_dynamic_jump_flooding(seeds, diagram, 2, &options) == VOROCL_BAD_ARGUMENT);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_report(diagram, &waves, &milliseconds, &host_milliseconds));
  CHECK(waves == 0 && milliseconds == 0 && host_milliseconds == 0);
  options.von_neumann_waves = 2;

  options.extra_waves = 0;
  options.refresh_interval = 1;
  OK(vorocl_run("djfa", seeds, diagram, 2, &options));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6);
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(exact);
}

static void test_seeds(const vorocl_device* device) {
  vorocl_seeds *seeds = NULL, *clone = NULL, *again = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_point read[200], moved[200], one = {7, 7};
  uint8_t mask[pixels] = {0};
  uint32_t nearest[pixels], positions[seed_count + 1];
  cl_mem buffer = NULL;
  cl_command_queue queue = NULL;
  size_t count = 0;
  vorocl_grid read_grid = {0, 0, 0};
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_diagram_grid(diagram, &read_grid));
  CHECK(read_grid.width == width && read_grid.height == height && read_grid.periodic == VOROCL_PERIODIC_NONE);

  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, &seeds));
  OK(vorocl_seeds_grid(seeds, &read_grid));
  CHECK(read_grid.width == width && read_grid.height == height && read_grid.periodic == VOROCL_PERIODIC_NONE);
  OK(vorocl_seeds_count(seeds, &count));
  CHECK(count == seed_count);
  OK(vorocl_seeds_alive(seeds, &count));
  CHECK(count == seed_count - 1);
  OK(vorocl_seeds_check(seeds));
  OK(vorocl_seeds_read(seeds, read, seed_count));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_seeds_positions(seeds, &buffer));
  CHECK(clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, sizeof positions, positions, 0, NULL, NULL) ==
        CL_SUCCESS);
  for (int id = 0; id < seed_count; ++id) {
    const uint32_t x = (uint32_t)points[id].x, y = (uint32_t)points[id].y;
    CHECK(positions[id] == (present[id] ? y << 16 | x : 0x80008000));
    CHECK(present[id] ? read[id].x == x + 0.5 && read[id].y == y + 0.5
                      : isnan(read[id].x) && isnan(read[id].y));
  }
  CHECK(positions[seed_count] == 0x80008000);

  /* A clone keeps what it was made from. */
  OK(vorocl_seeds_clone(seeds, &clone));
  OK(vorocl_seeds_move_to(seeds, &one, NULL, 1));
  OK(vorocl_seeds_alive(seeds, &count));
  CHECK(count == 1);
  OK(vorocl_exact_diagram(clone, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest));
  OK(vorocl_seeds_move_to(seeds, points, present, seed_count));
  vorocl_seeds_free(clone);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  vorocl_seeds_free(seeds);
  CHECK(has_labels(diagram, nearest));

  /* A mask's pixels are seeds in row-major order. */
  mask[2] = 1;
  mask[width] = 200;
  mask[pixels - 1] = 1;
  OK(vorocl_seeds_from_mask(device, grid, mask, pixels, &seeds));
  OK(vorocl_seeds_count(seeds, &count));
  CHECK(count == 3);
  OK(vorocl_seeds_read(seeds, read, 3));
  CHECK(pixel_of(read[0]) == 2 && pixel_of(read[1]) == width && pixel_of(read[2]) == pixels - 1);
  vorocl_seeds_free(seeds);

  /* Random seeds are the same for the same number, and move no farther than they may. */
  OK(vorocl_seeds_random(device, grid, 200, 7, &seeds));
  OK(vorocl_seeds_random(device, grid, 200, 7, &again));
  OK(vorocl_seeds_read(seeds, read, 200));
  OK(vorocl_seeds_read(again, moved, 200));
  CHECK(memcmp(read, moved, sizeof read) == 0);
  OK(vorocl_random_step(again, 3, VOROCL_REFLECT, 1, 1));
  OK(vorocl_seeds_read(again, moved, 200));
  CHECK(memcmp(read, moved, sizeof read) != 0);
  for (int id = 0; id < 200; ++id) {
    CHECK(fabs(read[id].x - moved[id].x) <= 3 && fabs(read[id].y - moved[id].y) <= 3);
  }
  vorocl_seeds_free(seeds);
  vorocl_seeds_free(again);

  OK(vorocl_seeds_from_points(device, grid, NULL, NULL, 0, &seeds)); /* no seeds are allowed */
  OK(vorocl_seeds_read(seeds, NULL, 0));
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  search_all(NULL, NULL, 0, VOROCL_EUCLIDEAN, nearest);
  CHECK(has_labels(diagram, nearest));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
}

/* Points, marks and labels in the caller's buffers. */
static void test_own_buffers(const vorocl_device* device) {
  float pairs[2 * seed_count];
  uint32_t labels[pixels], nearest[pixels], nearest_of_all[pixels];
  cl_int code = CL_SUCCESS;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_mem own_points, own_marks, own_labels, same_labels = NULL;
  cl_event uploaded = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  size_t alive = 0;
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  search_all(points, NULL, seed_count, VOROCL_EUCLIDEAN, nearest_of_all);
  for (int i = 0; i < seed_count; ++i) {
    pairs[2 * i] = (float)points[i].x;
    pairs[2 * i + 1] = (float)points[i].y;
  }
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  own_points = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof pairs, NULL, &code);
  own_marks = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof present, (void*)(uintptr_t)present, &code);
  own_labels = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof labels, NULL, &code);
  CHECK(clEnqueueWriteBuffer(queue, own_points, CL_FALSE, 0, sizeof pairs, pairs, 0, NULL, &uploaded) ==
        CL_SUCCESS);
  OK(vorocl_device_wait_for(device, 1, &uploaded));
  OK(vorocl_seeds_from_buffer(device, grid, own_points, own_marks, seed_count, &seeds));
  OK(vorocl_seeds_alive(seeds, &alive));
  CHECK(alive == seed_count - 1);
  OK(vorocl_diagram_over_buffer(device, grid, own_labels, &diagram));
  OK(vorocl_diagram_labels(diagram, &same_labels));
  CHECK(same_labels == own_labels);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(clEnqueueReadBuffer(queue, own_labels, CL_TRUE, 0, sizeof labels, labels, 0, NULL, NULL) ==
        CL_SUCCESS);
  CHECK(memcmp(labels, nearest, sizeof labels) == 0);
  OK(vorocl_seeds_move_to_buffer(seeds, own_points, NULL, seed_count));
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest_of_all));
  OK(vorocl_seeds_move_to_buffer(seeds, own_points, own_marks, seed_count));
  clReleaseMemObject(own_points); /* retained until they are read */
  clReleaseMemObject(own_marks);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_wait(diagram));
  CHECK(has_labels(diagram, nearest));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  clReleaseEvent(uploaded);
  clReleaseMemObject(own_labels);
}

/* What was made on a device outlives it, and a diagram the seeds it was made from. */
/* A domain of the grid's size is a periodic grid, wherever in it the points were. */
static void test_windows(const vorocl_device* device) {
  const vorocl_grid periodic = {width, height, VOROCL_PERIODIC_X};
  const vorocl_domain domain = {0, 0, width, height, VOROCL_PERIODIC_X};
  vorocl_domain wrong = {0, 0, 0, height, VOROCL_PERIODIC_X};
  const vorocl_point outside[2] = {{-0.5, 3}, {4, 1000}};
  vorocl_point moved[seed_count], read[2];
  vorocl_seeds *seeds = NULL, *of_grid = NULL;
  vorocl_diagram *diagram = NULL, *of_periodic = NULL;
  uint32_t labels[pixels];
  size_t count = 0;
  memcpy(moved, points, sizeof moved);
  for (int i = 0; i < seed_count; ++i) moved[i].x += (i % 3 - 1) * width;

  OK(vorocl_seeds_from_points(device, periodic, points, present, seed_count, &of_grid));
  OK(vorocl_diagram_create(device, periodic, &of_periodic));
  OK(vorocl_exact_diagram(of_grid, of_periodic, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_read(of_periodic, labels, pixels));
  OK(vorocl_seeds_in_domain(device, grid, domain, moved, present, seed_count, &seeds));
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, labels));
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_BAD_ARGUMENT,
        "exact");

  OK(vorocl_seeds_move_to(seeds, outside, NULL, 2));
  OK(vorocl_seeds_outside(seeds, &count));
  CHECK(count == 2);
  OK(vorocl_seeds_read(seeds, read, 2));
  CHECK(read[0].x == -0.5 && read[1].y == 1000.5);
  OK(vorocl_seeds_move_in_domain(seeds, domain, moved, present, seed_count));
  OK(vorocl_seeds_outside(seeds, &count));
  CHECK(count == 0);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, labels));
  FAILS(vorocl_seeds_move_in_domain(seeds, wrong, moved, present, seed_count), VOROCL_BAD_ARGUMENT,
        "the domain's width is 0");
  wrong.periodic = 4;
  FAILS(vorocl_seeds_move_in_domain(seeds, wrong, moved, present, seed_count), VOROCL_BAD_ARGUMENT,
        "choice of periodic axes");
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(of_periodic);
  vorocl_seeds_free(seeds);
  vorocl_seeds_free(of_grid);
}

static void test_order_of_freeing(void) {
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  uint32_t nearest[pixels];
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  OK(vorocl_device_select("", &device));
  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, &seeds));
  OK(vorocl_diagram_create(device, grid, &diagram));
  vorocl_device_free(device);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  vorocl_seeds_free(seeds);
  CHECK(has_labels(diagram, nearest));
  vorocl_diagram_free(diagram);
}

int main(void) {
  vorocl_device* device = NULL;
  CHECK(strlen(vorocl_version()) >= 5);
  CHECK(strcmp(vorocl_error_message(), "") == 0); /* nothing has failed yet */
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_devices(device);
  test_seeds(device);
  test_own_buffers(device);
  test_methods(device);
  test_dynamic_jump_flooding(device);
  test_windows(device);
  test_order_of_freeing();
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
