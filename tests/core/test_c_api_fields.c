/* The C functions of fields, comparisons, vertices and relaxation, from C: against what the labels say. */
#include "test_c_api.h"

static uint32_t labels[pixels];

/* A diagram with the right labels, by the metric. */
static vorocl_diagram* make_diagram(const vorocl_device* device, vorocl_metric metric) {
  vorocl_seeds* seeds = make_seeds(device);
  vorocl_diagram* diagram = NULL;
  OK(vorocl_diagram_create(device, window, &diagram));
  search_all(points, present, seed_count, metric, labels);
  OK(vorocl_diagram_write(diagram, labels, pixels, seeds, metric));
  vorocl_seeds_free(seeds);
  return diagram;
}

/* Whether a pixel beside this one has another label. */
static int is_border(int pixel) {
  const int x = pixel % width, y = pixel / width;
  return (x > 0 && labels[pixel - 1] != labels[pixel]) ||
         (x < width - 1 && labels[pixel + 1] != labels[pixel]) ||
         (y > 0 && labels[pixel - width] != labels[pixel]) ||
         (y < height - 1 && labels[pixel + width] != labels[pixel]);
}

static void test_distances(const vorocl_device* device, vorocl_metric metric) {
  vorocl_diagram* diagram = make_diagram(device, metric);
  vorocl_field* field = NULL;
  int32_t whole[pixels];
  float lengths[pixels];
  uint32_t grown[pixels];
  const double farthest = 9.5;
  OK(vorocl_field_create(&field));
  OK(vorocl_field_int_distances(field, diagram));
  OK(vorocl_field_read(field, whole, sizeof whole));
  OK(vorocl_field_float_distances(field, diagram));
  OK(vorocl_field_read(field, lengths, sizeof lengths));
  OK(vorocl_field_expand_labels(field, diagram, farthest));
  OK(vorocl_field_read(field, grown, sizeof grown));
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const int d = distance(pixel, pixel_of(points[labels[pixel]]), metric);
    const double length = metric == VOROCL_EUCLIDEAN ? sqrt(d) : d;
    CHECK(whole[pixel] == d);
    CHECK(fabs(lengths[pixel] - length) <= 4e-7 * length);
    CHECK(grown[pixel] == (length <= farthest ? labels[pixel] : VOROCL_NO_LABEL));
  }

  /* Without labels. */
  memset(labels, 0xff, sizeof labels);
  {
    vorocl_seeds* seeds = make_seeds(device);
    OK(vorocl_diagram_write(diagram, labels, pixels, seeds, metric));
    vorocl_seeds_free(seeds);
  }
  OK(vorocl_field_int_distances(field, diagram));
  OK(vorocl_field_read(field, whole, sizeof whole));
  OK(vorocl_field_float_distances(field, diagram));
  OK(vorocl_field_read(field, lengths, sizeof lengths));
  CHECK(whole[0] == INT32_MAX && whole[pixels - 1] == INT32_MAX && isinf(lengths[0]));
  vorocl_field_free(field);
  vorocl_diagram_free(diagram);
}

static void test_labels(const vorocl_device* device) {
  const uint32_t table[seed_count] = {10, 11, 12, 13, 14, 15, 16, VOROCL_NO_LABEL};
  vorocl_diagram* diagram = make_diagram(device, VOROCL_EUCLIDEAN);
  vorocl_field* field = NULL;
  uint8_t mask[pixels], same[pixels];
  uint32_t mapped[pixels], by_buffer[pixels];
  cl_context context = NULL;
  cl_command_queue queue = NULL;
  cl_int code = CL_SUCCESS;
  cl_mem own_table = NULL, values = NULL, again = NULL;
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  own_table = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof table, (void*)(uintptr_t)table, &code);
  OK(vorocl_field_create(&field));
  OK(vorocl_field_buffer(field, &values));
  CHECK(values == NULL);
  OK(vorocl_field_read(field, NULL, 0));

  OK(vorocl_field_border_mask(field, diagram));
  OK(vorocl_field_read(field, mask, sizeof mask));
  for (int pixel = 0; pixel < pixels; ++pixel) CHECK(mask[pixel] == is_border(pixel));
  OK(vorocl_field_buffer(field, &values));
  CHECK(clEnqueueReadBuffer(queue, values, CL_TRUE, 0, sizeof same, same, 0, NULL, NULL) == CL_SUCCESS);
  CHECK(memcmp(mask, same, sizeof same) == 0);
  OK(vorocl_field_border_mask(field, diagram)); /* into the same buffer */
  OK(vorocl_field_buffer(field, &again));
  CHECK(again == values);

  OK(vorocl_field_map_labels(field, diagram, table, seed_count));
  OK(vorocl_field_read(field, mapped, sizeof mapped));
  OK(vorocl_field_map_labels_by_buffer(field, diagram, own_table));
  OK(vorocl_field_read(field, by_buffer, sizeof by_buffer));
  for (int pixel = 0; pixel < pixels; ++pixel) {
    CHECK(mapped[pixel] == table[labels[pixel]] && by_buffer[pixel] == mapped[pixel]);
  }
  clReleaseMemObject(own_table);
  vorocl_field_free(field);
  vorocl_diagram_free(diagram);
}

static void test_vertices(const vorocl_device* device) {
  vorocl_diagram* diagram = make_diagram(device, VOROCL_EUCLIDEAN);
  vorocl_point found[pixels], first[1];
  size_t count = 0, next = 0;
  OK(vorocl_vertices(diagram, found, pixels, &count));
  CHECK(count > 0 && count < pixels);
  for (int y = 0; y + 1 < height; ++y) {
    for (int x = 0; x + 1 < width; ++x) {
      const uint32_t* const at = labels + y * width + x;
      const uint32_t four[] = {at[0], at[1], at[width], at[width + 1]};
      int different = 0;
      for (int i = 0; i < 4; ++i) {
        int is_first = 1;
        for (int j = 0; j < i; ++j) is_first = is_first && four[i] != four[j];
        different += is_first;
      }
      if (different < 3) continue;
      CHECK(next < count && found[next].x == x + 1 && found[next].y == y + 1);
      ++next;
    }
  }
  CHECK(next == count);
  OK(vorocl_vertices(diagram, NULL, 0, &next));
  CHECK(next == count);
  OK(vorocl_vertices(diagram, first, 1, &next));
  CHECK(next == count && memcmp(first, found, sizeof first) == 0);
  vorocl_diagram_free(diagram);
}

/* Every 7th label is that of seed 0, and one names no seed. */
static void test_comparisons(const vorocl_device* device) {
  vorocl_seeds* seeds = make_seeds(device);
  vorocl_diagram *exact = NULL, *other = NULL;
  vorocl_wrong_labels wrong;
  uint32_t changed_labels[pixels];
  size_t changed = 0, farther = 0, pixels_changed = 0;
  double percent = 0, excess = 0, largest = 0, sum = 0;
  double energy = 0, squares = 0;
  OK(vorocl_diagram_create(device, window, &exact));
  OK(vorocl_diagram_create(device, window, &other));
  OK(run("exact", seeds, exact, VOROCL_EUCLIDEAN));
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, labels);
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const double nearest = sqrt(distance(pixel, pixel_of(points[labels[pixel]]), VOROCL_EUCLIDEAN));
    squares += (double)distance(pixel, pixel_of(points[labels[pixel]]), VOROCL_EUCLIDEAN);
    changed_labels[pixel] = pixel % 7 == 0 ? 0 : labels[pixel];
    changed += changed_labels[pixel] != labels[pixel] ? 1 : 0;
    excess = sqrt(distance(pixel, pixel_of(points[changed_labels[pixel]]), VOROCL_EUCLIDEAN)) - nearest;
    farther += excess > 0 ? 1 : 0;
    largest = excess > largest ? excess : largest;
    sum += excess;
  }
  changed_labels[1] = seed_count; /* which was seed 0's, rightly */
  OK(vorocl_diagram_write(other, changed_labels, pixels, seeds, VOROCL_EUCLIDEAN));

  OK(vorocl_changed_pixels(other, exact, &pixels_changed));
  CHECK(pixels_changed == changed + 1);
  OK(vorocl_similarity(other, exact, &percent));
  CHECK(fabs(percent - 100.0 * (double)(pixels - changed - 1) / pixels) < 1e-9);
  OK(vorocl_similarity_within(other, exact, 1e-3, &percent));
  CHECK(fabs(percent - 100.0 * (double)(pixels - farther - 1) / pixels) < 1e-9);
  OK(vorocl_similarity_within(other, exact, 1e3, &percent));
  CHECK(fabs(percent - 100.0 * (pixels - 1) / pixels) < 1e-9);

  OK(vorocl_distance_errors(other, exact, &wrong));
  CHECK(wrong.pixels == pixels && wrong.wrong_pixels == farther + 1 && wrong.unlabelled_pixels == 1);
  CHECK(fabs(wrong.largest_excess - largest) <= 1e-4 * largest);
  CHECK(fabs(wrong.mean_excess - sum / pixels) <= 1e-4 * sum / pixels);

  OK(vorocl_energy(exact, &energy));
  CHECK(energy == squares);
  vorocl_diagram_free(exact);
  vorocl_diagram_free(other);
  vorocl_seeds_free(seeds);
}

/* What failed is empty, and what cannot be is refused. */
static void test_failures(const vorocl_device* device) {
  const uint32_t table[seed_count] = {0};
  vorocl_seeds *seeds = make_seeds(device), *outer = NULL;
  vorocl_diagram *diagram = make_diagram(device, VOROCL_EUCLIDEAN), *empty = NULL, *other = NULL;
  vorocl_field* field = NULL;
  vorocl_wrong_labels wrong;
  vorocl_relaxation relaxation;
  vorocl_method_options options = VOROCL_METHOD_OPTIONS_DEFAULTS;
  vorocl_point vertex;
  uint8_t mask[pixels];
  const vorocl_point outside = {-5, 5, 0};
  cl_mem values = NULL;
  size_t count = 0;
  double percent = 0;
  double energy = 0;
  OK(vorocl_diagram_create(device, window, &empty));
  OK(vorocl_diagram_create(device, window_of(height, width), &other));
  OK(vorocl_field_create(&field));

  FAILS(vorocl_field_create(NULL), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_int_distances(NULL, diagram), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_int_distances(field, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_field_int_distances(field, empty), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_field_float_distances(NULL, diagram), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_float_distances(field, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_field_float_distances(field, empty), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_field_border_mask(NULL, diagram), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_map_labels(NULL, diagram, table, seed_count), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_map_labels(field, NULL, table, seed_count), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_field_map_labels(field, diagram, NULL, seed_count), VOROCL_NULL_ARGUMENT, "table is NULL");
  FAILS(vorocl_field_map_labels(field, diagram, table, 7), VOROCL_BAD_ARGUMENT, "7");
  FAILS(vorocl_field_map_labels(field, empty, table, seed_count), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_field_map_labels_by_buffer(NULL, diagram, values), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_map_labels_by_buffer(field, diagram, NULL), VOROCL_NULL_ARGUMENT, "table is NULL");
  FAILS(vorocl_field_expand_labels(NULL, diagram, 1), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_expand_labels(field, diagram, -1), VOROCL_BAD_ARGUMENT, "-1");
  FAILS(vorocl_field_expand_labels(field, diagram, NAN), VOROCL_BAD_ARGUMENT, "nan");
  FAILS(vorocl_field_expand_labels(field, empty, 1), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_field_buffer(NULL, &values), VOROCL_NULL_ARGUMENT, "field is NULL");
  FAILS(vorocl_field_buffer(field, NULL), VOROCL_NULL_ARGUMENT, "values is NULL");
  FAILS(vorocl_field_read(NULL, mask, 0), VOROCL_NULL_ARGUMENT, "field is NULL");
  OK(vorocl_field_border_mask(field, diagram));
  FAILS(vorocl_field_read(field, NULL, sizeof mask), VOROCL_NULL_ARGUMENT, "values is NULL");
  FAILS(vorocl_field_read(field, mask, 7), VOROCL_BAD_ARGUMENT, "2440 bytes");
  OK(vorocl_field_read(field, mask, sizeof mask));
  FAILS(vorocl_field_border_mask(field, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  OK(vorocl_field_buffer(field, &values));
  CHECK(values == NULL);
  OK(vorocl_field_read(field, NULL, 0));

  FAILS(vorocl_similarity(diagram, other, &percent), VOROCL_BAD_ARGUMENT, "different");
  FAILS(vorocl_similarity(NULL, other, &percent), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_similarity(diagram, other, NULL), VOROCL_NULL_ARGUMENT, "percent is NULL");
  FAILS(vorocl_similarity_within(diagram, NULL, 1, &percent), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_similarity_within(diagram, diagram, -1, &percent), VOROCL_BAD_ARGUMENT, "-1");
  FAILS(vorocl_similarity_within(diagram, diagram, NAN, &percent), VOROCL_BAD_ARGUMENT, "nan");
  FAILS(vorocl_similarity_within(diagram, empty, 1, &percent), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_similarity_within(diagram, other, 1, NULL), VOROCL_NULL_ARGUMENT, "percent is NULL");
  FAILS(vorocl_changed_pixels(diagram, other, &count), VOROCL_BAD_ARGUMENT, "different");
  FAILS(vorocl_changed_pixels(diagram, NULL, &count), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_changed_pixels(diagram, other, NULL), VOROCL_NULL_ARGUMENT, "pixels is NULL");
  FAILS(vorocl_distance_errors(NULL, diagram, &wrong), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_distance_errors(diagram, diagram, NULL), VOROCL_NULL_ARGUMENT, "wrong is NULL");
  FAILS(vorocl_distance_errors(diagram, empty, &wrong), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_energy(NULL, &energy), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_energy(diagram, NULL), VOROCL_NULL_ARGUMENT, "energy is NULL");
  FAILS(vorocl_energy(empty, &energy), VOROCL_BAD_ARGUMENT, "seeds");
  FAILS(vorocl_vertices(NULL, NULL, 0, &count), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_vertices(diagram, NULL, 1, &count), VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_vertices(diagram, &vertex, 1, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");

  FAILS(vorocl_relax(NULL, diagram, "exact", NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_NULL_ARGUMENT,
        "seeds is NULL");
  FAILS(vorocl_relax(seeds, NULL, "exact", NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_NULL_ARGUMENT,
        "diagram is NULL");
  FAILS(vorocl_relax(seeds, diagram, NULL, NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_NULL_ARGUMENT,
        "method is NULL");
  FAILS(vorocl_relax(seeds, diagram, "fast", NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_BAD_ARGUMENT,
        "no method \"fast\"");
  FAILS(vorocl_relax(seeds, diagram, "exact", NULL, -1, NULL, NULL, NULL, &relaxation), VOROCL_BAD_ARGUMENT,
        "-1");
  FAILS(vorocl_relax(seeds, other, "exact", NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_BAD_ARGUMENT,
        "61 x 40");
  options.metric = 9;
  FAILS(vorocl_relax(seeds, diagram, "exact", &options, 1, NULL, NULL, NULL, &relaxation),
        VOROCL_BAD_ARGUMENT, "metric 9");
  OK(vorocl_seeds_from_points(device, grid, &outside, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                              &outer));
  FAILS(vorocl_relax(outer, diagram, "exact", NULL, 1, NULL, NULL, NULL, &relaxation), VOROCL_BAD_ARGUMENT,
        "outside");
  OK(vorocl_relax(seeds, diagram, "exact", NULL, 1, NULL, NULL, NULL,
                  &relaxation)); /* they are as they were */
  CHECK(relaxation.rounds == 1);
  vorocl_field_free(field);
  vorocl_field_free(NULL);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(empty);
  vorocl_diagram_free(other);
  vorocl_seeds_free(seeds);
  vorocl_seeds_free(outer);
}

/* A Lloyd round moves every seed to the pixel nearest to its cell's centroid. */
static void test_relaxation(const vorocl_device* device) {
  vorocl_seeds* seeds = make_seeds(device);
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* sums = NULL;
  vorocl_relaxation relaxation = {-1, -1};
  vorocl_point places[seed_count], centroids[seed_count];
  uint32_t labels[pixels], area[seed_count];
  double energies[201], energy = 0, squares = 0;
  float density[pixels];
  size_t moved[200];
  int waves = -1;
  OK(vorocl_diagram_create(device, window, &diagram));
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, labels);
  for (int i = 0; i < pixels; ++i)
    squares += (double)distance(i, pixel_of(points[labels[i]]), VOROCL_EUCLIDEAN);
  OK(vorocl_relax(seeds, diagram, "exact", NULL, 0, NULL, energies, NULL, &relaxation));
  CHECK(relaxation.rounds == 0 && !relaxation.converged && energies[0] == squares);
  CHECK(has_labels(diagram, labels));

  OK(vorocl_relax(seeds, diagram, "exact", NULL, 200, NULL, energies, moved, &relaxation));
  CHECK(relaxation.converged && relaxation.rounds > 1 && energies[0] == squares);
  for (int round = 0; round < relaxation.rounds && round < 200; ++round) {
    CHECK(energies[round + 1] <= energies[round] && moved[round] > 0);
  }
  OK(vorocl_energy(diagram, &energy));
  CHECK(energy == energies[relaxation.rounds]);
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_cell_sums_measure(sums, diagram));
  OK(vorocl_cell_sums_read(sums, area, NULL, NULL, NULL, seed_count));
  OK(vorocl_cell_sums_centroids(sums, centroids, seed_count));
  OK(vorocl_seeds_read_pixels(seeds, places, seed_count));
  for (int id = 0; id < seed_count; ++id) {
    if (area[id] == 0) continue;
    CHECK(fabs(places[id].x - centroids[id].x) <= 0.5 && fabs(places[id].y - centroids[id].y) <= 0.5);
  }
  for (int i = 0; i < pixels; ++i) density[i] = 2;
  OK(vorocl_relax(seeds, diagram, "exact", NULL, 0, density, energies, NULL, NULL));
  CHECK(energies[0] == 2 * energy);
  density[pixels - 1] = -1;
  FAILS(vorocl_relax(seeds, diagram, "exact", NULL, 0, density, NULL, NULL, NULL), VOROCL_BAD_ARGUMENT,
        "pixel (60, 39)");
  FAILS(vorocl_relax_exact(seeds, diagram, "exact", NULL, 1, NULL, NULL, NULL), VOROCL_BAD_ARGUMENT,
        "snapped to pixels");
  vorocl_seeds_free(seeds);
  seeds = NULL;
  const vorocl_point one = {3, 4, 0};
  OK(vorocl_seeds_from_points(device, window.grid, &one, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_NONE,
                              &seeds));
  OK(vorocl_relax_exact(seeds, diagram, "exact", NULL, 1, NULL, moved, &relaxation));
  OK(vorocl_seeds_read(seeds, places, 1));
  CHECK(moved[0] == 1 && places[0].x == 30.5 && places[0].y == 20);
  OK(vorocl_relax(seeds, diagram, "jfa", NULL, 5, NULL, NULL, NULL, NULL));
  OK(vorocl_diagram_report(diagram, &waves, NULL, NULL));
  CHECK(waves == 6); /* that of the method's last diagram */
  vorocl_cell_sums_free(sums);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
}

int main(void) {
  vorocl_device* device = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_distances(device, VOROCL_EUCLIDEAN);
  test_distances(device, VOROCL_MANHATTAN);
  test_labels(device);
  test_vertices(device);
  test_comparisons(device);
  test_relaxation(device);
  test_failures(device);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
