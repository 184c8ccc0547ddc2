#include "app/visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernel/engine/visibility/kept_rays.h"
#include "render/visibility/embree_caster.h"

namespace voxmelt::app {
namespace {

// Measured with bench/visibility_bench.cpp. Below this Embree follows rays no faster than two levels.
constexpr std::size_t kLeastEmbreeCells = std::size_t{1} << 26;

bool moves(const rule::HeatSource& source) {
  return std::any_of(source.keys.begin(), source.keys.end(), [&](const rule::SourceKey& key) {
    const rule::SourceKey& first = source.keys.front();
    const auto differ = [](const rule::Position& a, const rule::Position& b) {
      return a.x != b.x || a.y != b.y || a.z != b.z;
    };
    return differ(key.at, first.at) || differ(key.direction, first.direction) || key.radius != first.radius;
  });
}

}  // namespace

void add_visibility(CLI::App& command, Common& common) {
  command
      .add_option("--visibility", common.visibility,
                  "who follows the rays of heat sources; no result depends on it")
      ->check(CLI::IsMember({"auto", "walk", "two-level", "embree"}))
      ->capture_default_str();
}

// Of a source at rest few rays are cast again, fewer than pay for a refit of Embree's tree.
VisibilityChoice choose_visibility(const std::string& asked, const rule::Heat& heat,
                                   const state::Grid& grid) {
  if (asked == "embree" && !visibility::EmbreeCaster::built_in())
    throw UsageError("--visibility embree: error: this build has no Embree; it has walk and two-level");
  if (asked != "auto") return {asked, "asked for"};
  if (!visibility::EmbreeCaster::built_in()) return {"two-level", "this build has no Embree"};
  if (grid.cells() < kLeastEmbreeCells)
    return {"two-level", fmt::format("the grid has less than {} cells", kLeastEmbreeCells)};
  if (std::none_of(heat.sources.begin(), heat.sources.end(), moves))
    return {"two-level", "no source moves, so that few rays are cast again"};
  return {"embree", "a source moves in a large grid, so that all rays are cast each time"};
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
