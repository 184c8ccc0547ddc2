// The irradiance of each surface cell from the heat sources is data. It is recomputed at steps divisible by
// heat.visibility_every, and is a pure function of that step's masks and sources (docs/automaton.md, section
// 5).
#pragma once

#include <cstdint>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"

namespace voxmelt::visibility {

// Counts the rays that the definition asks for, and those that were followed, since a provider was made.
struct Casts {
  std::int64_t asked = 0, cast = 0;
  Casts& operator+=(const Casts& more) { return asked += more.asked, cast += more.cast, *this; }
};

class Provider {
 public:
  virtual ~Provider() = default;

  // Fills one UQ12.4 irradiance per cell, 0 for every cell that is not a lit surface cell. A solid cell keeps
  // its amount from one call to the next, unless forget_amounts() comes between. `result` has the size of the
  // volume. A provider may find its own earlier result there, and write only changes. Between two
  // calls, nobody else changes a result that is given again. It returns how often a cell was cut at the
  // largest irradiance, once for each source.
  virtual std::int64_t irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                                  state::Field<std::uint16_t>& result) = 0;

  // Pieces have moved: a place that was solid, and is, may hold another cell now.
  virtual void forget_amounts() {}

  // Tells where the last call gave its result other values than it found there. It is null if all may be
  // new.
  virtual const state::ChangedRows* changed() const { return nullptr; }

  virtual std::string_view name() const { return "walk"; }
  virtual Casts casts() const { return {}; }  // none if they are not counted
};

// Is the definition: the exact integer walk through the voxels, of every ray each time.
class VoxelWalkProvider final : public Provider {
 public:
  explicit VoxelWalkProvider(int threads = 1) : workers_(threads) {}
  std::int64_t irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                          state::Field<std::uint16_t>& result) override;

 private:
  cpu::Workers workers_;
};

}  // namespace voxmelt::visibility
