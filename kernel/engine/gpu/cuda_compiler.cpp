#include "kernel/engine/gpu/cuda_compiler.h"

#include <cstddef>
#include <memory>
#include <vector>

#include "kernel/engine/gpu/device.h"
#include "kernel/engine/gpu/program_text.h"

namespace voxmelt::gpu {
namespace {

void check(const NvrtcLibrary& compiler, NvrtcResult code, const char* what) {
  if (code != 0) throw DeviceError(std::string("CUDA, ") + what + ": " + compiler.nvrtcGetErrorString(code));
}

std::vector<std::string> words_of(const std::string& options, int architecture, bool says) {
  std::vector<std::string> words{"--gpu-architecture=sm_" + std::to_string(architecture), "--std=c++17",
                                 "-w"};
  if (says) words.emplace_back("--ptxas-options=-v");
  const std::string define = " -D ";
  for (std::size_t at = options.find(define); at != std::string::npos;) {
    const std::size_t begin = at + define.size();
    at = options.find(define, begin);
    words.push_back("--define-macro=" + options.substr(begin, at == std::string::npos ? at : at - begin));
  }
  return words;
}

std::string log_of(const NvrtcLibrary& compiler, NvrtcProgram program) {
  std::size_t size = 0;
  check(compiler, compiler.nvrtcGetProgramLogSize(program, &size), "ask what the compiler says");
  std::string log(size, '\0');
  check(compiler, compiler.nvrtcGetProgramLog(program, log.data()), "ask what the compiler says");
  return log;
}

}  // namespace

std::string compiled_for_cuda(const NvrtcLibrary& compiler, const std::string& text,
                              const std::string& options, int architecture, std::string* said) {
  const std::vector<std::string> words = words_of(options, architecture, said != nullptr);
  std::vector<const char*> begins;
  begins.reserve(words.size());
  for (const std::string& word : words) begins.push_back(word.c_str());

  NvrtcProgram program = nullptr;
  const std::string whole = cuda_dialect() + text;
  check(compiler, compiler.nvrtcCreateProgram(&program, whole.c_str(), "voxmelt", 0, nullptr, nullptr),
        "take the program");
  const auto destroy = [&](NvrtcProgram* one) { compiler.nvrtcDestroyProgram(one); };
  const std::unique_ptr<NvrtcProgram, decltype(destroy)> owned(&program, destroy);
  const NvrtcResult result =
      compiler.nvrtcCompileProgram(program, static_cast<int>(begins.size()), begins.data());
  const std::string log = log_of(compiler, program);
  if (result != 0)
    throw DeviceError(std::string("CUDA: ") + compiler.nvrtcGetErrorString(result) + ": " +
                      log.substr(0, 4096));
  if (said != nullptr) *said = log;
  std::size_t size = 0;
  check(compiler, compiler.nvrtcGetCUBINSize(program, &size), "take machine code");
  std::string code(size, '\0');
  check(compiler, compiler.nvrtcGetCUBIN(program, code.data()), "take machine code");
  return code;
}

}  // namespace voxmelt::gpu
