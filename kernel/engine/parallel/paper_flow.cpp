#include "kernel/engine/parallel/paper_flow.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace voxmelt::parallel {
namespace {

// Prefetches the data of a tile row, because slices are too far apart for the hardware prefetcher.
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
      bands_(view),
      fallen_(view.nz, view.tile_rows()),
      restless_(view.nz, view.tile_rows()),
      chunk_(chunks_.count()),
      cut_(chunks_.cuts()),
      none_(view, view.ny, 1) {
  const int flows = parameters.flow.paper.use_table ? 4 : 2;
  const int tile = std::min(1 << view.tile_shift, view.ny), tall = std::min(1 << bands_.shift(), view.ny);
  for (Worker& worker : chunk_) {
    for (int i = 0; i < 3; ++i) worker.gifts.emplace_back(view, tile, flows);
    for (int i = 0; i < 3; ++i) worker.tall_gifts.emplace_back(view, tall, flows);
    worker.follow.resize(view.nz);
    worker.moved.resize(static_cast<std::size_t>(view.tile_rows()) + 1);
    worker.awake.resize(view.nz);
    worker.ceiling.resize(static_cast<std::size_t>(view.nz) * view.words);
  }
  for (Worker& worker : cut_) {
    for (int i = 0; i < 2; ++i) worker.gifts.emplace_back(view, view.ny, flows);
    worker.awake.resize(2);
  }
}

void PaperFlow::gravity(const Job& job, const Tiles& dirty, simd::Books& books) {
  job.workers.run(chunks_.count(), gravity_turns_, [&](int chunk) {
    Worker& worker = chunk_[chunk];
    const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
    const Slices later = put_off(chunk);
    worker.ahead = job.ahead && later.begin < later.end &&
                   (!job.sleep || mostly(dirty, begin, end, 0, job.view.tile_rows(), all_words(job.view)));
    for (int z = begin; z < end; ++z) {
      const bool waits = worker.ahead && z >= later.begin && z < later.end;
      if (waits) {
        fallen_.clear(z);
        worker.follow[z] = 0;
      } else
        fall(job, dirty, z, worker);
    }
  });
  close(books);
}

// Returns the slices of which gravity may be put off. Patterns at a cut are found before those of the chunks,
// and they read the slices beside them.
PaperFlow::Slices PaperFlow::put_off(int chunk) const {
  return {chunks_.begin(chunk) + (chunk > 0 ? 2 : 0), chunks_.end(chunk) - (chunk < chunks_.cuts() ? 2 : 0)};
}

void PaperFlow::spread(const Job& job, const Tiles& dirty, Tiles& dirty_next, simd::Books& books) {
  simd::View tall = job.view;
  tall.tile_shift = bands_.shift();
  const Sweep sweep{job, tall, dirty, dirty_next};
  job.workers.run(chunks_.cuts(), cut_turns_, [&](int cut) { run_cut(sweep, cut); });
  job.workers.run(chunks_.count(), chunk_turns_, [&](int chunk) { run_chunk(sweep, chunk); });
  for (Worker& worker : chunk_) worker.ahead = false;
  close(books);
}

void PaperFlow::fall(const Job& job, const Tiles& dirty, int z, Worker& worker) {
  fallen_.clear(z);
  if (job.sleep && !dirty.any_near(z)) return;
  const TileRow all = all_words(job.view);
  TileRow follow = 0;  // tiles whose last row was moved, so that the row above may follow
  for (int r = 0; r < job.view.tile_rows(); ++r) {
    TileRow work = job.sleep ? dirty.near(z, r, all) : all;
    // A drop in the row above may hang from the row above that. With tiles of one row, that is beyond the
    // next tile.
    if (job.view.tile_shift == 0 && r + 2 < job.view.tile_rows()) work |= dirty.slice(z)[r + 2];
    if ((work | follow) != 0)
      job.kernels.gravity(job.view, job.step, z, r, work, follow, fallen_.edit(z), worker.books);
  }
  fallen_.tidy(z);
}

void PaperFlow::fall_band(const Job& job, const Band& band, int z, Worker& worker) {
  TileRow *moved = worker.moved.data() + band.row, *fallen = fallen_.edit(z);
  moved[0] = moved[1] = 0;
  job.kernels.gravity(band.view, job.step, z, band.row, all_words(job.view), worker.follow[z],
                      worker.moved.data(), worker.books);
  for (int r = band.begin; r < band.end; ++r) fallen[r] |= moved[0];
  if (moved[1] != 0) fallen[band.end] |= moved[1];
}

bool PaperFlow::awake(const Sweep& sweep, int z) const {
  return !sweep.job.sleep || sweep.dirty.any_near(z) || fallen_.any_near(z) || restless_.any(z);
}

[[gnu::always_inline]] inline TileRow PaperFlow::awake(const Sweep& sweep, const Band& band, int z) const {
  const TileRow all = all_words(sweep.job.view);
  int r = band.begin;
  TileRow work = 0;
  do work |= sweep.dirty.near(z, r, all) | fallen_.near(z, r, all) | restless_.slice(z)[r];
  while (++r < band.end);
  return work;
}

// Finds the patterns of a band. `given` has the tiles in which the gifts are not empty yet.
[[gnu::always_inline]] inline void PaperFlow::find_patterns(const Sweep& sweep, const Band& band, int z,
                                                            TileRow given, const std::uint64_t* below,
                                                            SliceGifts& gifts) {
  const Job& job = sweep.job;
  const TileRow work = job.sleep ? awake(sweep, band, z) : all_words(job.view);
  if ((work | given) == 0) return;
  const TileRow left = job.kernels.pattern(band.view, job.step, z, band.row, work, below, gifts.gifts());
  TileRow* restless = restless_.edit(z);
  band.set(restless, left);
}

// Finds the gifts of the two slices at a cut before either side changes them.
void PaperFlow::run_cut(const Sweep& sweep, int cut) {
  const simd::View& view = sweep.job.view;
  Worker& worker = cut_[cut];
  for (int k = 0; k < 2; ++k) {
    const int z = chunks_.cut(cut) - 1 + k;
    SliceGifts& gifts = worker.gifts[k];
    worker.awake[k] = awake(sweep, z);
    if (!worker.awake[k] && gifts.empty()) continue;
    for (int r = 0; r < view.tile_rows(); ++r)
      find_patterns(sweep, Bands::single(view, r), z, gifts.gifts().tiles(view, r), nullptr, gifts);
    restless_.tidy(z);
  }
}

void PaperFlow::run_chunk(const Sweep& sweep, int chunk) {
  const simd::View& view = sweep.job.view;
  Worker& worker = chunk_[chunk];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  bool any_awake = false, all_awake = true;
  for (int z = begin; z < end; ++z) {
    sweep.dirty_next.clear(z);
    const bool one = worker.ahead || awake(sweep, z);
    worker.awake[z] = one;
    any_awake = any_awake || one;
    all_awake = all_awake && one;
  }
  const bool beside = (chunk > 0 && !cut_[chunk - 1].gifts[0].empty()) ||
                      (chunk < chunks_.cuts() && !cut_[chunk].gifts[1].empty());
  if (!any_awake && !beside) return;
  for (int r = 0; r < view.tile_rows();) {
    const int last = bands_.end(r);
    if (worker.ahead || !sweep.job.sleep ||
        (all_awake && mostly(sweep.dirty, begin, end, r, last, all_words(view)))) {
      run_band(sweep, chunk, bands_.tall(sweep.tall, r), worker.tall_gifts);
      r = last;
    } else {
      for (; r < last; ++r) run_band(sweep, chunk, Bands::single(view, r), worker.gifts);
    }
  }
  for (int z = begin; z < end; ++z) {
    if (worker.ahead) fallen_.tidy(z);
    sweep.dirty_next.add(z, fallen_.slice(z));
    sweep.dirty_next.tidy(z);
    restless_.tidy(z);
  }
}

void PaperFlow::run_band(const Sweep& sweep, int chunk, const Band& band, std::vector<SliceGifts>& ring) {
  const Job& job = sweep.job;
  Worker& worker = chunk_[chunk];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  const bool cut_before = chunk > 0, cut_after = chunk < chunks_.cuts();
  for (SliceGifts& gifts : ring) gifts.gifts().first_row = band.view.tile_begin(band.row);

  const auto saved = [&](int z) -> const SliceGifts& {  // all rows of a slice
    if (z < 0 || z >= job.view.nz) return none_;
    if (cut_before && z <= begin) return cut_[chunk - 1].gifts[z == begin ? 1 : 0];
    return cut_[chunk].gifts[z == end ? 1 : 0];
  };
  struct Given {
    const simd::Gifts* gifts;
    TileRow tiles;
  };
  const auto given_by = [&](const SliceGifts& rows) {
    TileRow tiles = 0;
    for (int r = band.begin; r < band.end; ++r) tiles |= rows.gifts().tiles(job.view, r);
    return Given{&rows.gifts(), tiles};
  };
  const auto ceiling = [&](int z) {
    return worker.ceiling.data() + static_cast<std::size_t>(z) * job.view.words;
  };

  // The patterns of the slices beside a cut are already found.
  const int pattern_from = cut_before ? begin + 1 : begin, pattern_to = cut_after ? end - 1 : end;
  const std::uint64_t* last_row = job.view.liquid + job.view.word(0, band.view.tile_end(band.row) - 1, begin);
  Slices falls = worker.ahead ? put_off(chunk) : Slices{0, 0};
  Given below{nullptr, 0}, own = given_by(saved(begin - 1)), above{nullptr, 0};
  for (int z = begin - 1; z < end; ++z) {
    for (; falls.begin < std::min(z + 3, falls.end); ++falls.begin) fall_band(job, band, falls.begin, worker);
    if (z + 1 >= pattern_from && z + 1 < pattern_to) {
      SliceGifts& next = ring[(z + 1) % 3];
      const TileRow& tiles = next.gifts().tiles(band.view, band.row);
      const bool awake_next = worker.awake[static_cast<std::size_t>(z) + 1] != 0;
      if (awake_next && !worker.ahead)
        prefetch(band.view, z + 2, band.row, z + 2 < end ? sweep.dirty.slice(z + 2)[band.begin] : 0);
      if (awake_next || tiles != 0)
        find_patterns(sweep, band, z + 1, tiles, band.begin > 0 ? ceiling(z + 1) : nullptr, next);
      above = {&next.gifts(), tiles};
    } else {
      above = given_by(saved(z + 1));
    }
    if (z >= begin) {
      std::copy_n(last_row, job.view.words, ceiling(z));
      last_row += static_cast<std::size_t>(job.view.words) * job.view.ny;
      if ((below.tiles | own.tiles | above.tiles) != 0) {
        const TileRow changed = job.kernels.apply(band.view, job.step, z, band.row, *below.gifts, *own.gifts,
                                                  *above.gifts, worker.books);
        band.set(sweep.dirty_next.edit(z), changed);
      }
    }
    below = own;
    own = above;
  }
}

// Sums the books of the workers.
void PaperFlow::close(simd::Books& books) {
  for (std::vector<Worker>* workers : {&chunk_, &cut_})
    for (Worker& worker : *workers) {
      books += worker.books;
      worker.books = {};
    }
}

}  // namespace voxmelt::parallel
