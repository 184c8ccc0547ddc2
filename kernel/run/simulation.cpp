#include "kernel/run/simulation.h"

#include <chrono>
#include <string>
#include <utility>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/parallel/stepper.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::run {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

const step::Registry& implementations() {
  static const step::Registry registry = [] {
    step::Registry r;
    r.add({"reference", "plain loops over kernel/automaton/rule, one thread", scalar::create_reference});
    cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
      const cpu::InstructionSetRow& row = cpu::row_of(kSet);
      r.add({std::string(row.name), std::string(row.description) + ", threads", parallel::create<kSet>,
             row.supported()});
    });
    return r;
  }();
  return registry;
}

Simulation::Simulation(rule::Parameters parameters, state::Volume initial,
                       const step::Implementation& implementation, const step::Tuning& tuning,
                       std::unique_ptr<visibility::Provider> provider)
    : parameters_(std::move(parameters)),
      volume_(std::move(initial)),
      stepper_(implementation.create(parameters_, volume_.grid, tuning)),
      provider_(provider != nullptr ? std::move(provider)
                                    : std::make_unique<visibility::VoxelWalkProvider>(tuning.threads)),
      ledger_(state::Ledger::open(volume_)) {
  if (parameters_.heat.enabled && parameters_.heat.radiation) irradiance_ = step::Irradiance(volume_.grid);
}

void Simulation::begin_step() {
  const rule::Heat& heat = parameters_.heat;
  if (!heat.enabled || !heat.radiation || step_number() % heat.visibility_every != 0) return;
  const Stopwatch watch(seconds_.visibility);
  provider_->irradiance(volume_, heat, step_number(), irradiance_);
}

void Simulation::run_phase(step::Phase phase) {
  const Stopwatch watch(seconds_.phase[static_cast<std::size_t>(phase)]);
  stepper_->run(phase, step_number(), irradiance(), volume_, ledger_);
}

void Simulation::step() {
  begin_step();
  for (const step::Phase phase : step::phase_order(parameters_.flow.law)) run_phase(phase);
  end_step();
}

}  // namespace voxmelt::run
