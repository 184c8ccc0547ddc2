// Runs the SIMD kernels of source, heat and melt over a volume. It takes chunks of slices whose order does
// not matter, and only tiles where something may happen. All scratch memory begins as garbage.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/automaton/state/ledger.h"
#include "kernel/engine/parallel/walls.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/source.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::simd {

inline View view_of(state::Volume& v, int tile_shift) {
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
  view.tile_shift = tile_shift;
  view.last_word = ~std::uint64_t{0} >> ((64 - v.grid.x % 64) % 64);
  return view;
}

// A set of tiles has one bit per tile: [z][tile row].
class TileSet {
 public:
  TileSet(const View& view, bool all)
      : slices_(view.nz),
        rows_(((view.ny - 1) >> view.tile_shift) + 1),
        words_(view.words == 64 ? ~TileRow{0} : (TileRow{1} << view.words) - 1),
        bits_(static_cast<std::size_t>(slices_ * rows_), all ? words_ : 0) {}

  TileRow* slice(int z) { return bits_.data() + z * rows_; }
  const TileRow* slice(int z) const { return bits_.data() + z * rows_; }
  TileRow* data() { return bits_.data(); }
  void add(const TileSet& other) {
    for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] |= other.bits_[i];
  }
  void add_around(const TileSet& other) {
    for (int z = 0; z < slices_; ++z)
      for (int r = 0; r < rows_; ++r) {
        const TileRow row = other.slice(z)[r], wide = (row | row << 1 | row >> 1) & words_;
        for (int nz = std::max(0, z - 1); nz <= std::min(slices_ - 1, z + 1); ++nz)
          for (int nr = std::max(0, r - 1); nr <= std::min(rows_ - 1, r + 1); ++nr) slice(nz)[nr] |= wide;
      }
  }
  std::int64_t count() const {
    std::int64_t n = 0;
    for (const TileRow row : bits_) n += std::popcount(row);
    return n;
  }
  std::int64_t size() const { return std::popcount(words_) * static_cast<std::int64_t>(bits_.size()); }

 private:
  int slices_, rows_;
  TileRow words_;
  std::vector<TileRow> bits_;
};

class HeatDriver {
  using Slice = state::Field<std::uint16_t>;

 public:
  HeatDriver(const Kernels& kernels, state::Volume& volume, int tile_shift, std::vector<int> cuts)
      : kernels_(kernels), v_(view_of(volume, tile_shift)), cuts_(std::move(cuts)) {
    v_.walls = walls_.origin(v_);
    for (const std::unique_ptr<Slice>& slice : saved_) std::fill_n(slice->data(), v_.slice, 0xABCD);
    std::fill_n(row_.data(), v_.row, 0x1234);
    std::fill_n(front_.data(), v_.slice, 0x4321);
    std::fill_n(wall_gains_.data(), wall_gains_.layout().cells(), 0x2345);
    std::fill_n(wall_cells_.data(), wall_cells_.words().size(), ~std::uint64_t{0});
  }

  const View& view() const { return v_; }

  // `work` marks the tiles where anything may happen before any of this phase has. It grows as it happens.
  void heat(const Step& step, TileSet& work, TileSet& changed, TileSet& restless, TileSet& hot,
            Books& books) {
    HeatFlux flux{row_.data(), front_.data()};
    const auto pass = [&](auto&& slice) {
      TileSet now(v_, false);
      chunks([&](int begin, int end, const std::uint16_t* before, const std::uint16_t* behind) {
        for (int z = begin; z < end; ++z) {
          std::copy_n(heats(z), v_.slice, saved_[z & 1]->data());
          const OldHeat old{z > begin ? saved_[(z - 1) & 1]->data() : before, saved_[z & 1]->data(),
                            z + 1 < end ? heats(z + 1) : behind};
          slice(z, z == begin, old, HeatTiles{now.slice(z), restless.slice(z), hot.slice(z)});
        }
      });
      changed.add(now);
      work.add_around(now);
    };
    const auto with_walls = [&](const WallKernels& walls, auto&& conduct) {
      const TileSet asked = work;  // NOLINT(performance-unnecessary-copy-initialization): conduct() adds
      const WallGains gains{wall_gains_.data(), wall_cells_.data()};
      for (int z = v_.nz - 1; walls.find && z >= 0; --z)
        walls.find(v_, step, z, asked.slice(z), gains, restless.slice(z));
      conduct();
      if (walls.add)
        pass([&](int z, bool, const OldHeat&, const HeatTiles& found) {
          walls.add(v_, step, z, asked.slice(z), gains, found, books);
        });
    };
    if (kernels_.conduct_faces)
      with_walls(kernels_.face_walls, [&] {
        pass([&](int z, bool first, OldHeat old, const HeatTiles& found) {
          if (!first) old.below = heats(z - 1);  // it must not need the saved heats
          old.own = nullptr;
          kernels_.conduct_faces(v_, step, z, old, first ? nullptr : work.slice(z - 1), work.slice(z), flux,
                                 found, books);
        });
      });
    for (const auto& [kernel, walls] : {std::pair(kernels_.conduct_edges, kernels_.edge_walls),
                                        std::pair(kernels_.conduct_corners, kernels_.corner_walls)})
      if (kernel)
        with_walls(walls, [&, kernel = kernel] {
          pass([&](int z, bool, const OldHeat& old, const HeatTiles& found) {
            kernel(v_, step, z, old, work.slice(z), found, books);
          });
        });
    if (kernels_.convect)
      pass([&](int z, bool, const OldHeat&, const HeatTiles& found) {
        kernels_.convect(v_, step, z, work.slice(z), flux, found, books);
      });
    if (kernels_.exchange)
      pass([&](int z, bool, const OldHeat&, const HeatTiles& found) {
        kernels_.exchange(v_, step, z, work.slice(z), found, books);
      });
  }

  void melt(const Step& step, const TileSet& work, TileSet& changed, Books& books) {
    if (!kernels_.melt) return;
    for (int z = 0; z < v_.nz; ++z) kernels_.melt(v_, step, z, work.slice(z), changed.slice(z), books);
    for (int z = 0; z < v_.nz; ++z)
      for (int y = 0; y < v_.ny; ++y) walls_.refresh(v_, y, z);
  }

 private:
  std::uint16_t* heats(int z) const { return v_.heat + v_.cell(0, 0, z); }

  // Calls run(begin, end, old heats of slice begin - 1, of slice end) for each chunk, the last one first.
  template <class Run>
  void chunks(Run&& run) {
    std::vector<std::unique_ptr<Slice>> copies(static_cast<std::size_t>(v_.nz));
    for (int z = 0; z < v_.nz; ++z) {
      copies[static_cast<std::size_t>(z)] = slice_buffer();
      std::copy_n(heats(z), v_.slice, copies[static_cast<std::size_t>(z)]->data());
    }
    const auto copy = [&](int z) {
      return z >= 0 && z < v_.nz ? copies[static_cast<std::size_t>(z)]->data() : nullptr;
    };
    int end = v_.nz;
    for (auto cut = cuts_.rbegin(); cut != cuts_.rend(); ++cut) {
      if (*cut <= 0 || *cut >= end) continue;
      run(*cut, end, copy(*cut - 1), copy(end));
      end = *cut;
    }
    run(0, end, nullptr, copy(end));
  }
  std::unique_ptr<Slice> slice_buffer() const {
    return std::make_unique<Slice>(state::Grid{v_.nx, v_.ny, 1});
  }

  const Kernels kernels_;
  View v_;
  parallel::Walls walls_{v_};
  const std::vector<int> cuts_;
  std::unique_ptr<Slice> saved_[2] = {slice_buffer(), slice_buffer()};
  Slice wall_gains_{{v_.nx, v_.ny, v_.nz}};
  state::BitPlane wall_cells_{{v_.nx, v_.ny, v_.nz}};
  Slice row_{{v_.nx, 1, 1}}, front_{{v_.nx, v_.ny, 1}};
};

}  // namespace voxmelt::simd
