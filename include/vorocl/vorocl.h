/// @file
/// VoroCL for C, and for whatever calls C: what the C++ headers of the same names do, with status codes.
///
/// Covers devices, seeds and their random motion, diagrams, all methods, similarity, and the measures of
/// cells (sums, shapes, statistics, adjacency). Distance fields, distance errors, plans of waves,
/// simulations, Lloyd relaxation and pictures are for C++ alone.
///
/// Every function that can fail returns a status; vorocl_error_message() then says what was wrong and what to
/// do. What a function finds is stored through its last arguments, and only if it succeeds. One that makes an
/// object stores NULL if it fails; who made an object frees it, in any order: each keeps what it needs. To
/// free NULL does nothing. OpenCL objects that a function takes are retained as long as they are needed;
/// those that it gives are not: they belong to the object that was asked, and are valid as long as it is.
///
/// Threads, and the order of the device's work, are as the C++ class of an object says: several threads may
/// use a device at once, each with seeds, diagrams and results of its own.
#ifndef VOROCL_VOROCL_H
#define VOROCL_VOROCL_H

// OpenCL's headers print a note unless they are told a version. See vorocl/opencl.hpp, which agrees.
#ifndef CL_TARGET_OPENCL_VERSION
#ifdef CL_HPP_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION CL_HPP_TARGET_OPENCL_VERSION
#else
#define CL_TARGET_OPENCL_VERSION 300
#endif
#endif

#include <CL/cl.h>
#include <stddef.h>
#include <stdint.h>

#include "vorocl/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/// @name Errors: see vorocl::ErrorKind
/// @{

/// What a function returns.
typedef enum vorocl_status {
  VOROCL_SUCCESS = 0,
  VOROCL_BAD_ARGUMENT = 1,   ///< an argument is out of its range, or two do not fit together
  VOROCL_NULL_ARGUMENT = 2,  ///< a pointer that must not be NULL is
  VOROCL_OUT_OF_HOST_MEMORY = 3,
  VOROCL_BAD_POINT = 4,  ///< a seed's point is NaN, infinite or too far away: see vorocl_bad_point()
  VOROCL_OUT_OF_DEVICE_MEMORY = 5,
  VOROCL_DEVICE_ERROR = 6,        ///< there is no such device, or OpenCL, its driver or the system failed
  VOROCL_KERNEL_BUILD_ERROR = 7,  ///< a kernel could not be built; the message holds the compiler's log
  VOROCL_FILE_ERROR = 8           ///< a file cannot be read or written, or its contents are bad
} vorocl_status;

/// What was wrong in the calling thread's last call that failed; valid until its next one that fails. Never
/// NULL.
VOROCL_API const char* vorocl_error_message(void);

/// A position in pixel units: pixel i of an axis covers [i, i + 1), y points down.
typedef struct vorocl_point {
  double x;
  double y;
} vorocl_point;

/// The point of the calling thread's last call that failed with VOROCL_BAD_POINT, and its index in the
/// caller's list. Either may be NULL. VOROCL_BAD_ARGUMENT if there was no such call.
VOROCL_API vorocl_status vorocl_bad_point(size_t* index, vorocl_point* point);

/// @}

/// The version of the library that runs, such as "0.1.0".
VOROCL_API const char* vorocl_version(void);

/// The label of a pixel without a nearest seed.
#define VOROCL_NO_LABEL UINT32_C(0xffffffff)

// Choices are ints, so that a wrong one is an error rather than undefined behaviour.

/// One of VOROCL_EUCLIDEAN, VOROCL_MANHATTAN.
typedef int vorocl_metric;
enum { VOROCL_EUCLIDEAN = 0, VOROCL_MANHATTAN = 1 };

/// One of VOROCL_MOORE, VOROCL_VON_NEUMANN; for dynamic jump flooding alone, VOROCL_MIXED; and
/// VOROCL_DEFAULT_NEIGHBOURHOOD, which is mixed for dynamic jump flooding and Moore for the other methods.
typedef int vorocl_neighbourhood;
enum { VOROCL_MOORE = 0, VOROCL_VON_NEUMANN = 1, VOROCL_MIXED = 2, VOROCL_DEFAULT_NEIGHBOURHOOD = 3 };

/// One of VOROCL_JFA, VOROCL_JFA_PLUS_1, VOROCL_JFA_PLUS_2, VOROCL_ONE_PLUS_JFA.
typedef int vorocl_variant;
enum { VOROCL_JFA = 0, VOROCL_JFA_PLUS_1 = 1, VOROCL_JFA_PLUS_2 = 2, VOROCL_ONE_PLUS_JFA = 3 };

/// Where the waves of dynamic jump flooding get their reach from: see vorocl::Reach. One of
/// VOROCL_REACH_MEASURED, VOROCL_REACH_PAPER.
typedef int vorocl_reach;
enum { VOROCL_REACH_MEASURED = 0, VOROCL_REACH_PAPER = 1 };

/// Which axes of a grid are periodic: see vorocl::Periodic. One of VOROCL_PERIODIC_NONE, VOROCL_PERIODIC_X,
/// VOROCL_PERIODIC_Y, VOROCL_PERIODIC_XY.
typedef int vorocl_periodic;
enum { VOROCL_PERIODIC_NONE = 0, VOROCL_PERIODIC_X = 1, VOROCL_PERIODIC_Y = 2, VOROCL_PERIODIC_XY = 3 };

/// As vorocl::Grid. (vorocl_grid){640, 480, VOROCL_PERIODIC_NONE} is a grid of 640 x 480 pixels.
typedef struct vorocl_grid {
  int64_t width, height;  ///< pixels
  vorocl_periodic periodic;
} vorocl_grid;

/// As vorocl::Domain: the rectangle in which the plane repeats along its periodic axes, in pixels from the
/// grid's first one.
typedef struct vorocl_domain {
  int64_t x, y;           ///< the first pixel, which may be outside the grid
  int64_t width, height;  ///< the periods, 1 to 2^31
  vorocl_periodic periodic;
} vorocl_domain;

/// What happens at the border of an axis that is not periodic: see vorocl::Border. One of VOROCL_REFLECT,
/// VOROCL_PERIODIC.
typedef int vorocl_border;
enum { VOROCL_REFLECT = 0, VOROCL_PERIODIC = 1 };

/// @name Devices: see vorocl::Device
/// @{

typedef struct vorocl_device vorocl_device;

/// `request`: a part of a platform's or device's name, "platform:device" indices, or NULL for the library's
/// choice. VOROCL_DEVICE_ERROR, with a list of what there is, if nothing matches.
VOROCL_API vorocl_status vorocl_device_select(const char* request, vorocl_device** device);

/// The caller's context and in-order queue.
VOROCL_API vorocl_status vorocl_device_adopt(cl_context context, cl_command_queue queue,
                                             vorocl_device** device);

VOROCL_API void vorocl_device_free(vorocl_device* device);

VOROCL_API vorocl_status vorocl_device_name(const vorocl_device* device, const char** name);
VOROCL_API vorocl_status vorocl_device_platform_name(const vorocl_device* device, const char** name);
VOROCL_API vorocl_status vorocl_device_driver_version(const vorocl_device* device, const char** version);

VOROCL_API vorocl_status vorocl_device_context(const vorocl_device* device, cl_context* context);
VOROCL_API vorocl_status vorocl_device_queue(const vorocl_device* device, cl_command_queue* queue);
VOROCL_API vorocl_status vorocl_device_id(const vorocl_device* device, cl_device_id* id);

/// Lets all that is enqueued from now on wait for `count` events of other queues of the context.
VOROCL_API vorocl_status vorocl_device_wait_for(const vorocl_device* device, size_t count,
                                                const cl_event* events);

/// Waits until all that was enqueued is done.
VOROCL_API vorocl_status vorocl_device_finish(const vorocl_device* device);

/// One of VOROCL_VECTOR, VOROCL_GROUP.
typedef int vorocl_shape;
enum { VOROCL_VECTOR = 0, VOROCL_GROUP = 1 };

/// As vorocl::Tuning: how kernels are shaped. Results never depend on it, only speed does.
typedef struct vorocl_tuning {
  int vector_width;     ///< pixels of a row that one work-item computes: 1, 2, 4, 8 or 16
  size_t group_width;   ///< work-items of a work-group along a row ...
  size_t group_height;  ///< ... and across rows
  vorocl_shape shape;   ///< of exact diagrams
  size_t patch_items;   ///< fewest work-items of a work-group of VOROCL_GROUP: 32, 64, 128 or 256
} vorocl_tuning;

/// To begin with, the default of the device's class.
VOROCL_API vorocl_status vorocl_device_tuning(const vorocl_device* device, vorocl_tuning* tuning);

/// The same device, queue and built kernels with another tuning.
VOROCL_API vorocl_status vorocl_device_with_tuning(const vorocl_device* device, const vorocl_tuning* tuning,
                                                   vorocl_device** tuned);

/// The devices of this machine: see vorocl::Device::list().
typedef struct vorocl_device_list vorocl_device_list;

/// As vorocl::DeviceDescription. The texts belong to the list.
typedef struct vorocl_device_description {
  size_t platform_index;
  size_t device_index;  ///< within its platform; "platform:device" selects it
  const char* platform;
  const char* name;
  const char* type;  ///< "GPU", "CPU" or "accelerator"
  const char* opencl_version;
  const char* driver_version;
  unsigned compute_units;
  uint64_t global_memory;   ///< bytes
  uint64_t max_allocation;  ///< bytes, the largest single buffer
  const char* why_not;      ///< why VoroCL cannot use it; "" if it can
  int selected;             ///< 1 if vorocl_device_select() would take it, else 0 ...
  const char* reason;       ///< ... and why it would
} vorocl_device_description;

/// All devices of all platforms, with the one marked that vorocl_device_select() would take for the request.
/// Without a platform, an empty list.
VOROCL_API vorocl_status vorocl_device_list_create(const char* request, vorocl_device_list** list);

VOROCL_API void vorocl_device_list_free(vorocl_device_list* list);
VOROCL_API vorocl_status vorocl_device_list_count(const vorocl_device_list* list, size_t* count);
VOROCL_API vorocl_status vorocl_device_list_get(const vorocl_device_list* list, size_t index,
                                                vorocl_device_description* description);

/// @}
/// @name Seeds: see vorocl::Seeds
/// A seed's id is its index in the caller's list. Wherever points are given, `present` says which seeds there
/// are: one byte per seed, 0 for a seed that is absent, whose point is not looked at. NULL says that all are
/// there. Points in a caller's buffer are pairs (x, y) of float; buffers are read and checked when the device
/// comes to it, so that VOROCL_BAD_POINT comes from the first call that waits for what was made of them.
/// @{

typedef struct vorocl_seeds vorocl_seeds;

/// On a grid. Points outside it are seeds too: see vorocl::Seeds.
VOROCL_API vorocl_status vorocl_seeds_from_points(const vorocl_device* device, vorocl_grid grid,
                                                  const vorocl_point* points, const uint8_t* present,
                                                  size_t count, vorocl_seeds** seeds);

/// As above, in a plane that repeats: the grid itself must not be periodic.
VOROCL_API vorocl_status vorocl_seeds_in_domain(const vorocl_device* device, vorocl_grid grid,
                                                vorocl_domain domain, const vorocl_point* points,
                                                const uint8_t* present, size_t count, vorocl_seeds** seeds);

/// From the caller's buffers, whose points must lie in the grid.
VOROCL_API vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, vorocl_grid grid,
                                                  cl_mem points, cl_mem present, size_t count,
                                                  vorocl_seeds** seeds);

/// A seed for each pixel of the mask that is not 0, row-major: `count` must be width * height.
VOROCL_API vorocl_status vorocl_seeds_from_mask(const vorocl_device* device, vorocl_grid grid,
                                                const uint8_t* mask, size_t count, vorocl_seeds** seeds);

/// Uniformly random pixels, the same on every device.
VOROCL_API vorocl_status vorocl_seeds_random(const vorocl_device* device, vorocl_grid grid, size_t count,
                                             uint64_t rng_seed, vorocl_seeds** seeds);

/// The same seeds once more, to be moved on their own.
VOROCL_API vorocl_status vorocl_seeds_clone(const vorocl_seeds* seeds, vorocl_seeds** clone);

VOROCL_API void vorocl_seeds_free(vorocl_seeds* seeds);

VOROCL_API vorocl_status vorocl_seeds_grid(const vorocl_seeds* seeds, vorocl_grid* grid);

/// The number of ids, those of absent seeds too.
VOROCL_API vorocl_status vorocl_seeds_count(const vorocl_seeds* seeds, size_t* count);

/// The seeds that are not absent. Waits where a buffer said which are present.
VOROCL_API vorocl_status vorocl_seeds_alive(const vorocl_seeds* seeds, size_t* alive);

/// The seeds that lie outside the grid's pixels.
VOROCL_API vorocl_status vorocl_seeds_outside(const vorocl_seeds* seeds, size_t* outside);

/// New points for the same ids. Their number may change: ids past the end are absent.
VOROCL_API vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points,
                                              const uint8_t* present, size_t count);

/// As above, in a plane that repeats. The domain may be another one in each frame.
VOROCL_API vorocl_status vorocl_seeds_move_in_domain(vorocl_seeds* seeds, vorocl_domain domain,
                                                     const vorocl_point* points, const uint8_t* present,
                                                     size_t count);

/// From the caller's buffers, whose points must lie in the grid.
VOROCL_API vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points, cl_mem present,
                                                     size_t count);

/// Moves each seed by up to `max_displacement` pixels along each axis at random: see vorocl::random_step().
VOROCL_API vorocl_status vorocl_random_step(vorocl_seeds* seeds, int max_displacement, vorocl_border border,
                                            uint64_t rng_seed, uint32_t frame);

/// One uint32_t per seed and one more: see vorocl::Seeds::positions(). Valid until the seeds are moved.
VOROCL_API vorocl_status vorocl_seeds_positions(const vorocl_seeds* seeds, cl_mem* positions);

/// The centres of the seeds' pixels, (NaN, NaN) for a seed that is absent: `count` must be that of the seeds.
/// Waits.
VOROCL_API vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count);

/// Waits until the points of a caller's buffer are checked.
VOROCL_API vorocl_status vorocl_seeds_check(const vorocl_seeds* seeds);

/// @}
/// @name Diagrams: see vorocl::Diagram
/// @{

typedef struct vorocl_diagram vorocl_diagram;

VOROCL_API vorocl_status vorocl_diagram_create(const vorocl_device* device, vorocl_grid grid,
                                               vorocl_diagram** diagram);

/// The labels go to the caller's buffer of width * height uint32_t.
VOROCL_API vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, vorocl_grid grid,
                                                    cl_mem labels, vorocl_diagram** diagram);

VOROCL_API void vorocl_diagram_free(vorocl_diagram* diagram);

VOROCL_API vorocl_status vorocl_diagram_grid(const vorocl_diagram* diagram, vorocl_grid* grid);

/// The labels, row-major uint32_t, for use in OpenCL without a copy.
VOROCL_API vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels);

/// Writes labels of the caller's, row-major: `count` must be width * height. A method that goes on from the
/// last labels goes on from these. Waits until they are copied.
VOROCL_API vorocl_status vorocl_diagram_write(vorocl_diagram* diagram, const uint32_t* labels, size_t count);

/// As above, from a buffer of the same context. Enqueues and returns.
VOROCL_API vorocl_status vorocl_diagram_write_buffer(vorocl_diagram* diagram, cl_mem labels);

/// Completes with the labels of the last method that was to fill the diagram, and is valid until the next one
/// is called. NULL before the first, after one that failed, and after labels were written or that failed.
VOROCL_API vorocl_status vorocl_diagram_event(const vorocl_diagram* diagram, cl_event* event);

/// The last method's waves, the device's time (0 if the queue does not profile; waits) and the host's: 0
/// where vorocl_diagram_event() gives NULL. Each may be NULL.
VOROCL_API vorocl_status vorocl_diagram_report(const vorocl_diagram* diagram, int* waves,
                                               double* milliseconds, double* host_milliseconds);

/// Copies the labels to the host: `count` must be width * height. Waits.
VOROCL_API vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count);

/// Waits for the queue.
VOROCL_API vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram);

/// 100 x pixels with equal labels / all pixels, of two diagrams of one size and device. Waits.
VOROCL_API vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent);

/// The pixels whose labels differ, of two diagrams of one size and device. Waits.
VOROCL_API vorocl_status vorocl_changed_pixels(const vorocl_diagram* a, const vorocl_diagram* b,
                                               size_t* pixels);

/// The pixel corners where three or more cells meet: see vorocl::count_vertices(). Waits.
VOROCL_API vorocl_status vorocl_count_vertices(const vorocl_diagram* diagram, size_t* vertices);

/// @}
/// @name Methods: seeds in, diagram out
/// They enqueue and return; standard flooding waits. A diagram whose filling failed counts as never filled:
/// see vorocl::Diagram.
/// @{

/// See vorocl::standard_flooding().
VOROCL_API vorocl_status vorocl_standard_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                                  vorocl_metric metric, vorocl_neighbourhood neighbourhood);

/// See vorocl::jump_flooding().
VOROCL_API vorocl_status vorocl_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                              vorocl_metric metric, vorocl_neighbourhood neighbourhood,
                                              vorocl_variant variant);

/// See vorocl::exact_diagram().
VOROCL_API vorocl_status vorocl_exact_diagram(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                              vorocl_metric metric);

/// As vorocl::MethodOptions: the options of all methods. A method ignores those that it has no use for; mixed
/// neighbourhoods are refused but for dynamic jump flooding.
typedef struct vorocl_method_options {
  vorocl_metric metric;
  vorocl_neighbourhood neighbourhood;
  int von_neumann_waves;  ///< of dynamic jump flooding: see vorocl::DynamicPlanOptions
  int extra_waves;        ///< likewise
  int refresh_interval;   ///< likewise: see vorocl::DynamicJumpFloodingOptions
  vorocl_reach reach;     ///< likewise: see vorocl::dynamic_jump_flooding()
} vorocl_method_options;

/// Initialises options; to give NULL for them means the same.
#define VOROCL_METHOD_OPTIONS_DEFAULTS \
  { VOROCL_EUCLIDEAN, VOROCL_DEFAULT_NEIGHBOURHOOD, 2, 0, 0, VOROCL_REACH_MEASURED }

/// See vorocl::dynamic_jump_flooding(). No seed may have moved by more than `max_displacement` pixels along
/// an axis since the diagram was last filled.
VOROCL_API vorocl_status vorocl_dynamic_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                                      double max_displacement,
                                                      const vorocl_method_options* options);

/// As vorocl::Method.
typedef struct vorocl_method_description {
  const char* name;  ///< such as "jfa+1"; it belongs to the library
  int exact;         ///< 1 if every pixel gets its nearest seed, else 0
  int continues;     ///< 1 if it goes on from the labels that the diagram holds, else 0
  int outer_seeds;   ///< 1 if it takes seeds outside the grid and domains, else 0: then it refuses them
} vorocl_method_description;

/// How many methods there are.
VOROCL_API vorocl_status vorocl_method_count(size_t* count);

VOROCL_API vorocl_status vorocl_method_get(size_t index, vorocl_method_description* description);

/// Fills the diagram by the method of this name. Only a method that continues looks at `max_displacement`:
/// see vorocl_dynamic_jump_flooding().
VOROCL_API vorocl_status vorocl_run(const char* method, const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                    double max_displacement, const vorocl_method_options* options);

/// Builds all kernels that the method needs for so many seeds on a grid, so that the first diagram takes no
/// longer than the next: see vorocl::prepare(). Waits.
VOROCL_API vorocl_status vorocl_prepare(const char* method, const vorocl_device* device, vorocl_grid grid,
                                        size_t seeds, const vorocl_method_options* options);

/// @}
/// @name Sums of cells: see vorocl::cell_sums()
/// @{

/// What was measured, on the device: one entry per seed, by id. To be used frame after frame: it allocates
/// nothing unless there are more seeds. Empty before it is measured and after that failed. As
/// vorocl::CellSumsResult.
typedef struct vorocl_cell_sums vorocl_cell_sums;

VOROCL_API vorocl_status vorocl_cell_sums_create(vorocl_cell_sums** sums);
VOROCL_API void vorocl_cell_sums_free(vorocl_cell_sums* sums);

/// Enqueues and returns.
VOROCL_API vorocl_status vorocl_cell_sums_measure(vorocl_cell_sums* sums, const vorocl_seeds* seeds,
                                                  const vorocl_diagram* diagram);

/// The cells that were measured, one per seed; 0 if it is empty.
VOROCL_API vorocl_status vorocl_cell_sums_count(const vorocl_cell_sums* sums, size_t* count);

/// Per cell its area in pixels (uint32_t) and the sums of its pixels' columns and rows (uint64_t). Each may
/// be NULL. The buffers are valid until the next measurement.
VOROCL_API vorocl_status vorocl_cell_sums_buffers(const vorocl_cell_sums* sums, cl_mem* area, cl_mem* sum_x,
                                                  cl_mem* sum_y);

/// The same on the host, each into room for `count` cells, which must be all; each may be NULL. Waits.
VOROCL_API vorocl_status vorocl_cell_sums_read(const vorocl_cell_sums* sums, uint32_t* area, int64_t* sum_x,
                                               int64_t* sum_y, size_t count);

/// The means of the centres of the cells' pixels, (NaN, NaN) of an empty cell. Waits.
VOROCL_API vorocl_status vorocl_cell_sums_centroids(const vorocl_cell_sums* sums, vorocl_point* centroids,
                                                    size_t count);

/// As vorocl::CellStatistics. Absent seeds do not count.
typedef struct vorocl_cell_statistics {
  size_t cells;           ///< seeds; of those outside the grid the ones that own pixels
  size_t empty_cells;     ///< seeds without a pixel: another seed is on theirs
  uint64_t pixels;        ///< with a label
  double mean_area;       ///< 0 if there are no cells
  double area_deviation;  ///< the standard deviation (of all cells, not of a sample)
} vorocl_cell_statistics;

/// The number of cells and the spread of their areas. Waits.
VOROCL_API vorocl_status vorocl_cell_sums_statistics(vorocl_cell_sums* sums,
                                                     vorocl_cell_statistics* statistics);

/// @}
/// @name Shapes of cells: see vorocl::cell_shapes()
/// @{

/// As vorocl_cell_sums.
typedef struct vorocl_cell_shapes vorocl_cell_shapes;

VOROCL_API vorocl_status vorocl_cell_shapes_create(vorocl_cell_shapes** shapes);
VOROCL_API void vorocl_cell_shapes_free(vorocl_cell_shapes* shapes);

/// Enqueues and returns.
VOROCL_API vorocl_status vorocl_cell_shapes_measure(vorocl_cell_shapes* shapes, const vorocl_seeds* seeds,
                                                    const vorocl_diagram* diagram, vorocl_metric metric);

VOROCL_API vorocl_status vorocl_cell_shapes_count(const vorocl_cell_shapes* shapes, size_t* count);

/// Per cell int32_t left, top, right, bottom, and its largest distance (int32_t). Either may be NULL. The
/// buffers are valid until the next measurement. Where a seed lies so far outside the grid that distances may
/// not fit, the second one is NULL: vorocl_cell_shapes_read() tells them.
VOROCL_API vorocl_status vorocl_cell_shapes_buffers(const vorocl_cell_shapes* shapes, cl_mem* boxes,
                                                    cl_mem* largest_distances);

/// As vorocl::CellShape. An empty cell has right < left, bottom < top and largest_distance -1.
typedef struct vorocl_cell_shape {
  int left, top, right, bottom;  ///< the bounding box: first and last columns and rows
  int64_t largest_distance;      ///< of its pixels to its seed; squared if Euclidean
  int touches_border;            ///< 1 if it has a pixel in the first or last row or column, else 0
} vorocl_cell_shape;

/// The shapes of all cells: `count` must be their number. Waits.
VOROCL_API vorocl_status vorocl_cell_shapes_read(const vorocl_cell_shapes* shapes, vorocl_cell_shape* cells,
                                                 size_t count);

/// @}
/// @name Cells that touch: see vorocl::adjacency()
/// @{

/// What was found, on the device; to be used frame after frame. As vorocl::AdjacencyResult.
typedef struct vorocl_adjacency vorocl_adjacency;

VOROCL_API vorocl_status vorocl_adjacency_create(vorocl_adjacency** adjacency);
VOROCL_API void vorocl_adjacency_free(vorocl_adjacency* adjacency);

/// Waits.
VOROCL_API vorocl_status vorocl_adjacency_find(vorocl_adjacency* adjacency, const vorocl_seeds* seeds,
                                               const vorocl_diagram* diagram);

/// How many pairs of cells share a pixel edge.
VOROCL_API vorocl_status vorocl_adjacency_pairs(const vorocl_adjacency* adjacency, size_t* pairs);

/// uint32_t a, b, length per pair, and per cell the cells that it shares an edge with and the pixel edges
/// that it shares with them (uint32_t each). Each may be NULL. The buffers are valid until the next search.
VOROCL_API vorocl_status vorocl_adjacency_buffers(const vorocl_adjacency* adjacency, cl_mem* pair_list,
                                                  cl_mem* neighbours, cl_mem* perimeters);

/// As vorocl::CellPair.
typedef struct vorocl_cell_pair {
  uint32_t a, b;    ///< the ids of two cells, a < b
  uint32_t length;  ///< the pixel edges they share
} vorocl_cell_pair;

/// All pairs, sorted by a and then b: `count` must be their number. Waits.
VOROCL_API vorocl_status vorocl_adjacency_read_pairs(const vorocl_adjacency* adjacency,
                                                     vorocl_cell_pair* pairs, size_t count);

/// Per cell, by id: `count` must be that of the seeds. Either may be NULL. Waits.
VOROCL_API vorocl_status vorocl_adjacency_read_cells(const vorocl_adjacency* adjacency, uint32_t* neighbours,
                                                     uint32_t* perimeters, size_t count);

/// @}

#ifdef __cplusplus
}
#endif

#endif
