// NVIDIA's compiler takes the picture's kernels, where it is installed. It needs no card.
#include <gtest/gtest.h>

#include <string>

#include "kernel/engine/gpu/cuda_compiler.h"
#include "render/device/kernels.h"
#include "render/device/program_text.h"
#include "tests/rounds.h"

namespace voxmelt::render {
namespace {

TEST(CudaCompiler, TakesTheKernelsOfPictures) {
  if (!all_rounds()) GTEST_SKIP() << "it takes ten seconds: ./test.sh --slow -R render_device";
  if (gpu::nvrtc_library() == nullptr)
    GTEST_SKIP() << "no compiler of CUDA here (libnvrtc.so, of its toolkit)";
  std::string said;
  const std::string code = gpu::compiled_for_cuda(*gpu::nvrtc_library(), program_text(), "", 90, &said);
  EXPECT_TRUE(
      code.starts_with("\x7f"
                       "ELF"));
  for (const char* kernel : kPictureKernelNames)
    EXPECT_NE(said.find("Compiling entry function '" + std::string(kernel) + "'"), std::string::npos)
        << kernel;
}

}  // namespace
}  // namespace voxmelt::render
