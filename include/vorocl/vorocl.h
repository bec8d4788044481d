/// @file
/// VoroCL for C, and for whatever calls C: what the C++ headers of the same names do, with status codes.
///
/// Covers devices, seeds and their motion, diagrams of windows and of volumes, all methods and measures,
/// Lloyd relaxation, and distance transforms of images. C has no plans of waves, simulations, planes in tiles
/// or pictures.
///
/// A grid with a third axis is a volume, whose pixels are voxels; vorocl::Grid says what takes one. All else
/// is VOROCL_BAD_ARGUMENT there. What is "row-major" is so slice after slice.
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

/// A position: in the units of the data where it is a seed's point, in pixels where a function says so. Pixel
/// i of an axis covers [i, i + 1): z is 0 of points of a plane, as an initialiser leaves it, and 0.5 in
/// pixels.
typedef struct vorocl_point {
  double x;
  double y;
  double z;
} vorocl_point;

/// The point of the calling thread's last call that failed with VOROCL_BAD_POINT, and its index in the
/// caller's list. Either may be NULL. VOROCL_BAD_ARGUMENT if there was no such call.
VOROCL_API vorocl_status vorocl_bad_point(size_t* index, vorocl_point* point);

/// @}

/// The version of the library that runs, such as "0.3.0".
VOROCL_API const char* vorocl_version(void);

/// The label of a pixel without a nearest seed.
#define VOROCL_NO_LABEL UINT32_C(0xffffffff)

// Choices are ints, so that a wrong one is an error rather than undefined behaviour.

/// One of VOROCL_EUCLIDEAN, VOROCL_MANHATTAN and, for exact diagrams of longitudes and latitudes in degrees,
/// VOROCL_GREAT_CIRCLE: distances are kilometres there, and cells have square kilometres
/// (vorocl_cell_table()).
typedef int vorocl_metric;
enum { VOROCL_EUCLIDEAN = 0, VOROCL_MANHATTAN = 1, VOROCL_GREAT_CIRCLE = 2 };

/// Which axes of a grid are periodic. VOROCL_PERIODIC_NONE, or a sum of VOROCL_PERIODIC_X, VOROCL_PERIODIC_Y
/// and VOROCL_PERIODIC_Z.
typedef int vorocl_periodic;
enum {
  VOROCL_PERIODIC_NONE = 0,
  VOROCL_PERIODIC_X = 1,
  VOROCL_PERIODIC_Y = 2,
  VOROCL_PERIODIC_XY = 3,
  VOROCL_PERIODIC_Z = 4,
  VOROCL_PERIODIC_XZ = 5,
  VOROCL_PERIODIC_YZ = 6,
  VOROCL_PERIODIC_XYZ = 7
};

/// @name Axes, grids, windows: see vorocl::Axis, vorocl::Grid, vorocl::Window
/// Structs of the caller's, which are checked by the functions that take them.
/// @{

/// How many pixels there are along an axis, and which stretch of the data they cover. `from` 0 and `to` =
/// `pixels` say that the unit is the pixel.
typedef struct vorocl_axis {
  int64_t pixels;   ///< 1 to 2^31 - 1
  double from, to;  ///< in the units of the data
  int periodic;     ///< 1 if it repeats, else 0
  int reversed;     ///< 1 if its first pixel is at `to`, else 0
  int closed;       ///< 1 if the coordinate `to` falls in the last pixel and not behind it, else 0

  /// As how many units distances count a pixel: 1 to 64 (vorocl::Axis::spaced()), or 0, as an initialiser
  /// leaves it, which is 1. Where it is more for an axis, all distances are in these units.
  int spacing;
} vorocl_axis;

/// Initialises an axis whose unit is the pixel.
#define VOROCL_AXIS_OF_PIXELS(pixels) \
  { (pixels), 0, (pixels), 0, 0, 0, 1 }

/// The pixels that there are: x to the right, y down, z from slice to slice. With one slice it is a plane.
typedef struct vorocl_grid {
  vorocl_axis x, y;
  double
      tilt;  ///< how far the copy of the grid at greater y is shifted along x, in the units of the data; or 0
  vorocl_axis z;            ///< all zeros, as an initialiser leaves it, are an axis of one pixel
  double tilt_xz, tilt_yz;  ///< of a volume: how far the copy at greater z is shifted along x and y; or 0
} vorocl_grid;

/// What a diagram covers: `width` x `height` x `depth` pixels from column x, row y and slice z of the grid
/// on. Along a periodic axis it may begin anywhere. Of a volume it must show all.
typedef struct vorocl_window {
  vorocl_grid grid;
  int64_t x, y, width, height;
  int64_t z, depth;  ///< both 0, as an initialiser leaves them: all slices
} vorocl_window;

/// A grid whose unit is the pixel. Never fails: what is wrong is told by the function that takes the grid.
VOROCL_API vorocl_grid vorocl_grid_of_pixels(int64_t width, int64_t height, vorocl_periodic periodic);

/// The same with a third axis: a volume, whose unit is the voxel.
VOROCL_API vorocl_grid vorocl_grid_of_voxels(int64_t width, int64_t height, int64_t depth,
                                             vorocl_periodic periodic);

/// All pixels of a grid. Never fails, likewise.
VOROCL_API vorocl_window vorocl_window_of_grid(vorocl_grid grid);

/// @}
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
/// there. Points are in the units of the grid's axes.
/// @{

typedef struct vorocl_seeds vorocl_seeds;

/// What becomes of a point outside the grid: see vorocl::Outside. One of VOROCL_OUTSIDE_COUNTS,
/// VOROCL_OUTSIDE_IS_ABSENT, VOROCL_OUTSIDE_IS_REFUSED.
typedef int vorocl_outside;
enum { VOROCL_OUTSIDE_COUNTS = 0, VOROCL_OUTSIDE_IS_ABSENT = 1, VOROCL_OUTSIDE_IS_REFUSED = 2 };

/// What becomes of a point within its pixel: see vorocl::Snap. With VOROCL_SNAP_NONE exact diagrams take the
/// point itself, rounded to 1/4096 of a pixel, as C++ does unless it is told otherwise; with
/// VOROCL_SNAP_TO_PIXELS the centre of its pixel. Flooding methods snap: see vorocl_diagram_snapped().
typedef int vorocl_snap;
enum { VOROCL_SNAP_TO_PIXELS = 0, VOROCL_SNAP_NONE = 1 };

/// `outside` and `snap` hold for all frames. In a volume, and in a plane with an axis that is
/// spaced, VOROCL_OUTSIDE_COUNTS refuses points outside. See vorocl::Seeds.
VOROCL_API vorocl_status vorocl_seeds_from_points(const vorocl_device* device, vorocl_grid grid,
                                                  const vorocl_point* points, const uint8_t* present,
                                                  size_t count, vorocl_outside outside, vorocl_snap snap,
                                                  vorocl_seeds** seeds);

/// The same of `count` points with as many weights: see vorocl::Points::weighted(). Exact diagrams and exact
/// cells know them.
VOROCL_API vorocl_status vorocl_seeds_from_weighted_points(const vorocl_device* device, vorocl_grid grid,
                                                           const vorocl_point* points, const double* weights,
                                                           const uint8_t* present, size_t count,
                                                           vorocl_outside outside, vorocl_snap snap,
                                                           vorocl_seeds** seeds);

/// What a buffer of points holds for each, without gaps: two floats or doubles or, with a z, three. A
/// vorocl_point is VOROCL_DOUBLES_XYZ.
typedef int vorocl_point_format;
enum { VOROCL_FLOATS_XY = 0, VOROCL_DOUBLES_XY = 1, VOROCL_FLOATS_XYZ = 2, VOROCL_DOUBLES_XYZ = 3 };

/// From the caller's buffers. The device checks and places the points when it comes to it, and
/// VOROCL_BAD_POINT comes from the first call that waits for what was made of them. Points that may lie
/// outside the grid and count are waited for, and so are those that the host places (docs/linking.md, "What
/// waits").
VOROCL_API vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, vorocl_grid grid,
                                                  cl_mem points, vorocl_point_format format, cl_mem present,
                                                  size_t count, vorocl_outside outside, vorocl_snap snap,
                                                  vorocl_seeds** seeds);

/// A seed for each pixel of the mask that is not 0, row-major: `count` must be the grid's pixels.
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

/// The seeds that lie outside the grid.
VOROCL_API vorocl_status vorocl_seeds_outside(const vorocl_seeds* seeds, size_t* outside);

/// The greatest way that a seed went along an axis from the last frame to this one, in pixels. May wait.
VOROCL_API vorocl_status vorocl_seeds_displacement(const vorocl_seeds* seeds, double* displacement);

/// New points for the same ids. Their number may change: ids past the end are absent. If it fails, the seeds
/// are where they were.
VOROCL_API vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points,
                                              const uint8_t* present, size_t count);

/// The same of points with weights, on `grid` or, if that is NULL, where the seeds are.
VOROCL_API vorocl_status vorocl_seeds_move_to_weighted_points(vorocl_seeds* seeds, const vorocl_grid* grid,
                                                              const vorocl_point* points,
                                                              const double* weights, const uint8_t* present,
                                                              size_t count);

/// As vorocl_seeds_move_to(), on another grid.
VOROCL_API vorocl_status vorocl_seeds_move_to_grid(vorocl_seeds* seeds, vorocl_grid grid,
                                                   const vorocl_point* points, const uint8_t* present,
                                                   size_t count);

/// As vorocl_seeds_move_to(), from the caller's buffers.
VOROCL_API vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points,
                                                     vorocl_point_format format, cl_mem present,
                                                     size_t count);

/// What happens at the border of an axis that is not periodic: see vorocl::Border. One of VOROCL_REFLECT,
/// VOROCL_PERIODIC.
typedef int vorocl_border;
enum { VOROCL_REFLECT = 0, VOROCL_PERIODIC = 1 };

/// Moves each seed by up to `max_displacement` pixels along each axis at random: see vorocl::random_step().
VOROCL_API vorocl_status vorocl_random_step(vorocl_seeds* seeds, int max_displacement, vorocl_border border,
                                            uint64_t rng_seed, uint32_t frame);

/// The points as they were given, or the centres of their pixels where the device has placed them; all NaN
/// for a seed that is absent. `count` must be that of the seeds. Waits where the device has them.
VOROCL_API vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count);

/// As above, the positions that exact diagrams take, in pixels from the grid's first one: the centres of the
/// seeds' pixels, or whole numbers of 1/4096 with VOROCL_SNAP_NONE.
VOROCL_API vorocl_status vorocl_seeds_read_pixels(const vorocl_seeds* seeds, vorocl_point* points,
                                                  size_t count);

/// Waits until the points of a caller's buffer are checked.
VOROCL_API vorocl_status vorocl_seeds_check(const vorocl_seeds* seeds);

/// @}
/// @name Diagrams: see vorocl::Diagram
/// A diagram remembers the seeds, the metric and the method that its labels were made by: measures ask it for
/// them, whatever has become of the seeds since.
/// @{

typedef struct vorocl_diagram vorocl_diagram;

VOROCL_API vorocl_status vorocl_diagram_create(const vorocl_device* device, vorocl_window window,
                                               vorocl_diagram** diagram);

/// The labels go to the caller's buffer of width * height uint32_t, in a volume width * height * depth: so it
/// is wherever labels are counted.
VOROCL_API vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, vorocl_window window,
                                                    cl_mem labels, vorocl_diagram** diagram);

VOROCL_API void vorocl_diagram_free(vorocl_diagram* diagram);

VOROCL_API vorocl_status vorocl_diagram_window(const vorocl_diagram* diagram, vorocl_window* window);

/// The labels, row-major uint32_t, for use in OpenCL without a copy.
VOROCL_API vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels);

/// The metric that the labels were made by. VOROCL_BAD_ARGUMENT if there is none.
VOROCL_API vorocl_status vorocl_diagram_metric(const vorocl_diagram* diagram, vorocl_metric* metric);

/// The name of the method that made the labels, "" if none did. Valid until the diagram is filled or written.
VOROCL_API vorocl_status vorocl_diagram_method(const vorocl_diagram* diagram, const char** name);

/// Writes labels of the caller's, row-major, which name these seeds by this metric: `count` must be width *
/// height. Without seeds (NULL), measures that need them fail, and the metric is not looked at. A method that
/// goes on from the last labels goes on from these. Waits until they are copied.
VOROCL_API vorocl_status vorocl_diagram_write(vorocl_diagram* diagram, const uint32_t* labels, size_t count,
                                              const vorocl_seeds* seeds, vorocl_metric metric);

/// As above, from a buffer of the same context. Enqueues and returns.
VOROCL_API vorocl_status vorocl_diagram_write_buffer(vorocl_diagram* diagram, cl_mem labels,
                                                     const vorocl_seeds* seeds, vorocl_metric metric);

/// Completes with the labels of the last method that was to fill the diagram, and is valid until the next one
/// is called. NULL before the first, after one that failed, and after labels were written or that failed. (A
/// call that a NULL argument fails has not begun.)
VOROCL_API vorocl_status vorocl_diagram_event(const vorocl_diagram* diagram, cl_event* event);

/// The last method's waves, the device's time (0 if the queue does not profile; waits) and the host's: 0
/// where vorocl_diagram_event() gives NULL. Each may be NULL.
VOROCL_API vorocl_status vorocl_diagram_report(const vorocl_diagram* diagram, int* waves,
                                               double* milliseconds, double* host_milliseconds);

/// 1 if the labels of the last method are those of the centres of the seeds' pixels, although their points
/// lie elsewhere in them (VOROCL_SNAP_NONE), else 0: see vorocl::Report::snapped().
VOROCL_API vorocl_status vorocl_diagram_snapped(const vorocl_diagram* diagram, int* snapped);

/// Copies the labels to the host: `count` must be width * height. Waits.
VOROCL_API vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count);

/// Waits for the queue.
VOROCL_API vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram);

/// @}
/// @name Methods: seeds in, diagram out
/// They enqueue and return; standard flooding waits. A diagram whose filling failed counts as never filled:
/// see vorocl::Diagram.
/// @{

/// Which pixels a wave looks at. One of VOROCL_MOORE, VOROCL_VON_NEUMANN; for dynamic jump flooding alone,
/// VOROCL_MIXED; and VOROCL_DEFAULT_NEIGHBOURHOOD, which is mixed for dynamic jump flooding and Moore for the
/// other methods.
typedef int vorocl_neighbourhood;
enum { VOROCL_MOORE = 0, VOROCL_VON_NEUMANN = 1, VOROCL_MIXED = 2, VOROCL_DEFAULT_NEIGHBOURHOOD = 3 };

/// Where the waves of dynamic jump flooding get their reach from: see vorocl::Reach. One of
/// VOROCL_REACH_MEASURED, VOROCL_REACH_PAPER, VOROCL_REACH_AUTHORS.
typedef int vorocl_reach;
enum { VOROCL_REACH_MEASURED = 0, VOROCL_REACH_PAPER = 1, VOROCL_REACH_AUTHORS = 2 };

/// Says that seeds have moved as far as they know: vorocl_seeds_displacement(), over all frames since the
/// diagram was last filled.
#define VOROCL_DISPLACEMENT_OF_SEEDS (-1.0)

/// As vorocl::MethodOptions: the options of all methods. A method ignores those that it has no use for; mixed
/// neighbourhoods are refused by all but dynamic jump flooding.
typedef struct vorocl_method_options {
  vorocl_metric metric;
  vorocl_neighbourhood neighbourhood;
  int von_neumann_waves;    ///< of dynamic jump flooding: see vorocl::DynamicPlanOptions
  int extra_waves;          ///< likewise
  int refresh_interval;     ///< likewise: see vorocl::DynamicJumpFloodingOptions
  vorocl_reach reach;       ///< likewise: see vorocl::dynamic_jump_flooding()
  double max_displacement;  ///< likewise, in pixels, or VOROCL_DISPLACEMENT_OF_SEEDS
} vorocl_method_options;

/// Initialises options; to give NULL for them means the same.
#define VOROCL_METHOD_OPTIONS_DEFAULTS                                              \
  {                                                                                 \
    VOROCL_EUCLIDEAN, VOROCL_DEFAULT_NEIGHBOURHOOD, 2, 0, 0, VOROCL_REACH_MEASURED, \
        VOROCL_DISPLACEMENT_OF_SEEDS                                                \
  }

/// As vorocl::Method.
typedef struct vorocl_method_description {
  const char* name;  ///< such as "jfa+1"; it belongs to the library
  int exact;         ///< 1 if every pixel gets its nearest seed, else 0
  int continues;     ///< 1 if it goes on from the labels that the diagram holds, else 0
  int windows;       ///< 1 if it takes any window and seeds outside it, else 0: then it refuses them
  int volumes;       ///< 1 if it takes volumes, else 0: then it refuses them
} vorocl_method_description;

/// How many methods there are.
VOROCL_API vorocl_status vorocl_method_count(size_t* count);

VOROCL_API vorocl_status vorocl_method_get(size_t index, vorocl_method_description* description);

/// Fills the diagram by the method of this name: "exact", "jfa", "jfa+1", "jfa+2", "1+jfa",
/// "standard-flooding", "djfa" or "low-resolution". VOROCL_BAD_ARGUMENT, with a list, if there is none.
VOROCL_API vorocl_status vorocl_run(const char* method, const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                    const vorocl_method_options* options);

/// Builds all kernels that the method needs for so many seeds and such a window, so that the first diagram
/// takes no longer than the next: see vorocl::prepare(). `snap` is that of the seeds. Waits.
VOROCL_API vorocl_status vorocl_prepare(const char* method, const vorocl_device* device, vorocl_window window,
                                        size_t seeds, vorocl_snap snap, const vorocl_method_options* options);

/// As vorocl::Relaxation.
typedef struct vorocl_relaxation {
  int rounds;     ///< that were run
  int converged;  ///< 1 if no seed would move by 1/64 of a pixel or more, else 0
} vorocl_relaxation;

/// Moves seeds to the centroids of their cells, for at most so many rounds, to 1/4096 of a pixel, or from
/// pixel to pixel in volumes and if they were made with VOROCL_SNAP_TO_PIXELS: see vorocl::relax(). In the
/// end the diagram is that of the seeds. `density` has a value for each pixel of the diagram, row-major, as
/// vorocl::RelaxOptions::density; NULL: all pixels weigh alike. `energies` has room for `rounds` + 1 values,
/// at the start and after each round; `moved`, the seeds that each round moved, for `rounds`; each of the
/// three may be NULL. Waits.
VOROCL_API vorocl_status vorocl_relax(vorocl_seeds* seeds, vorocl_diagram* diagram, const char* method,
                                      const vorocl_method_options* options, int rounds, const float* density,
                                      double* energies, size_t* moved, vorocl_relaxation* relaxation);

/// As vorocl_relax() without a density, to the centroids of polygons or polyhedra, which lie anywhere: see
/// vorocl::RelaxOptions::exact.
VOROCL_API vorocl_status vorocl_relax_exact(vorocl_seeds* seeds, vorocl_diagram* diagram, const char* method,
                                            const vorocl_method_options* options, int rounds,
                                            double* energies, size_t* moved, vorocl_relaxation* relaxation);

/// @}
/// @name Measures that give numbers: they wait
/// @{

/// 100 x pixels with equal labels / all pixels, of two diagrams of one window and device.
VOROCL_API vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent);

/// As above, where labels are equal too if their seeds are equally far, within a tolerance in pixels.
VOROCL_API vorocl_status vorocl_similarity_within(const vorocl_diagram* a, const vorocl_diagram* b,
                                                  double tolerance, double* percent);

/// The pixels whose labels differ, of two diagrams of one window and device.
VOROCL_API vorocl_status vorocl_changed_pixels(const vorocl_diagram* a, const vorocl_diagram* b,
                                               size_t* pixels);

/// As vorocl::DistanceErrors.
typedef struct vorocl_wrong_labels {
  size_t pixels;             ///< of the diagram
  size_t wrong_pixels;       ///< whose label is not that of a seed at the least distance
  size_t unlabelled_pixels;  ///< of these: whose label names no seed; they have no excess distance
  double largest_excess;     ///< how much farther than the nearest seed that of a label is, in pixels ...
  double mean_excess;        ///< ... and the mean over all pixels
} vorocl_wrong_labels;

/// Judges a diagram by the exact one of the same seeds and metric: see vorocl::distance_errors().
VOROCL_API vorocl_status vorocl_distance_errors(const vorocl_diagram* diagram, const vorocl_diagram* exact,
                                                vorocl_wrong_labels* wrong);

/// The sum of the squared distances of all pixels to their seeds: see vorocl::energy().
VOROCL_API vorocl_status vorocl_energy(const vorocl_diagram* diagram, double* energy);

/// The pixel corners where three or more cells meet, in pixels from the window's first one, row-major: the
/// first `room` of them, and how many there are. With no room, `points` may be NULL. See vorocl::vertices().
VOROCL_API vorocl_status vorocl_vertices(const vorocl_diagram* diagram, vorocl_point* points, size_t room,
                                         size_t* count);

/// As vorocl::CellRow: by great circles areas are square kilometres, centroids degrees, distances kilometres.
typedef struct vorocl_cell_row {
  uint32_t id;
  vorocl_point seed;
  uint32_t pixels;
  double area;
  vorocl_point centroid;
  int touches_border;
  uint32_t neighbours;
  double largest_distance;
} vorocl_cell_row;

/// The cells of the seeds that are there, by id: the first `room` of them, and how many there are. With no
/// room, `rows` may be NULL. Waits. See vorocl::cell_table().
VOROCL_API vorocl_status vorocl_cell_table(const vorocl_diagram* diagram, vorocl_cell_row* rows, size_t room,
                                           size_t* count);

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
VOROCL_API vorocl_status vorocl_cell_sums_measure(vorocl_cell_sums* sums, const vorocl_diagram* diagram);

/// The cells that were measured, one per seed; 0 if it is empty.
VOROCL_API vorocl_status vorocl_cell_sums_count(const vorocl_cell_sums* sums, size_t* count);

/// Per cell its area in pixels (uint32_t), in a volume its voxels, and the sums of its pixels' columns, rows
/// and slices (int64_t), those of a plane 0. Each may be NULL. The buffers are valid until the next
/// measurement.
VOROCL_API vorocl_status vorocl_cell_sums_buffers(const vorocl_cell_sums* sums, cl_mem* area, cl_mem* sum_x,
                                                  cl_mem* sum_y, cl_mem* sum_z);

/// The same on the host, each into room for `count` cells, which must be all; each may be NULL. In a plane
/// `sum_z` is all 0. Waits.
VOROCL_API vorocl_status vorocl_cell_sums_read(const vorocl_cell_sums* sums, uint32_t* area, int64_t* sum_x,
                                               int64_t* sum_y, int64_t* sum_z, size_t count);

/// The means of the centres of the cells' pixels, in pixels from the window's first one; all NaN of an empty
/// cell. Waits.
VOROCL_API vorocl_status vorocl_cell_sums_centroids(const vorocl_cell_sums* sums, vorocl_point* centroids,
                                                    size_t count);

/// As vorocl::CellStatistics. Absent seeds do not count.
typedef struct vorocl_cell_statistics {
  size_t cells;           ///< seeds; of those outside the window the ones that own pixels
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
VOROCL_API vorocl_status vorocl_cell_shapes_measure(vorocl_cell_shapes* shapes,
                                                    const vorocl_diagram* diagram);

VOROCL_API vorocl_status vorocl_cell_shapes_count(const vorocl_cell_shapes* shapes, size_t* count);

/// Per cell int32_t left, top, front, right, bottom, back; and its
/// largest distance (int32_t). Either may be NULL. The buffers are valid until the next measurement. Where a
/// seed lies so far outside the window that distances may not fit, the second one is NULL:
/// vorocl_cell_shapes_read() tells them.
VOROCL_API vorocl_status vorocl_cell_shapes_buffers(const vorocl_cell_shapes* shapes, cl_mem* boxes,
                                                    cl_mem* largest_distances);

/// As vorocl::CellShape. An empty cell has right < left, bottom < top, in a volume back < front, and
/// largest_distance -1.
typedef struct vorocl_cell_shape {
  int left, top, right, bottom;  ///< the bounding box: first and last columns and rows
  double largest_distance;       ///< of its pixels to its seed, in pixels; squared if Euclidean
  int touches_border;            ///< 1 if it has a pixel next to a border of the window, else 0
  int front, back;               ///< of the box: its first and last slices, 0 in a plane
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

/// Enqueues and returns.
VOROCL_API vorocl_status vorocl_adjacency_find(vorocl_adjacency* adjacency, const vorocl_diagram* diagram);

/// How many pairs of cells share a pixel edge, in a volume a voxel face. Waits.
VOROCL_API vorocl_status vorocl_adjacency_pairs(const vorocl_adjacency* adjacency, size_t* pairs);

/// uint32_t a, b, length per pair, and per cell the cells that it shares an edge with and the pixel edges
/// that it shares with them (uint32_t each). Each may be NULL. The buffers are valid until the next search.
/// Waits.
VOROCL_API vorocl_status vorocl_adjacency_buffers(const vorocl_adjacency* adjacency, cl_mem* pair_list,
                                                  cl_mem* neighbours, cl_mem* perimeters);

/// As vorocl::CellPair.
typedef struct vorocl_cell_pair {
  uint32_t a, b;    ///< the ids of two cells, a < b
  uint32_t length;  ///< the pixel edges they share; in a volume the faces, an area
} vorocl_cell_pair;

/// All pairs, sorted by a and then b: `count` must be their number. Waits.
VOROCL_API vorocl_status vorocl_adjacency_read_pairs(const vorocl_adjacency* adjacency,
                                                     vorocl_cell_pair* pairs, size_t count);

/// Per cell, by id: `count` must be that of the seeds. Either may be NULL. Waits.
VOROCL_API vorocl_status vorocl_adjacency_read_cells(const vorocl_adjacency* adjacency, uint32_t* neighbours,
                                                     uint32_t* perimeters, size_t count);

/// @}
/// @name Cells as polygons, and in volumes as polyhedra: see vorocl::exact_cells()
/// @{

/// What was cut, on the device; to be used frame after frame. As vorocl::ExactCellsResult.
typedef struct vorocl_exact_cells vorocl_exact_cells;

VOROCL_API vorocl_status vorocl_exact_cells_create(vorocl_exact_cells** cells);
VOROCL_API void vorocl_exact_cells_free(vorocl_exact_cells* cells);

/// Cuts the rectangle of the seeds' grid, or the box of a volume, into their cells, without a diagram.
/// Enqueues and returns. VOROCL_DEVICE_ERROR if the device has no doubles.
VOROCL_API vorocl_status vorocl_exact_cells_cut(vorocl_exact_cells* cells, const vorocl_seeds* seeds);

/// The cells, one per seed; 0 if it is empty.
VOROCL_API vorocl_status vorocl_exact_cells_count(const vorocl_exact_cells* cells, size_t* count);

/// As vorocl::ExactCell, in the units of the data: of a volume the area is the cell's volume, the perimeter
/// its surface. An empty cell has the area 0 and a centroid of NaN.
typedef struct vorocl_exact_cell {
  double area;
  vorocl_point centroid;
  double perimeter;
  uint32_t neighbours;  ///< edges that it shares with cells
  int touches_border;   ///< 1 if a side of the rectangle bounds it, else 0
  int certified;        ///< 1: all decisions were certain
} vorocl_exact_cell;

/// All cells, by id: `count` must be their number. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_read(const vorocl_exact_cells* all, vorocl_exact_cell* cells,
                                                 size_t count);

/// Per cell its area (double), centroid (2 doubles, in a volume 3), perimeter (double), neighbours (uint32_t)
/// and flags (a byte: 1 touches the border, 2 certified). Each may be NULL. The buffers are valid until the
/// next cut. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_buffers(const vorocl_exact_cells* cells, cl_mem* areas,
                                                    cl_mem* centroids, cl_mem* perimeters, cl_mem* neighbours,
                                                    cl_mem* flags);

/// The edges of all polygons, of a volume the faces of all cells. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_edges(const vorocl_exact_cells* cells, size_t* edges);

/// The polygons: those edges of a cell that begin at its offset (uint32_t per cell, and one),
/// counter-clockwise where y points up. Per edge the vertex where it begins (2 doubles), the cell behind it
/// (uint32_t; VOROCL_NO_LABEL: a side of the rectangle) and its length (double). Of a volume the same of
/// faces, whose lengths are areas, without vertices. Each may be NULL. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_polygon_buffers(const vorocl_exact_cells* cells, cl_mem* offsets,
                                                            cl_mem* vertices, cl_mem* neighbours,
                                                            cl_mem* lengths);

/// The same on the host, of a plane: `count` must be the number of cells, `offsets` has one more, and the
/// others have `edges`, which must be all. Each may be NULL. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_read_polygons(const vorocl_exact_cells* cells, uint32_t* offsets,
                                                          size_t count, vorocl_point* vertices,
                                                          uint32_t* neighbours, double* lengths,
                                                          size_t edges);

/// As vorocl::ExactFace: a face that two cells of a volume share, a <= b. It is normal to
/// point b + image * periods - point a.
typedef struct vorocl_exact_face {
  uint32_t a, b;
  double area;
  int32_t image[3];
} vorocl_exact_face;

/// The faces between cells of a volume, each once, sorted: the first `room` of them, and how many there are.
/// With no room, `faces` may be NULL. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_read_faces(const vorocl_exact_cells* cells,
                                                       vorocl_exact_face* faces, size_t room, size_t* count);

/// All cells of a volume as polyhedra, on the host; as vorocl::ExactPolyhedra.
typedef struct vorocl_exact_polyhedra vorocl_exact_polyhedra;

/// What polyhedra hold. The arrays are valid until the polyhedra are freed.
typedef struct vorocl_polyhedra_arrays {
  size_t cells, faces, corners, vertices;
  const uint32_t* offsets;          ///< cells + 1: where the faces of each cell begin
  const uint32_t* neighbours;       ///< of each face the cell behind it; VOROCL_NO_LABEL: a side of the box
  const double* areas;              ///< of each face
  const uint64_t* corner_offsets;   ///< faces + 1: where the corners of each face begin
  const uint64_t* corner_vertices;  ///< of each corner, counter-clockwise as seen from outside
  const uint64_t* vertex_offsets;   ///< cells + 1: where the vertices of each cell begin
  const vorocl_point* points;       ///< of each vertex
} vorocl_polyhedra_arrays;

/// Cuts the cells once more. Waits.
VOROCL_API vorocl_status vorocl_exact_cells_polyhedra(const vorocl_exact_cells* cells,
                                                      vorocl_exact_polyhedra** polyhedra);
VOROCL_API vorocl_status vorocl_exact_polyhedra_arrays(const vorocl_exact_polyhedra* polyhedra,
                                                       vorocl_polyhedra_arrays* arrays);
VOROCL_API void vorocl_exact_polyhedra_free(vorocl_exact_polyhedra* polyhedra);

/// @}
/// @name Images: see vorocl::Field
/// @{

/// One value per pixel, row-major, on the device, of the type of the last function that filled it. To be used
/// frame after frame: it allocates nothing while the type and the window stay. Empty before it is filled and
/// after that failed.
typedef struct vorocl_field vorocl_field;

VOROCL_API vorocl_status vorocl_field_create(vorocl_field** field);
VOROCL_API void vorocl_field_free(vorocl_field* field);

/// int32_t: each pixel's distance to its seed, squared if Euclidean; INT32_MAX without a label. Enqueues and
/// returns, and so do all that follow. To read distances that do not fit is VOROCL_BAD_ARGUMENT.
VOROCL_API vorocl_status vorocl_field_int_distances(vorocl_field* field, const vorocl_diagram* diagram);

/// float: the same in pixels, not squared; infinity without a label.
VOROCL_API vorocl_status vorocl_field_float_distances(vorocl_field* field, const vorocl_diagram* diagram);

/// uint8_t: 1 for each pixel that shares an edge with a pixel of another label, else 0.
VOROCL_API vorocl_status vorocl_field_border_mask(vorocl_field* field, const vorocl_diagram* diagram);

/// uint32_t: each pixel's label, looked up in a table of `count` entries, at least one per seed;
/// VOROCL_NO_LABEL without a label.
VOROCL_API vorocl_status vorocl_field_map_labels(vorocl_field* field, const vorocl_diagram* diagram,
                                                 const uint32_t* table, size_t count);

/// As above, from a table of uint32_t in a buffer of the same context.
VOROCL_API vorocl_status vorocl_field_map_labels_by_buffer(vorocl_field* field, const vorocl_diagram* diagram,
                                                           cl_mem table);

/// uint32_t: the label of each pixel at most `distance` pixels away from its seed, else VOROCL_NO_LABEL.
VOROCL_API vorocl_status vorocl_field_expand_labels(vorocl_field* field, const vorocl_diagram* diagram,
                                                    double distance);

/// The values; NULL while the field is empty. Valid until the field is filled again.
VOROCL_API vorocl_status vorocl_field_buffer(const vorocl_field* field, cl_mem* values);

/// Copies the values to the host: `bytes` must be their size, 0 while the field is empty. Waits.
VOROCL_API vorocl_status vorocl_field_read(const vorocl_field* field, void* values, size_t bytes);

/// @}

/// @name Distance transforms of images: see vorocl::DistanceTransform
/// @{

/// What a pixel of an image is in memory. One of these; integers with a sign are given as those without.
typedef int vorocl_pixel_type;
enum {
  VOROCL_PIXEL_UINT8 = 0,
  VOROCL_PIXEL_UINT16 = 1,
  VOROCL_PIXEL_UINT32 = 2,
  VOROCL_PIXEL_UINT64 = 3,
  VOROCL_PIXEL_FLOAT32 = 4,
  VOROCL_PIXEL_FLOAT64 = 5
};

/// An image that is read: row-major, without gaps, at `pixels` in the host's memory or in a buffer of the
/// device's context; the other one is NULL.
typedef struct vorocl_image_source {
  const void* pixels;
  cl_mem buffer;
  vorocl_pixel_type type;
} vorocl_image_source;

/// An image that is written, likewise. It is not wanted if both are NULL, as an initialiser leaves them.
typedef struct vorocl_image_target {
  void* pixels;
  cl_mem buffer;
  vorocl_pixel_type type;
} vorocl_image_target;

/// Which pixels others look for: those that are zero, or those that are not. NaN is never marked.
typedef int vorocl_marked;
enum { VOROCL_MARKED_ZEROS = 0, VOROCL_MARKED_NON_ZEROS = 1 };

/// What a transform writes: see vorocl::TransformTargets, which says the types of each.
typedef struct vorocl_transform_targets {
  vorocl_image_target distances;  ///< float32, float64; uint32: squares
  vorocl_image_target indices;    ///< uint32: images of indices along z (of volumes), y and x
  vorocl_image_target places;     ///< uint32: x + width * (y + height * z)
  vorocl_image_target ranks;      ///< uint32: the number among the marked pixels, row-major
  vorocl_image_target values;     ///< of the type of the image: what the nearest marked pixel has
} vorocl_transform_targets;

/// Exact distance transforms of images of one size. It keeps its kernels and memory from image to image.
typedef struct vorocl_distance_transform vorocl_distance_transform;

/// Of images of a grid's size and periods. `size` are the three lengths of a pixel along x, y and z, up to
/// 1,000 times each other; NULL: 1.
VOROCL_API vorocl_status vorocl_distance_transform_create(const vorocl_device* device, vorocl_grid grid,
                                                          const double size[3],
                                                          vorocl_distance_transform** transform);
VOROCL_API void vorocl_distance_transform_free(vorocl_distance_transform* transform);

/// Transforms an image. What is farther than `farthest`, in the units of the sizes, has no nearest pixel:
/// infinity, VOROCL_NO_LABEL and 0 are written. INFINITY (math.h): all have one. Enqueues and returns if all
/// images are buffers, else waits.
VOROCL_API vorocl_status vorocl_distance_transform_run(vorocl_distance_transform* transform,
                                                       const vorocl_image_source* image, vorocl_marked marked,
                                                       double farthest,
                                                       const vorocl_transform_targets* targets);

/// Whether the last image had a marked pixel: 1 or 0. Waits.
VOROCL_API vorocl_status vorocl_distance_transform_found(const vorocl_distance_transform* transform,
                                                         int* found);

/// @}

#ifdef __cplusplus
}
#endif

#endif
