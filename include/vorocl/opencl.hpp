// The OpenCL C++ bindings. The library's headers use their handles alone (cl::Buffer, cl::Event, ...).
#pragma once

// The bindings print a note in every translation unit that does not say which version of OpenCL it wants.
// What is chosen here is what they choose by themselves. Who wants another version defines it, as without
// this library.
#ifndef CL_HPP_TARGET_OPENCL_VERSION
#ifdef CL_TARGET_OPENCL_VERSION
#define CL_HPP_TARGET_OPENCL_VERSION CL_TARGET_OPENCL_VERSION
#if CL_TARGET_OPENCL_VERSION < 200 && !defined(CL_HPP_MINIMUM_OPENCL_VERSION)
#define CL_HPP_MINIMUM_OPENCL_VERSION CL_TARGET_OPENCL_VERSION
#endif
#else
#define CL_HPP_TARGET_OPENCL_VERSION 300
#endif
#endif

#include <CL/opencl.hpp>
