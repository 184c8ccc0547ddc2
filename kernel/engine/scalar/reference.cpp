#include "kernel/engine/scalar/reference.h"

#include <memory>

#include "kernel/engine/scalar/pieces.h"

namespace voxmelt::scalar {

Reference::Reference(const rule::Parameters& parameters, state::Grid grid)
    : parameters_(parameters),
      materials_(parameters),
      solid_beds_(parameters),
      keys_(rule::round_keys(parameters.seed)) {
  if (parameters.freezes()) set_ = frozen_ = decltype(set_)(grid);
  if (parameters.flow.law == rule::Law::paper) {
    pattern_ = decltype(pattern_)(grid);
    melted_ = decltype(melted_)(grid);
  } else {
    in_run_ = decltype(in_run_)(grid);
    shut_ = decltype(shut_)(grid);
    head_ = decltype(head_)(grid);
    mobility_ = decltype(mobility_)(grid);
    exposed_ = decltype(exposed_)(grid);
    dead_ = decltype(dead_)(grid);
    bed_ = decltype(bed_)(grid);
    limit_ = decltype(limit_)(grid);
    filled_ = relaxed_ = decltype(filled_)(grid);
  }
}

bool Reference::let_pieces_fall(std::uint32_t step, state::Volume& volume) {
  return scalar::let_pieces_fall(parameters_.pieces, step, volume);
}

void Reference::run(step::Phase phase, step::Moment moment, const step::Irradiance* irradiance,
                    state::Volume& volume, state::Ledger& ledger) {
  const std::uint32_t step = moment.step;
  switch (phase) {
    case step::Phase::source:
      return source(step, volume, ledger);
    case step::Phase::heat:
      return heat(step, irradiance, volume, ledger);
    case step::Phase::melt:
      return melt(volume, ledger);
    case step::Phase::gravity:
      return gravity(step, volume, ledger);
    case step::Phase::spread:
      if (parameters_.flow.law == rule::Law::viscous) return viscous_spread(moment, volume, ledger);
      return spread(step, volume, ledger);
    case step::Phase::excess:
      if (parameters_.flow.law == rule::Law::viscous) settle(moment, volume, ledger);
      return;
  }
}

void add_implementations(step::Registry& registry) {
  registry.add({"reference", "plain loops over kernel/automaton/rule, one thread",
                [](const rule::Parameters& parameters, state::Grid grid,
                   const step::Tuning& /*one thread, nothing sleeps*/) -> std::unique_ptr<step::Stepper> {
                  return std::make_unique<Reference>(parameters, grid);
                }});
}

}  // namespace voxmelt::scalar
