/* The C functions, from C: each engine against a search of every pixel, and each bad argument against its
   status and message. Also built against an installed copy, through pkg-config. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vorocl/vorocl.h"

enum { width = 61, height = 40, pixels = width * height, seed_count = 5 };

static const vorocl_point points[seed_count] = {
    {3.5, 2.5}, {50.5, 5.5}, {20.5, 30.5}, {60.5, 39.5}, {33.5, 16.5}};
static int failures = 0;

static void check(int right, const char* what, int line) {
  if (right) return;
  fprintf(stderr, "test_c_api.c:%d: %s (last message: %s)\n", line, what, vorocl_error_message());
  ++failures;
}
#define CHECK(condition) check(condition, #condition, __LINE__)
#define OK(call) check((call) == VOROCL_SUCCESS, #call, __LINE__)

/* The call fails with this status, and the message holds this part. */
#define FAILS(call, status, part)                                                        \
  do {                                                                                   \
    check((call) == (status), #call " has the status " #status, __LINE__);               \
    check(strstr(vorocl_error_message(), part) != NULL, #call " says: " part, __LINE__); \
  } while (0)

static double distance_squared(vorocl_point point, int x, int y) {
  const double dx = point.x - (x + 0.5), dy = point.y - (y + 0.5);
  return dx * dx + dy * dy;
}

static int all_nearest(const uint32_t* labels) {
  for (int i = 0; i < pixels; ++i) {
    const int x = i % width, y = i / width;
    if (labels[i] >= seed_count) return 0;
    for (int seed = 0; seed < seed_count; ++seed) {
      if (distance_squared(points[seed], x, y) < distance_squared(points[labels[i]], x, y)) return 0;
    }
  }
  return 1;
}

static void test_engines(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *exact = NULL;
  uint32_t labels[pixels];
  int waves = -1;
  double milliseconds = -1, percent = 0;
  size_t count = 0;
  cl_event event = NULL;
  vorocl_dynamic_jump_flooding_options options = VOROCL_DYNAMIC_JUMP_FLOODING_DEFAULTS;

  OK(vorocl_seeds_from_points(device, width, height, points, seed_count, &seeds));
  OK(vorocl_seeds_count(seeds, &count));
  CHECK(count == seed_count);
  OK(vorocl_diagram_create(device, width, height, &diagram));
  OK(vorocl_diagram_create(device, width, height, &exact));
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event == NULL);
  OK(vorocl_diagram_read(diagram, labels, pixels));
  CHECK(labels[0] == VOROCL_NO_LABEL);

  OK(vorocl_exact_diagram(seeds, exact, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_read(exact, labels, pixels));
  CHECK(all_nearest(labels));

  OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA_PLUS_2));
  OK(vorocl_diagram_report(diagram, &waves, &milliseconds));
  CHECK(waves == 8); /* 32, 16, 8, 4, 2, 1 and 2, 1 */
  CHECK(milliseconds >= 0);
  OK(vorocl_diagram_event(diagram, &event));
  CHECK(event != NULL && clWaitForEvents(1, &event) == CL_SUCCESS);
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent == 100.0);

  OK(vorocl_standard_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE));
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent > 99.0);

  OK(vorocl_random_step(seeds, 2, VOROCL_PERIODIC, 7, 1));
  options.max_step = 2;
  OK(vorocl_dynamic_jump_flooding(seeds, diagram, &options));
  OK(vorocl_exact_diagram(seeds, exact, VOROCL_EUCLIDEAN));
  OK(vorocl_similarity(diagram, exact, &percent));
  CHECK(percent > 95.0);

  OK(vorocl_device_finish(device));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(exact);
}

static void test_motion_and_absence(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_point read[seed_count];
  const unsigned char present[seed_count] = {1, 1, 0, 1, 1};
  OK(vorocl_seeds_random(device, width, height, 3, 1, &seeds));
  OK(vorocl_seeds_move_to(seeds, points, present, seed_count));
  OK(vorocl_seeds_read(seeds, read, seed_count));
  CHECK(read[1].x == 50.5 && read[1].y == 5.5);
  CHECK(isnan(read[2].x));
  OK(vorocl_seeds_move_to(seeds, points, NULL, seed_count));
  OK(vorocl_seeds_read(seeds, read, seed_count));
  CHECK(read[2].x == 20.5 && read[2].y == 30.5);
  FAILS(vorocl_seeds_read(seeds, read, 4), VOROCL_ERROR, "5 seeds");
  vorocl_seeds_free(seeds);
}

/* Points and labels in the caller's buffers. */
static void test_own_buffers(const vorocl_device* device) {
  float pairs[2 * seed_count];
  uint32_t labels[pixels];
  cl_int code = CL_SUCCESS;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_mem own_points, own_labels, same_labels = NULL;
  cl_event uploaded = NULL;
  vorocl_seeds *seeds = NULL, *refused_seeds = NULL;
  vorocl_diagram *diagram = NULL, *refused_diagram = NULL;
  for (int i = 0; i < seed_count; ++i) {
    pairs[2 * i] = (float)points[i].x;
    pairs[2 * i + 1] = (float)points[i].y;
  }
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  own_points = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof pairs, NULL, &code);
  own_labels = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof labels, NULL, &code);
  CHECK(clEnqueueWriteBuffer(queue, own_points, CL_FALSE, 0, sizeof pairs, pairs, 0, NULL, &uploaded) ==
        CL_SUCCESS);
  OK(vorocl_device_wait_for(device, 1, &uploaded));
  OK(vorocl_seeds_from_buffer(device, width, height, own_points, seed_count, &seeds));
  OK(vorocl_diagram_over_buffer(device, width, height, own_labels, &diagram));
  OK(vorocl_diagram_labels(diagram, &same_labels));
  CHECK(same_labels == own_labels);
  OK(vorocl_exact_diagram(seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(clEnqueueReadBuffer(queue, own_labels, CL_TRUE, 0, sizeof labels, labels, 0, NULL, NULL) ==
        CL_SUCCESS);
  CHECK(all_nearest(labels));
  OK(vorocl_seeds_move_to_buffer(seeds, own_points, 2));
  OK(vorocl_diagram_wait(diagram));

  FAILS(vorocl_seeds_from_buffer(device, width, height, own_points, seed_count + 1, &refused_seeds),
        VOROCL_ERROR, "40 bytes; 48 are needed");
  CHECK(refused_seeds == NULL);
  FAILS(vorocl_seeds_from_buffer(device, width, height, NULL, 1, &refused_seeds), VOROCL_NULL_ARGUMENT,
        "points is NULL");
  FAILS(vorocl_diagram_over_buffer(device, width, height + 1, own_labels, &refused_diagram), VOROCL_ERROR,
        "are needed");
  FAILS(vorocl_diagram_over_buffer(device, 2, 2, own_points, &refused_diagram), VOROCL_ERROR, "read-only");
  FAILS(vorocl_diagram_over_buffer(device, 2, 2, NULL, &refused_diagram), VOROCL_NULL_ARGUMENT,
        "labels is NULL");
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  clReleaseEvent(uploaded);
  clReleaseMemObject(own_points);
  clReleaseMemObject(own_labels);
}

static void test_bad_devices(const vorocl_device* device) {
  cl_context context = NULL, other = NULL;
  cl_command_queue queue = NULL, out_of_order = NULL;
  cl_device_id id = NULL;
  cl_mem foreign = NULL;
  cl_event null_event = NULL;
  cl_int code = CL_SUCCESS;
  vorocl_device* made = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *here = NULL;
  double percent = 0;
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof id, &id, NULL);
  other = clCreateContext(NULL, 1, &id, NULL, NULL, &code);
  out_of_order = clCreateCommandQueue(context, id, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &code);

  FAILS(vorocl_device_select("no such device", &made), VOROCL_ERROR, "no such device");
  CHECK(made == NULL);
  FAILS(vorocl_device_adopt(NULL, queue, &made), VOROCL_NULL_ARGUMENT, "context is NULL");
  FAILS(vorocl_device_adopt(context, NULL, &made), VOROCL_NULL_ARGUMENT, "queue is NULL");
  FAILS(vorocl_device_adopt(other, queue, &made), VOROCL_ERROR, "another context");
  if (out_of_order != NULL) {
    FAILS(vorocl_device_adopt(context, out_of_order, &made), VOROCL_ERROR, "out of order");
    clReleaseCommandQueue(out_of_order);
  }
  FAILS(vorocl_device_wait_for(device, 1, &null_event), VOROCL_ERROR, "null");
  FAILS(vorocl_device_wait_for(device, 1, NULL), VOROCL_NULL_ARGUMENT, "events is NULL");

  foreign = clCreateBuffer(other, CL_MEM_READ_WRITE, pixels * sizeof(uint32_t), NULL, &code);
  FAILS(vorocl_seeds_from_buffer(device, width, height, foreign, 2, &seeds), VOROCL_ERROR,
        "another OpenCL context");
  FAILS(vorocl_diagram_over_buffer(device, width, height, foreign, &diagram), VOROCL_ERROR,
        "another OpenCL context");

  /* Seeds and a diagram of two devices. */
  OK(vorocl_device_select(NULL, &made));
  OK(vorocl_seeds_from_points(made, width, height, points, seed_count, &seeds));
  OK(vorocl_diagram_create(made, width, height, &diagram));
  OK(vorocl_diagram_create(device, width, height, &here));
  FAILS(vorocl_jump_flooding(seeds, here, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_ERROR,
        "different devices");
  FAILS(vorocl_exact_diagram(seeds, here, VOROCL_EUCLIDEAN), VOROCL_ERROR, "different devices");
  FAILS(vorocl_similarity(here, diagram, &percent), VOROCL_ERROR, "different devices");
  vorocl_device_free(made); /* before what was made of it */
  OK(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA));
  OK(vorocl_diagram_wait(diagram));
  vorocl_diagram_free(here);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseMemObject(foreign);
  clReleaseContext(other);
}

static void test_bad_arguments(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *other = NULL;
  uint32_t labels[pixels];
  double percent = 0;
  const vorocl_point outside = {61, 2}, not_finite = {NAN, 2};
  vorocl_dynamic_jump_flooding_options options = VOROCL_DYNAMIC_JUMP_FLOODING_DEFAULTS;
  FAILS(vorocl_seeds_from_points(device, width, height, &outside, 1, &seeds), VOROCL_ERROR, "point 0");
  FAILS(vorocl_seeds_from_points(device, width, height, &not_finite, 1, &seeds), VOROCL_ERROR, "not finite");
  FAILS(vorocl_seeds_from_points(device, width, height, NULL, 1, &seeds), VOROCL_NULL_ARGUMENT,
        "points is NULL");
  FAILS(vorocl_seeds_from_points(device, width, height, points, (size_t)-1, &seeds), VOROCL_ERROR,
        "too many");
  FAILS(vorocl_seeds_from_points(NULL, width, height, points, 1, &seeds), VOROCL_NULL_ARGUMENT,
        "device is NULL");
  FAILS(vorocl_seeds_from_points(device, width, height, points, 1, NULL), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_seeds_random(device, 0, height, 1, 1, &seeds), VOROCL_ERROR, "width is 0");
  FAILS(vorocl_diagram_create(device, width, 40000, &diagram), VOROCL_ERROR, "height is 40000");

  OK(vorocl_seeds_from_points(device, width, height, NULL, 0, &seeds)); /* no seeds are allowed */
  OK(vorocl_diagram_create(device, width, height, &diagram));
  OK(vorocl_diagram_create(device, height, width, &other));
  FAILS(vorocl_jump_flooding(seeds, other, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_ERROR,
        "61 x 40");
  FAILS(vorocl_jump_flooding(NULL, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_jump_flooding(seeds, NULL, VOROCL_EUCLIDEAN, VOROCL_MOORE, VOROCL_JFA), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_jump_flooding(seeds, diagram, 9, VOROCL_MOORE, VOROCL_JFA), VOROCL_ERROR, "metric 9");
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MIXED, VOROCL_JFA), VOROCL_ERROR,
        "mixed");
  FAILS(vorocl_jump_flooding(seeds, diagram, VOROCL_EUCLIDEAN, VOROCL_MOORE, 9), VOROCL_ERROR, "variant 9");
  FAILS(vorocl_random_step(seeds, 1, 9, 0, 0), VOROCL_ERROR, "border 9");
  FAILS(vorocl_dynamic_jump_flooding(seeds, diagram, NULL), VOROCL_NULL_ARGUMENT, "options is NULL");
  options.extra_waves = 3;
  FAILS(vorocl_dynamic_jump_flooding(seeds, diagram, &options), VOROCL_ERROR, "3 extra waves");
  FAILS(vorocl_similarity(diagram, other, &percent), VOROCL_ERROR, "different grids");
  FAILS(vorocl_diagram_read(diagram, labels, 7), VOROCL_ERROR, "room for 7");
  FAILS(vorocl_diagram_read(diagram, NULL, pixels), VOROCL_NULL_ARGUMENT, "labels is NULL");
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(other);
  vorocl_seeds_free(seeds);
  vorocl_device_free(NULL);
  vorocl_seeds_free(NULL);
  vorocl_diagram_free(NULL);
}

int main(void) {
  vorocl_device *device = NULL, *adopted = NULL;
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  const char* name = NULL;
  CHECK(strlen(vorocl_version()) >= 5);
  CHECK(strcmp(vorocl_error_message(), "") == 0); /* nothing has failed yet */
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return 1;
  OK(vorocl_device_name(device, &name));
  CHECK(name != NULL && strlen(name) > 0);
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_device_adopt(context, queue, &adopted));
  test_engines(adopted);
  vorocl_device_free(adopted);
  test_motion_and_absence(device);
  test_own_buffers(device);
  test_bad_devices(device);
  test_bad_arguments(device);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
