#include "hwmodel/pipeline/faults/code_fault.h"

#include <algorithm>

namespace voxmelt::hwmodel {
namespace {

bool holds_something(const Cell& cell) { return !cell.air() || cell.amount > 0; }

}  // namespace

PlantedCode::PlantedCode(FaultPlan& plan, Pipeline& pipeline)
    : plan_(plan), pipeline_(pipeline), layout_(pipeline.design()) {
  if (is_of_the_code(plan.fault())) pipeline.plant(this);
}

bool PlantedCode::armed_at_writer(Fault fault, std::int64_t pass) const {
  return plan_.armed(fault, pass_at(pass).first + pass_at(pass).steps - 1);
}

int PlantedCode::cells_of(const Place& place) const {
  const Shape& shape = pipeline_.design().shape;
  return std::min(shape.lanes, shape.grid.x - place.x);
}

void PlantedCode::strike_writer(std::int64_t pass, const Place& place, int lane) {
  plan_.strike({"writer", pass_at(pass).first + pass_at(pass).steps - 1, place.x + lane, place.y, place.z});
}

void PlantedCode::judged(std::int64_t pass, const Place& place, const Cell* lanes, bool& air) {
  const int cells = cells_of(place);
  if (air || !armed_at_writer(Fault::code_lane_missed, pass)) return;
  if (std::any_of(lanes, lanes + cells - 1, holds_something)) return;
  air = true;
  strike_writer(pass, place, 0);
}

void PlantedCode::stored(std::int64_t pass, const Place& place, const Cell* lanes, std::int64_t& at) {
  const int cells = cells_of(place);
  if (at > 0 && armed_at_writer(Fault::code_token_lost, pass)) {
    const auto differs = std::mismatch(lanes, lanes + cells, before_.begin()).first;
    if (differs != lanes + cells) {
      --at;
      strike_writer(pass, before_at_, static_cast<int>(differs - lanes));
    }
  }
  before_.assign(lanes, lanes + cells);
  before_at_ = place;
}

void PlantedCode::ended(std::int64_t pass, const Place& place, std::uint64_t* slot) {
  if (!armed_at_writer(Fault::code_bit_moved, pass)) return;
  for (Place at = place; at.y > 0; --at.y) {
    const bool here = bit_of(slot, at.y), below = bit_of(slot, at.y - 1);
    if (here == below) continue;
    set_bit(slot, at.y, below);
    set_bit(slot, at.y - 1, here);
    --at.y;
    return strike_writer(pass, at, 0);
  }
}

void PlantedCode::found(std::int64_t pass, const Place& place, const std::uint64_t* slot, bool& stored) {
  const std::uint32_t step = pass_at(pass).first;
  if (place.y + 1 == layout_.height() || !plan_.armed(Fault::code_bit_early, step)) return;
  if (bit_of(slot, place.y + 1) == stored) return;
  std::int64_t before = 0;
  for (int y = 0; y < place.y; ++y) before += bit_of(slot, y) ? 1 : 0;
  int lane = 0;
  while (lane < cells_of(place) && !holds_something(layout_.get(slot, layout_.at(before, lane)))) ++lane;
  if (lane == cells_of(place)) return;
  stored = !stored;
  plan_.strike({"reader", step, place.x + lane, place.y, place.z});
}

}  // namespace voxmelt::hwmodel
