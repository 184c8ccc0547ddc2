// Our declarations of NVIDIA's functions are those of its headers, where these are installed: as many
// arguments, each of the same size and kind.
#include <cuda.h>
#include <gtest/gtest.h>
#include <nvrtc.h>

#include <type_traits>

#include "kernel/engine/gpu/cuda_library.h"

namespace voxmelt::gpu {
namespace {

template <class Ours, class Theirs>
constexpr bool kAlike =
    sizeof(Ours) == sizeof(Theirs) && std::is_pointer_v<Ours> == std::is_pointer_v<Theirs>;

template <class Ours, class Theirs>
struct SameCall : std::false_type {};
template <class R, class... A, class S, class... B>
requires(sizeof...(A) == sizeof...(B)) struct SameCall<R (*)(A...), S(B...)>
    : std::bool_constant<kAlike<R, S> && (kAlike<A, B> && ...)> {
};

// Their header gives some functions another name: the newest form.
#define SAME(library, ours, theirs) \
  static_assert(SameCall<decltype(library::ours), std::remove_pointer_t<decltype(&::theirs)>>::value, #ours)

SAME(CudaLibrary, cuInit, cuInit);
SAME(CudaLibrary, cuDriverGetVersion, cuDriverGetVersion);
SAME(CudaLibrary, cuGetErrorString, cuGetErrorString);
SAME(CudaLibrary, cuDeviceGetCount, cuDeviceGetCount);
SAME(CudaLibrary, cuDeviceGet, cuDeviceGet);
SAME(CudaLibrary, cuDeviceGetName, cuDeviceGetName);
SAME(CudaLibrary, cuDeviceGetAttribute, cuDeviceGetAttribute);
SAME(CudaLibrary, cuDeviceTotalMem, cuDeviceTotalMem_v2);
SAME(CudaLibrary, cuDevicePrimaryCtxRetain, cuDevicePrimaryCtxRetain);
SAME(CudaLibrary, cuDevicePrimaryCtxRelease, cuDevicePrimaryCtxRelease_v2);
SAME(CudaLibrary, cuCtxSetCurrent, cuCtxSetCurrent);
SAME(CudaLibrary, cuStreamCreate, cuStreamCreate);
SAME(CudaLibrary, cuStreamQuery, cuStreamQuery);
SAME(CudaLibrary, cuStreamDestroy, cuStreamDestroy_v2);
SAME(CudaLibrary, cuMemAlloc, cuMemAlloc_v2);
SAME(CudaLibrary, cuMemFree, cuMemFree_v2);
SAME(CudaLibrary, cuMemHostAlloc, cuMemHostAlloc);
SAME(CudaLibrary, cuMemFreeHost, cuMemFreeHost);
SAME(CudaLibrary, cuMemsetD32Async, cuMemsetD32Async);
SAME(CudaLibrary, cuMemcpyHtoDAsync, cuMemcpyHtoDAsync_v2);
SAME(CudaLibrary, cuMemcpyDtoHAsync, cuMemcpyDtoHAsync_v2);
SAME(CudaLibrary, cuModuleLoadData, cuModuleLoadData);
SAME(CudaLibrary, cuModuleUnload, cuModuleUnload);
SAME(CudaLibrary, cuModuleGetFunction, cuModuleGetFunction);
SAME(CudaLibrary, cuLaunchKernel, cuLaunchKernel);
SAME(NvrtcLibrary, nvrtcVersion, nvrtcVersion);
SAME(NvrtcLibrary, nvrtcGetErrorString, nvrtcGetErrorString);
SAME(NvrtcLibrary, nvrtcCreateProgram, nvrtcCreateProgram);
SAME(NvrtcLibrary, nvrtcDestroyProgram, nvrtcDestroyProgram);
SAME(NvrtcLibrary, nvrtcCompileProgram, nvrtcCompileProgram);
SAME(NvrtcLibrary, nvrtcGetProgramLogSize, nvrtcGetProgramLogSize);
SAME(NvrtcLibrary, nvrtcGetProgramLog, nvrtcGetProgramLog);
SAME(NvrtcLibrary, nvrtcGetCUBINSize, nvrtcGetCUBINSize);
SAME(NvrtcLibrary, nvrtcGetCUBIN, nvrtcGetCUBIN);

TEST(CudaHeaders, HaveTheSameNumbers) {
  EXPECT_EQ(kCudaSuccess, CUDA_SUCCESS);
  EXPECT_EQ(kCudaOutOfMemory, CUDA_ERROR_OUT_OF_MEMORY);
  EXPECT_EQ(kCudaNotReady, CUDA_ERROR_NOT_READY);
  EXPECT_EQ(kCudaMultiprocessors, CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT);
  EXPECT_EQ(kCudaMajor, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR);
  EXPECT_EQ(kCudaMinor, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR);
  EXPECT_EQ(kCudaNonBlocking, unsigned{CU_STREAM_NON_BLOCKING});
  EXPECT_EQ(sizeof(CudaAddress), sizeof(CUdeviceptr));
}

}  // namespace
}  // namespace voxmelt::gpu
