// The renderer draws this scalar field. It holds the filtered intensity and the other channels, and is kept
// up to date brick by brick (docs/picture/field.md).
//
// The surface lies at the places with a filtered intensity of half of kFull. For a column of full cells with
// a part-filled cell on top, this is within a tenth of a cell of the column's height. So smooth amounts look
// smooth.
//
// Liquid is filtered more than solid (look.smooth, look.smooth_solid). The filtered share of liquid in the
// matter around decides which of the two holds. So the one passes into the other without a seam. A solid
// under a film of less than half a cell counts as solid. Obstacles are filtered like solids.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/brick.h"
#include "render/density/brick_filter.h"
#include "render/density/cell_fields.h"
#include "render/density/loops.h"

namespace voxmelt::render {

class DensityField {
 public:
  // Takes over a new state and returns the number of bricks filtered. Only bricks that the filter reaches
  // from a change are filtered again. The result has the same bits as a fresh field, on any number of
  // threads.
  //
  // If a volume is told its changes (Volume::changed), it is read only where it has changed. Any other
  // volume, size, look or terrain is read anew. Inert cells above the terrain are obstacles. If the terrain
  // does not fit the volume, those above any gap are.
  int update(const state::Volume& volume, const scene::Look& look, const scene::Terrain& terrain = {},
             int threads = 1, const Loops& with = loops());

  // Returns the bricks that the last update has filtered, in ascending order. Elsewhere the values below are
  // unchanged.
  const std::vector<std::uint32_t>& refreshed() const { return refreshed_; }
  // Tells where in such a brick something may have changed.
  const DirtyPart& refreshed_part(std::uint32_t brick) const { return parts_[brick]; }

  const state::Grid& grid() const { return cells_.grid; }
  const state::Grid& bricks() const { return cells_.bricks; }
  const Values<std::uint16_t>& intensity() const { return filtered_.intensity; }
  const Values<std::uint16_t>& solid() const { return filtered_.solid; }
  const Values<std::uint16_t>& liquid() const { return filtered_.liquid; }
  const Values<std::uint16_t>& heat() const { return filtered_.heat; }          // or tone, or 0
  const Values<std::uint16_t>& obstacle() const { return filtered_.obstacle; }  // empty if there is none
  const std::vector<std::int32_t>& ground() const { return cells_.columns().ground(); }    // 1/4096 cell
  const std::vector<std::int32_t>& wetness() const { return cells_.columns().wetness(); }  // 0..4096
  const CellFields& cells() const { return cells_; }                                       // before filtering
  bool has_obstacles() const { return !cells_.obstacle.empty(); }
  int liquid_passes() const { return liquid_passes_; }

 private:
  void find_dirty(bool all);

  CellFields cells_;
  ChannelValues filtered_;
  int liquid_passes_ = -1, solid_passes_ = -1;
  bool glow_ = false;
  std::optional<Tones> tones_;
  state::ChangedBricks::Seen seen_;
  BrickFlags dirty_;                // channels to filter
  std::vector<DirtyPart> parts_;    // parts of bricks to filter
  std::vector<std::uint8_t> rows_;  // [z][y] of bricks, 1 if something in the row is dirty
  std::vector<int> dirty_rows_;
  std::vector<BrickFilter> filters_;  // one for each part of the rows
  std::vector<std::uint32_t> refreshed_;
  std::unique_ptr<cpu::Workers> workers_;
};

}  // namespace voxmelt::render
