// A layer of OpenCL (OPENCL_LAYERS) between a program and the driver, for tests of drivers that hang. The
// environment says how many seconds it takes to build a program (SLOW_BUILD).
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <CL/cl_icd.h>
#include <CL/cl_layer.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace {

const cl_icd_dispatch* driver = nullptr;
cl_icd_dispatch layer;

cl_int CL_API_CALL build_program(cl_program program, cl_uint count, const cl_device_id* devices,
                                 const char* options, void(CL_CALLBACK* told)(cl_program, void*),
                                 void* user) {
  if (const char* seconds = std::getenv("SLOW_BUILD"))
    std::this_thread::sleep_for(std::chrono::seconds(std::atoi(seconds)));
  return driver->clBuildProgram(program, count, devices, options, told, user);
}

}  // namespace

extern "C" {

CL_API_ENTRY cl_int CL_API_CALL clGetLayerInfo(cl_layer_info what, size_t size, void* value, size_t* needed) {
  if (what != CL_LAYER_API_VERSION) return CL_INVALID_VALUE;
  if (value != nullptr && size >= sizeof(cl_layer_api_version))
    *static_cast<cl_layer_api_version*>(value) = CL_LAYER_API_VERSION_100;
  if (needed != nullptr) *needed = sizeof(cl_layer_api_version);
  return CL_SUCCESS;
}

CL_API_ENTRY cl_int CL_API_CALL clInitLayer(cl_uint entries, const cl_icd_dispatch* below,
                                            cl_uint* own_entries, const cl_icd_dispatch** own) {
  static_cast<void>(entries);
  driver = below;
  layer = *below;
  layer.clBuildProgram = build_program;
  *own_entries = sizeof layer / sizeof(void*);
  *own = &layer;
  return CL_SUCCESS;
}
}
