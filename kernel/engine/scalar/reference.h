// The reference implementation has plain loops over kernel/automaton/rule, one file per phase. Everything
// else is compared with it.
#pragma once

#include <cstdint>
#include <optional>

#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/scalar/cells.h"

namespace voxmelt::scalar {

class Reference final : public step::HostStepper {
 public:
  Reference(const rule::Parameters& parameters, state::Grid grid);

  void run(step::Phase phase, step::Moment moment, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override;
  bool let_pieces_fall(std::uint32_t step, state::Volume& volume) override;
  void change_sources(const rule::Parameters& parameters) override { parameters_ = parameters; }

  // Returns the directions that each liquid cell gave to, one bit each. It is for the paper law, after
  // `spread`.
  const state::Field<std::uint8_t>& pattern() const { return pattern_; }
  // Returns what the run of a cell shows, or nothing outside runs. It is for the viscous law, after `excess`.
  std::optional<rule::Column> run_of(state::Slot i) const {
    if (in_run_[i] == 0) return {};
    return column_of(i);
  }
  bool in_shut_run(state::Slot i) const { return shut_[i] != 0; }
  // Returns the cells that the last `melt` found set. It is empty if nothing freezes.
  const state::BitPlane& set_cells() const { return set_; }

 private:
  using Volume = state::Volume;
  using Ledger = state::Ledger;

  void source(std::uint32_t step, Volume& volume, Ledger& ledger);
  void heat(std::uint32_t step, const step::Irradiance* irradiance, Volume& volume, Ledger& ledger);
  void melt(Volume& volume, Ledger& ledger);
  void become_first(Volume& volume, state::Slot i, state::HeatLedger& ledger) const;
  void find_frozen(const Volume& volume);
  void freeze(Volume& volume, Ledger& ledger);
  bool is_set(int x, int y, int z) const { return parameters_.freezes() && set_.test(x, y, z); }
  void gravity(std::uint32_t step, Volume& volume, Ledger& ledger);
  void spread(std::uint32_t step, Volume& volume, Ledger& ledger);
  void settle(step::Moment moment, Volume& volume, Ledger& ledger);
  void relax(rule::Relaxation relaxation, const Volume& volume);
  void viscous_spread(step::Moment moment, Volume& volume, Ledger& ledger);
  rule::Column shown(const Cells& cells, int x, int y, int z) const;
  std::int32_t rise_across(const Cells& cells, int x, int y, int z, rule::Direction to) const;
  rule::Column column_of(state::Slot i) const {  // of a cell in a run
    return {head_[i], mobility_[i], exposed_[i], dead_[i], true, bed_[i], limit_[i]};
  }

  void find_patterns(std::uint32_t step, const Volume& volume, const ActiveRows& rows);

  rule::Parameters parameters_;
  rule::Materials materials_;
  rule::SolidBeds solid_beds_;
  rule::RoundKeys keys_;
  state::Field<std::uint8_t> pattern_;  // paper law: directions that each cell gives to
  state::BitPlane melted_;              // paper law: melted by the last `melt`, until `gravity` has run
  state::BitPlane set_, frozen_;        // by the last `melt`, if anything freezes
  // viscous law: the cell belongs to a run; and to one that is shut
  state::Field<std::uint8_t> in_run_, shut_;
  state::Field<std::int32_t> head_, mobility_, exposed_, dead_, bed_,
      limit_;                                    // viscous law: see rule::Column
  state::Field<std::int32_t> filled_, relaxed_;  // viscous law: cells of the run; relaxed heads
  Volume next_;                                  // the result of a phase while it is computed
};

void add_implementations(step::Registry& registry);  // the reference

}  // namespace voxmelt::scalar
