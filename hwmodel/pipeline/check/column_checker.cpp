#include "hwmodel/pipeline/check/column_checker.h"

#include <algorithm>
#include <memory>
#include <string>

#include "hwmodel/pipeline/check/wanted_cell.h"

namespace voxmelt::hwmodel {
namespace {

// Reads some bits of a slot, the lowest first.
class Bits {
 public:
  explicit Bits(const std::uint64_t* words) : words_(words) {}

  bool at(std::int64_t bit) const { return (words_[bit >> 6] & std::uint64_t{1} << (bit & 63)) != 0; }
  void go_to(std::int64_t bit) { next_ = bit; }
  std::int64_t take(int count) {
    std::int64_t value = 0;
    for (int i = 0; i < count; ++i) value |= std::int64_t{at(next_++)} << i;
    return value;
  }

 private:
  const std::uint64_t* words_;
  std::int64_t next_ = 0;
};

bool holds_something(const Cell& cell) {
  return !cell.air() || cell.amount > 0 || cell.energy > 0 || cell.heat > 0 || cell.set > 0;
}

// Returns what the code holds of a field. Between the passes of a step that freezes, the state of what is not
// blocked tells if the place is set: 1, or 0 if it is not.
std::int64_t coded(const CellWire& row, const Cell& cell, bool keeps_set) {
  if (row.wire == Wire::state && keeps_set && !cell.blocked()) return cell.set;
  return row.get(cell);
}

}  // namespace

bool ColumnChecker::differs(const Place& place, int lane, std::string_view field, std::int64_t expected,
                            std::int64_t actual) {
  if (expected == actual) return false;
  const Checker::Wanted& wanted = checker_.being_written();
  checker_.report({
      .kind = Mismatch::Kind::memory,
      .where = std::string(name_of(StageKind::writer)),
      .step = wanted.pass.first + wanted.pass.steps - 1,
      .cascade = machine_.configuration().cascade - 1,
      .lane = lane,
      .cycle = machine_.cycle(),
      .x = place.x + lane,
      .y = place.y,
      .z = place.z,
      .field = std::string(field),
      .expected = expected,
      .actual = actual,
  });
  return true;
}

void ColumnChecker::column_written(const Place& last, const std::uint64_t* slot) {
  const auto& left = checker_.being_written().left;
  if (checker_.mismatch() != nullptr || left == nullptr) return;
  const auto& step = checker_.being_written().steps.back();
  const std::shared_ptr<const state::BitPlane> set = step.empty() ? nullptr : step.back().bands.set;
  const auto wanted_at = [&](int x, int y, int z) {
    Cell cell = wanted_cell(*left, x, y, z);
    if (set != nullptr) cell.set = set->test(x, y, z);
    return cell;
  };
  const Design& design = machine_.design();
  const int lanes = design.shape.lanes, cells = std::min(lanes, design.shape.grid.x - last.x);
  Bits bits(slot);
  std::int64_t stored = 0;
  Place place = last;
  for (place.y = 0; place.y <= last.y; ++place.y) {
    bool holds = false;
    for (int lane = 0; lane < cells; ++lane)
      holds |= holds_something(wanted_at(place.x + lane, place.y, place.z));
    if (differs(place, 0, "is stored", holds ? 1 : 0, bits.at(place.y) ? 1 : 0)) return;
    if (!holds) continue;
    for (int lane = 0; lane < cells; ++lane) {
      const Cell wanted = wanted_at(place.x + lane, place.y, place.z);
      bits.go_to(design.shape.grid.y + (stored * lanes + lane) * design.cell_bits());
      for (const CellWire& row : kCellWires)
        if (is_in_memory(row, design.kept()) &&
            differs(place, lane, row.label, coded(row, wanted, design.keeps_set()), bits.take(row.bits)))
          return;
    }
    ++stored;
  }
}

}  // namespace voxmelt::hwmodel
