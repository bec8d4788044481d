/* Calls of the C functions that cannot be: each against its status and message. Those of the measures are in
   test_c_api_measures.c and test_c_api_fields.c. */
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
  FAILS(vorocl_seeds_from_buffer(device, grid, foreign, VOROCL_FLOATS_XY, NULL, 2, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &seeds),
        VOROCL_BAD_ARGUMENT, "another OpenCL context");
  FAILS(vorocl_diagram_over_buffer(device, window, foreign, &diagram), VOROCL_BAD_ARGUMENT,
        "another OpenCL context");
  OK(vorocl_diagram_create(device, window, &here));
  FAILS(vorocl_diagram_write_buffer(here, foreign, NULL, 0), VOROCL_BAD_ARGUMENT, "another OpenCL context");

  /* Seeds and diagrams of two devices. */
  OK(vorocl_device_select(NULL, &made));
  seeds = make_seeds(made);
  OK(vorocl_diagram_create(made, window, &diagram));
  FAILS(vorocl_run("jfa", seeds, here, NULL), VOROCL_BAD_ARGUMENT, "different devices");
  FAILS(vorocl_run("exact", seeds, here, NULL), VOROCL_BAD_ARGUMENT, "different devices");
  FAILS(vorocl_diagram_write_buffer(here, foreign, seeds, 0), VOROCL_BAD_ARGUMENT, "different devices");
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
  double displacement = 0;
  vorocl_grid read_grid;
  FAILS(vorocl_seeds_from_points(device, grid, NULL, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                                 &made),
        VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, (size_t)-1, VOROCL_OUTSIDE_COUNTS,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "too many");
  FAILS(vorocl_seeds_from_points(NULL, grid, points, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                                 &made),
        VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                                 NULL),
        VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_random(device, window_of(0, height).grid, 1, 1, &made), VOROCL_BAD_ARGUMENT, "0 pixels");
  FAILS(vorocl_seeds_random(NULL, grid, 1, 1, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_random(device, grid, 1, 1, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_from_mask(device, grid, mask, pixels - 1, &made), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_seeds_from_mask(device, grid, NULL, pixels, &made), VOROCL_NULL_ARGUMENT, "mask is NULL");
  FAILS(vorocl_seeds_from_mask(NULL, grid, mask, pixels, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_mask(device, grid, mask, pixels, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");

  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_READ_ONLY, 5 * 2 * sizeof(float), NULL, &code);
  few_marks = clCreateBuffer(context, CL_MEM_READ_ONLY, 4, NULL, &code);
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, NULL, 6, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "40 bytes; 48 are needed");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, few_marks, 5,
                                 VOROCL_OUTSIDE_IS_REFUSED, VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "4 bytes; 5 are needed");
  FAILS(vorocl_seeds_from_buffer(device, grid, NULL, VOROCL_FLOATS_XY, NULL, 1, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_from_buffer(NULL, grid, buffer, VOROCL_FLOATS_XY, NULL, 1, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, NULL, 1, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, NULL),
        VOROCL_NULL_ARGUMENT, "seeds is NULL");

  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_DOUBLES_XY, NULL, 5, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, 4, NULL, 5, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "format of points 4");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, NULL, 5, 3, VOROCL_SNAP_TO_PIXELS,
                                 &made),
        VOROCL_BAD_ARGUMENT, "points outside 3");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, 1, -1, VOROCL_SNAP_TO_PIXELS, &made),
        VOROCL_BAD_ARGUMENT, "points outside -1");
  FAILS(vorocl_seeds_from_points(device, grid, points, NULL, 1, VOROCL_OUTSIDE_COUNTS, 2, &made),
        VOROCL_BAD_ARGUMENT, "points within a pixel 2");
  FAILS(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, NULL, 5, VOROCL_OUTSIDE_IS_REFUSED,
                                 -1, &made),
        VOROCL_BAD_ARGUMENT, "points within a pixel -1");
  CHECK(made == NULL);

  seeds = make_seeds(device);
  FAILS(vorocl_seeds_clone(NULL, &made), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_clone(seeds, NULL), VOROCL_NULL_ARGUMENT, "clone is NULL");
  FAILS(vorocl_seeds_grid(NULL, &read_grid), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_grid(seeds, NULL), VOROCL_NULL_ARGUMENT, "grid is NULL");
  FAILS(vorocl_seeds_count(NULL, &count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_count(seeds, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_seeds_alive(NULL, &count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_alive(seeds, NULL), VOROCL_NULL_ARGUMENT, "alive is NULL");
  FAILS(vorocl_seeds_outside(NULL, &count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_outside(seeds, NULL), VOROCL_NULL_ARGUMENT, "outside is NULL");
  FAILS(vorocl_seeds_displacement(NULL, &displacement), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_displacement(seeds, NULL), VOROCL_NULL_ARGUMENT, "displacement is NULL");
  FAILS(vorocl_seeds_move_to_grid(NULL, grid, points, NULL, 1), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_move_to_grid(seeds, grid, NULL, NULL, 1), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_move_to_grid(seeds, window_of(0, 1).grid, points, NULL, 1), VOROCL_BAD_ARGUMENT,
        "0 pixels");
  FAILS(vorocl_seeds_move_to_buffer(seeds, buffer, 9, NULL, 1), VOROCL_BAD_ARGUMENT, "format of points 9");
  FAILS(vorocl_seeds_move_to(NULL, points, NULL, 1), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_move_to(seeds, NULL, NULL, 1), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_move_to_buffer(NULL, buffer, VOROCL_FLOATS_XY, NULL, 1), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_seeds_move_to_buffer(seeds, NULL, VOROCL_FLOATS_XY, NULL, 1), VOROCL_NULL_ARGUMENT,
        "points is NULL");
  FAILS(vorocl_seeds_move_to_buffer(seeds, buffer, VOROCL_FLOATS_XY, NULL, 6), VOROCL_BAD_ARGUMENT,
        "48 are needed");
  FAILS(vorocl_random_step(NULL, 1, VOROCL_REFLECT, 0, 0), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_random_step(seeds, 1, 9, 0, 0), VOROCL_BAD_ARGUMENT, "border 9");
  FAILS(vorocl_random_step(seeds, -1, VOROCL_REFLECT, 0, 0), VOROCL_BAD_ARGUMENT, "-1");
  FAILS(vorocl_seeds_read(NULL, read, seed_count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_read(seeds, NULL, seed_count), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_read(seeds, read, 7), VOROCL_BAD_ARGUMENT, "8 seeds");
  FAILS(vorocl_seeds_read_pixels(NULL, read, seed_count), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_seeds_read_pixels(seeds, NULL, seed_count), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_read_pixels(seeds, read, 9), VOROCL_BAD_ARGUMENT, "8 seeds");
  FAILS(vorocl_seeds_check(NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  vorocl_seeds_free(seeds);
  clReleaseMemObject(buffer);
  clReleaseMemObject(few_marks);
}

/* A bad point says which it is, at once or, in a caller's buffer, at the waits of what was made of it. */
static void test_bad_points(const vorocl_device* device) {
  const vorocl_point list[3] = {{1, 1, 0}, {2, 2, 0}, {NAN, 3, 0}};
  float pairs[6] = {1, 1, 61.5f, 7, 2, 2};
  cl_context context = NULL;
  cl_int code = CL_SUCCESS;
  cl_mem buffer = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* sums = NULL;
  vorocl_cell_statistics statistics;
  vorocl_adjacency* adjacency = NULL;
  vorocl_point point = {0, 0, 0}, read[3];
  uint32_t labels[pixels];
  size_t index = 0;
  FAILS(vorocl_bad_point(&index, &point), VOROCL_BAD_ARGUMENT, "no call");
  FAILS(vorocl_seeds_from_points(device, grid, list, NULL, 3, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                                 &seeds),
        VOROCL_BAD_POINT, "point 2 (nan, 3");
  CHECK(seeds == NULL);
  OK(vorocl_bad_point(&index, &point));
  CHECK(index == 2 && isnan(point.x) && point.y == 3);

  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, VOROCL_OUTSIDE_IS_REFUSED,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  FAILS(vorocl_seeds_move_to(seeds, list, NULL, 3), VOROCL_BAD_POINT, "not finite");
  OK(vorocl_seeds_count(seeds, &index));
  CHECK(index == seed_count); /* they stay as they were */

  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof pairs, pairs, &code);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_adjacency_create(&adjacency));
  OK(vorocl_seeds_move_to_buffer(seeds, buffer, VOROCL_FLOATS_XY, NULL, 3));
  OK(vorocl_run("exact", seeds, diagram, NULL));
  OK(vorocl_cell_sums_measure(sums, diagram));
  OK(vorocl_adjacency_find(adjacency, diagram));
  FAILS(vorocl_adjacency_pairs(adjacency, &index), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_seeds_check(seeds), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_seeds_read(seeds, read, 3), VOROCL_BAD_POINT, "point 1");
  OK(vorocl_seeds_move_to(seeds, points, present, seed_count)); /* an error of its frame */
  OK(vorocl_seeds_check(seeds));
  FAILS(vorocl_diagram_wait(diagram), VOROCL_BAD_POINT, "outside the grid");
  FAILS(vorocl_diagram_read(diagram, labels, pixels), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_cell_sums_statistics(sums, &statistics), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_cell_sums_read(sums, NULL, NULL, NULL, NULL, 3), VOROCL_BAD_POINT, "point 1");
  FAILS(vorocl_diagram_wait(NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  OK(vorocl_bad_point(&index, NULL)); /* still that of the last bad point */
  OK(vorocl_bad_point(NULL, &point));
  CHECK(index == 1 && point.x == 61.5 && point.y == 7);
  OK(vorocl_run("exact", seeds, diagram, NULL));
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, labels);
  CHECK(has_labels(diagram, labels));
  vorocl_adjacency_free(adjacency);
  vorocl_cell_sums_free(sums);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseMemObject(buffer);
}

static void test_bad_diagrams(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *other = NULL, *made = NULL;
  cl_context context = NULL;
  cl_mem buffer = NULL;
  cl_event event = NULL;
  cl_int code = CL_SUCCESS;
  uint32_t labels[pixels] = {0};
  vorocl_window read_window, wrong;
  vorocl_metric metric = 0;
  const char* name = NULL;
  int waves = 0;
  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof labels, NULL, &code);
  FAILS(vorocl_diagram_create(device, window_of(width, 40000), &made), VOROCL_BAD_ARGUMENT,
        "window is 40000");
  FAILS(vorocl_diagram_create(NULL, window, &made), VOROCL_NULL_ARGUMENT, "device is NULL");
  FAILS(vorocl_diagram_create(device, window, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_over_buffer(device, window_of(width, height + 1), buffer, &made), VOROCL_BAD_ARGUMENT,
        "are needed");
  FAILS(vorocl_diagram_over_buffer(device, window_of(2, 2), buffer, &made), VOROCL_BAD_ARGUMENT, "read-only");
  FAILS(vorocl_diagram_over_buffer(device, window_of(2, 2), NULL, &made), VOROCL_NULL_ARGUMENT,
        "labels is NULL");
  FAILS(vorocl_diagram_over_buffer(NULL, window_of(2, 2), buffer, &made), VOROCL_NULL_ARGUMENT,
        "device is NULL");
  FAILS(vorocl_diagram_over_buffer(device, window_of(2, 2), buffer, NULL), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_diagram_create(device, vorocl_window_of_grid(vorocl_grid_of_pixels(2, 2, 8)), &made),
        VOROCL_BAD_ARGUMENT, "periodic");
  wrong = window;
  wrong.grid.y.closed = 2;
  FAILS(vorocl_diagram_create(device, wrong, &made), VOROCL_BAD_ARGUMENT, "2 for closed");
  wrong = window;
  wrong.grid.x.from = 62;
  FAILS(vorocl_diagram_create(device, wrong, &made), VOROCL_BAD_ARGUMENT, "62");
  wrong.grid.x.from = NAN;
  FAILS(vorocl_diagram_create(device, wrong, &made), VOROCL_BAD_ARGUMENT, "nan");
  wrong = window;
  wrong.x = 1;
  FAILS(vorocl_diagram_create(device, wrong, &made), VOROCL_BAD_ARGUMENT, "x = 1");
  wrong.width = 0;
  FAILS(vorocl_diagram_create(device, wrong, &made), VOROCL_BAD_ARGUMENT, "0 pixels along x");
  CHECK(made == NULL);

  seeds = make_seeds(device);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_diagram_create(device, window_of(height, width), &other));
  FAILS(vorocl_diagram_window(NULL, &read_window), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_window(diagram, NULL), VOROCL_NULL_ARGUMENT, "window is NULL");
  FAILS(vorocl_diagram_metric(NULL, &metric), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_metric(diagram, NULL), VOROCL_NULL_ARGUMENT, "metric is NULL");
  FAILS(vorocl_diagram_metric(diagram, &metric), VOROCL_BAD_ARGUMENT, "no metric");
  FAILS(vorocl_diagram_method(NULL, &name), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_method(diagram, NULL), VOROCL_NULL_ARGUMENT, "name is NULL");
  FAILS(vorocl_diagram_labels(NULL, &buffer), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_labels(diagram, NULL), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_write(NULL, labels, pixels, NULL, 0), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_write(diagram, NULL, pixels, NULL, 0), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_write(diagram, labels, 7, NULL, 0), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_diagram_write_buffer(NULL, buffer, NULL, 0), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_write_buffer(diagram, NULL, NULL, 0), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_write(diagram, labels, pixels, seeds, 9), VOROCL_BAD_ARGUMENT, "metric 9");
  FAILS(vorocl_diagram_write(other, labels, pixels, seeds, 0), VOROCL_BAD_ARGUMENT, "61 x 40");
  FAILS(vorocl_diagram_event(NULL, &event), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_event(diagram, NULL), VOROCL_NULL_ARGUMENT, "event is NULL");
  FAILS(vorocl_diagram_report(NULL, &waves, NULL, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_snapped(NULL, &waves), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_snapped(diagram, NULL), VOROCL_NULL_ARGUMENT, "snapped is NULL");
  FAILS(vorocl_diagram_read(NULL, labels, pixels), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_diagram_read(diagram, labels, 7), VOROCL_BAD_ARGUMENT, "2440 pixels");
  FAILS(vorocl_diagram_read(diagram, NULL, pixels), VOROCL_NULL_ARGUMENT, "labels is NULL");
  FAILS(vorocl_diagram_wait(NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(other);
  clReleaseMemObject(buffer);
}

static void test_bad_methods(const vorocl_device* device) {
  vorocl_seeds* seeds = make_seeds(device);
  vorocl_diagram *diagram = NULL, *other = NULL;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_method_description method;
  const char* const names[] = {"standard-flooding", "jfa", "djfa", "low-resolution", "exact"};
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_diagram_create(device, window_of(height, width), &other));
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    FAILS(vorocl_run(names[i], seeds, other, NULL), VOROCL_BAD_ARGUMENT, "61 x 40");
    FAILS(vorocl_run(names[i], NULL, diagram, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
    FAILS(vorocl_run(names[i], seeds, NULL, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
    if (strcmp(names[i], "djfa") == 0) continue;
    options.neighbourhood = VOROCL_MIXED;
    FAILS(vorocl_run(names[i], seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "mixed");
    options.neighbourhood = VOROCL_DEFAULT_NEIGHBOURHOOD;
  }
  options.max_displacement = NAN;
  FAILS(vorocl_run("djfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "displacement");
  options.max_displacement = -2;
  FAILS(vorocl_run("djfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "displacement");
  options.max_displacement = 0;
  options.extra_waves = 3;
  FAILS(vorocl_run("djfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "3 extra waves");
  options.max_displacement = NAN;
  OK(vorocl_run("jfa", seeds, diagram, &options)); /* which looks at neither */

  FAILS(vorocl_method_count(NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_method_get(0, NULL), VOROCL_NULL_ARGUMENT, "description is NULL");
  FAILS(vorocl_method_get(1000, &method), VOROCL_BAD_ARGUMENT, "no index 1000");
  FAILS(vorocl_run("fast", seeds, diagram, NULL), VOROCL_BAD_ARGUMENT, "there is no method \"fast\"");
  FAILS(vorocl_run(NULL, seeds, diagram, NULL), VOROCL_NULL_ARGUMENT, "method is NULL");
  FAILS(vorocl_prepare("fast", device, window, 9, VOROCL_SNAP_TO_PIXELS, NULL), VOROCL_BAD_ARGUMENT,
        "no method");
  FAILS(vorocl_prepare(NULL, device, window, 9, VOROCL_SNAP_TO_PIXELS, NULL), VOROCL_NULL_ARGUMENT,
        "method is NULL");
  FAILS(vorocl_prepare("jfa", NULL, window, 9, VOROCL_SNAP_TO_PIXELS, NULL), VOROCL_NULL_ARGUMENT,
        "device is NULL");
  FAILS(vorocl_prepare("jfa", device, window_of(0, height), 9, VOROCL_SNAP_TO_PIXELS, NULL),
        VOROCL_BAD_ARGUMENT, "0 pixels");
  FAILS(vorocl_prepare("exact", device, window, 9, 2, NULL), VOROCL_BAD_ARGUMENT, "points within a pixel 2");
  options.metric = 9;
  FAILS(vorocl_run("jfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "metric 9");
  FAILS(vorocl_prepare("jfa", device, window, 9, VOROCL_SNAP_TO_PIXELS, &options), VOROCL_BAD_ARGUMENT,
        "metric 9");
  options.metric = VOROCL_EUCLIDEAN;
  options.reach = 9;
  FAILS(vorocl_run("djfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "reach 9");
  options.reach = VOROCL_REACH_MEASURED;
  options.neighbourhood = 9;
  FAILS(vorocl_run("jfa", seeds, diagram, &options), VOROCL_BAD_ARGUMENT, "neighbourhood 9");
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
