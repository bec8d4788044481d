/* The C functions that measure cells, from C: against straight counts on the labels of the diagram. */
#include "test_c_api.h"

static uint32_t labels[pixels];

/* What a count of the labels says of one cell. */
typedef struct cell {
  uint32_t area, neighbours, perimeter;
  int64_t sum_x, sum_y;
  vorocl_cell_shape shape;
} cell;
static cell cells[seed_count];
static uint32_t borders[seed_count][seed_count];

static void count_border(uint32_t a, uint32_t b) {
  if (a == b) return;
  ++borders[a][b];
  ++borders[b][a];
}

static void count_cells(vorocl_metric metric) {
  memset(cells, 0, sizeof cells);
  memset(borders, 0, sizeof borders);
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const int x = pixel % width, y = pixel / width;
    const int d = distance(pixel, pixel_of(points[labels[pixel]]), metric);
    cell* const here = &cells[labels[pixel]];
    vorocl_cell_shape* const shape = &here->shape;
    if (here->area++ == 0) *shape = (vorocl_cell_shape){x, y, x, y, d, 0, 0, 0};
    here->sum_x += x;
    here->sum_y += y;
    if (x < shape->left) shape->left = x;
    if (x > shape->right) shape->right = x;
    if (y > shape->bottom) shape->bottom = y; /* pixels come row by row: the top is the first one's */
    if (d > shape->largest_distance) shape->largest_distance = d;
    if (x == 0 || y == 0 || x == width - 1 || y == height - 1) shape->touches_border = 1;
    if (x > 0) count_border(labels[pixel], labels[pixel - 1]);
    if (y > 0) count_border(labels[pixel], labels[pixel - width]);
  }
  for (int a = 0; a < seed_count; ++a) {
    for (int b = 0; b < seed_count; ++b) {
      cells[a].neighbours += borders[a][b] > 0 ? 1 : 0;
      cells[a].perimeter += borders[a][b];
    }
  }
}

static void read_buffer(const vorocl_device* device, cl_mem buffer, size_t size, void* values) {
  cl_command_queue queue = NULL;
  OK(vorocl_device_queue(device, &queue));
  CHECK(clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, size, values, 0, NULL, NULL) == CL_SUCCESS);
}

static void test_sums(const vorocl_device* device, const vorocl_diagram* diagram) {
  vorocl_cell_sums* sums = NULL;
  vorocl_cell_statistics statistics;
  vorocl_point centroids[seed_count];
  uint32_t area[seed_count];
  int64_t sum_x[seed_count], sum_y[seed_count];
  cl_mem buffers[3] = {NULL, NULL, NULL}, same[3] = {NULL, NULL, NULL}, of_slices = NULL;
  double mean = 0, variance = 0;
  size_t count = 7;
  count_cells(VOROCL_EUCLIDEAN);
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_cell_sums_count(sums, &count));
  CHECK(count == 0);
  OK(vorocl_cell_sums_read(sums, NULL, NULL, NULL, NULL, 0));
  OK(vorocl_cell_sums_centroids(sums, NULL, 0));
  OK(vorocl_cell_sums_statistics(sums, &statistics));
  CHECK(statistics.cells == 0 && statistics.pixels == 0 && statistics.mean_area == 0);
  OK(vorocl_cell_sums_buffers(sums, NULL, NULL, &buffers[2], NULL));
  CHECK(buffers[2] == NULL);

  OK(vorocl_cell_sums_measure(sums, diagram));
  OK(vorocl_cell_sums_count(sums, &count));
  CHECK(count == seed_count);
  OK(vorocl_cell_sums_buffers(sums, &buffers[0], &buffers[1], &buffers[2], &of_slices));
  read_buffer(device, of_slices, sizeof sum_x, sum_x);
  for (int id = 0; id < seed_count; ++id) CHECK(sum_x[id] == 0);
  read_buffer(device, buffers[0], sizeof area, area);
  read_buffer(device, buffers[1], sizeof sum_x, sum_x);
  read_buffer(device, buffers[2], sizeof sum_y, sum_y);
  for (int round = 0; round < 2; ++round) { /* from the buffers, and as they are read */
    for (int id = 0; id < seed_count; ++id) {
      CHECK(area[id] == cells[id].area && sum_x[id] == cells[id].sum_x && sum_y[id] == cells[id].sum_y);
    }
    memset(area, 0, sizeof area);
    OK(vorocl_cell_sums_read(sums, area, sum_x, sum_y, NULL, seed_count));
  }
  OK(vorocl_cell_sums_centroids(sums, centroids, seed_count));
  for (int id = 0; id < seed_count; ++id) {
    const double n = cells[id].area;
    if (cells[id].area == 0) {
      CHECK(isnan(centroids[id].x) && isnan(centroids[id].y));
    } else {
      CHECK(fabs(centroids[id].x - ((double)cells[id].sum_x / n + 0.5)) < 1e-12);
      CHECK(fabs(centroids[id].y - ((double)cells[id].sum_y / n + 0.5)) < 1e-12);
    }
  }

  OK(vorocl_cell_sums_statistics(sums, &statistics));
  CHECK(statistics.cells == 7 && statistics.empty_cells == 1 && statistics.pixels == pixels);
  mean = (double)pixels / 7;
  for (int id = 0; id < seed_count; ++id) {
    if (present[id]) variance += (cells[id].area - mean) * (cells[id].area - mean) / 7;
  }
  CHECK(fabs(statistics.mean_area - mean) < 1e-9);
  CHECK(fabs(statistics.area_deviation - sqrt(variance)) < 1e-9);

  /* Another measurement goes to the same buffers. */
  OK(vorocl_cell_sums_measure(sums, diagram));
  OK(vorocl_cell_sums_buffers(sums, &same[0], &same[1], &same[2], NULL));
  CHECK(memcmp(same, buffers, sizeof same) == 0);
  vorocl_cell_sums_free(sums);
}

static void test_shapes(const vorocl_device* device, const vorocl_seeds* seeds, vorocl_diagram* diagram) {
  vorocl_cell_shapes* shapes = NULL;
  vorocl_cell_shape read[seed_count];
  int32_t boxes[seed_count][6], distances[seed_count];
  cl_mem of_boxes = NULL, of_distances = NULL;
  size_t count = 7;
  OK(vorocl_cell_shapes_create(&shapes));
  OK(vorocl_cell_shapes_count(shapes, &count));
  CHECK(count == 0);
  OK(vorocl_cell_shapes_read(shapes, NULL, 0));
  for (vorocl_metric metric = VOROCL_EUCLIDEAN; metric <= VOROCL_MANHATTAN; ++metric) {
    count_cells(metric);
    OK(vorocl_diagram_write(diagram, labels, pixels, seeds, metric));
    OK(vorocl_cell_shapes_measure(shapes, diagram));
    OK(vorocl_cell_shapes_count(shapes, &count));
    CHECK(count == seed_count);
    OK(vorocl_cell_shapes_read(shapes, read, seed_count));
    OK(vorocl_cell_shapes_buffers(shapes, &of_boxes, &of_distances));
    OK(vorocl_cell_shapes_buffers(shapes, NULL, NULL));
    read_buffer(device, of_boxes, sizeof boxes, boxes);
    read_buffer(device, of_distances, sizeof distances, distances);
    for (int id = 0; id < seed_count; ++id) {
      const vorocl_cell_shape *found = &read[id], *right = &cells[id].shape;
      CHECK(found->left == boxes[id][0] && found->top == boxes[id][1]);
      CHECK(found->right == boxes[id][3] && found->bottom == boxes[id][4]);
      CHECK(boxes[id][2] == found->front && boxes[id][5] == found->back);
      CHECK(found->largest_distance == distances[id]);
      if (cells[id].area == 0) {
        CHECK(found->right < found->left && found->bottom < found->top && found->largest_distance == -1);
        CHECK(!found->touches_border);
        continue;
      }
      CHECK(found->left == right->left && found->right == right->right);
      CHECK(found->top == right->top && found->bottom == right->bottom);
      CHECK(found->largest_distance == right->largest_distance);
      CHECK(found->touches_border == right->touches_border);
    }
  }
  vorocl_cell_shapes_free(shapes);
}

static void test_adjacency(const vorocl_device* device, const vorocl_diagram* diagram) {
  vorocl_adjacency* adjacency = NULL;
  vorocl_cell_pair pairs[seed_count * seed_count], same_pairs[seed_count * seed_count];
  uint32_t neighbours[seed_count], perimeters[seed_count], same[seed_count];
  cl_mem of_pairs = NULL, of_neighbours = NULL, of_perimeters = NULL;
  size_t count = 7, next = 0;
  count_cells(VOROCL_EUCLIDEAN);
  OK(vorocl_adjacency_create(&adjacency));
  OK(vorocl_adjacency_pairs(adjacency, &count));
  CHECK(count == 0);
  OK(vorocl_adjacency_read_pairs(adjacency, NULL, 0));
  OK(vorocl_adjacency_read_cells(adjacency, NULL, NULL, 0));

  OK(vorocl_adjacency_find(adjacency, diagram));
  OK(vorocl_adjacency_pairs(adjacency, &count));
  CHECK(count > 0 && count <= seed_count * seed_count);
  OK(vorocl_adjacency_read_pairs(adjacency, pairs, count));
  for (uint32_t a = 0; a < seed_count; ++a) {
    for (uint32_t b = a + 1; b < seed_count; ++b) {
      if (borders[a][b] == 0) continue;
      CHECK(next < count && pairs[next].a == a && pairs[next].b == b && pairs[next].length == borders[a][b]);
      ++next;
    }
  }
  CHECK(next == count);
  OK(vorocl_adjacency_read_cells(adjacency, neighbours, NULL, seed_count));
  OK(vorocl_adjacency_read_cells(adjacency, NULL, perimeters, seed_count));
  for (int id = 0; id < seed_count; ++id) {
    CHECK(neighbours[id] == cells[id].neighbours && perimeters[id] == cells[id].perimeter);
  }
  OK(vorocl_adjacency_buffers(adjacency, &of_pairs, &of_neighbours, &of_perimeters));
  OK(vorocl_adjacency_buffers(adjacency, NULL, NULL, NULL));
  read_buffer(device, of_pairs, count * sizeof *pairs, same_pairs);
  CHECK(memcmp(pairs, same_pairs, count * sizeof *pairs) == 0);
  read_buffer(device, of_neighbours, sizeof same, same);
  CHECK(memcmp(neighbours, same, sizeof same) == 0);
  read_buffer(device, of_perimeters, sizeof same, same);
  CHECK(memcmp(perimeters, same, sizeof same) == 0);
  vorocl_adjacency_free(adjacency);
}

/* What failed is empty, and what cannot be is refused. */
static void test_failures(const vorocl_device* device, const vorocl_diagram* diagram) {
  vorocl_cell_sums* sums = NULL;
  vorocl_cell_shapes* shapes = NULL;
  vorocl_adjacency* adjacency = NULL;
  vorocl_diagram* other = NULL;
  vorocl_cell_statistics statistics;
  vorocl_point centroids[seed_count];
  vorocl_cell_shape cells_read[seed_count];
  vorocl_cell_pair pairs[seed_count];
  size_t count = 7;
  OK(vorocl_diagram_create(device, window, &other)); /* which knows no seeds */
  OK(vorocl_cell_sums_create(&sums));
  OK(vorocl_cell_shapes_create(&shapes));
  OK(vorocl_adjacency_create(&adjacency));

  FAILS(vorocl_cell_sums_create(NULL), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_measure(NULL, diagram), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_measure(sums, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_cell_sums_count(NULL, &count), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_count(sums, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_cell_sums_buffers(NULL, NULL, NULL, NULL, NULL), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_read(NULL, NULL, NULL, NULL, NULL, 0), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_centroids(NULL, centroids, 0), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_statistics(NULL, &statistics), VOROCL_NULL_ARGUMENT, "sums is NULL");
  FAILS(vorocl_cell_sums_statistics(sums, NULL), VOROCL_NULL_ARGUMENT, "statistics is NULL");
  OK(vorocl_cell_sums_measure(sums, diagram));
  FAILS(vorocl_cell_sums_read(sums, NULL, NULL, NULL, NULL, 9), VOROCL_BAD_ARGUMENT, "8 cells");
  FAILS(vorocl_cell_sums_centroids(sums, centroids, 7), VOROCL_BAD_ARGUMENT, "8 cells");
  FAILS(vorocl_cell_sums_centroids(sums, NULL, 8), VOROCL_NULL_ARGUMENT, "centroids is NULL");
  FAILS(vorocl_cell_sums_measure(sums, other), VOROCL_BAD_ARGUMENT, "seeds");
  OK(vorocl_cell_sums_count(sums, &count));
  CHECK(count == 0);

  FAILS(vorocl_cell_shapes_create(NULL), VOROCL_NULL_ARGUMENT, "shapes is NULL");
  FAILS(vorocl_cell_shapes_measure(NULL, diagram), VOROCL_NULL_ARGUMENT, "shapes is NULL");
  FAILS(vorocl_cell_shapes_measure(shapes, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_cell_shapes_count(NULL, &count), VOROCL_NULL_ARGUMENT, "shapes is NULL");
  FAILS(vorocl_cell_shapes_count(shapes, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_cell_shapes_buffers(NULL, NULL, NULL), VOROCL_NULL_ARGUMENT, "shapes is NULL");
  FAILS(vorocl_cell_shapes_read(NULL, cells_read, 0), VOROCL_NULL_ARGUMENT, "shapes is NULL");
  OK(vorocl_cell_shapes_measure(shapes, diagram));
  FAILS(vorocl_cell_shapes_read(shapes, cells_read, 7), VOROCL_BAD_ARGUMENT, "8 cells");
  FAILS(vorocl_cell_shapes_read(shapes, NULL, 8), VOROCL_NULL_ARGUMENT, "cells is NULL");
  FAILS(vorocl_cell_shapes_measure(shapes, other), VOROCL_BAD_ARGUMENT, "seeds");
  OK(vorocl_cell_shapes_count(shapes, &count));
  CHECK(count == 0);

  FAILS(vorocl_adjacency_create(NULL), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  FAILS(vorocl_adjacency_find(NULL, diagram), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  FAILS(vorocl_adjacency_find(adjacency, NULL), VOROCL_NULL_ARGUMENT, "diagram is NULL");
  FAILS(vorocl_adjacency_pairs(NULL, &count), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  FAILS(vorocl_adjacency_pairs(adjacency, NULL), VOROCL_NULL_ARGUMENT, "pairs is NULL");
  FAILS(vorocl_adjacency_buffers(NULL, NULL, NULL, NULL), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  FAILS(vorocl_adjacency_read_pairs(NULL, pairs, 0), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  FAILS(vorocl_adjacency_read_pairs(adjacency, pairs, 1), VOROCL_BAD_ARGUMENT, "0 pairs");
  FAILS(vorocl_adjacency_read_cells(NULL, NULL, NULL, 0), VOROCL_NULL_ARGUMENT, "adjacency is NULL");
  OK(vorocl_adjacency_find(adjacency, diagram));
  OK(vorocl_adjacency_pairs(adjacency, &count));
  FAILS(vorocl_adjacency_read_pairs(adjacency, NULL, count), VOROCL_NULL_ARGUMENT, "pairs is NULL");
  FAILS(vorocl_adjacency_read_cells(adjacency, NULL, NULL, 7), VOROCL_BAD_ARGUMENT, "8 cells");
  FAILS(vorocl_adjacency_find(adjacency, other), VOROCL_BAD_ARGUMENT, "seeds");
  OK(vorocl_adjacency_pairs(adjacency, &count));
  CHECK(count == 0);
  vorocl_cell_sums_free(sums);
  vorocl_cell_shapes_free(shapes);
  vorocl_adjacency_free(adjacency);
  vorocl_diagram_free(other);
  vorocl_cell_sums_free(NULL);
  vorocl_cell_shapes_free(NULL);
  vorocl_adjacency_free(NULL);
}

/* Columns are longitudes and rows are latitudes. */
static void test_globe(const vorocl_seeds* seeds, vorocl_diagram* diagram) {
  const double radians = 3.14159265358979323846 / 180, radius = 6371.0088;
  vorocl_cell_row rows[seed_count];
  vorocl_metric metric = VOROCL_EUCLIDEAN;
  size_t count = 0;
  double area = 0;
  FAILS(run("jfa", seeds, diagram, VOROCL_GREAT_CIRCLE), VOROCL_BAD_ARGUMENT, "great circles");
  OK(run("exact", seeds, diagram, VOROCL_GREAT_CIRCLE));
  OK(vorocl_diagram_metric(diagram, &metric));
  CHECK(metric == VOROCL_GREAT_CIRCLE);
  OK(vorocl_cell_table(diagram, NULL, 0, &count));
  CHECK(count == seed_count - 1); /* one is absent */
  OK(vorocl_cell_table(diagram, rows, seed_count, &count));
  for (size_t i = 0; i < count; ++i) area += rows[i].area;
  CHECK(rows[0].id == 0 && rows[0].touches_border == 1 && rows[0].neighbours > 0 && rows[6].id == 7);
  CHECK(rows[0].largest_distance > 100 && rows[0].largest_distance < 20100);
  CHECK(fabs(area / (radius * radius * width * radians * sin(height * radians)) - 1) < 1e-9);
  FAILS(vorocl_cell_table(diagram, NULL, 1, &count), VOROCL_NULL_ARGUMENT, "rows");
}

int main(void) {
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  seeds = make_seeds(device);
  OK(vorocl_diagram_create(device, window, &diagram));
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, labels);
  OK(vorocl_diagram_write(diagram, labels, pixels, seeds, VOROCL_EUCLIDEAN));
  test_sums(device, diagram);
  test_shapes(device, seeds, diagram);
  test_adjacency(device, diagram);
  test_failures(device, diagram);
  test_globe(seeds, diagram);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
