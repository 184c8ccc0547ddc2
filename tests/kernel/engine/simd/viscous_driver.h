// Drives the viscous law's kernels over a volume without threads, as the simplest stepper would. The slices
// are cut in two chunks that run in the wrong order. Tiles sleep by exactly what the kernels promise.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/engine/parallel/job.h"
#include "kernel/engine/parallel/layer_memory.h"
#include "kernel/engine/parallel/walls.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/engine/scalar/substeps.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

class ViscousDriver {
 public:
  struct Way {
    cpu::InstructionSet set;
    bool sleep = false;
    int tile_shift = 3;
    int cut = 0;  // first slice of the chunk that runs first; 0 or nz: one chunk
  };

  ViscousDriver(const rule::Parameters& parameters, state::Grid grid, Way way)
      : parameters_(parameters),
        kernels_(kernels(way.set, parameters)),
        way_(way),
        rest_(parameters, grid),
        planes_{state::BitPlane(grid), state::BitPlane(grid), state::BitPlane(grid)},
        deep_(static_cast<std::size_t>(grid.y * grid.z)),
        limits_(static_cast<std::size_t>((grid.x + 63) / 64 * grid.z)),
        rows_(((grid.y - 1) >> way.tile_shift) + 1),
        for_settle_(tiles(grid)),
        for_exchange_(tiles(grid)),
        for_fall_(tiles(grid)),
        restless_(tiles(grid, 0)) {
    for (auto& field : fields_) field = state::Field<std::uint16_t>(grid);
    for (auto& field : relaxed_) field = state::Field<std::uint16_t>(grid);
    runs_ = {fields_[0].data(),  fields_[1].data(),  fields_[2].data(),  fields_[3].data(),
             fields_[4].data(),  fields_[5].data(),  fields_[6].data(),  fields_[7].data(),
             relaxed_[0].data(), relaxed_[1].data(), relaxed_[2].data(), planes_[0].data(),
             planes_[1].data(),  planes_[2].data(),  deep_.data(),       limits_.data()};
    for (SliceCurrents& c : currents_) {
      for (auto& field : c.fields) field = state::Field<std::uint16_t>(state::Grid{grid.x, grid.y, 1});
      c.giving.assign(static_cast<std::size_t>(grid.y), 0);
      for (std::size_t i = 0; i < 4; ++i) c.currents.flow[i] = c.fields[i].data();
      for (std::size_t i = 0; i < 2; ++i) c.currents.heat[i] = c.fields[4 + i].data();
      c.currents.giving = c.giving.data();
    }
    const std::size_t bytes = (settle_scratch_bytes(grid.y) + 63) / 64 * 64;
    scratch_.reset(std::aligned_alloc(64, bytes));
  }

  void run(step::Phase phase, step::Moment moment, state::Volume& volume, state::Ledger& ledger) {
    const std::uint32_t number = moment.step;
    View view = view_of(volume);
    const parallel::Walls walls(view);
    view.walls = walls.origin(view);
    const Step step = parallel::step_of(parameters_, phase, moment, nullptr, nullptr);
    Books books;
    awake_ = 0;
    if (phase == step::Phase::excess)
      settle(view, step, volume, books);
    else if (phase == step::Phase::spread)
      spread(view, step, books);
    else if (phase == step::Phase::gravity)
      fall(view, step, books);
    else
      others(phase, number, volume, ledger);
    ledger.book(books);
  }

  // Counts the tiles that the last phase was asked for.
  int awake() const { return awake_; }
  // Counts the stages of the last settle.
  int stages() const { return stages_; }
  // Tells whether `settle` named every tile in which it changed something.
  bool told() const { return told_; }

 private:
  using Tiles = std::vector<TileRow>;  // [z][tile row]
  struct SliceCurrents {
    std::array<state::Field<std::uint16_t>, 6> fields;
    std::vector<TileRow> giving;
    Currents currents;
  };

  Tiles tiles(state::Grid grid, TileRow value = ~TileRow{0}) const {
    return Tiles(static_cast<std::size_t>(grid.z * (((grid.y - 1) >> way_.tile_shift) + 1)), value);
  }
  std::size_t slice(int z) const { return static_cast<std::size_t>(z * rows_); }

  View view_of(state::Volume& v) const {
    View view;
    view.amount = v.amount.data();
    view.energy = v.energy.data();
    view.heat = v.heat.data();
    view.solid = v.solid.data();
    view.liquid = v.liquid.data();
    view.inert = v.inert.data();
    view.nx = v.grid.x;
    view.ny = v.grid.y;
    view.nz = v.grid.z;
    view.row = v.amount.layout().row();
    view.slice = v.amount.layout().slice();
    view.words = static_cast<int>(v.solid.row_words());
    view.tile_shift = way_.tile_shift;
    view.last_word = ~std::uint64_t{0} >> ((64 - v.grid.x % 64) % 64);
    return view;
  }

  void note(const Tiles& changed) {
    for (std::size_t i = 0; i < changed.size(); ++i) {
      for_settle_[i] |= changed[i];
      for_exchange_[i] |= changed[i];
      for_fall_[i] |= changed[i];
    }
  }
  // Returns the tiles that a phase must look at: `noted` and its neighbours, within the grid.
  Tiles take(Tiles& noted, const View& view, bool beside, bool above) {
    const TileRow words = view.words == 64 ? ~TileRow{0} : (TileRow{1} << view.words) - 1;
    Tiles work(noted.size());
    for (int z = 0; z < view.nz; ++z)
      for (int r = 0; r < rows_; ++r)
        for (int dz = -beside; dz <= beside; ++dz)
          for (int dr = -above; dr <= above; ++dr) {
            if (z + dz < 0 || z + dz >= view.nz || r + dr < 0 || r + dr >= rows_) continue;
            const TileRow from = noted[slice(z + dz) + static_cast<std::size_t>(r + dr)];
            const TileRow wide = beside ? from | from << 1 | from >> 1 : from;
            work[slice(z) + static_cast<std::size_t>(r)] |= way_.sleep ? wide & words : words;
          }
    std::fill(noted.begin(), noted.end(), 0);
    return work;
  }
  void count(const Tiles& work) {
    for (const TileRow row : work) awake_ += std::popcount(row);
  }

  void settle(const View& view, const Step& step, const state::Volume& volume, Books& books) {
    if (step.substeps != substeps_ || step.stages != stages_)
      std::fill(for_settle_.begin(), for_settle_.end(), ~TileRow{0});
    substeps_ = step.substeps;
    stages_ = step.stages;
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the kernels write it through `view`
    const state::Volume before = volume;
    const Tiles work = take(for_settle_, view, false, false);
    count(work);
    Tiles changed(work.size());
    for (int z = 0; z < view.nz; ++z)
      kernels_.settle(view, step, z, &work[slice(z)], runs_, scratch_.get(), &changed[slice(z)], books);
    const Tiles truly = differing(before, volume);
    for (std::size_t i = 0; i < truly.size(); ++i) told_ = told_ && (truly[i] & ~changed[i]) == 0;
    note(changed);
    limit_.add(books.limit);
    books.limit = limit_;
  }

  void spread(const View& view, const Step& step, Books& books) {
    Tiles work = take(for_exchange_, view, true, false);
    for (std::size_t i = 0; i < work.size(); ++i) work[i] |= restless_[i];
    count(work);
    std::fill(restless_.begin(), restless_.end(), 0);
    Tiles changed(work.size());
    const bool relaxes = step.stages > 1;
    if (relaxes && !layer_) layer_.emplace(view);
    for (int y = view.ny - 1; relaxes && y >= 0; --y) kernels_.relax(view, step, y, runs_, layer_->memory());
    const auto exchange_pairs = relaxes ? kernels_.exchange_relaxed : kernels_.exchange_pairs;
    const auto exchange = [&](int z, SliceCurrents& to) {
      exchange_pairs(view, step, z, &work[slice(z)], runs_, &restless_[slice(z)], to.currents);
    };
    const int cut = way_.cut > 0 && way_.cut < view.nz ? way_.cut : view.nz;
    if (cut < view.nz) exchange(cut - 1, currents_[2]);
    const auto chunk = [&](int begin, int end) {
      for (int z = begin; z < end; ++z) {
        SliceCurrents& own = z == cut - 1 && cut < view.nz ? currents_[2] : currents_[z & 1];
        const SliceCurrents& below = z == 0 ? currents_[3] : z == cut ? currents_[2] : currents_[(z - 1) & 1];
        if (&own != &currents_[2]) exchange(z, own);
        kernels_.carry(view, step, z, below.currents, own.currents, &changed[slice(z)], books);
      }
    };
    if (cut < view.nz) chunk(cut, view.nz);
    chunk(0, cut);
    note(changed);
  }

  void fall(const View& view, const Step& step, Books& books) {
    const Tiles work = take(for_fall_, view, true, true);
    count(work);
    Tiles changed(work.size());
    for (int z = 0; z < view.nz; ++z)
      kernels_.fall(view, step, z, &work[slice(z)], runs_, &changed[slice(z)], books);
    note(changed);
  }

  // Runs the other phases. Their changes are found by comparison.
  void others(step::Phase phase, std::uint32_t number, state::Volume& volume, state::Ledger& ledger) {
    const state::Volume before = volume;
    rest_.run(phase, step::Moment(number), nullptr, volume, ledger);
    note(differing(before, volume));
  }

  Tiles differing(const state::Volume& before, const state::Volume& volume) const {
    Tiles changed(for_fall_.size());
    for (int z = 0; z < volume.grid.z; ++z)
      for (int y = 0; y < volume.grid.y; ++y)
        for (int x = 0; x < volume.grid.x; ++x) {
          const state::Slot i = volume.at(x, y, z);
          if (before.amount[i] != volume.amount[i] || before.heat[i] != volume.heat[i] ||
              before.solid.test(x, y, z) != volume.solid.test(x, y, z))
            changed[slice(z) + static_cast<std::size_t>(y >> way_.tile_shift)] |= TileRow{1} << (x / 64);
        }
    return changed;
  }

  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };

  rule::Parameters parameters_;
  Kernels kernels_;
  Way way_;
  scalar::Reference rest_;
  std::array<state::Field<std::uint16_t>, 8> fields_;
  std::array<state::Field<std::uint16_t>, 3> relaxed_;
  std::optional<parallel::LayerMemory> layer_;
  std::array<state::BitPlane, 3> planes_;
  std::vector<TileRow> deep_;
  std::vector<state::LimitCounts<std::int64_t>> limits_;
  state::LimitCounts<std::int64_t> limit_;
  Runs runs_;
  std::array<SliceCurrents, 4> currents_;  // a ring of two, one at the cut, one beyond the grid
  std::unique_ptr<void, Free> scratch_;
  int rows_, awake_ = 0;
  bool told_ = true;
  std::uint32_t substeps_ = 0;  // sub-steps of the last settle
  int stages_ = 1;              // stages then
  Tiles for_settle_, for_exchange_, for_fall_, restless_;
};

}  // namespace voxmelt::simd
