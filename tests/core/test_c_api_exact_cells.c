/* The C functions that cut cells as polygons and polyhedra, from C: against sums over the polygons, and the
 * nearest of all seeds. */
#include "test_c_api.h"

enum { most_edges = 6 * seed_count };
static const double near = 1e-5; /* positions are rounded to 2^-24 */

static void read_buffer(const vorocl_device* device, cl_mem buffer, size_t size, void* values) {
  cl_command_queue queue = NULL;
  OK(vorocl_device_queue(device, &queue));
  CHECK(clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, size, values, 0, NULL, NULL) == CL_SUCCESS);
}

static double distance_of(vorocl_point a, vorocl_point b) { return hypot(a.x - b.x, a.y - b.y); }

static void test_cells(const vorocl_device* device, const vorocl_seeds* seeds) {
  vorocl_exact_cells* all = NULL;
  vorocl_exact_cell cells[seed_count];
  vorocl_point vertices[most_edges];
  uint32_t offsets[seed_count + 1], same_offsets[seed_count + 1], neighbours[most_edges];
  double lengths[most_edges], areas[seed_count], sum = 0;
  cl_mem buffers[5] = {NULL, NULL, NULL, NULL, NULL}, of_edges[4] = {NULL, NULL, NULL, NULL};
  size_t count = 7, edges = 7;
  OK(vorocl_exact_cells_create(&all));
  OK(vorocl_exact_cells_count(all, &count));
  OK(vorocl_exact_cells_edges(all, &edges));
  CHECK(count == 0 && edges == 0);
  OK(vorocl_exact_cells_read(all, NULL, 0));
  OK(vorocl_exact_cells_buffers(all, &buffers[0], NULL, NULL, NULL, NULL));
  CHECK(buffers[0] == NULL);

  OK(vorocl_exact_cells_cut(all, seeds));
  OK(vorocl_exact_cells_count(all, &count));
  OK(vorocl_exact_cells_edges(all, &edges));
  CHECK(count == seed_count && edges >= 3 * 7 && edges <= most_edges);
  if (edges > most_edges) return;
  OK(vorocl_exact_cells_read(all, cells, seed_count));
  OK(vorocl_exact_cells_read_polygons(all, offsets, seed_count, vertices, neighbours, lengths, edges));
  CHECK(offsets[0] == 0 && offsets[seed_count] == edges);
  for (uint32_t id = 0; id < seed_count; ++id) {
    const uint32_t begin = offsets[id], end = offsets[id + 1];
    uint32_t with_cells = 0;
    double area = 0, perimeter = 0;
    CHECK(cells[id].certified == 1);
    CHECK((end > begin) == (present[id] != 0));
    for (uint32_t i = begin; i < end; ++i) {
      const vorocl_point from = vertices[i], to = vertices[i + 1 < end ? i + 1 : begin];
      area += (from.x * to.y - to.x * from.y) / 2;
      perimeter += lengths[i];
      CHECK(fabs(lengths[i] - distance_of(from, to)) < 1e-12);
      /* A vertex has no seed that is nearer, and what is behind an edge is as near to it. */
      for (int other = 0; other < seed_count; ++other) {
        if (present[other] != 0)
          CHECK(distance_of(from, points[other]) > distance_of(from, points[id]) - near);
      }
      if (neighbours[i] == VOROCL_NO_LABEL) continue;
      ++with_cells;
      CHECK(fabs(distance_of(from, points[neighbours[i]]) - distance_of(from, points[id])) < near);
      CHECK(fabs(distance_of(to, points[neighbours[i]]) - distance_of(to, points[id])) < near);
    }
    CHECK(fabs(cells[id].area - area) < 1e-10 && fabs(cells[id].perimeter - perimeter) < 1e-10);
    CHECK(cells[id].neighbours == with_cells);
    CHECK(cells[id].touches_border == (with_cells < end - begin ? 1 : 0));
    CHECK(isnan(cells[id].centroid.x) == (present[id] == 0));
    sum += cells[id].area;
  }
  CHECK(fabs(sum - pixels) < 1e-10);

  OK(vorocl_exact_cells_buffers(all, &buffers[0], &buffers[1], &buffers[2], &buffers[3], &buffers[4]));
  OK(vorocl_exact_cells_polygon_buffers(all, &of_edges[0], &of_edges[1], &of_edges[2], &of_edges[3]));
  for (int i = 0; i < 5; ++i) CHECK(buffers[i] != NULL);
  for (int i = 0; i < 4; ++i) CHECK(of_edges[i] != NULL);
  read_buffer(device, buffers[0], sizeof areas, areas);
  read_buffer(device, of_edges[0], sizeof same_offsets, same_offsets);
  for (int id = 0; id < seed_count; ++id) CHECK(areas[id] == cells[id].area);
  CHECK(memcmp(offsets, same_offsets, sizeof offsets) == 0);
  vorocl_exact_cells_free(all);
}

/* A box whose third edge leans by half of the others repeats as a body centred lattice. */
static void test_tilted_volume(const vorocl_device* device) {
  vorocl_grid box = vorocl_grid_of_voxels(8, 8, 4, VOROCL_PERIODIC_XYZ);
  const vorocl_point one = {1, 2, 3}, two[2] = {{0.5, 0.5, 0.5}, {4.5, 4.5, 0.5}};
  uint32_t labels[256];
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_exact_cells* all = NULL;
  vorocl_exact_cell cell;
  vorocl_exact_face faces[7];
  vorocl_grid read_grid;
  size_t count = 0;
  box.tilt_xz = box.tilt_yz = 4;
  OK(vorocl_seeds_from_points(device, box, &one, NULL, 1, VOROCL_OUTSIDE_IS_REFUSED, VOROCL_SNAP_NONE,
                              &seeds));
  OK(vorocl_seeds_grid(seeds, &read_grid));
  CHECK(read_grid.tilt == 0 && read_grid.tilt_xz == 4 && read_grid.tilt_yz == 4);
  OK(vorocl_exact_cells_create(&all));
  OK(vorocl_exact_cells_cut(all, seeds));
  OK(vorocl_exact_cells_read(all, &cell, 1));
  CHECK(cell.neighbours == 14 && cell.area == 256 && cell.certified == 1);
  OK(vorocl_exact_cells_read_faces(all, faces, 7, &count));
  CHECK(count == 7);
  /* Of two points in the first slice the other one's image stands above each. */
  OK(vorocl_seeds_move_to(seeds, two, NULL, 2));
  OK(vorocl_diagram_create(device, vorocl_window_of_grid(box), &diagram));
  OK(vorocl_run("exact", seeds, diagram, NULL));
  OK(vorocl_diagram_read(diagram, labels, 256));
  CHECK(labels[0] == 0 && labels[4 * 8 + 4] == 1);
  CHECK(labels[3 * 64] == 1 && labels[3 * 64 + 4 * 8 + 4] == 0);
  FAILS(vorocl_run("jfa", seeds, diagram, NULL), VOROCL_BAD_ARGUMENT, "tilted");
  vorocl_diagram_free(diagram);
  vorocl_exact_cells_free(all);
  vorocl_seeds_free(seeds);
}

/* Two points in a box of 4 x 2 x 2, of which x is periodic: two faces between them. */
static void test_volume(const vorocl_device* device) {
  const vorocl_grid box = vorocl_grid_of_voxels(4, 2, 2, VOROCL_PERIODIC_X);
  const vorocl_point two[2] = {{1, 1, 1}, {3, 1, 1}};
  const double weights[2] = {1, 0.25};
  vorocl_seeds* seeds = NULL;
  vorocl_exact_cells* all = NULL;
  vorocl_exact_cell cells[2];
  vorocl_exact_face faces[2];
  vorocl_exact_polyhedra* polyhedra = NULL;
  vorocl_polyhedra_arrays arrays;
  size_t count = 7, edges = 7;
  OK(vorocl_seeds_from_points(device, box, two, NULL, 2, VOROCL_OUTSIDE_IS_REFUSED, VOROCL_SNAP_NONE,
                              &seeds));
  OK(vorocl_exact_cells_create(&all));
  OK(vorocl_exact_cells_read_faces(all, NULL, 0, &count));
  CHECK(count == 0);
  OK(vorocl_exact_cells_cut(all, seeds));
  OK(vorocl_exact_cells_read(all, cells, 2));
  CHECK(cells[0].area == 8 && cells[0].perimeter == 24 && cells[0].neighbours == 2 &&
        cells[0].certified == 1);
  CHECK(cells[1].centroid.x == 3 && cells[1].centroid.y == 1 && cells[1].centroid.z == 1);
  OK(vorocl_exact_cells_edges(all, &edges));
  CHECK(edges == 12);
  OK(vorocl_exact_cells_read_faces(all, faces, 1, &count));
  CHECK(count == 2 && faces[0].a == 0 && faces[0].b == 1 && faces[0].area == 4 && faces[0].image[0] == -1);
  OK(vorocl_exact_cells_read_faces(all, faces, 2, &count));
  CHECK(faces[1].image[0] == 0 && faces[1].image[1] == 0 && faces[1].image[2] == 0);
  FAILS(vorocl_exact_cells_read_polygons(all, NULL, 2, NULL, NULL, NULL, 12), VOROCL_BAD_ARGUMENT,
        "those of a volume");
  FAILS(vorocl_exact_cells_read_faces(all, NULL, 1, &count), VOROCL_NULL_ARGUMENT, "faces is NULL");
  FAILS(vorocl_exact_cells_polyhedra(all, NULL), VOROCL_NULL_ARGUMENT, "polyhedra is NULL");
  FAILS(vorocl_exact_polyhedra_arrays(NULL, &arrays), VOROCL_NULL_ARGUMENT, "polyhedra is NULL");
  OK(vorocl_exact_cells_polyhedra(all, &polyhedra));
  OK(vorocl_exact_polyhedra_arrays(polyhedra, &arrays));
  CHECK(arrays.cells == 2 && arrays.faces == 12 && arrays.corners == 48 && arrays.vertices == 16);
  CHECK(arrays.offsets[1] == 6 && arrays.vertex_offsets[2] == 16 && arrays.corner_offsets[12] == 48);
  for (size_t i = 0; i < arrays.corners; ++i) {
    const vorocl_point at = arrays.points[arrays.corner_vertices[i]];
    CHECK(fmod(at.x, 2) == 0 && (at.y == 0 || at.y == 2) && (at.z == 0 || at.z == 2));
  }
  vorocl_exact_polyhedra_free(polyhedra);
  vorocl_exact_polyhedra_free(NULL);
  /* With weights their bisectors are (4 + 1 - 1 / 4) / 4 from the first one. */
  OK(vorocl_seeds_move_to_weighted_points(seeds, NULL, two, weights, NULL, 2));
  OK(vorocl_exact_cells_cut(all, seeds));
  OK(vorocl_exact_cells_read(all, cells, 2));
  CHECK(cells[0].area == 9.5 && cells[1].area == 6.5);
  FAILS(vorocl_seeds_move_to(seeds, two, NULL, 2), VOROCL_BAD_ARGUMENT, "weight");
  FAILS(vorocl_seeds_move_to_weighted_points(seeds, &box, two, NULL, NULL, 2), VOROCL_NULL_ARGUMENT,
        "weights is NULL");
  vorocl_exact_cells_free(all);
  vorocl_seeds_free(seeds);
}

static void test_failures(const vorocl_device* device, const vorocl_seeds* seeds) {
  vorocl_exact_cells* all = NULL;
  vorocl_exact_cell cells[seed_count];
  vorocl_seeds* of_flat = NULL;
  size_t count = 7, edges = 0;
  vorocl_grid flat = grid;
  flat.y.from = flat.y.to = 3;
  FAILS(vorocl_exact_cells_create(NULL), VOROCL_NULL_ARGUMENT, "cells is NULL");
  OK(vorocl_exact_cells_create(&all));
  FAILS(vorocl_exact_cells_cut(all, NULL), VOROCL_NULL_ARGUMENT, "seeds is NULL");
  FAILS(vorocl_exact_cells_cut(NULL, seeds), VOROCL_NULL_ARGUMENT, "cells is NULL");
  FAILS(vorocl_exact_cells_count(all, NULL), VOROCL_NULL_ARGUMENT, "count is NULL");
  FAILS(vorocl_exact_cells_edges(NULL, &edges), VOROCL_NULL_ARGUMENT, "cells is NULL");
  FAILS(vorocl_exact_cells_buffers(NULL, NULL, NULL, NULL, NULL, NULL), VOROCL_NULL_ARGUMENT,
        "cells is NULL");
  FAILS(vorocl_exact_cells_polygon_buffers(NULL, NULL, NULL, NULL, NULL), VOROCL_NULL_ARGUMENT,
        "cells is NULL");
  OK(vorocl_exact_cells_cut(all, seeds));
  FAILS(vorocl_exact_cells_read(all, cells, 7), VOROCL_BAD_ARGUMENT, "8 cells");
  FAILS(vorocl_exact_cells_read(all, NULL, seed_count), VOROCL_NULL_ARGUMENT, "cells is NULL");
  FAILS(vorocl_exact_cells_read_polygons(all, NULL, seed_count, NULL, NULL, NULL, 1), VOROCL_BAD_ARGUMENT,
        "edges");
  FAILS(vorocl_exact_cells_read_faces(all, NULL, 0, &count), VOROCL_BAD_ARGUMENT, "those of a plane");
  OK(vorocl_seeds_from_points(device, flat, points, NULL, 1, VOROCL_OUTSIDE_COUNTS, VOROCL_SNAP_TO_PIXELS,
                              &of_flat));
  FAILS(vorocl_exact_cells_cut(all, of_flat), VOROCL_BAD_ARGUMENT, "extent");
  OK(vorocl_exact_cells_count(all, &count));
  CHECK(count == 0);
  vorocl_seeds_free(of_flat);
  vorocl_exact_cells_free(all);
  vorocl_exact_cells_free(NULL);
}

int main(void) {
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  OK(vorocl_device_select(NULL, &device));
  if (device == NULL) return EXIT_FAILURE;
  seeds = make_seeds(device);
  test_cells(device, seeds);
  test_volume(device);
  test_tilted_volume(device);
  test_failures(device, seeds);
  vorocl_seeds_free(seeds);
  vorocl_device_free(device);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
