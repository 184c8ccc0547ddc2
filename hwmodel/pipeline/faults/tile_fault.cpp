#include "hwmodel/pipeline/faults/tile_fault.h"

#include <algorithm>
#include <vector>

#include "hwmodel/pipeline/model/volume_port.h"

namespace voxmelt::hwmodel {

TileFault::TileFault(FaultPlan& plan, Pipeline& pipeline) : plan_(plan), pipeline_(pipeline) {
  if (is_of_tiles(plan.fault()) && pipeline.design().shape.tiled()) pipeline.plant(this);
}

void TileFault::reads(std::int64_t pass, const Place& place, const StateMemory& memory, Cell* lanes) {
  const Pass& now = pass_at(pass);
  if (plan_.armed(Fault::tile_halo_narrow, now.first)) give_border(place, now, lanes);
  if (plan_.armed(Fault::tile_halo_stale, now.first)) give_stale(place, now, memory, lanes);
}

// Treats the outermost column as if the halo ended before it.
void TileFault::give_border(const Place& place, const Pass& pass, Cell* lanes) {
  const Shape& shape = pipeline_.design().shape;
  const int end = place.left + shape.blocks() * shape.lanes;
  const bool west = place.x == place.left && place.left > 0;
  const bool east = place.x + shape.lanes == end && end < shape.grid.x;
  for (const int lane : {0, shape.lanes - 1}) {
    if (!(lane == 0 && west) && !(lane == shape.lanes - 1 && east)) continue;
    if (lanes[lane] == Cell{}) continue;
    lanes[lane] = {};
    return plan_.strike({"reader", pass.first, place.x + lane, place.y, place.z});
  }
}

void TileFault::give_stale(const Place& place, const Pass& pass, const StateMemory& memory, Cell* lanes) {
  const Shape& shape = pipeline_.design().shape;
  if (shape.owns(pass.tile, place.x)) return;
  std::vector<Cell> stale(shape.lanes);
  read_token(memory.stale(), shape, place, stale.data(), memory.stale_set());
  const auto lane = static_cast<int>(std::mismatch(stale.begin(), stale.end(), lanes).first - stale.begin());
  if (lane == shape.lanes) return;
  std::copy(stale.begin(), stale.end(), lanes);
  plan_.strike({"reader", pass.first, place.x + lane, place.y, place.z});
}

// Strikes only where the owner has written before. Otherwise the owner would write over the wrong cell.
int TileFault::writes(std::int64_t pass, const Place& place, StateMemory& memory, const Cell* lanes) {
  const Pass& now = pass_at(pass);
  const std::uint32_t step = now.first + now.steps - 1;
  const Shape& shape = pipeline_.design().shape;
  if (!plan_.armed(Fault::tile_overwritten, step) || shape.owner(place.x / shape.lanes) > now.tile) return -1;
  std::vector<Cell> owned(shape.lanes);
  read_token(memory.written(), shape, place, owned.data());
  // Side bands are not written.
  const auto same = [](const Cell& a, const Cell& b) {
    return a.state == b.state && a.amount == b.amount && a.energy == b.energy && a.heat == b.heat;
  };
  const auto lane =
      static_cast<int>(std::mismatch(owned.begin(), owned.end(), lanes, same).first - owned.begin());
  if (lane == shape.lanes) return -1;
  plan_.strike({"writer", step, place.x + lane, place.y, place.z});
  return lane;
}

// Counts a cell of a halo. The sums are compared when the pass has been written.
int TileFault::counts(std::int64_t pass, const Place& /*place*/) {
  const Pass& now = pass_at(pass);
  const std::uint32_t step = now.first + now.steps - 1;
  if (!plan_.armed(Fault::tile_counted_twice, step)) return -1;
  const Shape& shape = pipeline_.design().shape;
  const Place last = place_of(shape, shape.tokens() - 1, shape.tiles() - 1);
  plan_.strike({"writer", step, last.x, last.y, last.z});
  return 0;
}

}  // namespace voxmelt::hwmodel
