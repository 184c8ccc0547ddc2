#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/engine/parallel/heat_flow.h"

namespace voxmelt::parallel {
namespace {

std::uint16_t* heats(const Job& job, int z) { return job.view.heat + job.view.cell(0, 0, z); }

}  // namespace

HeatFlow::HeatFlow(state::Grid grid, const simd::View& view, int chunks)
    : chunks_(view.nz, chunks),
      stale_(view.nz, view.tile_rows()),
      taken_(stale_),
      awake_(stale_),
      restless_(stale_),
      moved_(stale_),
      for_melt_(stale_),
      changed_before_melt_(stale_),
      light_(stale_),
      tile_shift_(view.tile_shift),
      all_(all_words(view)),
      chunk_(chunks_.count()),
      cut_(chunks_.cuts()) {
  const state::Grid slice{grid.x, grid.y, 1};
  for (std::vector<Worker>* workers : {&chunk_, &cut_})
    for (Worker& worker : *workers) {
      worker.old.assign(2, Slice(slice));
      worker.moved.resize(view.tile_rows());
      worker.hot.resize(worker.moved.size());
    }
  for (Worker& worker : chunk_) {
    worker.up = Slice({grid.x, 1, 1});
    worker.front = Slice(slice);
    worker.flux = {worker.up.data(), worker.front.data()};
  }
}

void HeatFlow::note(const Tiles& changed) {
  stale_.add(changed);
  for_melt_.add(changed);
}

void HeatFlow::note_light(const state::ChangedRows& changed) {
  for (const state::ChangedRow& row : changed) light_.edit(row.z)[row.y >> tile_shift_] |= row.words;
}

void HeatFlow::tell_awake(Tiles& own, Tiles& with_neighbours) const {
  for (const Tiles* tiles : {&restless_, &for_melt_, &light_}) own.add(*tiles);
  with_neighbours.add(stale_);
}

void HeatFlow::note_light() { light_.fill(all_); }

void HeatFlow::heat(const Job& job, Tiles& changed, simd::Books& books) {
  freezes_ = job.kernels.freezes;
  wake(job);
  const bool later = job.kernels.conduct_edges || job.kernels.conduct_corners || job.kernels.convect;
  if (job.kernels.conduct_faces_gathered) {
    conduct_distant(job, job.kernels.conduct_faces_gathered);
    end_pass(job, later);
  }
  if (job.kernels.conduct_faces) {
    with_walls(job, job.kernels.face_walls, [&] { conduct_faces(job); });
    end_pass(job, later);
  }
  if (job.kernels.conduct_edges) {
    with_walls(job, job.kernels.edge_walls, [&] { conduct_distant(job, job.kernels.conduct_edges); });
    end_pass(job, true);
  }
  if (job.kernels.conduct_corners) {
    with_walls(job, job.kernels.corner_walls, [&] { conduct_distant(job, job.kernels.conduct_corners); });
    end_pass(job, true);
  }
  if (job.kernels.convect) {
    convect(job);
    end_pass(job, false);
  }
  // Each cell acts alone here. If nothing else has changed, only a restless tile may change, or one with new
  // irradiance.
  awake_.add(light_);
  light_.clear();
  if (job.kernels.exchange) {
    sweep(job, [&](int z, Worker& worker, const Neighbours&) { exchange(job, z, worker); });
    end_pass(job, false);
  }
  changed.add(stale_);
  close(books);
}

void HeatFlow::wake(const Job& job) {
  std::swap(taken_, stale_);
  job.workers.run(chunks_.count(), [&](int chunk) {
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      awake_.clear(z);
      if (!job.sleep)
        std::fill_n(awake_.edit(z), awake_.rows(), all_);
      else if (taken_.any_near(z) || restless_.any(z))
        for (int r = 0; r < job.view.tile_rows(); ++r)
          awake_.edit(z)[r] = taken_.near(z, r, all_) | restless_.slice(z)[r];
      stale_.clear(z);
      restless_.clear(z);
      moved_.clear(z);
    }
  });
}

// Notes the changes of a pass. Their neighbours are awake for the passes that follow.
void HeatFlow::end_pass(const Job& job, bool wake_neighbours) {
  job.workers.run(chunks_.count(), [&](int chunk) {
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      if (wake_neighbours && moved_.any_near(z))
        for (int r = 0; r < job.view.tile_rows(); ++r) awake_.edit(z)[r] |= moved_.near(z, r, all_);
      stale_.add(z, moved_.slice(z));
    }
  });
  moved_.clear();
}

// Saves the slices beside a cut before either is changed. It saves the rows that a tile that is awake may
// read.
void HeatFlow::save_cuts(const Job& job) {
  job.workers.run(chunks_.cuts(), [&](int i) {
    Worker& worker = cut_[i];
    const int cut = chunks_.cut(i), rows = job.view.tile_rows();
    int first = rows, last = -1;
    for (int r = 0; r < rows; ++r)
      if ((awake_.slice(cut - 1)[r] | awake_.slice(cut)[r]) != 0) {
        first = std::min(first, std::max(0, r - 1));
        last = std::min(rows - 1, r + 1);
      }
    if (last < 0) return;
    const std::size_t begin = job.view.row * job.view.tile_begin(first);
    const std::size_t end = job.view.row * job.view.tile_end(last);
    for (std::size_t k = 0; k < 2; ++k)
      std::copy_n(heats(job, cut - 1 + static_cast<int>(k)) + begin, end - begin,
                  worker.old[k].data() + begin);
  });
}

// Calls visit(z, worker, neighbours) for the slices with something awake, ascending within a chunk.
template <class Visit>
void HeatFlow::sweep(const Job& job, const Visit& visit) {
  save_cuts(job);
  job.workers.run(chunks_.count(), sweep_turns_, [&](int chunk) {
    Worker& worker = chunk_[chunk];
    const int begin = chunks_.begin(chunk), end = chunks_.end(chunk);
    for (int z = begin; z < end; ++z) {
      if (!awake_.any(z)) continue;
      Neighbours near{nullptr, nullptr, z == begin};
      if (z > begin)
        near.below = heats(job, z - 1);
      else if (chunk > 0)
        near.below = cut_[chunk - 1].old[0].data();
      if (z + 1 < end)
        near.above = heats(job, z + 1);
      else if (chunk < chunks_.cuts())
        near.above = cut_[chunk].old[1].data();
      visit(z, worker, near);
    }
  });
}

// Runs one kernel on slice z: kernel(found).
template <class Call>
void HeatFlow::call(int z, Worker& worker, const Call& kernel) {
  std::fill(worker.moved.begin(), worker.moved.end(), TileRow{0});
  std::fill(worker.hot.begin(), worker.hot.end(), TileRow{0});
  kernel(simd::HeatTiles{worker.moved.data(), restless_.edit(z), worker.hot.data()});
  restless_.tidy(z);
  moved_.add(z, worker.moved.data());
  for_melt_.add(z, freezes_ ? worker.moved.data() : worker.hot.data());
}

// Finds the gains from walls first, because they depend on the heats before the pass.
template <class Pass>
void HeatFlow::with_walls(const Job& job, const simd::WallKernels& walls, const Pass& pass) {
  if (!walls.find) return pass();
  if (wall_gains_.empty()) {
    const state::Grid grid{job.view.nx, job.view.ny, job.view.nz};
    wall_gains_ = Slice(grid);
    wall_cells_ = state::BitPlane(grid);
  }
  const simd::WallGains gains{wall_gains_.data(), wall_cells_.data()};
  const auto each_slice = [&](const auto& visit) {
    job.workers.run(chunks_.count(), [&](int chunk) {
      for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z)
        if (awake_.any(z)) visit(z, chunk_[chunk]);
    });
  };
  each_slice(
      [&](int z, Worker&) { walls.find(job.view, job.step, z, awake_.slice(z), gains, restless_.edit(z)); });
  pass();
  each_slice([&](int z, Worker& worker) {
    call(z, worker, [&](const simd::HeatTiles& found) {
      walls.add(job.view, job.step, z, awake_.slice(z), gains, found, worker.books);
    });
  });
}

void HeatFlow::conduct_faces(const Job& job) {
  sweep(job, [&](int z, Worker& worker, const Neighbours& near) {
    const TileRow* carried = near.first || !awake_.any(z - 1) ? nullptr : awake_.slice(z - 1);
    call(z, worker, [&](const simd::HeatTiles& found) {
      job.kernels.conduct_faces(job.view, job.step, z, {near.below, nullptr, near.above}, carried,
                                awake_.slice(z), worker.flux, found, worker.books);
    });
  });
}

void HeatFlow::conduct_distant(const Job& job, Gather kernel) {
  sweep(job, [&](int z, Worker& worker, const Neighbours& near) {
    // If the slice below was awake, it has been changed, and its old heats are in the ring.
    const auto ring = [&](int slice) -> Slice& { return worker.old[static_cast<std::size_t>(slice & 1)]; };
    std::copy_n(heats(job, z), job.view.slice, ring(z).data());
    const bool below_changed = !near.first && awake_.any(z - 1);
    const simd::OldHeat old{below_changed ? ring(z - 1).data() : near.below, ring(z).data(), near.above};
    call(z, worker, [&](const simd::HeatTiles& found) {
      kernel(job.view, job.step, z, old, awake_.slice(z), found, worker.books);
    });
  });
}

void HeatFlow::convect(const Job& job) {
  sweep(job, [&](int z, Worker& worker, const Neighbours&) {
    call(z, worker, [&](const simd::HeatTiles& found) {
      job.kernels.convect(job.view, job.step, z, awake_.slice(z), worker.flux, found, worker.books);
    });
  });
}

void HeatFlow::exchange(const Job& job, int z, Worker& worker) {
  call(z, worker, [&](const simd::HeatTiles& found) {
    job.kernels.exchange(job.view, job.step, z, awake_.slice(z), found, worker.books);
  });
}

// A cell freezes beside walls, which may have come in a tile beside its own.
void HeatFlow::wake_for_melt(const Job& job) {
  std::swap(for_melt_, changed_before_melt_);
  for_melt_.clear();
  for (int z = 0; z < job.view.nz; ++z) {
    if (!changed_before_melt_.any_near(z)) continue;
    for (int r = 0; r < job.view.tile_rows(); ++r)
      for_melt_.edit(z)[r] = changed_before_melt_.near(z, r, all_);
    for_melt_.tidy(z);
  }
}

void HeatFlow::melt(const Job& job, Tiles& changed, simd::Books& books) {
  if (freezes_ && job.sleep) wake_for_melt(job);
  job.workers.run(chunks_.count(), melt_turns_, [&](int chunk) {
    Worker& worker = chunk_[chunk];
    for (int z = chunks_.begin(chunk); z < chunks_.end(chunk); ++z) {
      if (!job.sleep) std::fill_n(for_melt_.edit(z), for_melt_.rows(), all_);
      if (!for_melt_.any(z)) continue;
      std::fill(worker.moved.begin(), worker.moved.end(), TileRow{0});
      job.kernels.melt(job.view, job.step, z, for_melt_.slice(z), worker.moved.data(), worker.books);
      for_melt_.clear(z);
      for_melt_.add(z, worker.moved.data());
      stale_.add(z, worker.moved.data());
      changed.add(z, worker.moved.data());
    }
  });
  close(books);
}

// Sums the books of the workers.
void HeatFlow::close(simd::Books& books) {
  for (Worker& worker : chunk_) {
    books += worker.books;
    worker.books = {};
  }
}

}  // namespace voxmelt::parallel
