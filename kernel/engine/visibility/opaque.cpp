#include "kernel/engine/visibility/opaque.h"

#include <algorithm>
#include <bit>

#include "kernel/automaton/state/changed_bricks.h"

namespace voxmelt::visibility {
namespace {

constexpr int kSide = state::kBrickSide;
constexpr int kWordBricks = 64 / kSide;

// Makes a box as large as it must be to hold another one, too.
void widen(Opaque::Box& box, const Opaque::Box& other) {
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::min(box.low[a], other.low[a]);
    box.high[a] = std::max(box.high[a], other.high[a]);
  }
}

}  // namespace

void Opaque::resize(const state::Grid& grid) {
  grid_ = grid;
  seen_ = {};
  bricks_ = state::brick_grid(grid);
  plane_ = state::BitPlane(grid);
  solid_ = state::BitPlane(grid);
  bits_ = state::Pages(bricks_.cells() * kSide * kSide);
  contents_.assign(bricks_.cells(), kEmpty);
  column_words_ = state::words_for(grid.y);
  changed_.assign(column_words_ * grid.z, 0);
  changed_cells_ = state::BitPlane(grid);
}

Opaque::News Opaque::take(const state::Volume& volume, cpu::Workers& workers) {
  News all;
  if (grid_ != volume.grid) {
    resize(volume.grid);
    all.appeared = true;
    all.filled = 1;
    all.box = {{0, 0, 0}, {grid_.x - 1, grid_.y - 1, grid_.z - 1}};
  }
  std::vector<News> news(bricks_.z);
  workers.run(bricks_.z, [&](int layer) { news[layer] = take_layer(volume, layer); });
  seen_ = volume.changed.now();
  for (const News& more : news) {
    if (more.appeared) note_appeared(more.box, all);
    all.vanished |= more.vanished;
    all.turned |= more.turned;
    all.emptied += more.emptied;
    all.filled += more.filled;
  }
  return all;
}

Opaque::News Opaque::take_layer(const state::Volume& volume, int layer) {
  News news;
  const int first = kSide * layer, end = std::min(grid_.z, first + kSide);
  for (int z = first; z < end; ++z) forget_changes(z);
  for (int brick = 0; brick < bricks_.y; ++brick) {
    const std::uint64_t words = words_that_may_differ(volume, brick, layer);
    if (words == 0) continue;
    for (int z = first; z < end; ++z)
      for (int y = kSide * brick; y < std::min(grid_.y, kSide * (brick + 1)); ++y)
        take_row(volume, words, y, z, news);
  }
  if (news.appeared || news.vanished) news.emptied = look_into(layer);
  return news;
}

// Returns the words of the rows at y and z, in bricks, in which walls of the volume may have changed.
std::uint64_t Opaque::words_that_may_differ(const state::Volume& volume, int y, int z) const {
  const state::ChangedBricks& changed = volume.changed;
  const std::size_t words = plane_.row_words();
  if (changed.all_since(seen_)) return ~std::uint64_t{0} >> (64 - words);
  std::uint64_t result = 0;
  for (int x = 0; x < bricks_.x; ++x)
    if (changed.since(state::ChangedBricks::kWalls, seen_, bricks_.index(x, y, z)))
      result |= std::uint64_t{1} << (x / kWordBricks);
  return result;
}

// Takes over these words of a row.
void Opaque::take_row(const state::Volume& volume, std::uint64_t words, int y, int z, News& news) {
  const auto now_solid = volume.solid.row(y, z), now_inert = volume.inert.row(y, z);
  const auto solid = solid_.row(y, z), opaque = plane_.row(y, z);
  for (; words != 0; words &= words - 1) {
    const std::size_t w = std::countr_zero(words);
    const std::uint64_t now_opaque = now_solid[w] | now_inert[w];
    if (now_opaque != opaque[w] || now_solid[w] != solid[w])  // seldom
      take_word(now_solid[w], now_opaque, w, y, z, news);
  }
}

void Opaque::take_word(std::uint64_t now_solid, std::uint64_t now_opaque, std::size_t w, int y, int z,
                       News& news) {
  std::uint64_t &solid = solid_.row(y, z)[w], &opaque = plane_.row(y, z)[w];
  const std::uint64_t was = opaque, turned = solid ^ now_solid;
  changed_[change_word(y, z)] |= std::uint64_t{1} << (y & 63);
  changed_cells_.row(y, z)[w] = (was ^ now_opaque) | turned;
  if (const std::uint64_t now = now_opaque & ~was; now != 0) {
    const int x = static_cast<int>(64 * w);
    note_appeared({{x + std::countr_zero(now), y, z}, {x + 63 - std::countl_zero(now), y, z}}, news);
  }
  news.vanished |= (was & ~now_opaque) != 0;
  news.turned |= turned != 0;
  solid = now_solid;
  opaque = now_opaque;
  news.filled += write_bricks(was, now_opaque, w, y, z);
}

void Opaque::note_appeared(const Box& box, News& news) {
  if (!news.appeared) news.box = box;
  news.appeared = true;
  widen(news.box, box);
}

void Opaque::forget_changes(int z) {
  for (std::size_t w = 0; w < column_words_; ++w)
    for (std::uint64_t& rows = changed_[z * column_words_ + w]; rows != 0; rows &= rows - 1)
      std::ranges::fill(changed_cells_.row(static_cast<int>(64 * w) + std::countr_zero(rows), z), 0);
}

// Writes a word into its bricks. It returns how many of them were empty and are not.
int Opaque::write_bricks(std::uint64_t was, std::uint64_t is, std::size_t w, int y, int z) {
  const std::size_t first = bricks_.index(kWordBricks * w, y / kSide, z / kSide);
  const std::size_t row = z % kSide * kSide + y % kSide;
  int filled = 0;
  for (std::size_t k = 0; k < kWordBricks; ++k) {
    if (((was ^ is) >> (kSide * k) & 0xff) == 0) continue;
    bytes()[((first + k) << 6) + row] = static_cast<std::uint8_t>(is >> (kSide * k));
    filled += contents_[first + k] == kEmpty ? 1 : 0;
    contents_[first + k] = kUnknown;
  }
  return filled;
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

std::uint64_t Opaque::cells_about(std::size_t w, int y, int z) const {
  const auto row = changed_cells_.row(y, z);
  std::uint64_t about = row[w] | row[w] << 1 | row[w] >> 1;
  if (w > 0) about |= row[w - 1] >> 63;
  if (w + 1 < row.size()) about |= row[w + 1] << 63;
  if (y > 0) about |= changed_cells_.row(y - 1, z)[w];
  if (y + 1 < grid_.y) about |= changed_cells_.row(y + 1, z)[w];
  if (z > 0) about |= changed_cells_.row(y, z - 1)[w];
  if (z + 1 < grid_.z) about |= changed_cells_.row(y, z + 1)[w];
  return about;
}

}  // namespace voxmelt::visibility
