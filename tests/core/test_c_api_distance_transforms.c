/* The C functions of distance transforms, from C: against a search of all pixels. */
#include "test_c_api.h"

enum { most_pixels = 23 * 17 * 5 };

static uint8_t image[most_pixels];

/* The way along an axis, the shorter one round where it is periodic. */
static int way(int a, int b, int size, int periodic) {
  const int direct = abs(a - b);
  return periodic && size - direct < direct ? size - direct : direct;
}

static void test_image(const vorocl_device* device, int64_t depth, vorocl_periodic periodic,
                       const double* lengths, vorocl_marked marked, double farthest) {
  const int columns = 23, rows = 17, slices = (int)depth, count = columns * rows * slices;
  const double unit[3] = {1, 1, 1}, *const size = lengths != NULL ? lengths : unit;
  const vorocl_grid of = depth > 1 ? vorocl_grid_of_voxels(columns, rows, depth, periodic)
                                   : vorocl_grid_of_pixels(columns, rows, periodic);
  static double distances[most_pixels];
  static uint32_t places[most_pixels], indices[3 * most_pixels];
  static uint8_t values[most_pixels];
  vorocl_distance_transform* transform = NULL;
  const vorocl_image_source source = {image, NULL, VOROCL_PIXEL_UINT8};
  vorocl_transform_targets targets = {
      {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}};
  int pixel, other, found = -1, wrong = 0;
  for (pixel = 0; pixel < count; ++pixel) {
    const int is_rare = rand() % 40 == 0;
    image[pixel] = (uint8_t)(is_rare == (marked == VOROCL_MARKED_NON_ZEROS) ? 1 + rand() % 200 : 0);
  }
  targets.distances.pixels = distances;
  targets.distances.type = VOROCL_PIXEL_FLOAT64;
  targets.indices.pixels = indices;
  targets.places.pixels = places;
  targets.indices.type = targets.places.type = VOROCL_PIXEL_UINT32;
  targets.values.pixels = values;
  targets.values.type = VOROCL_PIXEL_UINT8;
  OK(vorocl_distance_transform_create(device, of, lengths, &transform));
  OK(vorocl_distance_transform_run(transform, &source, marked, farthest, &targets));
  OK(vorocl_distance_transform_found(transform, &found));
  CHECK(found == 1);
  for (pixel = 0; pixel < count; ++pixel) {
    const int x = pixel % columns, y = pixel / columns % rows, z = pixel / columns / rows;
    double least = INFINITY;
    uint32_t nearest = VOROCL_NO_LABEL;
    for (other = 0; other < count; ++other) {
      const double dx = size[0] * way(x, other % columns, columns, periodic & VOROCL_PERIODIC_X);
      const double dy = size[1] * way(y, other / columns % rows, rows, periodic & VOROCL_PERIODIC_Y);
      const double dz = size[2] * way(z, other / columns / rows, slices, periodic & VOROCL_PERIODIC_Z);
      const double away = sqrt(dx * dx + dy * dy + dz * dz);
      if ((image[other] != 0) != (marked == VOROCL_MARKED_NON_ZEROS) || away > farthest || away >= least)
        continue;
      least = away;
      nearest = (uint32_t)other;
    }
    wrong += !(distances[pixel] == least || fabs(distances[pixel] - least) < 1e-12);
    wrong += places[pixel] != nearest;
    wrong += values[pixel] != (nearest == VOROCL_NO_LABEL ? 0 : image[nearest]);
    if (depth > 1) {
      wrong +=
          indices[pixel] != (nearest == VOROCL_NO_LABEL ? nearest : nearest / (uint32_t)(columns * rows));
    }
    wrong += indices[(depth > 1 ? 2 : 1) * count + pixel] !=
             (nearest == VOROCL_NO_LABEL ? nearest : nearest % (uint32_t)columns);
  }
  CHECK(wrong == 0);
  vorocl_distance_transform_free(transform);
}

/* Of buffers, without a wait between; and of an image without zeros. */
static void test_buffers(const vorocl_device* device) {
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_int status = CL_SUCCESS;
  cl_mem from, to;
  float distances[6];
  uint8_t marks[6] = {1, 1, 0, 1, 1, 1};
  int found = -1;
  vorocl_distance_transform* transform = NULL;
  vorocl_image_source source = {NULL, NULL, VOROCL_PIXEL_UINT8};
  vorocl_transform_targets targets = {
      {NULL, NULL, VOROCL_PIXEL_FLOAT32}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}};
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  from = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, sizeof marks, marks, &status);
  CHECK(status == CL_SUCCESS);
  to = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof distances, NULL, &status);
  CHECK(status == CL_SUCCESS);
  source.buffer = from;
  targets.distances.buffer = to;
  OK(vorocl_distance_transform_create(device, vorocl_grid_of_pixels(6, 1, VOROCL_PERIODIC_NONE), NULL,
                                      &transform));
  OK(vorocl_distance_transform_run(transform, &source, VOROCL_MARKED_ZEROS, INFINITY, &targets));
  CHECK(clEnqueueReadBuffer(queue, to, CL_TRUE, 0, sizeof distances, distances, 0, NULL, NULL) == CL_SUCCESS);
  CHECK(distances[0] == 2 && distances[1] == 1 && distances[2] == 0 && distances[5] == 3);
  marks[2] = 7;
  source.buffer = NULL;
  source.pixels = marks;
  OK(vorocl_distance_transform_run(transform, &source, VOROCL_MARKED_ZEROS, INFINITY, &targets));
  OK(vorocl_distance_transform_found(transform, &found));
  CHECK(found == 0);
  clReleaseMemObject(from);
  clReleaseMemObject(to);
  vorocl_distance_transform_free(transform);
}

static void test_refusals(const vorocl_device* device) {
  const vorocl_grid of = vorocl_grid_of_pixels(6, 1, VOROCL_PERIODIC_NONE);
  const double flat[3] = {1, 0, 1};
  uint8_t marks[6] = {1, 1, 0, 1, 1, 1};
  float distances[6];
  vorocl_distance_transform* transform = NULL;
  vorocl_image_source source = {marks, NULL, VOROCL_PIXEL_UINT8};
  const vorocl_image_source nowhere = {NULL, NULL, VOROCL_PIXEL_UINT8};
  vorocl_transform_targets none = {
      {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}, {NULL, NULL, 0}};
  vorocl_transform_targets targets = none;
  targets.distances.pixels = distances;
  targets.distances.type = VOROCL_PIXEL_FLOAT32;
  FAILS(vorocl_distance_transform_create(device, of, flat, &transform), VOROCL_BAD_ARGUMENT, "length 0");
  CHECK(transform == NULL);
  FAILS(vorocl_distance_transform_create(NULL, of, NULL, &transform), VOROCL_NULL_ARGUMENT, "device");
  OK(vorocl_distance_transform_create(device, of, NULL, &transform));
  FAILS(vorocl_distance_transform_run(transform, &source, VOROCL_MARKED_ZEROS, INFINITY, &none),
        VOROCL_BAD_ARGUMENT, "target");
  FAILS(vorocl_distance_transform_run(transform, &nowhere, VOROCL_MARKED_ZEROS, INFINITY, &targets),
        VOROCL_NULL_ARGUMENT, "image");
  FAILS(vorocl_distance_transform_run(transform, &source, 5, INFINITY, &targets), VOROCL_BAD_ARGUMENT,
        "marked");
  FAILS(vorocl_distance_transform_run(transform, &source, VOROCL_MARKED_ZEROS, -1, &targets),
        VOROCL_BAD_ARGUMENT, "farthest");
  source.type = 9;
  FAILS(vorocl_distance_transform_run(transform, &source, VOROCL_MARKED_ZEROS, INFINITY, &targets),
        VOROCL_BAD_ARGUMENT, "pixel type");
  vorocl_distance_transform_free(transform);
  vorocl_distance_transform_free(NULL);
}

int main(void) {
  const double lengths[3] = {0.5, 2, 3.25};
  vorocl_device* device = NULL;
  OK(vorocl_device_select(NULL, &device));
  test_image(device, 1, VOROCL_PERIODIC_NONE, NULL, VOROCL_MARKED_ZEROS, INFINITY);
  test_image(device, 1, VOROCL_PERIODIC_XY, NULL, VOROCL_MARKED_NON_ZEROS, 3.5);
  test_image(device, 5, VOROCL_PERIODIC_NONE, lengths, VOROCL_MARKED_NON_ZEROS, INFINITY);
  test_image(device, 5, VOROCL_PERIODIC_XYZ, NULL, VOROCL_MARKED_ZEROS, INFINITY);
  test_buffers(device);
  test_refusals(device);
  vorocl_device_free(device);
  return failures == 0 ? 0 : 1;
}
