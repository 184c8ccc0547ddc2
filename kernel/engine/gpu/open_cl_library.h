// The functions of libOpenCL, found at run time.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_2_APIS
#include <CL/cl.h>

namespace voxmelt::gpu {

#define VOXMELT_OPEN_CL_FUNCTIONS(visit)                                                                  \
  visit(clGetPlatformIDs) visit(clGetDeviceIDs) visit(clGetDeviceInfo) visit(clCreateContext)             \
      visit(clReleaseContext) visit(clCreateCommandQueue) visit(clReleaseCommandQueue)                    \
          visit(clCreateProgramWithSource) visit(clBuildProgram) visit(clGetProgramBuildInfo)             \
              visit(clReleaseProgram) visit(clCreateKernel) visit(clReleaseKernel) visit(clSetKernelArg)  \
                  visit(clCreateBuffer) visit(clReleaseMemObject) visit(clEnqueueWriteBuffer)             \
                      visit(clEnqueueReadBuffer) visit(clEnqueueFillBuffer) visit(clEnqueueNDRangeKernel) \
                          visit(clFlush) visit(clGetEventInfo) visit(clReleaseEvent)

struct OpenClLibrary {
#define VOXMELT_MEMBER(name) decltype(&::name) name = nullptr;
  VOXMELT_OPEN_CL_FUNCTIONS(VOXMELT_MEMBER)
#undef VOXMELT_MEMBER
};

// Returns null where there is no library, or one that lacks a function.
const OpenClLibrary* open_cl_library();

}  // namespace voxmelt::gpu
