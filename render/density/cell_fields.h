// Each cell contributes to the picture, before filtering (docs/picture/field.md, sections 2 to 5).
//
// Intensities are the paper's 0..255 with eight fraction bits (u16, kFull = 255 * 256). They are linear in
// the amount of a cell, and full at kOne and above. Arrays are [z][y][x], x fastest.
//
// The ground (columns.h) is filled below and beside matter. Otherwise the surface of a thin film would sink
// into the floor, and the rim of a puddle would curl. Next to dry ground the filling ends a little below the
// ground, so that the surface closes where the ground hides it.
//
// Puddles are shifted up or down by a fraction of a cell to remove their terraces (levels.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/brick.h"
#include "render/density/columns.h"
#include "render/density/loops.h"
#include "render/density/tones.h"
#include "render/density/values.h"

namespace voxmelt::render {

inline constexpr std::int32_t kFull = 255 * 256;

enum Channel { kIntensity, kSolid, kLiquid, kHeat, kObstacle, kChannels };
inline std::uint8_t flag_of(int channel) { return static_cast<std::uint8_t>(1 << channel); }
inline constexpr std::uint8_t kAllChannels = (1 << kChannels) - 1;

// Holds one array per channel. The array of the obstacles is empty if there are none.
struct ChannelValues {
  Values<std::uint16_t> intensity;  // matter, obstacles and the ground that carries them
  Values<std::uint16_t> solid;      // the solid's part of the intensity
  Values<std::uint16_t> liquid;     // the liquid's part
  Values<std::uint16_t> heat;       // liquid * temperature, so that thin cells weigh little;
                                    // without glow solid * tone, or 0
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

// Tells in which channels an update has changed a brick, and where. Heat has a part of its own, because it
// changes nearly everywhere and shifts no surface.
struct BrickChange {
  std::uint8_t channels = 0;
  BrickPart matter, heat;
};

class CellFields : public ChannelValues {
 public:
  static constexpr std::int32_t kMixed = -1;

  CellFields() = default;
  explicit CellFields(const state::Grid& size);  // fields of an empty volume

  state::Grid grid, bricks;

  struct Wanted {
    int smooth = 0;              // smoothing of the terraces of puddles, 0 for none
    bool heat = false;           // if false, the heat is 0 everywhere
    std::optional<Tones> tones;  // if given, there is no heat, but solid * tone
  };
  // Takes over another state of the same size. Parts that are known to be unchanged are left out.
  void update(const state::Volume& volume, const state::ChangedBricks::Seen& seen, const Wanted& wanted,
              const scene::Terrain& terrain, cpu::Workers& workers, const Loops& with = loops());

  // These tell what the last update has changed. The bricks come in ascending order.
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  const BrickChange& change(std::uint32_t brick) const { return changes_[brick]; }

  const Columns& columns() const { return columns_; }

  // Returns the one value that a channel has in all of a brick, or kMixed.
  std::int32_t uniform(int channel, std::size_t brick) const { return uniform_[channel][brick]; }

  friend bool operator==(const CellFields& a, const CellFields& b) {
    return a.grid == b.grid && static_cast<const ChannelValues&>(a) == b && a.columns_ == b.columns_ &&
           a.uniform_ == b.uniform_;
  }

 private:
  friend class BrickWriter;
  bool same_terrain(const scene::Terrain& terrain) const;
  // Takes over the channels of matter in the marked bricks of a slice. Notes in `news` which columns must be
  // looked at anew.
  template <class Marked>
  void take_matter(const state::Volume& volume, int bz, const Marked& marked, Columns::News& news,
                   const Loops& with);
  // Writes their intensity afterwards, and that of bricks whose columns have another plan. `changed` gets the
  // bricks in which any channel differs.
  void write_intensities(const state::Volume& volume, int bz, const Columns::News& news,
                         const std::vector<Extent>& another, const Loops& with,
                         std::vector<std::uint32_t>& changed);

  Columns columns_;
  std::vector<float> terrain_;  // heights of the last update
  Wanted wanted_;
  state::BitPlane inert_;
  std::array<std::vector<std::int32_t>, kChannels> uniform_;
  std::vector<BrickChange> changes_;
  std::vector<std::uint32_t> changed_;
};

// Returns the fields of a volume that are computed without earlier ones.
CellFields cell_fields(const state::Volume& volume, int smooth = 0, const scene::Terrain& terrain = {});

}  // namespace voxmelt::render
