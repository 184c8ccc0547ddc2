#include "app/version.h"

#include <fmt/format.h>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/run/io/vdb.h"
#include "kernel/scene/shape/heightfield.h"
#include "render/frames/webp_bytes.h"
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

#ifdef VOXMELT_PYTHON_VERSION  // set where the package is built
constexpr const char* kPython = "package for " VOXMELT_PYTHON_VERSION;
#else
constexpr const char* kPython = "no package (apt-get install pybind11-dev python3-dev)";
#endif

std::string instruction_sets() {
  std::string found;
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets) {
    if (!row.supported()) continue;
    if (!found.empty()) found += ' ';
    found += row.name;
  }
  return found.empty() ? "none of those this build looks for" : found;
}

}  // namespace

std::string version_number() { return VOXMELT_VERSION; }

std::string version_text() {
  return fmt::format(
      "voxmelt {}\ncompiler: {}\nprocessor: {}\nffmpeg: {}\nlibwebp: {}\nlibtiff: {}\nOpenVDB: {}\nPython: "
      "{}",
      version_number(), compiler(), instruction_sets(),
      render::ffmpeg_found() ? "found (MP4)" : "not found (no MP4: apt-get install ffmpeg)",
      render::webp_is_built_in() ? "built in (WebP)" : "not built in (no WebP: apt-get install libwebp-dev)",
      scene::tiff_is_built_in() ? "built in (GeoTIFF)"
                                : "not built in (no GeoTIFF: apt-get install libtiff-dev)",
      io::missing_for_vdb().empty() ? "found (VDB)" : "not found (no VDB: apt-get install libopenvdb-dev)",
      kPython);
}

}  // namespace voxmelt::app
