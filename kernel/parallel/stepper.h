// The SIMD kernels of one instruction set over all slices, with threads, and with everything asleep that
// provably stays as it is. Gives the bits of the reference whatever the instruction set, threads, tiles and
// sleeping.
#pragma once

#include <memory>
#include <optional>

#include "kernel/cpu/instruction_set.h"
#include "kernel/parallel/paper_flow.h"
#include "kernel/parallel/viscous_flow.h"
#include "kernel/parallel/walls.h"
#include "kernel/rule/random.h"
#include "kernel/step/stepper.h"

namespace voxmelt::parallel {

class Stepper final : public step::Stepper {
 public:
  Stepper(cpu::InstructionSet set, const rule::Parameters& parameters, state::Grid grid,
          const step::Tuning& tuning);

  void run(step::Phase phase, std::uint32_t step, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override;

 private:
  simd::View view_of(state::Volume& volume) const;
  void note_all(const simd::View& view);

  rule::Parameters parameters_;
  step::Tuning tuning_;
  simd::Kernels kernels_;
  rule::RoundKeys keys_;
  Workers workers_;
  std::unique_ptr<step::Stepper> rest_;  // phases that have no kernels yet
  std::optional<PaperFlow> paper_;
  std::optional<ViscousFlow> viscous_;
  Walls walls_;
  bool begun_ = false;
  Tiles dirty_, dirty_next_;
};

template <cpu::InstructionSet kSet>
std::unique_ptr<step::Stepper> create(const rule::Parameters& parameters, state::Grid grid,
                                      const step::Tuning& tuning) {
  return std::make_unique<Stepper>(kSet, parameters, grid, tuning);
}

}  // namespace voxmelt::parallel
