#include "kernel/engine/gpu/cuda_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace voxmelt::gpu {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  return function != nullptr;
}

// The driver's functions keep their old forms under their old names. These are the forms that cuda_library.h
// has.
std::optional<CudaLibrary> loaded_driver() {
  void* const library = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return {};
  CudaLibrary all;
  const bool whole =
      find(library, "cuInit", all.cuInit) && find(library, "cuDriverGetVersion", all.cuDriverGetVersion) &&
      find(library, "cuGetErrorString", all.cuGetErrorString) &&
      find(library, "cuDeviceGetCount", all.cuDeviceGetCount) &&
      find(library, "cuDeviceGet", all.cuDeviceGet) &&
      find(library, "cuDeviceGetName", all.cuDeviceGetName) &&
      find(library, "cuDeviceGetAttribute", all.cuDeviceGetAttribute) &&
      find(library, "cuDeviceTotalMem_v2", all.cuDeviceTotalMem) &&
      find(library, "cuDevicePrimaryCtxRetain", all.cuDevicePrimaryCtxRetain) &&
      find(library, "cuDevicePrimaryCtxRelease_v2", all.cuDevicePrimaryCtxRelease) &&
      find(library, "cuCtxSetCurrent", all.cuCtxSetCurrent) &&
      find(library, "cuStreamCreate", all.cuStreamCreate) &&
      find(library, "cuStreamQuery", all.cuStreamQuery) &&
      find(library, "cuStreamDestroy_v2", all.cuStreamDestroy) &&
      find(library, "cuMemAlloc_v2", all.cuMemAlloc) && find(library, "cuMemFree_v2", all.cuMemFree) &&
      find(library, "cuMemHostAlloc", all.cuMemHostAlloc) &&
      find(library, "cuMemFreeHost", all.cuMemFreeHost) &&
      find(library, "cuMemsetD32Async", all.cuMemsetD32Async) &&
      find(library, "cuMemcpyHtoDAsync_v2", all.cuMemcpyHtoDAsync) &&
      find(library, "cuMemcpyDtoHAsync_v2", all.cuMemcpyDtoHAsync) &&
      find(library, "cuModuleLoadData", all.cuModuleLoadData) &&
      find(library, "cuModuleUnload", all.cuModuleUnload) &&
      find(library, "cuModuleGetFunction", all.cuModuleGetFunction) &&
      find(library, "cuLaunchKernel", all.cuLaunchKernel);
  if (!whole) return {};
  return all;
}

// The compiler belongs to the toolkit, and its name ends with the toolkit's number. The newest comes first. A
// toolkit need not be where the system looks for libraries.
void* compiler() {
  std::string folders[] = {"", "", "/usr/local/cuda/lib64/"};
  if (const char* home = std::getenv("CUDA_HOME")) folders[1] = std::string(home) + "/lib64/";
  for (const std::string& folder : folders)
    for (const char* end : {".13", ".12", ".11.2", ""})
      if (void* found = dlopen((folder + "libnvrtc.so" + end).c_str(), RTLD_NOW | RTLD_LOCAL)) return found;
  return nullptr;
}

std::optional<NvrtcLibrary> loaded_compiler() {
  void* const library = compiler();
  if (library == nullptr) return {};
  NvrtcLibrary all;
  const bool whole = find(library, "nvrtcVersion", all.nvrtcVersion) &&
                     find(library, "nvrtcGetErrorString", all.nvrtcGetErrorString) &&
                     find(library, "nvrtcCreateProgram", all.nvrtcCreateProgram) &&
                     find(library, "nvrtcDestroyProgram", all.nvrtcDestroyProgram) &&
                     find(library, "nvrtcCompileProgram", all.nvrtcCompileProgram) &&
                     find(library, "nvrtcGetProgramLogSize", all.nvrtcGetProgramLogSize) &&
                     find(library, "nvrtcGetProgramLog", all.nvrtcGetProgramLog) &&
                     find(library, "nvrtcGetCUBINSize", all.nvrtcGetCUBINSize) &&
                     find(library, "nvrtcGetCUBIN", all.nvrtcGetCUBIN);
  if (!whole) return {};
  return all;
}

}  // namespace

const CudaLibrary* cuda_library() {
  static const std::optional<CudaLibrary> library = loaded_driver();
  return library ? &*library : nullptr;
}

const NvrtcLibrary* nvrtc_library() {
  static const std::optional<NvrtcLibrary> library = loaded_compiler();
  return library ? &*library : nullptr;
}

}  // namespace voxmelt::gpu
