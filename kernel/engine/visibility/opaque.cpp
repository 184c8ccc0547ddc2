#include "kernel/engine/visibility/opaque.h"

#include <algorithm>

#include "kernel/automaton/state/changed_bricks.h"

namespace voxmelt::visibility {
namespace {

constexpr int kSide = state::kBrickSide;
constexpr int kWordBricks = 64 / kSide;
constexpr std::size_t kTogether = 16;  // words that are compared at once

}  // namespace

void Opaque::resize(const state::Grid& grid) {
  grid_ = grid;
  bricks_ = state::brick_grid(grid);
  plane_ = state::BitPlane(grid);
  solid_ = state::BitPlane(grid);
  bits_ = state::Pages(bricks_.cells() * kSide * kSide);
  contents_.assign(bricks_.cells(), kEmpty);
  column_words_ = state::words_for(grid.y);
  changed_.assign(column_words_ * grid.z, 0);
}

Opaque::News Opaque::take(const state::Volume& volume, cpu::Workers& workers) {
  News all;
  if (grid_ != volume.grid) {
    resize(volume.grid);
    all.appeared = true;
  }
  std::vector<News> news(bricks_.z);
  workers.run(bricks_.z, [&](int layer) { news[layer] = take_layer(volume, layer); });
  for (const News& more : news) {
    all.appeared |= more.appeared;
    all.vanished |= more.vanished;
    all.turned |= more.turned;
    all.emptied += more.emptied;
  }
  return all;
}

Opaque::News Opaque::take_layer(const state::Volume& volume, int layer) {
  News news;
  const std::size_t words = plane_.row_words(), slice = words * grid_.y;
  for (int z = kSide * layer; z < std::min(grid_.z, kSide * (layer + 1)); ++z) {
    std::fill_n(changed_.begin() + change_word(0, z), column_words_, 0);
    const std::uint64_t *const now_solid = volume.solid.row(0, z).data(), *const now_inert =
                                                                              volume.inert.row(0, z).data();
    std::uint64_t *const solid = solid_.row(0, z).data(), *const opaque = plane_.row(0, z).data();
    const auto differs = [&](std::size_t w) {
      return ((now_solid[w] | now_inert[w]) ^ opaque[w]) | (solid[w] ^ now_solid[w]);
    };
    for (std::size_t first = 0; first < slice; first += kTogether) {
      const std::size_t end = std::min(slice, first + kTogether);
      std::uint64_t any = 0;  // most words have not changed
      if (end - first == kTogether)
        for (std::size_t i = 0; i < kTogether; ++i) any |= differs(first + i);
      else
        any = 1;
      for (std::size_t w = first; any != 0 && w < end; ++w) {
        const std::uint64_t was = opaque[w], is = now_solid[w] | now_inert[w];
        const std::uint64_t turned = solid[w] ^ now_solid[w];
        if (((was ^ is) | turned) == 0) continue;
        const int y = static_cast<int>(w / words);
        changed_[change_word(y, z)] |= std::uint64_t{1} << (y & 63);
        news.appeared |= (is & ~was) != 0;
        news.vanished |= (was & ~is) != 0;
        news.turned |= turned != 0;
        solid[w] = now_solid[w];
        opaque[w] = is;
        write_bricks(was, is, w % words, y, z);
      }
    }
  }
  if (news.appeared || news.vanished) news.emptied = look_into(layer);
  return news;
}

void Opaque::write_bricks(std::uint64_t was, std::uint64_t is, std::size_t w, int y, int z) {
  const std::size_t first = bricks_.index(kWordBricks * w, y / kSide, z / kSide);
  const std::size_t row = z % kSide * kSide + y % kSide;
  for (std::size_t k = 0; k < kWordBricks; ++k) {
    if (((was ^ is) >> (kSide * k) & 0xff) == 0) continue;
    bytes()[((first + k) << 6) + row] = static_cast<std::uint8_t>(is >> (kSide * k));
    contents_[first + k] = kUnknown;
  }
}

// Looks into the bricks that have changed. It returns how many are empty now.
int Opaque::look_into(int layer) {
  const std::size_t each = bricks_.index(0, 0, 1), begin = each * layer;
  int emptied = 0;
  for (std::size_t brick = begin; brick < begin + each; ++brick) {
    if (contents_[brick] != kUnknown) continue;
    std::uint8_t any = 0, all = 0xff;
    for (std::size_t row = 0; row < 64; ++row) {
      any |= rows(brick)[row];
      all &= rows(brick)[row];
    }
    contents_[brick] = any == 0 ? kEmpty : all == 0xff ? kFull : kPartly;
    if (any == 0) ++emptied;
  }
  return emptied;
}

bool Opaque::clear_ahead(std::size_t brick, const Cell& cell, std::size_t octant) const {
  const unsigned x = cell[0] & 7, y = cell[1] & 7;
  int z = cell[2] & 7;
  constexpr std::uint64_t kRows = 0x0101'0101'0101'0101;
  const std::uint64_t row = (octant & 1) != 0 ? 0xffu << x & 0xff : 0xffu >> (7 - x);
  const std::uint64_t column =
      (octant & 2) != 0 ? ~std::uint64_t{0} << (8 * y) : ~std::uint64_t{0} >> (8 * (7 - y));
  const std::uint64_t* const slices = reinterpret_cast<const std::uint64_t*>(bits_.data()) + 8 * brick;
  std::uint64_t any = 0;
  if ((octant & 4) != 0) {
    for (; z < 8; ++z) any |= slices[z];
  } else {
    for (; z >= 0; --z) any |= slices[z];
  }
  return (any & row * kRows & column) == 0;
}

std::uint64_t Opaque::changed_about(std::size_t w, int z) const {
  const std::uint64_t* const slice = changed_.data() + change_word(0, z);
  std::uint64_t about = slice[w] | slice[w] << 1 | slice[w] >> 1;
  if (w > 0) about |= slice[w - 1] >> 63;
  if (w + 1 < column_words_) about |= slice[w + 1] << 63;
  if (z > 0) about |= changed_[change_word(0, z - 1) + w];
  if (z + 1 < grid_.z) about |= changed_[change_word(0, z + 1) + w];
  return about;
}

}  // namespace voxmelt::visibility
