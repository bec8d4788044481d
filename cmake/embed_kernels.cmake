# Writes a C++ source that holds each .cl file as a string, so that programs need no file at run time. A kernel's name is
# its path below ROOT ("exact/keys.cl").
# Called as: cmake -DOUTPUT=file.cpp -DFUNCTION=kernel_sources -DROOT=folder "-DKERNELS=a.cl;b.cl" -P embed_kernels.cmake
set(text "// Generated from .cl files: do not edit.\n#include <map>\n#include <string>\n\nnamespace vorocl {\n\n")
string(APPEND text "const std::map<std::string, std::string>& ${FUNCTION}() {\n")
string(APPEND text "  static const std::map<std::string, std::string> sources = {\n")
foreach(kernel IN LISTS KERNELS)
  file(READ ${ROOT}/${kernel} source)
  string(APPEND text "      {\"${kernel}\", R\"opencl(${source})opencl\"},\n")
endforeach()
string(APPEND text "  };\n  return sources;\n}\n\n}  // namespace vorocl\n")
file(WRITE ${OUTPUT} "${text}")
