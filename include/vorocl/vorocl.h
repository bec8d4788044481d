/// @file
/// VoroCL for C, and for whatever calls C: the same functions as the C++ headers, with status codes.
///
/// Every function that can fail returns a status; vorocl_error_message() then says what was wrong and what to
/// do. A function that makes an object stores it through its last argument, and stores NULL if it fails.
/// Objects may be freed in any order: each keeps what it needs. Threads may share a device, as far as each
/// has its own seeds and diagrams.
#ifndef VOROCL_VOROCL_H
#define VOROCL_VOROCL_H

#include <CL/cl.h>
#include <stddef.h>
#include <stdint.h>

#include "vorocl/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a function returns.
typedef enum vorocl_status {
  VOROCL_SUCCESS = 0,
  VOROCL_ERROR = 1,              ///< a bad argument, or OpenCL failed: see vorocl_error_message()
  VOROCL_NULL_ARGUMENT = 2,      ///< a pointer that must not be NULL is
  VOROCL_OUT_OF_HOST_MEMORY = 3  ///< (too little device memory is a VOROCL_ERROR)
} vorocl_status;

/// What was wrong in the calling thread's last call that failed; valid until its next one that fails. Never
/// NULL.
VOROCL_API const char* vorocl_error_message(void);

/// The version of the library that runs, such as "0.1.0".
VOROCL_API const char* vorocl_version(void);

/// The label of a pixel without a nearest seed.
#define VOROCL_NO_LABEL UINT32_C(0xffffffff)

// Choices are ints, so that a wrong one is an error rather than undefined behaviour.

/// One of VOROCL_EUCLIDEAN, VOROCL_MANHATTAN.
typedef int vorocl_metric;
enum { VOROCL_EUCLIDEAN = 0, VOROCL_MANHATTAN = 1 };

/// One of VOROCL_MOORE, VOROCL_VON_NEUMANN and, for dynamic jump flooding alone, VOROCL_MIXED.
typedef int vorocl_neighbourhood;
enum { VOROCL_MOORE = 0, VOROCL_VON_NEUMANN = 1, VOROCL_MIXED = 2 };

/// One of VOROCL_JFA, VOROCL_JFA_PLUS_1, VOROCL_JFA_PLUS_2, VOROCL_ONE_PLUS_JFA.
typedef int vorocl_variant;
enum { VOROCL_JFA = 0, VOROCL_JFA_PLUS_1 = 1, VOROCL_JFA_PLUS_2 = 2, VOROCL_ONE_PLUS_JFA = 3 };

/// One of VOROCL_REFLECT, VOROCL_PERIODIC.
typedef int vorocl_border;
enum { VOROCL_REFLECT = 0, VOROCL_PERIODIC = 1 };

/// A position in pixel units: pixel i of an axis covers [i, i + 1), y points down.
typedef struct vorocl_point {
  double x;
  double y;
} vorocl_point;

/// @name Devices: see vorocl::Device
/// @{

typedef struct vorocl_device vorocl_device;

/// `request`: a part of a platform's or device's name, "platform:device" indices, or NULL for the library's
/// choice.
VOROCL_API vorocl_status vorocl_device_select(const char* request, vorocl_device** device);

/// Retains the caller's context and in-order queue.
VOROCL_API vorocl_status vorocl_device_adopt(cl_context context, cl_command_queue queue,
                                             vorocl_device** device);

VOROCL_API void vorocl_device_free(vorocl_device* device);

/// The name, context and queue belong to the device, and are valid as long as it is.
VOROCL_API vorocl_status vorocl_device_name(const vorocl_device* device, const char** name);
VOROCL_API vorocl_status vorocl_device_context(const vorocl_device* device, cl_context* context);
VOROCL_API vorocl_status vorocl_device_queue(const vorocl_device* device, cl_command_queue* queue);

/// Lets all that is enqueued from now on wait for `count` events of other queues of the context.
VOROCL_API vorocl_status vorocl_device_wait_for(const vorocl_device* device, size_t count,
                                                const cl_event* events);

/// Waits until all that was enqueued is done.
VOROCL_API vorocl_status vorocl_device_finish(const vorocl_device* device);

/// @}
/// @name Seeds: see vorocl::Seeds
/// @{

typedef struct vorocl_seeds vorocl_seeds;

VOROCL_API vorocl_status vorocl_seeds_from_points(const vorocl_device* device, int64_t width, int64_t height,
                                                  const vorocl_point* points, size_t count,
                                                  vorocl_seeds** seeds);

/// From `count` pairs (x, y) of float in the caller's buffer.
VOROCL_API vorocl_status vorocl_seeds_from_buffer(const vorocl_device* device, int64_t width, int64_t height,
                                                  cl_mem points, size_t count, vorocl_seeds** seeds);

VOROCL_API vorocl_status vorocl_seeds_random(const vorocl_device* device, int64_t width, int64_t height,
                                             size_t count, uint64_t rng_seed, vorocl_seeds** seeds);

VOROCL_API void vorocl_seeds_free(vorocl_seeds* seeds);

VOROCL_API vorocl_status vorocl_seeds_count(const vorocl_seeds* seeds, size_t* count);

/// New points for the same ids. Where `present` is not NULL, a seed whose byte there is 0 is absent.
VOROCL_API vorocl_status vorocl_seeds_move_to(vorocl_seeds* seeds, const vorocl_point* points,
                                              const unsigned char* present, size_t count);
VOROCL_API vorocl_status vorocl_seeds_move_to_buffer(vorocl_seeds* seeds, cl_mem points, size_t count);

/// Moves each seed by up to `most` pixels an axis at random: see vorocl::random_step().
VOROCL_API vorocl_status vorocl_random_step(vorocl_seeds* seeds, int most, vorocl_border border,
                                            uint64_t rng_seed, uint32_t frame);

/// The centres of the seeds' pixels, NaN for a seed that is absent, into room for `count` of them. Waits.
VOROCL_API vorocl_status vorocl_seeds_read(const vorocl_seeds* seeds, vorocl_point* points, size_t count);

/// @}
/// @name Diagrams: see vorocl::Diagram
/// @{

typedef struct vorocl_diagram vorocl_diagram;

VOROCL_API vorocl_status vorocl_diagram_create(const vorocl_device* device, int64_t width, int64_t height,
                                               vorocl_diagram** diagram);

/// The labels go to the caller's buffer of width * height uint32_t, which is retained.
VOROCL_API vorocl_status vorocl_diagram_over_buffer(const vorocl_device* device, int64_t width,
                                                    int64_t height, cl_mem labels, vorocl_diagram** diagram);

VOROCL_API void vorocl_diagram_free(vorocl_diagram* diagram);

/// The buffer of labels, for use in OpenCL without a copy; it belongs to the diagram.
VOROCL_API vorocl_status vorocl_diagram_labels(const vorocl_diagram* diagram, cl_mem* labels);

/// Completes with the last engine's labels. NULL before the first engine ran; it belongs to the diagram, and
/// is valid until the next engine runs.
VOROCL_API vorocl_status vorocl_diagram_event(const vorocl_diagram* diagram, cl_event* event);

/// The last engine's waves and device time (0 if the queue does not profile; waits). Either may be NULL.
VOROCL_API vorocl_status vorocl_diagram_report(const vorocl_diagram* diagram, int* waves,
                                               double* milliseconds);

/// Copies the labels to the host: `count` must be width * height. Waits.
VOROCL_API vorocl_status vorocl_diagram_read(const vorocl_diagram* diagram, uint32_t* labels, size_t count);

/// Waits for the queue; reports a bad point of the caller's buffer.
VOROCL_API vorocl_status vorocl_diagram_wait(const vorocl_diagram* diagram);

/// 100 x pixels with equal labels / all pixels, of two diagrams of one size and device. Waits.
VOROCL_API vorocl_status vorocl_similarity(const vorocl_diagram* a, const vorocl_diagram* b, double* percent);

/// @}
/// @name Engines: seeds in, diagram out; they enqueue and return
/// @{

/// See vorocl::standard_flooding(); this one waits.
VOROCL_API vorocl_status vorocl_standard_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                                  vorocl_metric metric, vorocl_neighbourhood neighbourhood);

/// See vorocl::jump_flooding().
VOROCL_API vorocl_status vorocl_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                              vorocl_metric metric, vorocl_neighbourhood neighbourhood,
                                              vorocl_variant variant);

/// As vorocl::DynamicJumpFloodingOptions.
typedef struct vorocl_dynamic_jump_flooding_options {
  vorocl_metric metric;
  double max_step;  ///< the longest motion of a seed along an axis since the last frame, in pixels
  vorocl_neighbourhood neighbourhood;
  int von_neumann_waves;
  int extra_waves;
  int refresh_interval;
} vorocl_dynamic_jump_flooding_options;

/// Initialises the options; then set max_step.
#define VOROCL_DYNAMIC_JUMP_FLOODING_DEFAULTS \
  { VOROCL_EUCLIDEAN, 0.0, VOROCL_MIXED, 2, 0, 0 }

/// See vorocl::dynamic_jump_flooding().
VOROCL_API vorocl_status vorocl_dynamic_jump_flooding(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                                      const vorocl_dynamic_jump_flooding_options* options);

/// See vorocl::exact_diagram().
VOROCL_API vorocl_status vorocl_exact_diagram(const vorocl_seeds* seeds, vorocl_diagram* diagram,
                                              vorocl_metric metric);

/// @}

#ifdef __cplusplus
}
#endif

#endif
