#include "kernel/engine/gpu/open_cl_library.h"

#include <dlfcn.h>

#include <optional>

namespace voxmelt::gpu {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

// The library stays loaded, since drivers end threads of their own when the program does.
std::optional<OpenClLibrary> loaded() {
  void* const library = dlopen("libOpenCL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return {};
  OpenClLibrary all;
  const bool whole = find(library, "clGetPlatformIDs", all.clGetPlatformIDs) &&
                     find(library, "clGetDeviceIDs", all.clGetDeviceIDs) &&
                     find(library, "clGetDeviceInfo", all.clGetDeviceInfo) &&
                     find(library, "clCreateContext", all.clCreateContext) &&
                     find(library, "clReleaseContext", all.clReleaseContext) &&
                     find(library, "clCreateCommandQueue", all.clCreateCommandQueue) &&
                     find(library, "clReleaseCommandQueue", all.clReleaseCommandQueue) &&
                     find(library, "clCreateProgramWithSource", all.clCreateProgramWithSource) &&
                     find(library, "clBuildProgram", all.clBuildProgram) &&
                     find(library, "clGetProgramBuildInfo", all.clGetProgramBuildInfo) &&
                     find(library, "clReleaseProgram", all.clReleaseProgram) &&
                     find(library, "clCreateKernel", all.clCreateKernel) &&
                     find(library, "clReleaseKernel", all.clReleaseKernel) &&
                     find(library, "clSetKernelArg", all.clSetKernelArg) &&
                     find(library, "clCreateBuffer", all.clCreateBuffer) &&
                     find(library, "clReleaseMemObject", all.clReleaseMemObject) &&
                     find(library, "clEnqueueWriteBuffer", all.clEnqueueWriteBuffer) &&
                     find(library, "clEnqueueReadBuffer", all.clEnqueueReadBuffer) &&
                     find(library, "clEnqueueFillBuffer", all.clEnqueueFillBuffer) &&
                     find(library, "clEnqueueNDRangeKernel", all.clEnqueueNDRangeKernel) &&
                     find(library, "clFlush", all.clFlush) &&
                     find(library, "clGetEventInfo", all.clGetEventInfo) &&
                     find(library, "clReleaseEvent", all.clReleaseEvent);
  if (!whole) return {};
  return all;
}

}  // namespace

const OpenClLibrary* open_cl_library() {
  static const std::optional<OpenClLibrary> library = loaded();
  return library ? &*library : nullptr;
}

}  // namespace voxmelt::gpu
