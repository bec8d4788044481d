/* Volumes by the C functions, from C: labels against a search of every voxel, measures against straight
   counts on these labels: without periodic axes, along x and z, and with spaced axes. Also built against an
   installed copy. */
#include "test_c_api.h"

enum { columns = 13, rows = 10, slices = 7, voxels = columns * rows * slices, volume_seeds = 9 };

/* Seed 3 has the voxel of seed 1, seed 5 is absent, and seeds 6 and 7 are equally far from many voxels. */
static const vorocl_point places[volume_seeds] = {{2.5, 1.5, 0.5},  {11.2, 8.9, 6.5}, {6.5, 5.5, 3.5},
                                                  {11.8, 8.1, 6.1}, {1.5, 8.5, 5.5},  {6, 6, 6},
                                                  {9.5, 2.5, 1.5},  {9.5, 2.5, 5.5},  {0.5, 5.5, 3.5}};
static const uint8_t there[volume_seeds] = {1, 1, 1, 1, 1, 0, 1, 1, 1};

static const int sides[3] = {columns, rows, slices}, steps[3] = {1, columns, columns*rows};

/* What is the same of all of a case: the volume's periodic axes and their spacing, and its labels as a search
   finds them. */
static vorocl_periodic axes;
static int spacing[3];
static uint32_t labels[voxels];

static int is_periodic(int axis) { return (axes >> axis) & 1; }

static int voxel_along(vorocl_point point, int axis) {
  return (int)(axis == 0 ? point.x : axis == 1 ? point.y : point.z);
}

/* How far a voxel lies from a seed along an axis, the shorter way round; half a period away it lies behind.
 */
static int way_along(int voxel, uint32_t seed, int axis) {
  const int side = sides[axis], way = voxel / steps[axis] % side - voxel_along(places[seed], axis);
  if (!is_periodic(axis)) return way;
  return 2 * way > side ? way - side : 2 * way <= -side ? way + side : way;
}

static int squared_distance(int voxel, uint32_t seed) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int units = spacing[axis] * way_along(voxel, seed, axis);
    sum += units * units;
  }
  return sum;
}

static int voxel_of(uint32_t seed) {
  int voxel = 0;
  for (int axis = 0; axis < 3; ++axis) voxel += voxel_along(places[seed], axis) * steps[axis];
  return voxel;
}

/* The least distance, of equal ones the first voxel, of one voxel the lowest id. */
static void search_volume(void) {
  for (int voxel = 0; voxel < voxels; ++voxel) {
    uint32_t best = 0;
    for (uint32_t seed = 1; seed < volume_seeds; ++seed) {
      const int d = squared_distance(voxel, seed), least = squared_distance(voxel, best);
      if (there[seed] && (d < least || (d == least && voxel_of(seed) < voxel_of(best)))) best = seed;
    }
    labels[voxel] = best;
  }
}

static size_t differences(const vorocl_diagram* diagram) {
  uint32_t read[voxels];
  size_t count = 0;
  OK(vorocl_diagram_read(diagram, read, voxels));
  for (int voxel = 0; voxel < voxels; ++voxel) count += read[voxel] != labels[voxel] ? 1 : 0;
  return count;
}

static void test_methods(const vorocl_seeds* seeds, vorocl_diagram* diagram, const vorocl_diagram* right) {
  vorocl_wrong_labels wrong;
  uint32_t flooded[voxels];
  size_t farther = 0;
  double percent = 0;
  OK(vorocl_run("exact", seeds, diagram, NULL));
  CHECK(differences(diagram) == 0);
  FAILS(run("exact", seeds, diagram, VOROCL_MANHATTAN), VOROCL_BAD_ARGUMENT, "are Euclidean");
  OK(vorocl_run("jfa", seeds, diagram, NULL));
  OK(vorocl_diagram_read(diagram, flooded, voxels));
  for (int voxel = 0; voxel < voxels; ++voxel) {
    if (flooded[voxel] < volume_seeds) {
      farther += squared_distance(voxel, flooded[voxel]) > squared_distance(voxel, labels[voxel]) ? 1 : 0;
    }
  }
  OK(vorocl_distance_errors(diagram, right, &wrong));
  CHECK(wrong.pixels == voxels && wrong.unlabelled_pixels == 0 && wrong.wrong_pixels == farther);
  OK(vorocl_similarity(diagram, right, &percent));
  CHECK(fabs(percent - 100.0 * (double)(voxels - differences(diagram)) / voxels) < 1e-9);
  FAILS(vorocl_run("djfa", seeds, diagram, NULL), VOROCL_BAD_ARGUMENT, "volume");
}

static void test_cells(const vorocl_diagram* diagram) {
  static uint32_t faces[volume_seeds][volume_seeds];
  uint32_t area[volume_seeds], counted[volume_seeds] = {0};
  int64_t sums[3][volume_seeds], ways[3][volume_seeds] = {{0}};
  int low[3][volume_seeds] = {{0}}, high[3][volume_seeds] = {{0}}, farthest[volume_seeds] = {0},
      border[volume_seeds] = {0};
  vorocl_point centroids[volume_seeds];
  vorocl_cell_shape shapes_read[volume_seeds];
  vorocl_cell_pair pairs_read[volume_seeds * volume_seeds];
  vorocl_cell_sums* of_sums = NULL;
  vorocl_cell_shapes* of_shapes = NULL;
  vorocl_adjacency* of_pairs = NULL;
  cl_mem of_slices = NULL;
  size_t count = 0, next = 0;

  memset(faces, 0, sizeof faces);
  for (int voxel = 0; voxel < voxels; ++voxel) {
    const uint32_t id = labels[voxel];
    const int d = squared_distance(voxel, id);
    if (d > farthest[id]) farthest[id] = d;
    for (int axis = 0; axis < 3; ++axis) {
      const int at = voxel / steps[axis] % sides[axis], is_last = at == sides[axis] - 1;
      const int home = voxel_along(places[id], axis) + way_along(voxel, id, axis);
      ways[axis][id] += home;
      if (counted[id] == 0 || home < low[axis][id]) low[axis][id] = home;
      if (counted[id] == 0 || home > high[axis][id]) high[axis][id] = home;
      if (!is_periodic(axis) && (at == 0 || is_last)) border[id] = 1;
      if (!is_last || is_periodic(axis)) {
        const uint32_t other = labels[voxel + ((at + 1) % sides[axis] - at) * steps[axis]];
        if (other != id) ++faces[id < other ? id : other][id < other ? other : id];
      }
    }
    ++counted[id];
  }

  OK(vorocl_cell_sums_create(&of_sums));
  OK(vorocl_cell_sums_measure(of_sums, diagram));
  OK(vorocl_cell_sums_read(of_sums, area, sums[0], sums[1], sums[2], volume_seeds));
  OK(vorocl_cell_sums_centroids(of_sums, centroids, volume_seeds));
  OK(vorocl_cell_sums_buffers(of_sums, NULL, NULL, NULL, &of_slices));
  CHECK(of_slices != NULL);
  OK(vorocl_cell_shapes_create(&of_shapes));
  OK(vorocl_cell_shapes_measure(of_shapes, diagram));
  OK(vorocl_cell_shapes_read(of_shapes, shapes_read, volume_seeds));
  for (int id = 0; id < volume_seeds; ++id) {
    const vorocl_cell_shape* const shape = &shapes_read[id];
    CHECK(area[id] == counted[id]);
    if (counted[id] == 0) {
      CHECK(isnan(centroids[id].z) && shape->back < shape->front && shape->largest_distance == -1);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) CHECK(sums[axis][id] == ways[axis][id]);
    CHECK(fabs(centroids[id].z - ((double)ways[2][id] / counted[id] + 0.5)) < 1e-12);
    CHECK(shape->left == low[0][id] && shape->top == low[1][id] && shape->front == low[2][id]);
    CHECK(shape->right == high[0][id] && shape->bottom == high[1][id] && shape->back == high[2][id]);
    CHECK(shape->largest_distance == farthest[id] && shape->touches_border == border[id]);
  }

  OK(vorocl_adjacency_create(&of_pairs));
  OK(vorocl_adjacency_find(of_pairs, diagram));
  OK(vorocl_adjacency_pairs(of_pairs, &count));
  CHECK(count > 0 && count <= volume_seeds * volume_seeds);
  OK(vorocl_adjacency_read_pairs(of_pairs, pairs_read, count));
  for (uint32_t a = 0; a < volume_seeds; ++a) {
    for (uint32_t b = a + 1; b < volume_seeds; ++b) {
      if (faces[a][b] == 0) continue;
      CHECK(next < count && pairs_read[next].a == a && pairs_read[next].b == b);
      CHECK(next < count && pairs_read[next].length == faces[a][b]);
      ++next;
    }
  }
  CHECK(next == count);
  vorocl_cell_sums_free(of_sums);
  vorocl_cell_shapes_free(of_shapes);
  vorocl_adjacency_free(of_pairs);
}

static void test_fields(const vorocl_diagram* diagram) {
  vorocl_field* field = NULL;
  int32_t distances[voxels];
  uint32_t grown[voxels];
  OK(vorocl_field_create(&field));
  OK(vorocl_field_int_distances(field, diagram));
  OK(vorocl_field_read(field, distances, sizeof distances));
  for (int voxel = 0; voxel < voxels; ++voxel) {
    CHECK(distances[voxel] == squared_distance(voxel, labels[voxel]));
  }
  OK(vorocl_field_expand_labels(field, diagram, 2));
  OK(vorocl_field_read(field, grown, sizeof grown));
  for (int voxel = 0; voxel < voxels; ++voxel) {
    CHECK(grown[voxel] == (distances[voxel] <= 4 ? labels[voxel] : VOROCL_NO_LABEL));
  }
  uint8_t borders[voxels];
  OK(vorocl_field_border_mask(field, diagram));
  OK(vorocl_field_read(field, borders, sizeof borders));
  for (int voxel = 0; voxel + 1 < voxels; ++voxel) {
    if ((voxel + 1) % columns == 0 || labels[voxel] == labels[voxel + 1]) continue;
    CHECK(borders[voxel] == 1 && borders[voxel + 1] == 1);
  }
  vorocl_field_free(field);
}

static void test_volume(const vorocl_device* device, vorocl_periodic periodic, int of_y, int of_z) {
  vorocl_grid volume = vorocl_grid_of_voxels(columns, rows, slices, periodic), same;
  vorocl_window all;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram *diagram = NULL, *right = NULL;
  vorocl_point read[volume_seeds];
  axes = periodic;
  spacing[0] = 1;
  spacing[1] = of_y;
  spacing[2] = of_z;
  volume.y.spacing = of_y;
  volume.z.spacing = of_z;
  search_volume();
  OK(vorocl_seeds_from_points(device, volume, places, there, volume_seeds, VOROCL_OUTSIDE_IS_REFUSED,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  OK(vorocl_seeds_grid(seeds, &same));
  CHECK(same.z.pixels == slices && same.z.to == slices && same.z.periodic == (periodic & 4) / 4);
  CHECK(same.x.spacing == 1 && same.y.spacing == of_y && same.z.spacing == of_z);
  OK(vorocl_seeds_read_pixels(seeds, read, volume_seeds));
  CHECK(read[1].x == 11.5 && read[1].y == 8.5 && read[1].z == 6.5 && isnan(read[5].z));
  OK(vorocl_seeds_read(seeds, read, volume_seeds));
  CHECK(read[1].x == places[1].x && read[1].y == places[1].y && read[1].z == places[1].z && isnan(read[5].z));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(volume), &diagram));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(volume), &right));
  OK(vorocl_diagram_window(diagram, &all));
  CHECK(all.width == columns && all.height == rows && all.z == 0 && all.depth == slices);
  OK(vorocl_diagram_write(right, labels, voxels, seeds, VOROCL_EUCLIDEAN));
  test_methods(seeds, diagram, right);
  test_cells(right);
  test_fields(right);
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(right);
  vorocl_seeds_free(seeds);
}

/* Points move, in data units and to another volume. */
static void test_moves(const vorocl_device* device) {
  const vorocl_grid volume = vorocl_grid_of_voxels(columns, rows, slices, VOROCL_PERIODIC_Z);
  vorocl_grid deep = volume;
  const vorocl_point outside = {1, 1, -1.5}, far = {1, 1, 99};
  vorocl_seeds* seeds = NULL;
  vorocl_point read[1];
  size_t index = 7;
  OK(vorocl_seeds_from_points(device, volume, places, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                              &seeds));
  OK(vorocl_seeds_move_to(seeds, &outside, NULL, 1)); /* z wraps */
  OK(vorocl_seeds_read_pixels(seeds, read, 1));
  CHECK(read[0].z == slices - 1.5);
  deep.z = (vorocl_axis){20, -10, 10, 0, 0, 0, 1};
  OK(vorocl_seeds_move_to_grid(seeds, deep, &outside, NULL, 1));
  OK(vorocl_seeds_read_pixels(seeds, read, 1));
  CHECK(read[0].z == 8.5);
  FAILS(vorocl_seeds_move_to(seeds, &far, NULL, 1), VOROCL_BAD_POINT, "point 0");
  OK(vorocl_bad_point(&index, NULL));
  CHECK(index == 0);
  vorocl_seeds_free(seeds);
}

static void test_refusals(const vorocl_device* device) {
  const vorocl_grid volume = vorocl_grid_of_voxels(columns, rows, slices, VOROCL_PERIODIC_NONE);
  const vorocl_grid unknown = vorocl_grid_of_voxels(columns, rows, slices, 8);
  vorocl_grid flat = vorocl_grid_of_voxels(width, height, 1, VOROCL_PERIODIC_NONE), wrong = grid;
  vorocl_window part = vorocl_window_of_grid(volume);
  vorocl_seeds *seeds = NULL, *none = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_point read[seed_count];
  double number = 0, energies[2];
  OK(vorocl_seeds_from_points(device, volume, places, there, volume_seeds, VOROCL_OUTSIDE_COUNTS,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  FAILS(vorocl_seeds_from_points(device, grid, places + 1, NULL, 1, VOROCL_OUTSIDE_COUNTS,
                                 VOROCL_SNAP_TO_PIXELS, &none),
        VOROCL_BAD_POINT, "z in [0, 1)");
  FAILS(vorocl_seeds_from_points(device, volume, NULL, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                                 &none),
        VOROCL_NULL_ARGUMENT, "points is NULL");
  FAILS(vorocl_seeds_random(device, unknown, 3, 1, &none), VOROCL_BAD_ARGUMENT, "must be 0 or 1");
  flat.x.spacing = 65;
  FAILS(vorocl_seeds_random(device, flat, 3, 1, &none), VOROCL_BAD_ARGUMENT, "a spacing of 65");
  flat.x.spacing = 0;
  wrong.z.to = 5;
  FAILS(vorocl_seeds_random(device, wrong, 3, 1, &none), VOROCL_BAD_ARGUMENT, "0 pixels");
  FAILS(vorocl_seeds_move_to(NULL, places, NULL, 1), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  part.height = 3;
  FAILS(vorocl_diagram_create(device, part, &diagram), VOROCL_BAD_ARGUMENT, "volume");
  part = vorocl_window_of_grid(volume);
  part.depth = slices - 1;
  FAILS(vorocl_diagram_create(device, part, &diagram), VOROCL_BAD_ARGUMENT, "volume");
  part.depth = slices + 1;
  FAILS(vorocl_diagram_create(device, part, &diagram), VOROCL_BAD_ARGUMENT, "from z = 0 on");
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(volume), &diagram));
  OK(vorocl_run("jfa", seeds, diagram, NULL));
  OK(vorocl_energy(diagram, &number));
  OK(vorocl_relax(seeds, diagram, "jfa", NULL, 1, NULL, energies, NULL, NULL));
  CHECK(number > 0 && energies[0] == number && energies[1] < number);
  FAILS(vorocl_random_step(seeds, 1, VOROCL_REFLECT, 1, 1), VOROCL_BAD_ARGUMENT, "volume");
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);

  /* A depth of 1 is a plane, whose z may say so or be left out. */
  OK(vorocl_seeds_from_points(device, flat, points, present, seed_count, VOROCL_OUTSIDE_COUNTS,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  OK(vorocl_seeds_read_pixels(seeds, read, seed_count));
  CHECK(read[0].z == 0.5);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_run("exact", seeds, diagram, NULL));
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
}

int main(void) {
  vorocl_device* device = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_volume(device, VOROCL_PERIODIC_NONE, 1, 1);
  test_volume(device, VOROCL_PERIODIC_X | VOROCL_PERIODIC_Z, 1, 1);
  test_volume(device, VOROCL_PERIODIC_X, 2, 3);
  test_moves(device);
  test_refusals(device);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
