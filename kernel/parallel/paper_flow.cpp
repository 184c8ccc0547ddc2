#include "kernel/parallel/paper_flow.h"

namespace voxmelt::parallel {

PaperFlow::PaperFlow(const rule::Parameters& parameters, const simd::View& view, int chunks)
    : chunks_(view.nz, chunks),
      fallen_(view.nz, view.tile_rows()),
      restless_(view.nz, view.tile_rows()),
      chunk_(static_cast<std::size_t>(chunks_.count())),
      cut_(static_cast<std::size_t>(chunks_.cuts())),
      none_(view, 1) {
  const int flows = parameters.flow.paper.use_table ? 4 : 2;
  const auto prepare = [&](Worker& worker, int slices) {
    for (int i = 0; i < slices; ++i) worker.gifts.emplace_back(view, flows);
    worker.work.resize(static_cast<std::size_t>(view.tile_rows()));
  };
  for (Worker& worker : chunk_) prepare(worker, 3);
  for (Worker& worker : cut_) prepare(worker, 2);
}

void PaperFlow::gravity(const Job& job, const Tiles& dirty, simd::Books& books) {
  job.workers.run(chunks_.count(), [&](int chunk) {
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z)
      fall(job, dirty, z, chunk_[static_cast<std::size_t>(chunk)]);
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

void PaperFlow::fall(const Job& job, const Tiles& dirty, int z, Worker& worker) {
  fallen_.clear(z);
  std::fill(worker.work.begin(), worker.work.end(), job.sleep ? TileRow{0} : all_words(job.view));
  if (job.sleep) dirty.add_neighbours(z, job.view, worker.work.data());
  if (any(worker.work))
    job.kernels.gravity(job.view, job.step, z, worker.work.data(), fallen_.slice(z), worker.books);
}

void PaperFlow::find_patterns(const Sweep& sweep, int z, Worker& worker, SliceGifts& gifts) {
  const Job& job = sweep.job;
  std::fill(worker.work.begin(), worker.work.end(), job.sleep ? TileRow{0} : all_words(job.view));
  if (job.sleep) {
    sweep.dirty.add_neighbours(z, job.view, worker.work.data());
    fallen_.add_neighbours(z, job.view, worker.work.data());
    for (std::size_t r = 0; r < worker.work.size(); ++r) worker.work[r] |= restless_.slice(z)[r];
  }
  restless_.clear(z);
  const bool awake = any(worker.work);
  if (awake || gifts.written())
    job.kernels.pattern(job.view, job.step, z, worker.work.data(), restless_.slice(z), gifts.gifts());
  gifts.set_written(awake);
}

void PaperFlow::apply(const Sweep& sweep, int z, const SliceGifts& below, const SliceGifts& own,
                      const SliceGifts& above, Worker& worker) {
  TileRow* changed = sweep.dirty_next.slice(z);
  std::copy_n(fallen_.slice(z), sweep.dirty_next.rows(), changed);
  if (below.written() || own.written() || above.written())
    sweep.job.kernels.apply(sweep.job.view, sweep.job.step, z, below.gifts(), own.gifts(), above.gifts(),
                            changed, worker.books);
}

// The two slices at a cut must show their gifts before either side changes them.
void PaperFlow::run_cut(const Sweep& sweep, int cut) {
  Worker& worker = cut_[static_cast<std::size_t>(cut)];
  const int at = chunks_.cut(cut);
  if (sweep.with_gravity)
    for (int z = at - 2; z < at + 2; ++z) fall(sweep.job, sweep.dirty, z, worker);
  find_patterns(sweep, at - 1, worker, worker.gifts[0]);
  find_patterns(sweep, at, worker, worker.gifts[1]);
}

void PaperFlow::run_chunk(const Sweep& sweep, int chunk) {
  Worker& worker = chunk_[static_cast<std::size_t>(chunk)];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  const bool cut_before = chunk > 0, cut_after = chunk < chunks_.cuts();

  const auto gifts = [&](int z) -> SliceGifts& {
    if (z < 0 || z >= sweep.job.view.nz) return none_;
    if (cut_before && z <= begin) return cut_[static_cast<std::size_t>(chunk - 1)].gifts[z == begin ? 1 : 0];
    if (cut_after && z >= end - 1) return cut_[static_cast<std::size_t>(chunk)].gifts[z == end ? 1 : 0];
    return worker.gifts[static_cast<std::size_t>(z % 3)];
  };
  // What the cuts have not done.
  const int fall_from = cut_before ? begin + 2 : begin, fall_to = cut_after ? end - 2 : end;
  const int pattern_from = cut_before ? begin + 1 : begin, pattern_to = cut_after ? end - 1 : end;
  for (int z = begin - 2; z < end; ++z) {
    if (sweep.with_gravity && z + 2 >= fall_from && z + 2 < fall_to)
      fall(sweep.job, sweep.dirty, z + 2, worker);
    if (z + 1 >= pattern_from && z + 1 < pattern_to) find_patterns(sweep, z + 1, worker, gifts(z + 1));
    if (z >= begin) apply(sweep, z, gifts(z - 1), gifts(z), gifts(z + 1), worker);
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
