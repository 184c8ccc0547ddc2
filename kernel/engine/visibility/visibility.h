// What each surface cell receives from the heat sources, as data: recomputed at steps divisible by
// heat.visibility_every, a pure function of that step's masks and sources (docs/automaton.md, section 5).
#pragma once

#include <cstdint>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"

namespace voxmelt::visibility {

// Since a provider was made: the rays that the definition asks for, and those that were followed.
struct Casts {
  std::int64_t asked = 0, cast = 0;
  Casts& operator+=(const Casts& more) { return asked += more.asked, cast += more.cast, *this; }
};

class Provider {
 public:
  virtual ~Provider() = default;

  // Fills one UQ12.4 irradiance per cell; 0 for every cell that is not a lit surface cell. `result` has the
  // size of the volume. A provider may find its own earlier result there, and write only what is new: between
  // two calls, nobody else changes a result that is given again. Returns how often a cell was cut at the
  // largest irradiance, once for each source.
  virtual std::int64_t irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                                  state::Field<std::uint16_t>& result) = 0;

  virtual std::string_view name() const { return "walk"; }
  virtual Casts casts() const { return {}; }  // none where they are not counted
};

// The exact integer walk through the voxels, of every ray each time: the definition.
class VoxelWalkProvider final : public Provider {
 public:
  explicit VoxelWalkProvider(int threads = 1) : workers_(threads) {}
  std::int64_t irradiance(const state::Volume& volume, const rule::Heat& heat, std::uint32_t step,
                          state::Field<std::uint16_t>& result) override;

 private:
  cpu::Workers workers_;
};

}  // namespace voxmelt::visibility
