/* Calls of the C functions that cannot be: each against its status and message. Those of the measures are in
   test_c_api_measures.c. */
#include "test_c_api.h"

static void test_bad_devices(const vorocl_device* device) {
  cl_context context = NULL, other = NULL;
  cl_command_queue queue = NULL, out_of_order = NULL;
  cl_device_id id = NULL;
  cl_mem foreign = NULL;
  cl_event null_event = NULL;
  cl_int code = CL_SUCCESS;
  vorocl_device* made = NULL;
  vorocl_device_list* list = NULL;
  vorocl_device_description description;
  vorocl_tuning tuning;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *here = NULL;
  const char* name = NULL;
  size_t count = 0;
  double percent = 0;
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_device_id(device, &id));
  other = clCreateContext(NULL, 1, &id, NULL, NULL, &code);
  out_of_order = clCreateCommandQueue(context, id, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &code);

  FAILS(vorocl_device_select("no such device", &made), VOROCL_DEVICE_ERROR, "no such device");
  CHECK(made == NULL);
  FAILS(vorocl_device_select(NULL, NULL), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_adopt(NULL, queue, &made), VOROCL_NULL_ARGUMENT, "context is NULL");
  FAILS(vorocl_device_adopt(context, NULL, &made), VOROCL_NULL_ARGUMENT, "queue is NULL");
  FAILS(vorocl_device_adopt(context, queue, NULL), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_adopt(other, queue, &made), VOROCL_BAD_ARGUMENT, "another context");
  if (out_of_order != NULL) {
    FAILS(vorocl_device_adopt(context, out_of_order, &made), VOROCL_BAD_ARGUMENT, "out of order");
    clReleaseCommandQueue(out_of_order);
  }
  FAILS(vorocl_device_name(NULL, &name), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_name(device, NULL), VOROCL_NULL_ARGUMENT, "name is NULL");
  FAILS(vorocl_device_platform_name(NULL, &name), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_platform_name(device, NULL), VOROCL_NULL_ARGUMENT, "name is NULL");
  FAILS(vorocl_device_driver_version(NULL, &name), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_driver_version(device, NULL), VOROCL_NULL_ARGUMENT, "version is NULL");
  FAILS(vorocl_device_context(NULL, &context), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_context(device, NULL), VOROCL_NULL_ARGUMENT, "context is NULL");
  FAILS(vorocl_device_queue(NULL, &queue), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_queue(device, NULL), VOROCL_NULL_ARGUMENT, "queue is NULL");
  FAILS(vorocl_device_id(NULL, &id), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_id(device, NULL), VOROCL_NULL_ARGUMENT, "id is NULL");
  FAILS(vorocl_device_wait_for(NULL, 0, NULL), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_wait_for(device, 1, &null_event), VOROCL_BAD_ARGUMENT, "null");
  FAILS(vorocl_device_wait_for(device, 1, NULL), VOROCL_NULL_ARGUMENT, "events is NULL");
  FAILS(vorocl_device_finish(NULL), VOROCL_NULL_ARGUMENT, "device is NULL");

  FAILS(vorocl_device_tuning(NULL, &tuning), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_tuning(device, NULL), VOROCL_NULL_ARGUMENT, "tuning is NULL");
  OK(vorocl_device_tuning(device, &tuning));
  FAILS(vorocl_device_with_tuning(NULL, &tuning, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_device_with_tuning(device, NULL, &made), VOROCL_NULL_ARGUMENT, "tuning is NULL");
  FAILS(vorocl_device_with_tuning(device, &tuning, NULL), VOROCL_NULL_ARGUMENT, "tuned is NULL");
  tuning.vector_width = 3;
  FAILS(vorocl_device_with_tuning(device, &tuning, &made), VOROCL_BAD_ARGUMENT, "vector width of 3");

  FAILS(vorocl_device_list_create(NULL, NULL), VOROCL_NULL_ARGUMENT, "list is NULL");
  FAILS(vorocl_device_list_count(NULL, &count), VOROCL_NULL_ARGUMENT, "list is NULL");
  FAILS(vorocl_device_list_get(NULL, 0, &description), VOROCL_NULL_ARGUMENT, "list is NULL");
  OK(vorocl_device_list_create(NULL, &list));
  OK(vorocl_device_list_count(list, &count));
  FAILS(vorocl_device_list_count(list, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_device_list_get(list, count, &description), VOROCL_BAD_ARGUMENT, "devices, and no index");
  FAILS(vorocl_device_list_get(list, 0, NULL), VOROCL_NULL_ARGUMENT, "description is NULL");
  vorocl_device_list_free(list);

  /* Objects of another context. */
  foreign = clCreateBuffer(other, CL_MEM_READ_WRITE, pixels * sizeof(uint32_t), NULL, &code);
  FAILS(vorocl_seeds_from_buffer(device, grid, foreign, NULL, 2, &seeds), VOROCL_BAD_ARGUMENT,
        "another OpenCL context");
  FAILS(vorocl_diagram_over_buffer(device, grid, foreign, &diagram), VOROCL_BAD_ARGUMENT,
        "another OpenCL context");
  OK(vorocl_diagram_create(device, grid, &here));
  FAILS(vorocl_diagram_write_buffer(here, foreign), VOROCL_BAD_ARGUMENT, "another OpenCL context");

  /* Seeds and diagrams of two devices. */
  OK(vorocl_device_select(NULL, &made));
  OK(vorocl_seeds_from_points(made, grid, points, NULL, seed_count, &seeds));
  OK(vorocl_diagram_create(made, grid, &diagram));
  FAILS(vorocl_jump_flooding(seeds, here, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_BAD_ARGUMENT,
        "different devices");
  FAILS(vorocl_exact_diagram(seeds, here, VOROCL_EUCLIDEAN), VOROCL_BAD_ARGUMENT, "different devices");
  FAILS(vorocl_similarity(here, diagram, &percent), VOROCL_BAD_ARGUMENT, "different devices");
  vorocl_device_free(made);
  vorocl_diagram_free(here);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseMemObject(foreign);
  clReleaseContext(other);
}

static void test_bad_seeds(const vorocl_device* device) {
  vorocl_seeds *seeds = NULL, *made = NULL;
  cl_context context = NULL;
  cl_mem buffer = NULL, few_marks = NULL;
  cl_int code = CL_SUCCESS;
  uint8_t mask[pixels] = {1};
  vorocl_point read[seed_count];
  size_t count = 0;
  vorocl_grid read_grid = {0, 0, 0};
  FAILS(vorocl_seeds_from_points(device, grid, NULL, NULL, 1, &made), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, (size_t)-1, &made), VOROCL_BAD_ARGUMENT,
        "too many");
  FAILS(vorocl_seeds_from_points(NULL, grid, points, NULL, 1, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, 1, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_random(device, (vorocl_grid){0, height, 0}, 1, 1, &made), VOROCL_BAD_ARGUMENT,
        "width is 0");
  FAILS(vorocl_seeds_random(NULL, grid, 1, 1, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_random(device, grid, 1, 1, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_from_mask(device, grid, mask, pixels - 1, &made), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_seeds_from_mask(device, grid, NULL, pixels, &made), VOROCL_NULL_ARGUMENT, "mask is NULL");
  FAILS(vorocl_seeds_from_mask(NULL, grid, mask, pixels, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_mask(device, grid, mask, pixels, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");

  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_READ_ONLY, 5 * 2 * sizeof(float), NULL, &code);
  few_marks = clCreateBuffer(context, CL_MEM_READ_ONLY, 4, NULL, &code);
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, NULL, 6, &made), VOROCL_BAD_ARGUMENT,
        "40 bytes; 48 are needed");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, few_marks, 5, &made), VOROCL_BAD_ARGUMENT,
        "4 bytes; 5 are needed");
  FAILS(vorocl_seeds_from_buffer(device, grid, NULL, NULL, 1, &made), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_from_buffer(NULL, grid, buffer, NULL, 1, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, NULL, 1, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");

  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, &seeds));
  FAILS(vorocl_seeds_clone(NULL, &made), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_clone(seeds, NULL), VOROCL_NULL_ARGUMENT, "clone is NULL");
  FAILS(vorocl_seeds_grid(NULL, &read_grid), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_grid(seeds, NULL), VOROCL_NULL_ARGUMENT, "grid is NULL");
  FAILS(vorocl_seeds_count(NULL, &count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_count(seeds, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_seeds_alive(NULL, &count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_alive(seeds, NULL), VOROCL_NULL_ARGUMENT, "alive is NULL");
  FAILS(vorocl_seeds_move_to(NULL, points, NULL, 1), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_move_to(seeds, NULL, NULL, 1), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_move_to_buffer(NULL, buffer, NULL, 1), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_move_to_buffer(seeds, NULL, NULL, 1), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_move_to_buffer(seeds, buffer, NULL, 6), VOROCL_BAD_ARGUMENT, "48 are needed");
  FAILS(vorocl_random_step(NULL, 1, VOROCL_REFLECT, 0, 0), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_random_step(seeds, 1, 9, 0, 0), VOROCL_BAD_ARGUMENT, "border 9");
  FAILS(vorocl_random_step(seeds, -1, VOROCL_REFLECT, 0, 0), VOROCL_BAD_ARGUMENT, "-1");
  FAILS(vorocl_seeds_positions(NULL, &buffer), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_positions(seeds, NULL), VOROCL_NULL_ARGUMENT, "positions is NULL");
  FAILS(vorocl_seeds_read(NULL, read, seed_count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_read(seeds, NULL, seed_count), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_read(seeds, read, 7), VOROCL_BAD_ARGUMENT, "8 seeds");
  FAILS(vorocl_seeds_check(NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  vorocl_seeds_free(seeds);
  clReleaseMemObject(buffer);
  clReleaseMemObject(few_marks);
}

/* A bad point says which it is, at once or, in a caller's buffer, at the waits of what was made of it. */
static void test_bad_points(const vorocl_device* device) {
  const vorocl_point list[3] = {{1, 1}, {2, 2}, {NAN, 3}};
  float pairs[6] = {1, 1, 61.5f, 7, 2, 2};
  cl_context context = NULL;
  cl_int code = CL_SUCCESS;
  cl_mem buffer = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* sums = NULL;
  vorocl_cell_statistics statistics;
  vorocl_adjacency* adjacency = NULL;
  vorocl_point point = {0, 0}, read[3];
  uint32_t labels[pixels];
  size_t index = 0;
  FAILS(vorocl_bad_point(&index, &point), VOROCL_BAD_ARGUMENT, "no call");
  FAILS(vorocl_seeds_from_points(device, grid, list, NULL, 3, &seeds), VOROCL_BAD_POINT, "point 2 (nan, 3");
  CHECK(seeds == NULL);
  OK(vorocl_bad_point(&index, &point));
  CHECK(index == 2 && isnan(point.x) && point.y == 3);

  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, &seeds));
  FAILS(vorocl_seeds_move_to(seeds, list, NULL, 3), VOROCL_BAD_POINT, "not finite");
  OK(vorocl_seeds_count(seeds, &index));
  CHECK(index == seed_count); /* they stay as they were */

  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof pairs, pairs, &code);
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_adjacency_create(&adjacency));
  OK(vorocl_seeds_move_to_buffer(seeds, buffer, NULL, 3));
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  OK(vorocl_cell_sums_measure(sums, seeds, diagram));
  FAILS(vorocl_adjacency_find(adjacency, seeds, diagram), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_seeds_check(seeds), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_seeds_read(seeds, read, 3), VOROCL_BAD_POINT, "point 1");
  OK(vorocl_seeds_move_to(seeds, points, present, seed_count)); /* an error of its frame */
  OK(vorocl_seeds_check(seeds));
  FAILS(vorocl_diagram_wait(diagram), VOROCL_BAD_POINT, "outside the grid");
  FAILS(vorocl_diagram_read(diagram, labels, pixels), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_cell_sums_statistics(sums, &statistics), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_cell_sums_read(sums, NULL, NULL, NULL, 3), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_diagram_wait(NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  OK(vorocl_bad_point(&index, NULL)); /* still that of the last bad point */
  OK(vorocl_bad_point(NULL, &point));
  CHECK(index == 1 && point.x == 61.5 && point.y == 7);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, labels);
  CHECK(has_labels(diagram, labels));
  vorocl_adjacency_free(adjacency);
  vorocl_cell_sums_free(sums);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseMemObject(buffer);
}

static void test_bad_diagrams(const vorocl_device* device) {
  vorocl_diagram *diagram = NULL, *other = NULL, *made = NULL;
  cl_context context = NULL;
  cl_mem buffer = NULL;
  cl_event event = NULL;
  cl_int code = CL_SUCCESS;
  uint32_t labels[pixels] = {0};
  vorocl_grid read_grid = {0, 0, 0};
  size_t count = 0;
  double percent = 0;
  int waves = 0;
  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof labels, NULL, &code);
  FAILS(vorocl_diagram_create(device, (vorocl_grid){width, 40000, 0}, &made), VOROCL_BAD_ARGUMENT,
        "height is 40000");
  FAILS(vorocl_diagram_create(NULL, grid, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_diagram_create(device, grid, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_over_buffer(device, (vorocl_grid){width, height + 1, 0}, buffer, &made),
        VOROCL_BAD_ARGUMENT, "are needed");
  FAILS(vorocl_diagram_over_buffer(device, (vorocl_grid){2, 2, 0}, buffer, &made), VOROCL_BAD_ARGUMENT,
        "read-only");
  FAILS(vorocl_diagram_over_buffer(device, (vorocl_grid){2, 2, 0}, NULL, &made), VOROCL_NULL_ARGUMENT,
        "labels is NULL");
  FAILS(vorocl_diagram_over_buffer(NULL, (vorocl_grid){2, 2, 0}, buffer, &made), VOROCL_NULL_ARGUMENT,
        "device is NULL");
  FAILS(vorocl_diagram_over_buffer(device, (vorocl_grid){2, 2, 0}, buffer, NULL), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_diagram_create(device, (vorocl_grid){2, 2, 4}, &made), VOROCL_BAD_ARGUMENT, "periodic axes 4");
  FAILS(vorocl_diagram_create(device, (vorocl_grid){32001, 2, VOROCL_PERIODIC_X}, &made), VOROCL_BAD_ARGUMENT,
        "32000");
  CHECK(made == NULL);

  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_diagram_create(device, (vorocl_grid){height, width, 0}, &other));
  FAILS(vorocl_diagram_grid(NULL, &read_grid), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_grid(diagram, NULL), VOROCL_NULL_ARGUMENT, "grid is NULL");
  FAILS(vorocl_diagram_labels(NULL, &buffer), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_labels(diagram, NULL), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_write(NULL, labels, pixels), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_write(diagram, NULL, pixels), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_write(diagram, labels, 7), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_diagram_write_buffer(NULL, buffer), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_write_buffer(diagram, NULL), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_event(NULL, &event), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_event(diagram, NULL), VOROCL_NULL_ARGUMENT, "event is NULL");
  FAILS(vorocl_diagram_report(NULL, &waves, NULL, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_read(NULL, labels, pixels), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_read(diagram, labels, 7), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_diagram_read(diagram, NULL, pixels), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_wait(NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_similarity(diagram, other, &percent), VOROCL_BAD_ARGUMENT, "different grids");
  FAILS(vorocl_similarity(NULL, other, &percent), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_similarity(diagram, other, NULL), VOROCL_NULL_ARGUMENT, "percent is NULL");
  FAILS(vorocl_changed_pixels(diagram, other, &count), VOROCL_BAD_ARGUMENT, "different grids");
  FAILS(vorocl_changed_pixels(diagram, NULL, &count), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_changed_pixels(diagram, other, NULL), VOROCL_NULL_ARGUMENT, "pixels is NULL");
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(other);
  clReleaseMemObject(buffer);
}

static void test_bad_methods(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *other = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_method_description method;
  OK(vorocl_seeds_from_points(device, grid, points, NULL, seed_count, &seeds));
  OK(vorocl_diagram_create(device, grid, &diagram));
  OK(vorocl_diagram_create(device, (vorocl_grid){height, width, 0}, &other));
  FAILS(vorocl_jump_flooding(seeds, other, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_BAD_ARGUMENT,
        "61 x 40");
  FAILS(vorocl_jump_flooding(NULL, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_jump_flooding(seeds, NULL, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_jump_flooding(seeds, diagram, 9, VOROCL_MOORE, VOROCL_JFA), VOROCL_BAD_ARGUMENT, "metric 9");
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, 9, VOROCL_JFA), VOROCL_BAD_ARGUMENT,
        "neighbourhood 9");
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MIXED, VOROCL_JFA), VOROCL_BAD_ARGUMENT,
        "mixed");
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, 9), VOROCL_BAD_ARGUMENT,
        "variant 9");
  FAILS(vorocl_standard_flooding(NULL, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_standard_flooding(seeds, NULL, VOROCL_EUCLIDEAN, VOROCL_MOORE), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_standard_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MIXED), VOROCL_BAD_ARGUMENT,
        "mixed");
  FAILS(vorocl_exact_diagram(NULL, diagram, VOROCL_EUCLIDEAN), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_exact_diagram(seeds, NULL, VOROCL_EUCLIDEAN), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_exact_diagram(seeds, diagram, -1), VOROCL_BAD_ARGUMENT, "metric -1");
  FAILS(vorocl_dynamic_jump_flooding(NULL, diagram, 0, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_dynamic_jump_flooding(seeds, NULL, 0, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_dynamic_jump_flooding(seeds, diagram, NAN, NULL), VOROCL_BAD_ARGUMENT, "displacement");
  options.extra_waves = 3;
  FAILS(vorocl_dynamic_jump_flooding(seeds, diagram, 0, &options), VOROCL_BAD_ARGUMENT, "3 extra waves");
  OK(vorocl_run("jfa", seeds, diagram, NAN, &options)); /* which looks at neither */

  FAILS(vorocl_method_count(NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_method_get(0, NULL), VOROCL_NULL_ARGUMENT, "description is NULL");
  FAILS(vorocl_method_get(1000, &method), VOROCL_BAD_ARGUMENT, "no index 1000");
  FAILS(vorocl_run("fast", seeds, diagram, 0, NULL), VOROCL_BAD_ARGUMENT, "there is no method \"fast\"");
  FAILS(vorocl_run(NULL, seeds, diagram, 0, NULL), VOROCL_NULL_ARGUMENT, "method is NULL");
  FAILS(vorocl_run("jfa", NULL, diagram, 0, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_run("jfa", seeds, NULL, 0, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_prepare("fast", device, grid, 9, NULL), VOROCL_BAD_ARGUMENT, "no method");
  FAILS(vorocl_prepare(NULL, device, grid, 9, NULL), VOROCL_NULL_ARGUMENT, "method is NULL");
  FAILS(vorocl_prepare("jfa", NULL, grid, 9, NULL), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_prepare("jfa", device, (vorocl_grid){0, height, 0}, 9, NULL), VOROCL_BAD_ARGUMENT,
        "width is 0");
  options.metric = 9;
  FAILS(vorocl_run("jfa", seeds, diagram, 0, &options), VOROCL_BAD_ARGUMENT, "metric 9");
  FAILS(vorocl_prepare("jfa", device, grid, 9, &options), VOROCL_BAD_ARGUMENT, "metric 9");
  options.metric = VOROCL_EUCLIDEAN;
  options.reach = 9;
  FAILS(vorocl_run("djfa", seeds, diagram, 0, &options), VOROCL_BAD_ARGUMENT, "reach 9");
  options.reach = VOROCL_REACH_MEASURED;
  options.neighbourhood = 9;
  FAILS(vorocl_run("jfa", seeds, diagram, 0, &options), VOROCL_BAD_ARGUMENT, "neighbourhood 9");
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(other);
  vorocl_seeds_free(seeds);
}

int main(void) {
  vorocl_device* device = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_bad_points(device);
  test_bad_devices(device);
  test_bad_seeds(device);
  test_bad_diagrams(device);
  test_bad_methods(device);
  vorocl_device_free(device);
  vorocl_device_free(NULL);
  vorocl_device_list_free(NULL);
  vorocl_seeds_free(NULL);
  vorocl_diagram_free(NULL);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
