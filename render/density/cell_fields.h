// What each cell contributes to the picture, before filtering (paper, section 5).
//
// Intensities are the paper's 0..255 with eight fraction bits (u16, kFull = 255 * 256): linear in the
// amount of a cell, full at kOne and above. Arrays are [z][y][x], x fastest.
//
// The ground (columns.h) is filled below and beside matter, because otherwise the surface of a thin film
// would sink into the floor and the rim of a puddle would curl. Next to dry ground the filling ends a little
// below the ground, so that the surface closes where the ground hides it.
//
// Puddles are shifted up or down by a fraction of a cell to remove their terraces (levels.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/brick.h"
#include "render/density/columns.h"
#include "render/density/values.h"

namespace voxmelt::render {

inline constexpr std::int32_t kFull = 255 * 256;

enum Channel { kIntensity, kSolid, kLiquid, kHeat, kObstacle, kChannels };
inline std::uint8_t flag_of(int channel) { return static_cast<std::uint8_t>(1 << channel); }
inline constexpr std::uint8_t kAllChannels = (1 << kChannels) - 1;

// One array per channel; that of the obstacles is empty where there is none.
struct ChannelValues {
  Values<std::uint16_t> intensity;  // matter, obstacles and the ground that carries them
  Values<std::uint16_t> solid;      // the solid's part of the intensity
  Values<std::uint16_t> liquid;     // the liquid's part
  Values<std::uint16_t> heat;       // liquid * temperature, so that thin cells weigh little
  Values<std::uint16_t> obstacle;   // the obstacles' part

  ChannelValues() = default;
  explicit ChannelValues(std::size_t cells) : intensity(cells), solid(cells), liquid(cells), heat(cells) {}

  std::array<Values<std::uint16_t>*, kChannels> all() {
    return {&intensity, &solid, &liquid, &heat, &obstacle};
  }
  std::array<const Values<std::uint16_t>*, kChannels> all() const {
    return {&intensity, &solid, &liquid, &heat, &obstacle};
  }
  friend bool operator==(const ChannelValues&, const ChannelValues&) = default;
};

class CellFields : public ChannelValues {
 public:
  static constexpr std::int32_t kMixed = -1;

  CellFields() = default;
  explicit CellFields(const state::Grid& size);  // an empty volume's

  state::Grid grid, bricks;
  std::vector<float> ground;   // [z][x]: height of the ground in cells, 0 where there is none
  std::vector<float> wetness;  // [z][x]: 0 dry ground .. 1 covered by at least a thin film

  // Takes over another state of the same size. Returns which channels changed in which bricks.
  BrickFlags update(const state::Volume& volume, int smooth, const scene::Terrain& terrain,
                    cpu::Workers& workers);

  // The one value that a channel has in all of a brick, or kMixed.
  std::int32_t uniform(int channel, std::size_t brick) const {
    return uniform_[static_cast<std::size_t>(channel)][brick];
  }

  friend bool operator==(const CellFields&, const CellFields&) = default;

 private:
  friend class SliceWriter;
  std::array<std::vector<std::int32_t>, kChannels> uniform_;
  std::vector<std::uint8_t> written_;  // [z][y]: in which channels a row may hold anything but 0
};

// The fields of a volume without a field before it. `smooth`: how much the terraces of puddles are smoothed,
// 0: not at all.
CellFields cell_fields(const state::Volume& volume, int smooth = 0, const scene::Terrain& terrain = {});

}  // namespace voxmelt::render
