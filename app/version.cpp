#include "app/version.h"

#include <fmt/format.h>

#include "render/image/video.h"

namespace voxmelt::app {
namespace {

std::string compiler() {
#ifdef __clang__
  return fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string instruction_sets() {
  std::string found;
#if defined(__x86_64__)
  const auto add = [&](bool has, const char* name) {
    if (has) found += found.empty() ? name : std::string(" ") + name;
  };
  add(__builtin_cpu_supports("sse4.2"), "sse4.2");
  add(__builtin_cpu_supports("avx2"), "avx2");
  add(__builtin_cpu_supports("avx512bw"), "avx512bw");
#endif
  return found.empty() ? "none of those this build looks for" : found;
}

}  // namespace

std::string version_number() { return VOXMELT_VERSION; }

std::string version_text() {
  return fmt::format("voxmelt {}\ncompiler: {}\nprocessor: {}\nffmpeg: {}", version_number(), compiler(),
                     instruction_sets(), render::ffmpeg_found() ? "found (MP4)" : "not found (no MP4)");
}

}  // namespace voxmelt::app
