/* What the tests of the C functions share: checks, a small grid of seeds, and a search of every pixel. Each
   test is a program of its own, with one file to compile. */
#ifndef VOROCL_TEST_C_API_H
#define VOROCL_TEST_C_API_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vorocl/vorocl.h"

static int failures = 0;

static inline void check(int right, const char* what, const char* file, int line) {
  if (right) return;
  fprintf(stderr, "%s:%d: %s (last message: %s)\n", file, line, what, vorocl_error_message());
  ++failures;
}
#define CHECK(condition) check(condition, #condition, __FILE__, __LINE__)
#define OK(call) check((call) == VOROCL_SUCCESS, #call, __FILE__, __LINE__)

/* The call fails with this status, and the message holds this part. */
#define FAILS(call, status, part)                                                                  \
  do {                                                                                             \
    check((call) == (status), #call " has the status " #status, __FILE__, __LINE__);               \
    check(strstr(vorocl_error_message(), part) != NULL, #call " says: " part, __FILE__, __LINE__); \
  } while (0)

/* Seed 4 has the pixel of seed 1, and seed 6 is absent: neither has a cell. */
static const vorocl_grid grid = {
    VOROCL_AXIS_OF_PIXELS(61), VOROCL_AXIS_OF_PIXELS(40), 0, {0, 0, 0, 0, 0, 0, 0}, 0, 0};
static const vorocl_window window = {
    {VOROCL_AXIS_OF_PIXELS(61), VOROCL_AXIS_OF_PIXELS(40), 0, {0, 0, 0, 0, 0, 0, 0}, 0, 0},
    0,
    0,
    61,
    40,
    0,
    0};
enum { width = 61, height = 40, pixels = width * height, seed_count = 8 };
static const vorocl_point points[seed_count] = {{3.5, 2.5, 0},   {50.5, 5.5, 0}, {20.5, 30.5, 0},
                                                {60.5, 39.5, 0}, {50.9, 5.1, 0}, {33.5, 16.5, 0},
                                                {30, 20, 0},     {0, 39.9, 0}};
static const uint8_t present[seed_count] = {1, 1, 1, 1, 255, 1, 0, 1};

/* All of a grid of this size, which is not periodic. */
static inline vorocl_window window_of(int64_t columns, int64_t rows) {
  return vorocl_window_of_grid(vorocl_grid_of_pixels(columns, rows, VOROCL_PERIODIC_NONE));
}

/* Seeds on the grid at the points above. */
static inline vorocl_seeds* make_seeds(const vorocl_device* device) {
  vorocl_seeds* seeds = NULL;
  OK(vorocl_seeds_from_points(device, grid, points, present, seed_count, VOROCL_OUTSIDE_COUNTS,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  return seeds;
}

/* Fills a diagram by a method with the defaults of all options but one. */
static inline vorocl_status run(const char* method, const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                vorocl_metric metric) {
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  options.metric = metric;
  return vorocl_run(method, seeds, diagram, &options);
}

/* A seed's pixel, as its place in row-major order. */
static inline int pixel_of(vorocl_point point) { return (int)point.y * width + (int)point.x; }

static inline int distance(int a, int b, vorocl_metric metric) {
  const int dx = abs(a % width - b % width), dy = abs(a / width - b / width);
  return metric == VOROCL_MANHATTAN ? dx + dy : dx * dx + dy * dy;
}

/* The label of every pixel by a search of all seeds: the least distance, of equal ones the first pixel, of
   one pixel the lowest id. `there` may be NULL, as in the library. */
static inline void search_all(const vorocl_point* list, const uint8_t* there, uint32_t count,
                              vorocl_metric metric, uint32_t* labels) {
  for (int pixel = 0; pixel < pixels; ++pixel) {
    uint32_t best = VOROCL_NO_LABEL;
    for (uint32_t seed = 0; seed < count; ++seed) {
      if (there != NULL && there[seed] == 0) continue;
      const int here = pixel_of(list[seed]), d = distance(pixel, here, metric);
      if (best != VOROCL_NO_LABEL) {
        const int best_there = pixel_of(list[best]), least = distance(pixel, best_there, metric);
        if (d > least || (d == least && here >= best_there)) continue;
      }
      best = seed;
    }
    labels[pixel] = best;
  }
}

/* Whether a diagram has these labels. */
static inline int has_labels(const vorocl_diagram* diagram, const uint32_t* labels) {
  uint32_t read[pixels];
  OK(vorocl_diagram_read(diagram, read, pixels));
  return memcmp(read, labels, sizeof read) == 0;
}

#endif
