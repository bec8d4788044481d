/* The C functions of axes, grids, seeds and windows, from C: against a search of every pixel. */
#include "test_c_api.h"

static int is_axis(const vorocl_axis* a, const vorocl_axis* b) {
  return a->pixels == b->pixels && a->from == b->from && a->to == b->to && a->periodic == b->periodic &&
         a->reversed == b->reversed && a->closed == b->closed && a->spacing == b->spacing;
}

static int is_grid(const vorocl_grid* a, const vorocl_grid* b) {
  return is_axis(&a->x, &b->x) && is_axis(&a->y, &b->y);
}

static void test_seeds(const vorocl_device* device) {
  vorocl_seeds *seeds = make_seeds(device), *clone = NULL, *again = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_point read[200], moved[200], one = {7, 7, 0};
  uint8_t mask[pixels] = {0};
  uint32_t nearest[pixels];
  size_t count = 0;
  double displacement = -1;
  vorocl_grid read_grid;
  vorocl_window read_window;
  memset(&read_grid, 0, sizeof read_grid);
  memset(&read_window, 0, sizeof read_window);
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_diagram_window(diagram, &read_window));
  CHECK(is_grid(&read_window.grid, &grid) && read_window.x == 0 && read_window.y == 0);
  CHECK(read_window.width == width && read_window.height == height);

  OK(vorocl_seeds_grid(seeds, &read_grid));
  CHECK(is_grid(&read_grid, &grid));
  OK(vorocl_seeds_count(seeds, &count));
  CHECK(count == seed_count);
  OK(vorocl_seeds_alive(seeds, &count));
  CHECK(count == seed_count - 1);
  OK(vorocl_seeds_check(seeds));
  OK(vorocl_seeds_read(seeds, read, seed_count));
  OK(vorocl_seeds_read_pixels(seeds, moved, seed_count));
  for (int id = 0; id < seed_count; ++id) {
    if (present[id]) {
      CHECK(read[id].x == points[id].x && read[id].y == points[id].y);
      CHECK(moved[id].x == floor(points[id].x) + 0.5 && moved[id].y == floor(points[id].y) + 0.5);
    } else {
      CHECK(isnan(read[id].x) && isnan(read[id].y) && isnan(moved[id].x) && isnan(moved[id].y));
    }
  }

  /* A clone keeps what it was made from. */
  OK(vorocl_seeds_clone(seeds, &clone));
  OK(vorocl_seeds_displacement(seeds, &displacement));
  CHECK(displacement == 0);
  OK(vorocl_seeds_move_to(seeds, &one, NULL, 1));
  OK(vorocl_seeds_alive(seeds, &count));
  CHECK(count == 1);
  OK(vorocl_seeds_displacement(seeds, &displacement));
  CHECK(displacement == 5); /* seed 0 went from (3, 2) to (7, 7) */
  OK(run("exact", clone, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest));
  OK(vorocl_seeds_move_to(seeds, points, present, seed_count));
  vorocl_seeds_free(clone);
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  vorocl_seeds_free(seeds);
  CHECK(has_labels(diagram, nearest));

  /* Weights of radii move the border of two cells: to (36 + 9 - 1) / 12 from the first one. */
  {
    const vorocl_point two[2] = {{1, 2.5, 0}, {7, 2.5, 0}};
    const double weights[2] = {9, 1};
    const vorocl_grid plane = vorocl_grid_of_pixels(width, height, VOROCL_PERIODIC_NONE);
    OK(vorocl_seeds_from_weighted_points(device, plane, two, weights, NULL, 2, VOROCL_OUTSIDE_COUNTS,
                                         VOROCL_SNAP_NONE, &seeds));
    OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
    for (int i = 0; i < pixels; ++i) nearest[i] = i % width + 0.5 > 1 + 44. / 12;
    CHECK(has_labels(diagram, nearest));
    vorocl_seeds_free(seeds);
    FAILS(vorocl_seeds_from_weighted_points(device, plane, two, NULL, NULL, 2, VOROCL_OUTSIDE_COUNTS,
                                            VOROCL_SNAP_NONE, &seeds),
          VOROCL_NULL_ARGUMENT, "weights is NULL");
  }

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

  /* No seeds are allowed. */
  OK(vorocl_seeds_from_points(device, grid, NULL, NULL, 0, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                              &seeds));
  OK(vorocl_seeds_read(seeds, NULL, 0));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
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
  cl_device_id id = NULL;
  cl_device_fp_config doubles = 0;
  cl_mem own_points, same_points, own_marks, own_labels, same_labels = NULL;
  cl_event uploaded = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_status status;
  size_t alive = 0;
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  search_all(points, NULL, seed_count, VOROCL_EUCLIDEAN, nearest_of_all);
  for (int i = 0; i < seed_count; ++i) {
    pairs[2 * i] = (float)points[i].x;
    pairs[2 * i + 1] = (float)points[i].y;
  }
  OK(vorocl_device_context(device, &context));
  OK(vorocl_device_queue(device, &queue));
  OK(vorocl_device_id(device, &id));
  own_points = clCreateBuffer(context, CL_MEM_READ_ONLY, sizeof pairs, NULL, &code);
  same_points = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof points, (void*)(uintptr_t)points, &code);
  own_marks = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof present, (void*)(uintptr_t)present, &code);
  own_labels = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof labels, NULL, &code);
  CHECK(clEnqueueWriteBuffer(queue, own_points, CL_FALSE, 0, sizeof pairs, pairs, 0, NULL, &uploaded) ==
        CL_SUCCESS);
  OK(vorocl_device_wait_for(device, 1, &uploaded));
  OK(vorocl_seeds_from_buffer(device, grid, own_points, VOROCL_FLOATS_XY, own_marks, seed_count,
                              VOROCL_OUTSIDE_IS_REFUSED, VOROCL_SNAP_TO_PIXELS, &seeds));
  OK(vorocl_seeds_alive(seeds, &alive));
  CHECK(alive == seed_count - 1);
  OK(vorocl_diagram_over_buffer(device, window, own_labels, &diagram));
  OK(vorocl_diagram_labels(diagram, &same_labels));
  CHECK(same_labels == own_labels);
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(clEnqueueReadBuffer(queue, own_labels, CL_TRUE, 0, sizeof labels, labels, 0, NULL, NULL) ==
        CL_SUCCESS);
  CHECK(memcmp(labels, nearest, sizeof labels) == 0);
  OK(vorocl_seeds_move_to_buffer(seeds, own_points, VOROCL_FLOATS_XY, NULL, seed_count));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest_of_all));
  OK(vorocl_seeds_move_to_buffer(seeds, own_points, VOROCL_FLOATS_XY, own_marks, seed_count));
  clReleaseMemObject(own_points); /* retained until they are read */
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_wait(diagram));
  CHECK(has_labels(diagram, nearest));

  /* Points in doubles, where the device knows them. */
  clGetDeviceInfo(id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, NULL);
  status = vorocl_seeds_move_to_buffer(seeds, same_points, VOROCL_DOUBLES_XYZ, NULL, seed_count);
  CHECK(status == (doubles != 0 ? VOROCL_SUCCESS : VOROCL_BAD_ARGUMENT));
  clReleaseMemObject(same_points);
  clReleaseMemObject(own_marks);
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, doubles != 0 ? nearest_of_all : nearest));
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
  clReleaseEvent(uploaded);
  clReleaseMemObject(own_labels);
}

/* The points with other coordinates, along axes that say so, have the same pixels. */
static void test_axes(const vorocl_device* device) {
  const vorocl_axis x = {width, -1, 1, 0, 0, 1, 1}, y = {height, 0, 8, 0, 1, 0, 1};
  const vorocl_grid stretched = {x, y, 0, {0, 0, 0, 0, 0, 0, 0}, 0, 0};
  vorocl_point list[seed_count], read[seed_count];
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_grid read_grid;
  uint32_t nearest[pixels];
  memset(&read_grid, 0, sizeof read_grid);
  search_all(points, present, seed_count, VOROCL_EUCLIDEAN, nearest);
  for (int id = 0; id < seed_count; ++id) {
    list[id].x = -1 + (floor(points[id].x) + 0.25) * 2 / width;
    list[id].y = 8 - (floor(points[id].y) + 0.75) * 8 / height;
  }
  list[3].x = 1; /* the last column, as the axis is closed */
  OK(vorocl_seeds_from_points(device, stretched, list, present, seed_count, VOROCL_OUTSIDE_IS_REFUSED,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  OK(vorocl_seeds_grid(seeds, &read_grid));
  CHECK(is_grid(&read_grid, &stretched));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(stretched), &diagram));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest));
  OK(vorocl_seeds_read(seeds, read, seed_count));
  CHECK(read[3].x == 1 && read[0].y == list[0].y);
  OK(vorocl_seeds_read_pixels(seeds, read, seed_count));
  CHECK(pixel_of(read[3]) == pixels - 1 && pixel_of(read[0]) == pixel_of(points[0]));

  /* The seeds go to another grid, and a diagram of the old one is not theirs. */
  OK(vorocl_seeds_move_to_grid(seeds, grid, points, present, seed_count));
  OK(vorocl_seeds_grid(seeds, &read_grid));
  CHECK(is_grid(&read_grid, &grid));
  FAILS(run("exact", seeds, diagram, VOROCL_EUCLIDEAN), VOROCL_BAD_ARGUMENT, "grid");
  vorocl_diagram_free(diagram);
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  CHECK(has_labels(diagram, nearest));
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
}

/* What becomes of points outside. */
static void test_points_outside(const vorocl_device* device) {
  const vorocl_point outside[2] = {{-0.5, 3, 0}, {4, 1000, 0}}, inside = {4, 4, 0};
  vorocl_point read[2];
  vorocl_seeds *seeds = NULL, *few = NULL;
  vorocl_diagram* diagram = NULL;
  uint32_t labels[pixels];
  size_t count = 0, index = 7;
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_seeds_from_points(device, grid, outside, NULL, 2, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                              &seeds));
  OK(vorocl_seeds_outside(seeds, &count));
  CHECK(count == 2);
  OK(vorocl_seeds_read(seeds, read, 2));
  CHECK(read[0].x == -0.5 && read[1].y == 1000);
  OK(vorocl_seeds_read_pixels(seeds, read, 2));
  CHECK(read[0].x == -0.5 && read[1].y == 1000.5);
  FAILS(run("jfa", seeds, diagram, VOROCL_EUCLIDEAN), VOROCL_BAD_ARGUMENT, "exact");
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  memset(labels, 0, sizeof labels); /* the first one is nearer everywhere */
  CHECK(has_labels(diagram, labels));

  OK(vorocl_seeds_from_points(device, grid, outside, NULL, 2, VOROCL_OUTSIDE_IS_ABSENT, VOROCL_SNAP_TO_PIXELS,
                              &few));
  OK(vorocl_seeds_alive(few, &count));
  CHECK(count == 0);
  OK(vorocl_seeds_move_to(few, &inside, NULL, 1));
  OK(vorocl_seeds_alive(few, &count));
  CHECK(count == 1);
  vorocl_seeds_free(few);
  FAILS(vorocl_seeds_from_points(device, grid, outside, NULL, 2, VOROCL_OUTSIDE_IS_REFUSED,
                                 VOROCL_SNAP_TO_PIXELS, &few),
        VOROCL_BAD_POINT, "point 0 (-0.5");
  CHECK(few == NULL);
  OK(vorocl_bad_point(&index, NULL));
  CHECK(index == 0);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
}

/* A position in units of 1/4096 pixel. */
static int64_t parts_of(double at) {
  return (int64_t)floor(at) * 4096 + (int64_t)nearbyint((at - floor(at)) * 4096);
}

/* The label of every pixel by a search of all points: the least distance from its centre, of equal ones the
   first point row by row, of one point the lowest id. */
static void search_all_points(const vorocl_point* list, uint32_t count, uint32_t* labels) {
  for (int pixel = 0; pixel < pixels; ++pixel) {
    const int64_t x = pixel % width * 4096 + 2048, y = pixel / width * 4096 + 2048;
    int64_t least = INT64_MAX, first_x = 0, first_y = 0;
    for (uint32_t seed = 0; seed < count; ++seed) {
      const int64_t at_x = parts_of(list[seed].x), at_y = parts_of(list[seed].y);
      const int64_t d = (at_x - x) * (at_x - x) + (at_y - y) * (at_y - y);
      if (d > least || (d == least && (at_y > first_y || (at_y == first_y && at_x >= first_x)))) continue;
      least = d;
      first_x = at_x;
      first_y = at_y;
      labels[pixel] = seed;
    }
  }
}

/* Points that are not snapped: several of one pixel own pixels, and flooding methods snap them still. */
static void test_true_positions(const vorocl_device* device) {
  enum { count = 6 };
  const vorocl_point list[count] = {{20.1, 20.5, 0},  {20.9, 20.5, 0}, {20.5, 20.125, 0},
                                    {-3.25, 7.75, 0}, {20.9, 20.5, 0}, {50.3, 9.7, 0}};
  float pairs[2 * count];
  vorocl_point read[count], exact_in_float[count];
  uint32_t nearest[pixels], labels[pixels];
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  cl_context context = NULL;
  cl_mem buffer = NULL;
  cl_int code = CL_SUCCESS;
  int snapped = 2;
  OK(vorocl_diagram_create(device, window, &diagram));
  OK(vorocl_seeds_from_points(device, grid, list, NULL, count, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_NONE,
                              &seeds));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_snapped(diagram, &snapped));
  CHECK(snapped == 0);
  search_all_points(list, count, nearest);
  CHECK(has_labels(diagram, nearest));
  CHECK(nearest[20 * width + 19] == 0 && nearest[20 * width + 21] == 1 && nearest[19 * width + 20] == 2);
  OK(vorocl_seeds_read_pixels(seeds, read, count));
  for (int id = 0; id < count; ++id) {
    CHECK(read[id].x == (double)parts_of(list[id].x) / 4096 &&
          read[id].y == (double)parts_of(list[id].y) / 4096);
  }
  OK(vorocl_seeds_read(seeds, read, count));
  CHECK(read[0].x == list[0].x && read[3].y == list[3].y);

  /* Later frames too; a method that floods takes the pixels. */
  OK(vorocl_seeds_move_to(seeds, list, NULL, 3));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  search_all_points(list, 3, nearest);
  CHECK(has_labels(diagram, nearest));
  OK(run("jfa", seeds, diagram, VOROCL_EUCLIDEAN));
  memset(labels, 0, sizeof labels); /* the lowest id of the pixel */
  CHECK(has_labels(diagram, labels));
  OK(vorocl_diagram_snapped(diagram, &snapped));
  CHECK(snapped == 1);
  vorocl_seeds_free(seeds);

  /* The same points in a buffer. */
  for (int id = 0; id < count; ++id) {
    pairs[2 * id] = (float)list[id].x;
    pairs[2 * id + 1] = (float)list[id].y;
    exact_in_float[id].x = (double)pairs[2 * id];
    exact_in_float[id].y = (double)pairs[2 * id + 1];
  }
  OK(vorocl_device_context(device, &context));
  buffer = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof pairs, pairs, &code);
  OK(vorocl_seeds_from_buffer(device, grid, buffer, VOROCL_FLOATS_XY, NULL, count, VOROCL_OUTSIDE_IS_ABSENT,
                              VOROCL_SNAP_NONE, &seeds));
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  exact_in_float[3] =
      exact_in_float[0]; /* outside: it is absent, and this one has no pixel beside the first */
  search_all_points(exact_in_float, count, nearest);
  CHECK(has_labels(diagram, nearest));
  clReleaseMemObject(buffer);
  vorocl_seeds_free(seeds);
  vorocl_diagram_free(diagram);
}

/* A box that is tilted by half a period repeats as one of twice the height does that has each seed twice. */
static void test_tilted_grid(const vorocl_device* device) {
  enum { half = height / 2, count = 3 };
  vorocl_grid tilted = vorocl_grid_of_pixels(width, half, VOROCL_PERIODIC_XY);
  const vorocl_grid twice = vorocl_grid_of_pixels(width, height, VOROCL_PERIODIC_XY);
  vorocl_point of_both[2 * count] = {{3.27, 2.71, 0}, {50.53, 5.16, 0}, {33.02, 16.48, 0}};
  vorocl_grid read_grid;
  vorocl_seeds *few = NULL, *all = NULL;
  vorocl_diagram *diagram = NULL, *other = NULL;
  uint32_t labels[width * half], expected[pixels];
  memset(&read_grid, 0, sizeof read_grid);
  tilted.tilt = 0.5 * width;
  for (int i = 0; i < count; ++i) {
    of_both[count + i].x = of_both[i].x + tilted.tilt;
    of_both[count + i].y = of_both[i].y + half;
  }
  OK(vorocl_seeds_from_points(device, tilted, of_both, NULL, count, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_NONE,
                              &few));
  OK(vorocl_seeds_from_points(device, twice, of_both, NULL, 2 * count, VOROCL_OUTSIDE_COUNTS,
                              VOROCL_SNAP_NONE, &all));
  OK(vorocl_seeds_grid(few, &read_grid));
  CHECK(read_grid.tilt == tilted.tilt);
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(tilted), &diagram));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(twice), &other));
  OK(run("exact", few, diagram, VOROCL_EUCLIDEAN));
  OK(run("exact", all, other, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_read(diagram, labels, sizeof labels / sizeof *labels));
  OK(vorocl_diagram_read(other, expected, pixels));
  for (int i = 0; i < width * half; ++i) CHECK(labels[i] == expected[i] % count);
  FAILS(run("jfa", few, diagram, VOROCL_EUCLIDEAN), VOROCL_BAD_ARGUMENT, "tilted");
  vorocl_diagram_free(other);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(all);
  vorocl_seeds_free(few);
  all = NULL;
  tilted.tilt = NAN;
  FAILS(vorocl_seeds_from_points(device, tilted, of_both, NULL, count, VOROCL_OUTSIDE_COUNTS,
                                 VOROCL_SNAP_NONE, &all),
        VOROCL_BAD_ARGUMENT, "tilt must be a finite number");
  tilted.tilt = 2;
  tilted.y.periodic = 0;
  FAILS(vorocl_seeds_from_points(device, tilted, of_both, NULL, count, VOROCL_OUTSIDE_COUNTS,
                                 VOROCL_SNAP_NONE, &all),
        VOROCL_BAD_ARGUMENT, "periodic in x and y");
  CHECK(all == NULL);
}

/* A window shows the labels of its pixels of the grid, across the end of a period too. */
static void test_windows(const vorocl_device* device) {
  const vorocl_grid periodic = vorocl_grid_of_pixels(width, height, VOROCL_PERIODIC_X);
  const vorocl_window across = {periodic, -7, 5, 30, 20, 0, 0};
  vorocl_window read_window;
  vorocl_point moved[seed_count];
  vorocl_seeds *seeds = NULL, *wrapped = NULL;
  vorocl_diagram *diagram = NULL, *whole = NULL;
  uint32_t labels[pixels], part[30 * 20];
  memset(&read_window, 0, sizeof read_window);
  memcpy(moved, points, sizeof moved);
  for (int i = 0; i < seed_count; ++i) moved[i].x += (i % 3 - 1) * width;

  OK(vorocl_seeds_from_points(device, periodic, points, present, seed_count, VOROCL_OUTSIDE_COUNTS,
                              VOROCL_SNAP_TO_PIXELS, &seeds));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(periodic), &whole));
  OK(run("exact", seeds, whole, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_read(whole, labels, pixels));

  /* Points wrap. */
  OK(vorocl_seeds_from_points(device, periodic, moved, present, seed_count, VOROCL_OUTSIDE_IS_REFUSED,
                              VOROCL_SNAP_TO_PIXELS, &wrapped));
  OK(run("exact", wrapped, whole, VOROCL_EUCLIDEAN));
  CHECK(has_labels(whole, labels));

  OK(vorocl_diagram_create(device, across, &diagram));
  OK(vorocl_diagram_window(diagram, &read_window));
  CHECK(read_window.x == width - 7 && read_window.y == 5);
  CHECK(read_window.width == 30 && read_window.height == 20 && read_window.grid.x.periodic == 1);
  OK(run("exact", seeds, diagram, VOROCL_EUCLIDEAN));
  OK(vorocl_diagram_read(diagram, part, sizeof part / sizeof *part));
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      CHECK(part[y * 30 + x] == labels[(y + 5) * width + (x + width - 7) % width]);
    }
  }
  FAILS(run("jfa", seeds, diagram, VOROCL_EUCLIDEAN), VOROCL_BAD_ARGUMENT, "exact");
  vorocl_diagram_free(diagram);
  vorocl_diagram_free(whole);
  vorocl_seeds_free(wrapped);
  vorocl_seeds_free(seeds);
}

int main(void) {
  vorocl_device* device = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  test_seeds(device);
  test_own_buffers(device);
  test_axes(device);
  test_points_outside(device);
  test_true_positions(device);
  test_tilted_grid(device);
  test_windows(device);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
