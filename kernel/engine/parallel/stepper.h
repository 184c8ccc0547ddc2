// The stepper runs the SIMD kernels of one instruction set over all slices, with threads. Every tile that
// provably stays as it is sleeps. The bits are those of the reference, whatever the instruction set, threads,
// tiles and sleeping.
#pragma once

#include <cstdint>
#include <optional>

#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/parallel/heat_flow.h"
#include "kernel/engine/parallel/loose_pieces.h"
#include "kernel/engine/parallel/paper_flow.h"
#include "kernel/engine/parallel/viscous_flow.h"
#include "kernel/engine/parallel/walls.h"

namespace voxmelt::parallel {

class Stepper final : public step::HostStepper {
 public:
  Stepper(cpu::InstructionSet set, const rule::Parameters& parameters, state::Grid grid,
          const step::Tuning& tuning);

  void run(step::Phase phase, step::Moment moment, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override;
  bool let_pieces_fall(std::uint32_t step, state::Volume& volume) override;
  void tell_matter(const state::ChangedRows& changed, state::Volume& volume) override;
  void tell_irradiance(const state::ChangedRows& changed) override;
  void change_sources(const rule::Parameters& parameters) override;
  void tell_changes(state::ChangedBricks& changed) override;
  step::AwakeTiles awake() const override;

 private:
  simd::View view_of(state::Volume& volume);
  void source(const Job& job, simd::Books& books);
  void heat(const Job& job, simd::Books& books);
  void melt(const Job& job, simd::Books& books);
  void gravity(const Job& job, simd::Books& books);
  template <class Mark>
  void tell(Tiles& tiles, const Mark& mark) const;
  void note_matter(const Tiles& changed);  // by a phase after `source`
  void open_sides(const simd::View& view);
  void spread(const Job& job, simd::Books& books);
  void settle(const Job& job, simd::Books& books);

  cpu::InstructionSet set_;
  rule::Parameters parameters_;
  step::Tuning tuning_;
  simd::Kernels kernels_;
  rule::RoundKeys keys_;
  cpu::Workers workers_;
  int rows_;                            // rows of the grid
  std::optional<Walls> walls_, sides_;  // sides_: before this step's melt, if gravity asks for them
  state::BitPlane set_cells_;           // by the last melt; empty if nothing freezes
  LoosePieces pieces_;
  std::optional<HeatFlow> heat_;
  bool knows_light_ = false;  // the new irradiance of this step has been told
  std::optional<PaperFlow> paper_;
  std::optional<ViscousFlow> viscous_;
  Tiles dirty_, dirty_next_;                   // paper law: changed since the last gravity; working memory
  Tiles changed_;                              // changed by a phase
  Tiles untold_, untold_heat_, untold_walls_;  // changed since the last call of tell_changes, by part
  Tiles moved_;                                // open border: matter has changed since the last source
  Tiles melted_;                               // tiles with melted solids that still count as sides
  Tiles freed_;                                // tiles that lost sides since the last gravity began
};

void add_implementations(step::Registry& registry);  // one for each instruction set, the narrowest first

}  // namespace voxmelt::parallel
