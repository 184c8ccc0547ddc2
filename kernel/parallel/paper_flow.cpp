#include "kernel/parallel/paper_flow.h"

namespace voxmelt::parallel {

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
    worker.follow.resize(static_cast<std::size_t>(view.nz));
    worker.ceiling.resize(static_cast<std::size_t>(view.nz) * static_cast<std::size_t>(view.words));
  }
  for (Worker& worker : cut_)
    for (int i = 0; i < 2; ++i) worker.gifts.emplace_back(view, view.ny, flows);
}

void PaperFlow::gravity(const Job& job, const Tiles& dirty, simd::Books& books) {
  job.workers.run(chunks_.count(), [&](int chunk) {
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      fallen_.clear(z);
      TileRow follow = 0;
      for (int r = 0; r < job.view.tile_rows(); ++r)
        fall(job, dirty, z, r, follow, chunk_[static_cast<std::size_t>(chunk)]);
    }
  });
  close(books);
}

void PaperFlow::spread(const Job& job, const Tiles& dirty, Tiles& dirty_next, simd::Books& books) {
  run({job, dirty, dirty_next, false}, books);
}

void PaperFlow::gravity_and_spread(const Job& job, const Tiles& dirty, Tiles& dirty_next,
                                   simd::Books& books) {
  run({job, dirty, dirty_next, true}, books);
}

void PaperFlow::run(const Sweep& sweep, simd::Books& books) {
  sweep.job.workers.run(chunks_.cuts(), [&](int cut) { run_cut(sweep, cut); });
  sweep.job.workers.run(chunks_.count(), [&](int chunk) { run_chunk(sweep, chunk); });
  close(books);
}

void PaperFlow::fall(const Job& job, const Tiles& dirty, int z, int r, TileRow& follow, Worker& worker) {
  const TileRow all = all_words(job.view), work = job.sleep ? dirty.near(z, r, all) : all;
  if ((work | follow) != 0)
    job.kernels.gravity(job.view, job.step, z, r, work, follow, fallen_.slice(z), worker.books);
}

void PaperFlow::find_patterns(const Sweep& sweep, int z, int r, const std::uint64_t* below,
                              SliceGifts& gifts) {
  const Job& job = sweep.job;
  TileRow work = all_words(job.view);
  TileRow& restless = restless_.slice(z)[r];
  if (job.sleep) work = sweep.dirty.near(z, r, work) | fallen_.near(z, r, work) | restless;
  if ((work | gifts.gifts().tiles(job.view, r)) != 0)
    restless = job.kernels.pattern(job.view, job.step, z, r, work, below, gifts.gifts());
}

// The two slices at a cut must show their gifts before either side changes them.
void PaperFlow::run_cut(const Sweep& sweep, int cut) {
  Worker& worker = cut_[static_cast<std::size_t>(cut)];
  const int at = chunks_.cut(cut), rows = sweep.job.view.tile_rows();
  if (sweep.with_gravity)
    for (int z = at - 2; z < at + 2; ++z) {
      fallen_.clear(z);
      TileRow follow = 0;
      for (int r = 0; r < rows; ++r) fall(sweep.job, sweep.dirty, z, r, follow, worker);
    }
  for (int r = 0; r < rows; ++r) {
    find_patterns(sweep, at - 1, r, nullptr, worker.gifts[0]);
    find_patterns(sweep, at, r, nullptr, worker.gifts[1]);
  }
}

void PaperFlow::run_chunk(const Sweep& sweep, int chunk) {
  Worker& worker = chunk_[static_cast<std::size_t>(chunk)];
  std::fill(worker.follow.begin(), worker.follow.end(), TileRow{0});
  if (sweep.with_gravity) {
    const int begin = chunks_.begin(chunk) + (chunk > 0 ? 2 : 0);
    const int end = chunks_.end(chunk) - (chunk < chunks_.cuts() ? 2 : 0);
    for (int z = begin; z < end; ++z) fallen_.clear(z);
  }
  for (int r = 0; r < sweep.job.view.tile_rows(); ++r) run_rows(sweep, chunk, r);
}

// Tile row r of a chunk's slices. Gravity is final in a tile row when it has run there: what spread changes
// in the row, gravity in the next one does not read.
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
  const auto gives = [&](int z) { return gifts(z).gifts().tiles(job.view, r); };

  const auto ceiling = [&](int z) {
    return worker.ceiling.data() + static_cast<std::size_t>(z) * static_cast<std::size_t>(job.view.words);
  };

  // What the cuts have not done.
  const int fall_from = cut_before ? begin + 2 : begin, fall_to = cut_after ? end - 2 : end;
  const int pattern_from = cut_before ? begin + 1 : begin, pattern_to = cut_after ? end - 1 : end;
  if (sweep.with_gravity)
    for (int z = fall_from; z < fall_to; ++z)
      fall(job, sweep.dirty, z, r, worker.follow[static_cast<std::size_t>(z)], worker);
  for (int z = begin - 1; z < end; ++z) {
    if (z + 1 >= pattern_from && z + 1 < pattern_to)
      find_patterns(sweep, z + 1, r, r > 0 ? ceiling(z + 1) : nullptr, gifts(z + 1));
    if (z < begin) continue;
    std::copy_n(job.view.liquid + job.view.word(0, job.view.tile_end(r) - 1, z), job.view.words, ceiling(z));
    TileRow changed = fallen_.slice(z)[r];
    if ((gives(z - 1) | gives(z) | gives(z + 1)) != 0)
      changed |= job.kernels.apply(job.view, job.step, z, r, gifts(z - 1).gifts(), gifts(z).gifts(),
                                   gifts(z + 1).gifts(), worker.books);
    sweep.dirty_next.slice(z)[r] = changed;
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
