// The viscous law needs memory for what runs show to their neighbours, and for what the pairs of one slice
// exchange.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/field.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

class RunMemory {
 public:
  // The heads of a scene that relaxes need more.
  RunMemory(state::Grid grid, bool relaxes)
      : planes_{state::BitPlane(grid), state::BitPlane(grid), state::BitPlane(grid)},
        deep_(static_cast<std::size_t>(grid.y) * grid.z),
        limits_((static_cast<std::size_t>(grid.x) + 63) / 64 * grid.z) {
    for (auto& field : fields_) field = state::Field<std::uint16_t>(grid);
    runs_ = {fields_[0].data(), fields_[1].data(), fields_[2].data(), fields_[3].data(),
             fields_[4].data(), fields_[5].data(), fields_[6].data(), fields_[7].data(),
             nullptr,           nullptr,           nullptr,           planes_[0].data(),
             planes_[1].data(), planes_[2].data(), deep_.data(),      limits_.data()};
    if (!relaxes) return;
    for (auto& field : relaxed_) field = state::Field<std::uint16_t>(grid);
    runs_.filled = relaxed_[0].data();
    runs_.relaxed_low = relaxed_[1].data();
    runs_.relaxed_high = relaxed_[2].data();
  }
  simd::Runs& runs() { return runs_; }

 private:
  std::array<state::Field<std::uint16_t>, 8> fields_;
  std::array<state::Field<std::uint16_t>, 3> relaxed_;
  std::array<state::BitPlane, 3> planes_;
  std::vector<simd::TileRow> deep_;
  std::vector<state::LimitCounts<std::int64_t>> limits_;
  simd::Runs runs_;
};

class SliceCurrents {
 public:
  explicit SliceCurrents(state::Grid grid) : giving_(grid.y) {
    for (auto& field : fields_) field = state::Field<std::uint16_t>(state::Grid{grid.x, grid.y, 1});
    for (std::size_t i = 0; i < 4; ++i) currents_.flow[i] = fields_[i].data();
    for (std::size_t i = 0; i < 2; ++i) currents_.heat[i] = fields_[4 + i].data();
    currents_.giving = giving_.data();
  }
  simd::Currents& currents() { return currents_; }

  // Tells if anything is exchanged. If not, no kernel need look.
  bool written() const { return written_; }
  void set_written(bool written) { written_ = written; }

 private:
  std::array<state::Field<std::uint16_t>, 6> fields_;
  std::vector<simd::TileRow> giving_;
  simd::Currents currents_;
  bool written_ = false;
};

}  // namespace voxmelt::parallel
