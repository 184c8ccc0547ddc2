#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernel/engine/parallel/viscous_flow.h"

namespace voxmelt::parallel {

ViscousFlow::ViscousFlow(const rule::ViscousLaw& law, state::Grid grid, const simd::View& view, int chunks)
    : chunks_(view.nz, chunks),
      memory_(grid, law.relaxes()),
      for_settle_(view.nz, view.tile_rows()),
      for_exchange_(for_settle_),
      for_fall_(for_settle_),
      taken_(for_settle_),
      restless_(for_settle_),
      changed_(for_settle_),
      changed_before_(for_settle_),
      chunk_(chunks_.count()),
      cut_(chunks_.cuts()),
      none_(grid) {
  const auto prepare = [&](Worker& worker, int slices) {
    for (int i = 0; i < slices; ++i) worker.ring.emplace_back(grid);
    worker.work.resize(view.tile_rows());
    worker.changed.resize(worker.work.size());
  };
  for (Worker& worker : chunk_) {
    prepare(worker, 2);
    worker.scratch = state::Pages(simd::settle_scratch_bytes(view.ny));
    if (law.relaxes()) worker.layer = LayerMemory(view);
  }
  for (Worker& worker : cut_) prepare(worker, 1);
}

void ViscousFlow::note(const Tiles& changed) {
  for (Tiles* noted : {&for_settle_, &for_exchange_, &for_fall_}) noted->add(changed);
}

void ViscousFlow::note(int z, const TileRow* changed) {
  for (Tiles* noted : {&for_settle_, &for_exchange_, &for_fall_, &changed_}) noted->add(z, changed);
}

const Tiles& ViscousFlow::take_changed() {
  std::swap(changed_, changed_before_);
  changed_.clear();
  return changed_before_;
}

// Finds the tiles of slice z that are awake: the noted ones, with those beside them if `beside`. If nothing
// may sleep, it takes all.
void ViscousFlow::find_work(const Job& job, const Tiles* noted, int z, bool beside, Worker& worker) {
  const TileRow all = all_words(job.view);
  for (int r = 0; r < job.view.tile_rows(); ++r) {
    TileRow& work = worker.work[r];
    work = !job.sleep ? all : beside ? noted->near(z, r, all) : noted->slice(z)[r];
  }
  std::fill(worker.changed.begin(), worker.changed.end(), TileRow{0});
}

void ViscousFlow::tell_awake(Tiles& own, Tiles& with_neighbours) const {
  for (const Tiles* tiles : {&restless_, &for_settle_}) own.add(*tiles);
  for (const Tiles* tiles : {&for_exchange_, &for_fall_}) with_neighbours.add(*tiles);
}

void ViscousFlow::settle(const Job& job, simd::Books& books) {
  // Every mobility is for one of so many sub-steps and stages. If their number changes, all runs are settled
  // again.
  if (job.step.substeps != substeps_ || job.step.stages != stages_) for_settle_.fill(all_words(job.view));
  substeps_ = job.step.substeps;
  stages_ = job.step.stages;
  job.workers.run(chunks_.count(), settle_turns_, [&](int chunk) {
    Worker& worker = chunk_[chunk];
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      if (job.sleep && !for_settle_.any(z)) continue;
      find_work(job, &for_settle_, z, false, worker);
      for_settle_.clear(z);
      job.kernels.settle(job.view, job.step, z, worker.work.data(), memory_.runs(), worker.scratch.data(),
                         worker.changed.data(), worker.books);
      note(z, worker.changed.data());
    }
  });
  close(books);
  limit_.add(books.limit);  // the kernel books only changes
  books.limit = limit_;
}

// Layers relax by themselves. Each worker takes every so many of them, since neighbours cost alike.
void ViscousFlow::relax(const Job& job) {
  const int workers = chunks_.count();
  job.workers.run(workers, relax_turns_, [&](int first) {
    for (int y = first; y < job.view.ny; y += workers)
      job.kernels.relax(job.view, job.step, y, memory_.runs(), chunk_[first].layer.memory());
  });
}

void ViscousFlow::exchange(const Job& job, int z, Worker& worker, SliceCurrents& to) {
  if (job.sleep && !to.written() && !taken_.any_near(z) && !restless_.any(z)) return;
  find_work(job, &taken_, z, true, worker);
  for (std::size_t r = 0; r < worker.work.size(); ++r) worker.work[r] |= restless_.slice(z)[r];
  restless_.clear(z);
  const bool awake = any(worker.work);
  const auto exchange_pairs = job.step.stages > 1 ? job.kernels.exchange_relaxed : job.kernels.exchange_pairs;
  if (awake || to.written())
    exchange_pairs(job.view, job.step, z, worker.work.data(), memory_.runs(), restless_.edit(z),
                   to.currents());
  restless_.tidy(z);
  to.set_written(awake);
}

void ViscousFlow::spread(const Job& job, simd::Books& books) {
  std::swap(taken_, for_exchange_);
  if (job.step.stages > 1) relax(job);
  // The slice before a cut exchanges with the one after it before either is changed.
  job.workers.run(chunks_.cuts(), cut_turns_, [&](int i) {
    Worker& worker = cut_[i];
    exchange(job, chunks_.cut(i) - 1, worker, worker.ring[0]);
  });
  job.workers.run(chunks_.count(), chunk_turns_, [&](int chunk) { spread_chunk(job, chunk); });
  close(books);
}

void ViscousFlow::spread_chunk(const Job& job, int chunk) {
  Worker& worker = chunk_[chunk];
  const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
  const auto currents = [&](int z) -> SliceCurrents& {
    if (z < 0) return none_;
    if (z < begin) return cut_[chunk - 1].ring[0];
    if (z == end - 1 && chunk < chunks_.cuts()) return cut_[chunk].ring[0];
    return worker.ring[z & 1];
  };
  for (int z = begin; z < end; ++z) {
    SliceCurrents &own = currents(z), &below = currents(z - 1);
    if (z < end - 1 || chunk == chunks_.cuts()) exchange(job, z, worker, own);
    std::fill(worker.changed.begin(), worker.changed.end(), TileRow{0});
    for_exchange_.clear(z);
    if (!own.written() && !below.written()) continue;
    job.kernels.carry(job.view, job.step, z, below.currents(), own.currents(), worker.changed.data(),
                      worker.books);
    note(z, worker.changed.data());
  }
}

void ViscousFlow::fall(const Job& job, simd::Books& books) {
  std::swap(taken_, for_fall_);
  job.workers.run(chunks_.count(), fall_turns_, [&](int chunk) {
    Worker& worker = chunk_[chunk];
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      for_fall_.clear(z);
      if (job.sleep && !taken_.any_near(z)) continue;
      find_work(job, &taken_, z, true, worker);
      job.kernels.fall(job.view, job.step, z, worker.work.data(), memory_.runs(), worker.changed.data(),
                       worker.books);
      note(z, worker.changed.data());
    }
  });
  close(books);
}

// Sums the books of the workers.
void ViscousFlow::close(simd::Books& books) {
  for (std::vector<Worker>* workers : {&chunk_, &cut_})
    for (Worker& worker : *workers) {
      books += worker.books;
      worker.books = {};
    }
}

}  // namespace voxmelt::parallel
