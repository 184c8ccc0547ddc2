// The run loop: state, visibility, phases, books.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::run {

// All implementations linked into this program, the reference first.
const step::Registry& implementations();

class Simulation {
 public:
  Simulation(rule::Parameters parameters, state::Volume initial, const step::Implementation& implementation,
             const step::Tuning& tuning = {},
             std::unique_ptr<visibility::Provider> provider = nullptr);  // null: the integer walk

  // The automaton's number of the next step, before the first one; 0 without this call.
  void begin_at(std::uint32_t step) { first_step_ = step; }

  // Runs one whole step.
  void step();

  // Runs one phase of the present step; used where implementations are compared phase by phase.
  void begin_step();
  void run_phase(step::Phase phase);
  void end_step() { ++steps_done_; }

  std::uint32_t steps_done() const { return steps_done_; }
  std::uint32_t step_number() const { return first_step_ + steps_done_; }
  const step::Irradiance* irradiance() const { return irradiance_.empty() ? nullptr : &irradiance_; }
  const state::Volume& volume() const { return volume_; }
  state::Volume& mutable_volume() { return volume_; }  // for tests that plant a leak
  const state::Ledger& ledger() const { return ledger_; }
  state::Ledger& mutable_ledger() { return ledger_; }
  const rule::Parameters& parameters() const { return parameters_; }
  state::Drift drift() const { return state::drift(ledger_, volume_); }

  struct Seconds {
    std::array<double, step::kPhaseCount> phase{};  // by step::Phase
    double visibility = 0;
  };
  const Seconds& seconds() const { return seconds_; }

 private:
  rule::Parameters parameters_;
  state::Volume volume_;
  std::unique_ptr<step::Stepper> stepper_;
  std::unique_ptr<visibility::Provider> provider_;
  state::Ledger ledger_;
  step::Irradiance irradiance_;  // empty without radiation
  std::uint32_t first_step_ = 0, steps_done_ = 0;
  Seconds seconds_;
};

}  // namespace voxmelt::run
