#include "app/visibility.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "kernel/engine/visibility/kept_rays.h"
#include "render/visibility/embree_caster.h"

namespace voxmelt::app {
void add_visibility(CLI::App& command, Common& common) {
  command
      .add_option("--visibility", common.visibility,
                  "who follows the rays of heat sources; no result depends on it")
      ->check(CLI::IsMember({"auto", "walk", "two-level", "embree"}))
      ->capture_default_str();
}

VisibilityChoice choose_visibility(const std::string& asked) {
  if (asked == "embree" && !visibility::EmbreeCaster::built_in())
    throw UsageError("--visibility embree: error: this build has no Embree; it has walk and two-level");
  if (asked != "auto") return {asked, "asked for"};
  // bench/visibility_bench.cpp, from 64 to 1024 cells along a side: docs/decisions/rays-only-what-changed.md
  return {"two-level", "no slower than embree at any size of grid that was measured"};
}

std::unique_ptr<visibility::Provider> make_provider(const VisibilityChoice& choice, int threads) {
  if (choice.name == "walk") return std::make_unique<visibility::VoxelWalkProvider>(threads);
  std::unique_ptr<visibility::Caster> caster;
  if (choice.name == "embree") {
    caster = std::make_unique<visibility::EmbreeCaster>();
  } else {
    caster = std::make_unique<visibility::TwoLevelCaster>();
  }
  return std::make_unique<visibility::KeptRays>(std::move(caster), threads);
}

}  // namespace voxmelt::app
