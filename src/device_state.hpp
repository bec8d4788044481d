// What all copies of a Device share.
#pragma once

#include <CL/opencl.hpp>
#include <map>
#include <mutex>
#include <string>

#include "vorocl/device.hpp"

namespace vorocl {

struct Device::State {
  cl::Context context;
  cl::CommandQueue queue;
  cl::Device device;

  std::mutex programs_mutex;                    // held while a program is looked up or built
  std::map<std::string, cl::Program> programs;  // by file and build options
};

}  // namespace vorocl
