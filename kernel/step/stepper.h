// What every implementation of the automaton offers: one phase at a time, so that any two can be compared
// after each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/rule/parameters.h"
#include "kernel/state/ledger.h"
#include "kernel/state/volume.h"
#include "kernel/step/phase.h"

namespace voxmelt::step {

using Irradiance = state::Field<std::uint16_t>;  // UQ12.4 temperature units per step

class Stepper {
 public:
  virtual ~Stepper() = default;

  // Runs one phase of step number `step` on `volume` and books it in `ledger`.
  // `irradiance`: null when the scene has no radiation.
  virtual void run(Phase phase, std::uint32_t step, const Irradiance* irradiance, state::Volume& volume,
                   state::Ledger& ledger) = 0;
};

struct Implementation {
  std::string name;
  std::string description;
  std::unique_ptr<Stepper> (*create)(const rule::Parameters& parameters, state::Grid grid);
};

// A registry is filled by who links the implementations (kernel/run), never by their headers.
class Registry {
 public:
  void add(Implementation implementation) { implementations_.push_back(std::move(implementation)); }
  const std::vector<Implementation>& all() const { return implementations_; }

  // "auto" is the last one added (the fastest); nullptr for an unknown name.
  const Implementation* find(const std::string& name) const {
    if (name == "auto") return implementations_.empty() ? nullptr : &implementations_.back();
    for (const Implementation& candidate : implementations_)
      if (candidate.name == name) return &candidate;
    return nullptr;
  }

 private:
  std::vector<Implementation> implementations_;
};

}  // namespace voxmelt::step
