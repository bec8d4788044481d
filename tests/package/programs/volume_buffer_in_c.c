/* A volume of points that lie in a buffer of the device, in the units of the data. */
#include <stdio.h>
#include <vorocl/vorocl.h>

static int failed(vorocl_status status) {
  if (status != VOROCL_SUCCESS) fprintf(stderr, "%s\n", vorocl_error_message());
  return status != VOROCL_SUCCESS;
}

int main(void) {
  const vorocl_grid box = {.x = {32, 0, 2}, .y = {16, 0, 1}, .z = {64, 0, 4}};
  double values[] = {1, 0.5, 0.97, 1, 0.5, 3.03}; /* x, y, z */
  uint32_t voxels[2];
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* sums = NULL;
  cl_context context;
  if (failed(vorocl_device_select(NULL, &device)) || failed(vorocl_device_context(device, &context)))
    return 1;
  cl_mem points = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof values, values, NULL);
  if (failed(vorocl_seeds_from_buffer(device, box, points, VOROCL_DOUBLES_XYZ, NULL, 2, VOROCL_OUTSIDE_COUNTS,
                                      VOROCL_SNAP_NONE, &seeds)) ||
      failed(vorocl_diagram_create(device, vorocl_window_of_grid(box), &diagram)) ||
      failed(vorocl_run("exact", seeds, diagram, NULL)) || failed(vorocl_cell_sums_create(&sums)) ||
      failed(vorocl_cell_sums_measure(sums, diagram)) ||
      failed(vorocl_cell_sums_read(sums, voxels, NULL, NULL, NULL, 2)))
    return 1;
  printf("%u voxels and %u\n", voxels[0], voxels[1]);
  vorocl_cell_sums_free(sums);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseMemObject(points);
  vorocl_device_free(device);
  return 0;
}
