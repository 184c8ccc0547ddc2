#include "kernel/engine/parallel/paper_flow.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace voxmelt::parallel {
namespace {

// Prefetches what a tile row will need: slices are too far apart for the hardware prefetcher.
void prefetch(const simd::View& view, int z, int r, TileRow tiles) {
  for (; tiles != 0; tiles &= tiles - 1) {
    const int w = std::countr_zero(tiles);
    for (int y = view.tile_begin(r); y < view.tile_end(r); ++y) {
      const std::size_t cell = view.cell(w, y, z);
      for (const std::uint16_t* field : {view.amount, view.energy}) {
        __builtin_prefetch(field + cell);
        __builtin_prefetch(field + cell + 32);
      }
    }
  }
}

}  // namespace

PaperFlow::PaperFlow(const rule::Parameters& parameters, const simd::View& view, int chunks)
    : chunks_(view.nz, chunks),
      fallen_(view.nz, view.tile_rows()),
      restless_(view.nz, view.tile_rows()),
      chunk_(static_cast<std::size_t>(chunks_.count())),
      cut_(static_cast<std::size_t>(chunks_.cuts())),
      none_(view, view.ny, 1) {
  const int flows = parameters.flow.paper.use_table ? 4 : 2;
  const int tile = std::min(1 << view.tile_shift, view.ny);
  for (Worker& worker : chunk_) {
    for (int i = 0; i < 3; ++i) worker.gifts.emplace_back(view, tile, flows);
    worker.awake.resize(static_cast<std::size_t>(view.nz));
    worker.ceiling.resize(static_cast<std::size_t>(view.nz) * static_cast<std::size_t>(view.words));
  }
  for (Worker& worker : cut_) {
    for (int i = 0; i < 2; ++i) worker.gifts.emplace_back(view, view.ny, flows);
    worker.awake.resize(2);
  }
}

void PaperFlow::gravity(const Job& job, const Tiles& dirty, simd::Books& books) {
  job.workers.run(chunks_.count(), gravity_turns_, [&](int chunk) {
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z)
      fall(job, dirty, z, chunk_[static_cast<std::size_t>(chunk)]);
  });
  close(books);
}

void PaperFlow::spread(const Job& job, const Tiles& dirty, Tiles& dirty_next, simd::Books& books) {
  const Sweep sweep{job, dirty, dirty_next};
  job.workers.run(chunks_.cuts(), cut_turns_, [&](int cut) { run_cut(sweep, cut); });
  job.workers.run(chunks_.count(), chunk_turns_, [&](int chunk) { run_chunk(sweep, chunk); });
  close(books);
}

void PaperFlow::fall(const Job& job, const Tiles& dirty, int z, Worker& worker) {
  fallen_.clear(z);
  if (job.sleep && !dirty.any_near(z)) return;
  const TileRow all = all_words(job.view);
  TileRow follow = 0;  // tiles whose last row was moved: the row above may follow
  for (int r = 0; r < job.view.tile_rows(); ++r) {
    TileRow work = job.sleep ? dirty.near(z, r, all) : all;
    // What hangs in the row above may hang from the row above that. With tiles of one row, that is beyond the
    // next tile.
    if (job.view.tile_shift == 0 && r + 2 < job.view.tile_rows()) work |= dirty.slice(z)[r + 2];
    if ((work | follow) != 0)
      job.kernels.gravity(job.view, job.step, z, r, work, follow, fallen_.edit(z), worker.books);
  }
  fallen_.tidy(z);
}

bool PaperFlow::awake(const Sweep& sweep, int z) const {
  return !sweep.job.sleep || sweep.dirty.any_near(z) || fallen_.any_near(z) || restless_.any(z);
}

void PaperFlow::find_patterns(const Sweep& sweep, int z, int r, const std::uint64_t* below,
                              SliceGifts& gifts) {
  const Job& job = sweep.job;
  TileRow work = all_words(job.view);
  TileRow* restless = restless_.edit(z) + r;
  if (job.sleep) work = sweep.dirty.near(z, r, work) | fallen_.near(z, r, work) | *restless;
  if ((work | gifts.gifts().tiles(job.view, r)) != 0)
    *restless = job.kernels.pattern(job.view, job.step, z, r, work, below, gifts.gifts());
}

// The gifts of the two slices at a cut must be known before either side changes them.
void PaperFlow::run_cut(const Sweep& sweep, int cut) {
  Worker& worker = cut_[static_cast<std::size_t>(cut)];
  for (int k = 0; k < 2; ++k) {
    const int z = chunks_.cut(cut) - 1 + k;
    SliceGifts& gifts = worker.gifts[static_cast<std::size_t>(k)];
    worker.awake[static_cast<std::size_t>(k)] = awake(sweep, z);
    if (!worker.awake[static_cast<std::size_t>(k)] && gifts.empty()) continue;
    for (int r = 0; r < sweep.job.view.tile_rows(); ++r) find_patterns(sweep, z, r, nullptr, gifts);
    restless_.tidy(z);
  }
}

void PaperFlow::run_chunk(const Sweep& sweep, int chunk) {
  Worker& worker = chunk_[static_cast<std::size_t>(chunk)];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  bool any_awake = false;
  for (int z = begin; z < end; ++z) {
    sweep.dirty_next.clear(z);
    worker.awake[static_cast<std::size_t>(z)] = awake(sweep, z);
    any_awake = any_awake || worker.awake[static_cast<std::size_t>(z)] != 0;
  }
  const bool beside = (chunk > 0 && !cut_[static_cast<std::size_t>(chunk - 1)].gifts[0].empty()) ||
                      (chunk < chunks_.cuts() && !cut_[static_cast<std::size_t>(chunk)].gifts[1].empty());
  if (!any_awake && !beside) return;
  for (int r = 0; r < sweep.job.view.tile_rows(); ++r) run_rows(sweep, chunk, r);
  for (int z = begin; z < end; ++z) {
    sweep.dirty_next.add(z, fallen_.slice(z));
    sweep.dirty_next.tidy(z);
    restless_.tidy(z);
  }
}

// Tile row r of a chunk's slices.
void PaperFlow::run_rows(const Sweep& sweep, int chunk, int r) {
  const Job& job = sweep.job;
  Worker& worker = chunk_[static_cast<std::size_t>(chunk)];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  const bool cut_before = chunk > 0, cut_after = chunk < chunks_.cuts();
  for (SliceGifts& gifts : worker.gifts) gifts.gifts().first_row = job.view.tile_begin(r);

  const auto gifts = [&](int z) -> SliceGifts& {
    if (z < 0 || z >= job.view.nz) return none_;
    if (cut_before && z <= begin) return cut_[static_cast<std::size_t>(chunk - 1)].gifts[z == begin ? 1 : 0];
    if (cut_after && z >= end - 1) return cut_[static_cast<std::size_t>(chunk)].gifts[z == end ? 1 : 0];
    return worker.gifts[static_cast<std::size_t>(z % 3)];
  };
  const auto ceiling = [&](int z) {
    return worker.ceiling.data() + static_cast<std::size_t>(z) * static_cast<std::size_t>(job.view.words);
  };

  // The cuts have done the slices beside them.
  const int pattern_from = cut_before ? begin + 1 : begin, pattern_to = cut_after ? end - 1 : end;
  TileRow below = gifts(begin - 1).gifts().tiles(job.view, r), own = 0, above = 0;
  for (int z = begin - 1; z < end; ++z) {
    SliceGifts& next = gifts(z + 1);
    if (z + 1 >= pattern_from && z + 1 < pattern_to) {
      const bool awake_next = worker.awake[static_cast<std::size_t>(z) + 1] != 0;
      if (awake_next) prefetch(job.view, z + 2, r, z + 2 < end ? sweep.dirty.slice(z + 2)[r] : 0);
      if (awake_next || next.gifts().tiles(job.view, r) != 0)
        find_patterns(sweep, z + 1, r, r > 0 ? ceiling(z + 1) : nullptr, next);
    }
    above = next.gifts().tiles(job.view, r);
    if (z >= begin) {
      std::copy_n(job.view.liquid + job.view.word(0, job.view.tile_end(r) - 1, z), job.view.words,
                  ceiling(z));
      if ((below | own | above) != 0)
        sweep.dirty_next.edit(z)[r] = job.kernels.apply(job.view, job.step, z, r, gifts(z - 1).gifts(),
                                                        gifts(z).gifts(), next.gifts(), worker.books);
      below = own;
    }
    own = above;
  }
}

// Sums what the workers booked.
void PaperFlow::close(simd::Books& books) {
  for (std::vector<Worker>* workers : {&chunk_, &cut_})
    for (Worker& worker : *workers) {
      books += worker.books;
      worker.books = {};
    }
}

}  // namespace voxmelt::parallel
