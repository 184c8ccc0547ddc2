// The functions of NVIDIA's driver and of its compiler at run time, found when somebody asks for a device. So
// a build needs no header of theirs, and a program starts without them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace voxmelt::gpu {

// The driver's types. Whatever it gives is opaque, and goes back to it.
using CudaResult = int;  // 0 is success
using CudaDeviceNumber = int;
using CudaAddress = std::uint64_t;
using CudaContext = struct CudaContextOfDriver*;
using CudaStream = struct CudaStreamOfDriver*;
using CudaModule = struct CudaModuleOfDriver*;
using CudaFunction = struct CudaFunctionOfDriver*;
inline constexpr CudaResult kCudaSuccess = 0, kCudaOutOfMemory = 2, kCudaNotReady = 600;
inline constexpr int kCudaMultiprocessors = 16, kCudaMajor = 75, kCudaMinor = 76;  // attributes of a device
inline constexpr unsigned kCudaNonBlocking = 1;                                    // a stream of its own

struct CudaLibrary {
  CudaResult (*cuInit)(unsigned) = nullptr;
  CudaResult (*cuDriverGetVersion)(int*) = nullptr;
  CudaResult (*cuGetErrorString)(CudaResult, const char**) = nullptr;
  CudaResult (*cuDeviceGetCount)(int*) = nullptr;
  CudaResult (*cuDeviceGet)(CudaDeviceNumber*, int) = nullptr;
  CudaResult (*cuDeviceGetName)(char*, int, CudaDeviceNumber) = nullptr;
  CudaResult (*cuDeviceGetAttribute)(int*, int, CudaDeviceNumber) = nullptr;
  CudaResult (*cuDeviceTotalMem)(std::size_t*, CudaDeviceNumber) = nullptr;
  CudaResult (*cuDevicePrimaryCtxRetain)(CudaContext*, CudaDeviceNumber) = nullptr;
  CudaResult (*cuDevicePrimaryCtxRelease)(CudaDeviceNumber) = nullptr;
  CudaResult (*cuCtxSetCurrent)(CudaContext) = nullptr;
  CudaResult (*cuStreamCreate)(CudaStream*, unsigned) = nullptr;
  CudaResult (*cuStreamQuery)(CudaStream) = nullptr;
  CudaResult (*cuStreamDestroy)(CudaStream) = nullptr;
  CudaResult (*cuMemAlloc)(CudaAddress*, std::size_t) = nullptr;
  CudaResult (*cuMemFree)(CudaAddress) = nullptr;
  CudaResult (*cuMemHostAlloc)(void**, std::size_t, unsigned) = nullptr;
  CudaResult (*cuMemFreeHost)(void*) = nullptr;
  CudaResult (*cuMemsetD32Async)(CudaAddress, unsigned, std::size_t, CudaStream) = nullptr;
  CudaResult (*cuMemcpyHtoDAsync)(CudaAddress, const void*, std::size_t, CudaStream) = nullptr;
  CudaResult (*cuMemcpyDtoHAsync)(void*, CudaAddress, std::size_t, CudaStream) = nullptr;
  CudaResult (*cuModuleLoadData)(CudaModule*, const void*) = nullptr;
  CudaResult (*cuModuleUnload)(CudaModule) = nullptr;
  CudaResult (*cuModuleGetFunction)(CudaFunction*, CudaModule, const char*) = nullptr;
  CudaResult (*cuLaunchKernel)(CudaFunction, unsigned, unsigned, unsigned, unsigned, unsigned, unsigned,
                               unsigned, CudaStream, void**, void**) = nullptr;
};

using NvrtcResult = int;  // 0 is success
using NvrtcProgram = struct NvrtcProgramOfCompiler*;

struct NvrtcLibrary {
  NvrtcResult (*nvrtcVersion)(int*, int*) = nullptr;
  const char* (*nvrtcGetErrorString)(NvrtcResult) = nullptr;
  NvrtcResult (*nvrtcCreateProgram)(NvrtcProgram*, const char*, const char*, int, const char* const*,
                                    const char* const*) = nullptr;
  NvrtcResult (*nvrtcDestroyProgram)(NvrtcProgram*) = nullptr;
  NvrtcResult (*nvrtcCompileProgram)(NvrtcProgram, int, const char* const*) = nullptr;
  NvrtcResult (*nvrtcGetProgramLogSize)(NvrtcProgram, std::size_t*) = nullptr;
  NvrtcResult (*nvrtcGetProgramLog)(NvrtcProgram, char*) = nullptr;
  NvrtcResult (*nvrtcGetCUBINSize)(NvrtcProgram, std::size_t*) = nullptr;
  NvrtcResult (*nvrtcGetCUBIN)(NvrtcProgram, char*) = nullptr;
};

// Return null where there is no library, or one that lacks a function.
const CudaLibrary* cuda_library();
const NvrtcLibrary* nvrtc_library();

}  // namespace voxmelt::gpu
