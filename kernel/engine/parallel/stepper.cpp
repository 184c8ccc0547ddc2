#include "kernel/engine/parallel/stepper.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "kernel/engine/simd/source.h"

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

// Tells if falling in this scene sees its sides in an earlier state than all else.
bool keeps_sides(const rule::Parameters& p) {
  return p.flow.law == rule::Law::paper && p.heat.enabled && p.falls_by_sides();
}

// Calls visit(z, r, words) for the tiles whose walls are others now.
template <class Visit>
void refresh(const simd::View& view, const Tiles& tiles, Walls& walls, const Visit& visit) {
  for (int z = 0; z < view.nz; ++z)
    for (int r = 0; tiles.any(z) && r < view.tile_rows(); ++r) {
      if (tiles.slice(z)[r] == 0) continue;
      TileRow words = 0;
      for (int y = view.tile_begin(r); y < view.tile_end(r); ++y) words |= walls.refresh(view, y, z);
      if (words != 0) visit(z, r, words);
    }
}
void refresh(const simd::View& view, const Tiles& tiles, Walls& walls) {
  refresh(view, tiles, walls, [](int, int, TileRow) {});
}

int chunks_for(const step::Tuning& tuning) { return tuning.threads == 1 ? 1 : 4 * tuning.threads; }

}  // namespace

Stepper::Stepper(cpu::InstructionSet set, const rule::Parameters& parameters, state::Grid grid,
                 const step::Tuning& tuning)
    : set_(set),
      parameters_(parameters),
      tuning_(tuning),
      kernels_(simd::kernels(set, parameters)),
      keys_(rule::round_keys(parameters.seed)),
      workers_(tuning.threads),
      rows_(grid.y) {
  const simd::View view = shape_of(grid, tuning.tile_shift);
  const int chunks = chunks_for(tuning);
  if (parameters.heat.enabled) heat_.emplace(grid, view, chunks);
  if (parameters.flow.law == rule::Law::paper)
    paper_.emplace(parameters, view, chunks);
  else
    viscous_.emplace(parameters.flow.viscous, grid, view, chunks);
  dirty_ = dirty_next_ = changed_ = untold_ = untold_heat_ = untold_walls_ = melted_ = freed_ = moved_ =
      Tiles(view.nz, view.tile_rows());
  moved_.fill(all_words(view));
  dirty_.fill(all_words(view));  // the first state counts as changed everywhere
  if (heat_) heat_->note(dirty_);
  if (viscous_) viscous_->note(dirty_);
}

simd::View Stepper::view_of(state::Volume& volume) {
  simd::View view = shape_of(volume.grid, tuning_.tile_shift);
  view.amount = volume.amount.data();
  view.energy = volume.energy.data();
  view.heat = volume.heat.data();
  if (!volume.material.empty()) view.material = volume.material.data();
  view.solid = volume.solid.data();
  view.liquid = volume.liquid.data();
  view.inert = volume.inert.data();
  if (!walls_) walls_.emplace(view);
  if (!sides_ && keeps_sides(parameters_)) sides_ = walls_;
  if (kernels_.freezes) {
    if (set_cells_.empty()) set_cells_ = state::BitPlane(volume.grid);
    view.set = set_cells_.data();
  }
  view.walls = walls_->origin(view);
  view.sides = sides_ ? sides_->origin(view) : view.walls;
  return view;
}

bool Stepper::let_pieces_fall(std::uint32_t step, state::Volume& volume) {
  const FallOfPieces how{static_cast<std::uint32_t>(parameters_.pieces.in_liquid),
                         parameters_.pieces.density};
  const state::ChangedRows& rows = pieces_.fall(how, step, volume);
  if (rows.empty()) return false;
  tell_matter(rows, volume);
  return true;
}

void Stepper::tell_matter(const state::ChangedRows& rows, state::Volume& volume) {
  const simd::View view = view_of(volume);
  changed_.clear();
  for (const state::ChangedRow& row : rows) changed_.edit(row.z)[row.y >> view.tile_shift] |= row.words;
  note_matter(changed_);
  untold_walls_.add(changed_);
  refresh(view, changed_, *walls_);
  if (sides_) refresh(view, changed_, *sides_);
  dirty_.add(changed_);
  if (heat_) heat_->note(changed_);
  if (viscous_) viscous_->note(changed_);
}

void Stepper::tell_irradiance(const state::ChangedRows& changed) {
  if (heat_) heat_->note_light(changed);
  knows_light_ = true;
}

// Vents and drains report their changes, and new irradiance is told.
void Stepper::change_sources(const rule::Parameters& parameters) {
  parameters_ = parameters;
  kernels_ = simd::kernels(set_, parameters);  // others are needed if radiation is new
}

simd::Step step_of(const rule::Parameters& parameters, step::Phase phase, step::Moment moment,
                   const std::uint32_t* keys, const step::Irradiance* irradiance) {
  const std::uint32_t dither = rule::dither(moment.step);
  simd::Step step{&parameters, moment.step, dither, keys,
                  irradiance == nullptr ? nullptr : irradiance->data()};
  if (parameters.flow.law == rule::Law::paper) return step;
  const auto k = static_cast<std::uint32_t>(moment.substep), n = static_cast<std::uint32_t>(moment.substeps);
  step.substeps = n;
  step.stages = moment.stages;
  step.relaxed_reach = step.stages * (step.stages + 1) / 2;
  while (1 << step.relaxed_bits < step.relaxed_reach) ++step.relaxed_bits;
  step.relaxed_scale = (32768 << step.relaxed_bits) / step.relaxed_reach;
  for (std::uint32_t axis = 0; axis < 4; ++axis) {
    step.pair_dither[axis] = (dither + 16384 * axis) & 0xFFFF;
    step.turn[axis] = 65536 * ((k + axis * n / 4) % n);
  }
  if (phase == step::Phase::excess || phase == step::Phase::spread)
    step.dither = (dither + rule::dither(k)) & 0xFFFF;
  return step;
}

void Stepper::run(step::Phase phase, step::Moment moment, const step::Irradiance* irradiance,
                  state::Volume& volume, state::Ledger& ledger) {
  const simd::View view = view_of(volume);
  const simd::Step step = step_of(parameters_, phase, moment, keys_.data(), irradiance);
  // If gravity were put off, it would see sides that have changed since.
  const bool ahead = moment.unseen && !sides_ && volume.grid.cells() >= tuning_.ahead_from;
  const Job job{view, step, kernels_, workers_, tuning_.sleep, ahead};
  simd::Books books;
  switch (phase) {
    case step::Phase::source:
      source(job, books);
      break;
    case step::Phase::heat:
      heat(job, books);
      break;
    case step::Phase::melt:
      melt(job, books);
      break;
    case step::Phase::gravity:
      gravity(job, books);
      break;
    case step::Phase::spread:
      spread(job, books);
      break;
    case step::Phase::excess:
      settle(job, books);
      break;
  }
  ledger.book(books);
}

void Stepper::source(const Job& job, simd::Books& books) {
  if (!parameters_.has_openings()) return;
  changed_.clear();
  if (!job.sleep) moved_.fill(all_words(job.view));
  for (int z = 0; z < job.view.nz; ++z) changed_.edit(z);  // all slices, since the sources say which tiles
  simd::run_sources(job.view, job.step, moved_.slice(0), changed_.edit(0), changed_.stride(), books);
  for (int z = 0; z < job.view.nz; ++z) changed_.tidy(z);
  moved_.clear();  // the border has seen what the vents added, too
  untold_.add(changed_);
  dirty_.add(changed_);
  if (heat_) heat_->note(changed_);
  if (viscous_) viscous_->note(changed_);
}

void Stepper::note_matter(const Tiles& changed) {
  untold_.add(changed);
  if (parameters_.open_border) moved_.add(changed);
}

void Stepper::heat(const Job& job, simd::Books& books) {
  if (!heat_) return;
  changed_.clear();
  if (parameters_.heat.is_visibility_step(job.step.number) && !knows_light_) heat_->note_light();
  knows_light_ = false;
  heat_->heat(job, changed_, books);
  untold_heat_.add(changed_);
  // The flow of the paper's law reads heat only when it mixes, unless its shares depend on it.
  if (parameters_.flow.thermal_viscosity) dirty_.add(changed_);
  if (viscous_) viscous_->note(changed_);
}

void Stepper::melt(const Job& job, simd::Books& books) {
  if (!heat_) return;
  changed_.clear();
  open_sides(job.view);
  heat_->melt(job, changed_, books);
  note_matter(changed_);
  if (parameters_.has_materials()) untold_heat_.add(changed_);  // a cell takes on the heat of the first one
  refresh(job.view, changed_, *walls_,
          [this](int z, int r, TileRow words) { untold_walls_.edit(z)[r] |= words; });
  if (sides_) melted_.add(changed_);
  dirty_.add(changed_);
  if (viscous_) viscous_->note(changed_);
}

// Removes melted cells from the sides. The next gravity must look at the drops that they supported.
void Stepper::open_sides(const simd::View& view) {
  if (!sides_) return;
  refresh(view, melted_, *sides_);
  freed_.add(melted_);
  melted_.clear();
}

void Stepper::gravity(const Job& job, simd::Books& books) {
  if (viscous_) {
    viscous_->fall(job, books);
    const Tiles& changed = viscous_->take_changed();
    note_matter(changed);
    if (heat_) heat_->note(changed);
    return;
  }
  if (sides_) dirty_.add(freed_);
  paper_->gravity(job, dirty_, books);
  freed_.clear();
  open_sides(job.view);
}

void Stepper::spread(const Job& job, simd::Books& books) {
  if (viscous_) return viscous_->spread(job, books);
  paper_->spread(job, dirty_, dirty_next_, books);
  std::swap(dirty_, dirty_next_);
  note_matter(dirty_);
  if (heat_) heat_->note(dirty_);
}

void Stepper::tell_changes(state::ChangedBricks& changed) {
  using Changed = state::ChangedBricks;
  tell(untold_, [&](TileRow words, int y, int z) { changed.mark_flow(words, y, z); });
  tell(untold_walls_, [&](TileRow words, int y, int z) { changed.mark(Changed::kMatter, words, y, z); });
  tell(untold_heat_, [&](TileRow words, int y, int z) { changed.mark(Changed::kHeat, words, y, z); });
}

// Tells the slices of one brick together, because a mark for each would cost as much again.
template <class Mark>
void Stepper::tell(Tiles& tiles, const Mark& mark) const {
  const int side = state::kBrickSide;
  for (int first = 0; first < tiles.slices(); first += side)
    for (int r = 0; r < tiles.rows(); ++r) {
      TileRow words = 0;
      for (int z = first; z < std::min(first + side, tiles.slices()); ++z) words |= tiles.slice(z)[r];
      if (words == 0) continue;
      const int begin = r << tuning_.tile_shift;
      const int end = std::min(begin + (1 << tuning_.tile_shift), rows_);
      for (int brick = begin / side; brick <= (end - 1) / side; ++brick) mark(words, brick, first / side);
    }
  tiles.clear();
}

step::AwakeTiles Stepper::awake() const {
  if (!tuning_.sleep) return {};
  Tiles own(dirty_.slices(), dirty_.rows()), with_neighbours = own;
  if (heat_) heat_->tell_awake(own, with_neighbours);
  if (viscous_) viscous_->tell_awake(own, with_neighbours);
  if (paper_) {
    own.add(paper_->restless());
    for (const Tiles* tiles : {&dirty_, &melted_, &freed_}) with_neighbours.add(*tiles);
  }
  step::AwakeTiles awake{dirty_.rows(), tuning_.tile_shift, {}};
  for (int z = 0; z < own.slices(); ++z)
    for (int r = 0; r < own.rows(); ++r)
      awake.tiles.push_back(own.slice(z)[r] | with_neighbours.near(z, r, ~TileRow{0}));
  return awake;
}

void Stepper::settle(const Job& job, simd::Books& books) {
  if (viscous_) viscous_->settle(job, books);
}

void add_implementations(step::Registry& registry) {
  cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
    const cpu::InstructionSetRow& row = cpu::row_of(kSet);
    registry.add({std::string(row.name), std::string(row.description) + ", threads",
                  [](const rule::Parameters& parameters, state::Grid grid,
                     const step::Tuning& tuning) -> std::unique_ptr<step::Stepper> {
                    return std::make_unique<Stepper>(kSet, parameters, grid, tuning);
                  },
                  row.supported()});
  });
}

}  // namespace voxmelt::parallel
