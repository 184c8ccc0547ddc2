// This table has the scenes in the middle of their melt whose pictures the matrix draws, and the machines.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/check/verify_picture.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel::raycast {

using SceneStep = std::pair<std::string, std::uint32_t>;

// Lists the showcase (docs/results/performance.md has the steps), and the scenes in which every rule acts.
inline const std::vector<SceneStep>& drawn_scenes() {
  static const std::vector<SceneStep> scenes{{"cello", 1048},         {"goblet", 1100},
                                             {"lava", 1200},          {"bunny", 896},
                                             {"cello_viscous", 1048}, {"goblet_viscous", 1100},
                                             {"lava_viscous", 1200},  {"bunny_viscous", 896},
                                             {"proving_ground", 40},  {"proving_ground_viscous", 40}};
  return scenes;
}

// Holds a scene that has melted for the given number of steps. docs/verification.md counts its pictures: its
// pieces stay where they are.
class MidMelt {
 public:
  explicit MidMelt(const SceneStep& which)
      : scene_(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (which.first + ".toml"),
                           {"pieces.fall=false"})),
        simulation_(scene_.parameters, std::move(scene_.initial), run::implementations().widest()) {
    while (simulation_.steps_done() < which.second) simulation_.step();
  }
  const state::Volume& volume() const { return simulation_.volume(); }
  const scene::Scene& scene() const { return scene_; }

  // The views are the scene's own, one from its other side and above, and one from below.
  static constexpr int kViews = 3;
  scene::Camera camera(int view, int pixels) const {
    scene::Camera result = scene_.camera;
    result.width = result.height = pixels;
    if (view == 1) {
      result.azimuth += 160;
      result.elevation = 40;
    }
    if (view == 2) {
      result.azimuth += 75;
      result.elevation = -12;
    }
    return result;
  }
  PictureReport draw(const scene::Camera& camera, const PictureOptions& options,
                     render::Setting setting = render::Setting::normal) const {
    return verify_picture({volume(), scene_.look, scene_.light, scene_.terrain, camera, setting}, options);
  }

 private:
  scene::Scene scene_;
  run::Simulation simulation_;
};

// Describes a run of the matrix by the indices of its values in the arrays below.
struct MatrixRun {
  int pipes, view, seed, depth, size, ways;

  static constexpr std::array<int, 3> kPipes{1, 2, 4}, kSeeds{0, 1, 2};
  static constexpr std::array<int, 2> kDepths{1, 64};  // the least depth, and a generous one
  static constexpr std::array<int, 2> kLines{16, 256};
  static constexpr std::array<int, 2> kWays{1, 4};

  Configuration configuration() const {
    const auto at = [](const auto& values, int i) { return values[static_cast<std::size_t>(i)]; };
    Configuration c;
    c.pipes = at(kPipes, pipes);
    c.stall_seed = static_cast<std::uint64_t>(at(kSeeds, seed));
    c.fifo_depth = at(kDepths, depth);
    for (CacheShape* cache : {&c.levels, &c.matter, &c.light, &c.ground}) {
      cache->ways = at(kWays, ways);
      cache->sets = at(kLines, size) / cache->ways;
    }
    return c;
  }
  std::string text() const {
    const Configuration c = configuration();
    return "view " + std::to_string(view) + ", pipes " + std::to_string(c.pipes) + ", depth " +
           std::to_string(c.fifo_depth) + ", stall seed " + std::to_string(c.stall_seed) + ", caches of " +
           std::to_string(c.levels.sets) + " sets of " + std::to_string(c.levels.ways) + " ways";
  }
};

// Every pair of values of two parameters occurs.
inline std::vector<MatrixRun> covering_array() {
  std::vector<MatrixRun> runs;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 2; ++k)
        runs.push_back({i, j, (i + j + k) % 3, k, (i + j + k) % 2, (i * j + k) % 2});
  return runs;
}
inline std::vector<MatrixRun> full_product() {
  std::vector<MatrixRun> runs;
  runs.reserve(3 * 3 * 3 * 2 * 2 * 2);
  for (int i = 0; i < 3 * 3 * 3 * 2 * 2 * 2; ++i)
    runs.push_back({i % 3, i / 3 % 3, i / 9 % 3, i / 27 % 2, i / 54 % 2, i / 108});
  return runs;
}

inline std::string text_of(const PictureReport& report) {
  return (report.difference ? text_of(*report.difference) : "") + report.hang +
         std::to_string(report.different_bytes) + " pixels differ";
}

}  // namespace voxmelt::hwmodel::raycast
