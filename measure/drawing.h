// A picture of a scene is timed part by part: the field that is drawn, light and bricks, the drawing, and the
// PNG file. The bytes of every instruction set are checked before it is timed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/scene/scene.h"
#include "measure/rounds.h"
#include "measure/workloads.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::measure {

inline constexpr int kPictureSide = 512;  // pixels
inline constexpr int kPictureSteps = 3;   // steps between two pictures
using render::kSettingNames;
using render::kSettings;
using PerSetting = std::array<double, kSettings.size()>;

// A drawer has the packets, and the loops of a processor that has this set.
struct Drawer {
  cpu::InstructionSet set;
  const render::Packets* packets;
};
Drawer drawer_of(cpu::InstructionSet set);

// Times are in seconds: processor time on one thread, time of the clock on more.
struct DrawingTiming {
  cpu::InstructionSet set{};
  int threads = 1;
  double field = 0, light = 0;  // after kPictureSteps steps; `light` includes bricks
  double unchanged = 0;         // field and light, after no step
  PerSetting draw{};
};

struct Drawing {
  std::string workload;
  state::Grid grid;
  int rounds = 0;
  int bricks = 0;                                     // bricks of the field that an update filters
  std::array<std::int64_t, kSettings.size()> rays{};  // rays of a picture, as far as they may meet something
  double encode = 0;                                  // seconds, for the picture at `normal`
  std::size_t png_bytes = 0;
  std::vector<DrawingTiming> timings;

  double nanoseconds_per_ray(const DrawingTiming& timing, std::size_t setting) const {
    return 1e9 * timing.draw[setting] / static_cast<double>(rays[setting]);
  }
};

// Returns the scene's camera, for a square picture.
scene::Camera square_camera(scene::Camera camera, int side);

// Throws Mismatch if an updated field is not that of a fresh one. It also throws if a picture differs from
// another one of the same state, or, at a quarter of the size, from that of the plain painter.
Drawing measure_drawing(const Workload& workload, const scene::Scene& scene,
                        const std::vector<Drawer>& drawers, const std::vector<int>& threads,
                        const Rounds& rounds);

}  // namespace voxmelt::measure
