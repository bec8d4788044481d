#include "faulty_calls.hpp"

VOROCL_FAULTY_MAKER(cl_mem, clCreateBuffer,
                    (cl_context context, cl_mem_flags flags, size_t size, void* host, cl_int* code),
                    (context, flags, size, host, code))
VOROCL_FAULTY_MAKER(cl_kernel, clCreateKernel, (cl_program program, const char* name, cl_int* code),
                    (program, name, code))
VOROCL_FAULTY_CALL(clSetKernelArg, (cl_kernel kernel, cl_uint index, size_t size, const void* value),
                   (kernel, index, size, value))
VOROCL_FAULTY_CALL(clEnqueueNDRangeKernel,
                   (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                    const size_t* global, const size_t* local, cl_uint count, const cl_event* waits,
                    cl_event* event),
                   (queue, kernel, dimensions, offset, global, local, count, waits, event))
VOROCL_FAULTY_CALL(clEnqueueFillBuffer,
                   (cl_command_queue queue, cl_mem buffer, const void* pattern, size_t pattern_size,
                    size_t offset, size_t size, cl_uint count, const cl_event* waits, cl_event* event),
                   (queue, buffer, pattern, pattern_size, offset, size, count, waits, event))
VOROCL_FAULTY_CALL(clEnqueueCopyBuffer,
                   (cl_command_queue queue, cl_mem from, cl_mem to, size_t from_offset, size_t to_offset,
                    size_t size, cl_uint count, const cl_event* waits, cl_event* event),
                   (queue, from, to, from_offset, to_offset, size, count, waits, event))
VOROCL_FAULTY_CALL(clEnqueueReadBuffer,
                   (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t size,
                    void* host, cl_uint count, const cl_event* waits, cl_event* event),
                   (queue, buffer, blocking, offset, size, host, count, waits, event))
VOROCL_FAULTY_MAKER(void*, clEnqueueMapBuffer,
                    (cl_command_queue queue, cl_mem buffer, cl_bool blocking, cl_map_flags flags,
                     size_t offset, size_t size, cl_uint count, const cl_event* waits, cl_event* event,
                     cl_int* code),
                    (queue, buffer, blocking, flags, offset, size, count, waits, event, code))
VOROCL_FAULTY_CALL(clEnqueueUnmapMemObject,
                   (cl_command_queue queue, cl_mem buffer, void* mapped, cl_uint count, const cl_event* waits,
                    cl_event* event),
                   (queue, buffer, mapped, count, waits, event))
VOROCL_FAULTY_CALL(clEnqueueWriteBuffer,
                   (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t size,
                    const void* host, cl_uint count, const cl_event* waits, cl_event* event),
                   (queue, buffer, blocking, offset, size, host, count, waits, event))
VOROCL_FAULTY_CALL(clGetDeviceInfo,
                   (cl_device_id device, cl_device_info name, size_t room, void* value, size_t* size),
                   (device, name, room, value, size))
VOROCL_FAULTY_MAKER(cl_program, clCreateProgramWithSource,
                    (cl_context context, cl_uint count, const char** texts, const size_t* sizes,
                     cl_int* code),
                    (context, count, texts, sizes, code))
VOROCL_FAULTY_MAKER(cl_program, clCreateProgramWithBinary,
                    (cl_context context, cl_uint count, const cl_device_id* devices, const size_t* sizes,
                     const unsigned char** binaries, cl_int* statuses, cl_int* code),
                    (context, count, devices, sizes, binaries, statuses, code))
VOROCL_FAULTY_CALL(clBuildProgram,
                   (cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
                    void(CL_CALLBACK* notify)(cl_program, void*), void* data),
                   (program, count, devices, options, notify, data))
VOROCL_FAULTY_CALL(clGetMemObjectInfo,
                   (cl_mem memory, cl_mem_info name, size_t room, void* value, size_t* size),
                   (memory, name, room, value, size))
VOROCL_FAULTY_CALL(clWaitForEvents, (cl_uint count, const cl_event* events), (count, events))
VOROCL_FAULTY_CALL(clFlush, (cl_command_queue queue), (queue))
VOROCL_FAULTY_CALL(clFinish, (cl_command_queue queue), (queue))
