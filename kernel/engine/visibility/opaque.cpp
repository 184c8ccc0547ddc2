#include "kernel/engine/visibility/opaque.h"

#include <algorithm>

#include "kernel/automaton/state/changed_bricks.h"

namespace voxmelt::visibility {
namespace {

constexpr int kSide = state::kBrickSide;
constexpr int kWordBricks = 64 / kSide;

}  // namespace

void Opaque::resize(const state::Grid& grid) {
  grid_ = grid;
  bricks_ = state::brick_grid(grid);
  plane_ = state::BitPlane(grid);
  solid_ = state::BitPlane(grid);
  bits_ = state::Pages(bricks_.cells() * kSide * kSide);
  filled_.assign((bricks_.cells() + 63) / 64, 0);
  full_.assign(bricks_.cells(), 0);
  changed_.assign(static_cast<std::size_t>(grid.z), 0);
}

Opaque::News Opaque::take(const state::Volume& volume, cpu::Workers& workers) {
  News all;
  if (grid_ != volume.grid) {
    resize(volume.grid);
    all.appeared = true;
  }
  std::vector<News> news(static_cast<std::size_t>(bricks_.z));
  workers.run(bricks_.z,
              [&](int layer) { news[static_cast<std::size_t>(layer)] = take_layer(volume, layer); });
  for (std::size_t layer = 0; layer < news.size(); ++layer) {
    // A word of `filled_` may be shared by two layers, so one thread writes them all.
    if (news[layer].appeared || news[layer].vanished) fill(static_cast<int>(layer));
    all.appeared |= news[layer].appeared;
    all.vanished |= news[layer].vanished;
    all.turned |= news[layer].turned;
  }
  return all;
}

Opaque::News Opaque::take_layer(const state::Volume& volume, int layer) {
  News news;
  for (int z = kSide * layer; z < std::min(grid_.z, kSide * (layer + 1)); ++z) {
    std::uint64_t changed = 0;
    for (int y = 0; y < grid_.y; ++y) {
      const auto now_solid = volume.solid.row(y, z), now_inert = volume.inert.row(y, z);
      const auto solid = solid_.row(y, z), opaque = plane_.row(y, z);
      std::uint64_t any = 0;  // most rows are as they were
      for (std::size_t w = 0; w < solid.size(); ++w)
        any |= ((now_solid[w] | now_inert[w]) ^ opaque[w]) | (solid[w] ^ now_solid[w]);
      if (any == 0) continue;
      for (std::size_t w = 0; w < solid.size(); ++w) {
        const std::uint64_t was = opaque[w], is = now_solid[w] | now_inert[w];
        const std::uint64_t turned = solid[w] ^ now_solid[w];
        if (((was ^ is) | turned) == 0) continue;
        changed = 1;
        news.appeared |= (is & ~was) != 0;
        news.vanished |= (was & ~is) != 0;
        news.turned |= turned != 0;
        solid[w] = now_solid[w];
        opaque[w] = is;
        write_bricks(was, is, w, y, z);
      }
    }
    changed_[static_cast<std::size_t>(z)] = static_cast<std::uint8_t>(changed);
  }
  return news;
}

void Opaque::write_bricks(std::uint64_t was, std::uint64_t is, std::size_t w, int y, int z) {
  const std::size_t first = bricks_.index(kWordBricks * static_cast<int>(w), y / kSide, z / kSide);
  const std::size_t row = static_cast<std::size_t>(z % kSide * kSide + y % kSide);
  for (std::size_t k = 0; k < kWordBricks; ++k)
    if (((was ^ is) >> (kSide * k) & 0xff) != 0)
      bytes()[((first + k) << 6) + row] = static_cast<std::uint8_t>(is >> (kSide * k));
}

void Opaque::fill(int layer) {
  const std::size_t each = bricks_.index(0, 0, 1), first = each * static_cast<std::size_t>(layer);
  for (std::size_t brick = first; brick < first + each; ++brick) {
    std::uint8_t any = 0, all = 0xff;
    for (std::size_t row = 0; row < 64; ++row) {
      any |= rows(brick)[row];
      all &= rows(brick)[row];
    }
    full_[brick] = all == 0xff;
    const std::uint64_t bit = std::uint64_t{1} << (brick & 63);
    std::uint64_t& word = filled_[brick >> 6];
    word = any != 0 ? word | bit : word & ~bit;
  }
}

bool Opaque::changed_about(int z) const {
  for (int near = std::max(0, z - 1); near <= std::min(grid_.z - 1, z + 1); ++near)
    if (changed_[static_cast<std::size_t>(near)] != 0) return true;
  return false;
}

}  // namespace voxmelt::visibility
