/* A simulation on the device: points drift in a periodic box, and a kernel reads the areas of their cells.
   Until the end nothing comes to the host. */
#include <stdio.h>
#include <stdlib.h>
#include <vorocl/vorocl.h>

enum { count = 100, frames = 50, side = 64 };

static const char* const source =
    "kernel void drift(global double2* points, double2 way) { points[get_global_id(0)] += way; }\n"
    "kernel void add_areas(global const uint* areas, global uint* sums) {\n"
    "  sums[get_global_id(0)] += areas[get_global_id(0)];\n"
    "}\n";

static void must(int good) {
  if (good) return;
  fprintf(stderr, "%s\n", vorocl_error_message());
  exit(1);
}

int main(void) {
  const vorocl_axis axis = {side, 0, 10, 1, 0, 0, 1};
  const vorocl_grid box = {.x = axis, .y = axis};
  const cl_double2 way = {{0.37, -0.21}};
  const size_t all = count;
  static double values[2 * count];
  static cl_uint zeros[count], sums[count];
  vorocl_device* device = NULL;
  vorocl_seeds* seeds = NULL;
  vorocl_diagram* diagram = NULL;
  vorocl_cell_sums* cells = NULL;
  cl_context context;
  cl_command_queue queue;
  cl_device_id id;
  unsigned long sum = 0;
  for (int i = 0; i < 2 * count; ++i) values[i] = i * 617 % 1009 / 100.9;
  must(vorocl_device_select(NULL, &device) == VOROCL_SUCCESS &&
       vorocl_device_context(device, &context) == VOROCL_SUCCESS &&
       vorocl_device_queue(device, &queue) == VOROCL_SUCCESS &&
       vorocl_device_id(device, &id) == VOROCL_SUCCESS);
  cl_mem points = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof values, values, NULL);
  cl_mem added = clCreateBuffer(context, CL_MEM_COPY_HOST_PTR, sizeof zeros, zeros, NULL);
  cl_program program = clCreateProgramWithSource(context, 1, (const char**)&source, NULL, NULL);
  must(clBuildProgram(program, 1, &id, "-cl-std=CL1.2", NULL, NULL) == CL_SUCCESS);
  cl_kernel drift = clCreateKernel(program, "drift", NULL), add = clCreateKernel(program, "add_areas", NULL);
  clSetKernelArg(drift, 0, sizeof points, &points);
  clSetKernelArg(drift, 1, sizeof way, &way);
  clSetKernelArg(add, 1, sizeof added, &added);

  must(vorocl_seeds_from_buffer(device, box, points, VOROCL_DOUBLES_XY, NULL, count, VOROCL_OUTSIDE_COUNTS,
                                VOROCL_SNAP_NONE, &seeds) == VOROCL_SUCCESS &&
       vorocl_diagram_create(device, vorocl_window_of_grid(box), &diagram) == VOROCL_SUCCESS &&
       vorocl_cell_sums_create(&cells) == VOROCL_SUCCESS);
  for (int frame = 0; frame < frames; ++frame) {
    cl_mem areas;
    clEnqueueNDRangeKernel(queue, drift, 1, NULL, &all, NULL, 0, NULL, NULL);
    must(vorocl_seeds_move_to_buffer(seeds, points, VOROCL_DOUBLES_XY, NULL, count) == VOROCL_SUCCESS &&
         vorocl_run("exact", seeds, diagram, NULL) == VOROCL_SUCCESS &&
         vorocl_cell_sums_measure(cells, diagram) == VOROCL_SUCCESS &&
         vorocl_cell_sums_buffers(cells, &areas, NULL, NULL, NULL) == VOROCL_SUCCESS);
    clSetKernelArg(add, 0, sizeof areas, &areas);
    clEnqueueNDRangeKernel(queue, add, 1, NULL, &all, NULL, 0, NULL, NULL);
  }
  clEnqueueReadBuffer(queue, added, CL_TRUE, 0, sizeof sums, sums, 0, NULL, NULL);
  for (int i = 0; i < count; ++i) sum += sums[i];
  printf("areas of %d frames: %lu pixels\n", frames, sum);
  vorocl_cell_sums_free(cells);
  vorocl_diagram_free(diagram);
  vorocl_seeds_free(seeds);
  clReleaseKernel(drift);
  clReleaseKernel(add);
  clReleaseProgram(program);
  clReleaseMemObject(points);
  clReleaseMemObject(added);
  vorocl_device_free(device);
  return 0;
}
