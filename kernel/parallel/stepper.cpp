#include "kernel/parallel/stepper.h"

#include "kernel/scalar/reference.h"

namespace voxmelt::parallel {
namespace {

simd::View shape_of(state::Grid grid, int tile_shift) {
  const state::Layout layout(grid);
  simd::View view;
  view.nx = grid.x;
  view.ny = grid.y;
  view.nz = grid.z;
  view.row = layout.row();
  view.slice = layout.slice();
  view.words = (grid.x + 63) / 64;
  view.last_word = grid.x % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (grid.x % 64)) - 1;
  view.tile_shift = tile_shift;
  return view;
}

int chunks_for(const step::Tuning& tuning) { return tuning.threads == 1 ? 1 : 4 * tuning.threads; }

}  // namespace

Stepper::Stepper(cpu::InstructionSet set, const rule::Parameters& parameters, state::Grid grid,
                 const step::Tuning& tuning)
    : parameters_(parameters),
      tuning_(tuning),
      kernels_(simd::kernels(set, parameters)),
      keys_(rule::round_keys(parameters.seed)),
      workers_(tuning.threads),
      rest_(scalar::create_reference(parameters, grid, tuning)) {
  const simd::View view = shape_of(grid, tuning.tile_shift);
  if (parameters.flow.law == rule::Law::paper)
    paper_.emplace(parameters, view, chunks_for(tuning));
  else
    viscous_.emplace(grid, view, chunks_for(tuning));
  dirty_ = dirty_next_ = Tiles(view.nz, view.tile_rows());
  dirty_.fill(all_words(view));  // nothing is known about the first state
  if (viscous_) viscous_->note(dirty_);
}

simd::View Stepper::view_of(state::Volume& volume) const {
  simd::View view = shape_of(volume.grid, tuning_.tile_shift);
  view.amount = volume.amount.data();
  view.energy = volume.energy.data();
  view.temperature = volume.temperature.data();
  view.solid = volume.solid.data();
  view.liquid = volume.liquid.data();
  view.inert = volume.inert.data();
  return view;
}

void Stepper::run(step::Phase phase, std::uint32_t number, const step::Irradiance* irradiance,
                  state::Volume& volume, state::Ledger& ledger) {
  simd::View view = view_of(volume);
  if (!begun_) walls_ = Walls(view);
  begun_ = true;
  view.walls = walls_.origin(view);
  const simd::Step step{&parameters_, number, static_cast<std::uint32_t>(rule::dither(number)), keys_.data(),
                        irradiance == nullptr ? nullptr : irradiance->data()};
  const Job job{view, step, kernels_, workers_, tuning_.sleep};
  simd::Books books;
  switch (phase) {
    case step::Phase::gravity:
      if (paper_)
        paper_->gravity(job, dirty_, books);
      else
        viscous_->fall(job, books);
      break;
    case step::Phase::spread:
      if (paper_) {
        paper_->spread(job, dirty_, dirty_next_, books);
        std::swap(dirty_, dirty_next_);
      } else {
        viscous_->spread(job, books);
      }
      break;
    case step::Phase::excess:
      if (viscous_) viscous_->settle(job, books);
      break;
    case step::Phase::source:
      if (parameters_.vents.empty() && parameters_.drains.empty()) return;
      rest_->run(phase, number, irradiance, volume, ledger);
      note_all(view);
      return;
    case step::Phase::heat:
    case step::Phase::melt:
      if (!parameters_.heat.enabled) return;
      rest_->run(phase, number, irradiance, volume, ledger);
      if (phase == step::Phase::melt) walls_ = Walls(view);
      note_all(view);
      return;
  }
  ledger.energy.accelerated += books.accelerated;
  ledger.energy.dissipated += books.dissipated;
  ledger.energy.capped += books.capped;
  ledger.heat.rounded += books.rounded;
}

void Stepper::note_all(const simd::View& view) {
  dirty_.fill(all_words(view));
  if (viscous_) viscous_->note(dirty_);
}

}  // namespace voxmelt::parallel
