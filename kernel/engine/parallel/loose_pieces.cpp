#include "kernel/engine/parallel/loose_pieces.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "kernel/automaton/state/connectivity.h"
#include "kernel/engine/parallel/local_parts.h"

namespace voxmelt::parallel {
namespace {

using Words = std::span<const std::uint64_t>;

// All rows of a slice, one after another.
Words slice_of(const state::BitPlane& plane, state::Grid grid, int z) {
  return {plane.row(0, z).data(), grid.y * plane.row_words()};
}

bool is_clear(Words words) {
  return std::ranges::all_of(words, [](std::uint64_t word) { return word == 0; });
}

template <class Run>
void append_runs(Words row, int y, int z, std::vector<Run>& runs) {
  bool goes_on = false;  // the last run reaches the end of the word before
  for (std::size_t w = 0; w < row.size(); ++w) {
    const int x = static_cast<int>(64 * w);
    for (std::uint64_t left = row[w]; left != 0;) {
      const int begin = std::countr_zero(left), end = begin + std::countr_one(left >> begin);
      if (begin == 0 && goes_on)
        runs.back().x1 = x + end;
      else
        runs.push_back({x + begin, x + end, y, z, runs.size()});
      left = end == 64 ? 0 : left & ~std::uint64_t{0} << end;
    }
    goes_on = row[w] >> 63 != 0;
  }
}

struct Layer {
  std::int64_t cells = 0, open = 0, full = 0, feet = 0, wet = 0;
  Layer& operator+=(const Layer& other) {
    cells += other.cells;
    open += other.open;
    full += other.full;
    feet += other.feet;
    wet += other.wet;
    return *this;
  }
};

template <class Run>
Layer look(const state::Volume& volume, const Run& run) {
  constexpr std::uint16_t kHalf = 2048;
  const state::Grid grid = volume.grid;
  Layer layer;
  layer.cells = run.x1 - run.x0;
  const auto side = [&](int x, int z) {
    if (!grid.contains(x, run.y, z) || volume.solid.test(x, run.y, z)) return;
    ++layer.open;
    if (volume.amount[volume.at(x, run.y, z)] >= kHalf) ++layer.full;
  };
  side(run.x0 - 1, run.z);
  side(run.x1, run.z);
  for (int x = run.x0; x < run.x1; ++x) {
    side(x, run.z - 1);
    side(x, run.z + 1);
    if (volume.solid.test(x, run.y - 1, run.z)) continue;
    ++layer.feet;
    if (volume.amount[volume.at(x, run.y - 1, run.z)] >= kHalf) ++layer.wet;
  }
  return layer;
}

// Tells if a piece moves, by its layers from the lowest on.
bool moves(const FallOfPieces& how, std::uint32_t step, std::span<const Layer> layers) {
  Layer all;
  std::int64_t sunk = 0;
  bool under = true;
  for (const Layer& layer : layers) {
    all += layer;
    under = under && layer.open > 0 && 2 * layer.full >= layer.open;
    if (under) sunk += layer.cells;
  }
  if (2 * all.wet < all.feet) return true;
  if (step % how.in_liquid != 0) return false;
  return how.density == 65536 || 65536 * sunk < how.density * all.cells;
}

template <class Value>
void put(Value& to, Value value) {  // writes memory only if something changes
  if (to != value) to = value;
}

}  // namespace

std::size_t LoosePieces::root_of(std::vector<Run>& runs, std::size_t i) {
  while (runs[i].piece != i) i = runs[i].piece = runs[runs[i].piece].piece;
  return i;
}

// Joins the runs of two rows that touch. Both are in order.
void LoosePieces::join(std::vector<Run>& runs, std::size_t a, std::size_t a_end, std::size_t b,
                       std::size_t b_end) {
  while (a < a_end && b < b_end) {
    if (runs[a].x0 < runs[b].x1 && runs[b].x0 < runs[a].x1) {
      const std::size_t one = root_of(runs, a), other = root_of(runs, b);
      runs[std::max(one, other)].piece = std::min(one, other);
    }
    if (runs[a].x1 < runs[b].x1)
      ++a;
    else
      ++b;
  }
}

// Finds the runs of a set of cells, [z][y], and joins those of a piece.
std::vector<LoosePieces::Run> LoosePieces::runs_of(const state::BitPlane& solids, state::Grid grid) {
  std::vector<Run> runs;
  std::vector<std::size_t> below(static_cast<std::size_t>(grid.y) + 1), here(below.size());  // of a slice
  for (int z = 0; z < grid.z; ++z) {
    if (is_clear(slice_of(solids, grid, z))) {
      std::ranges::fill(below, runs.size());
      continue;
    }
    for (int y = 0; y < grid.y; ++y) {
      const auto at = static_cast<std::size_t>(y);
      here[at] = runs.size();
      append_runs(solids.row(y, z), y, z, runs);
      here[at + 1] = runs.size();
      if (y > 0) join(runs, here[at - 1], here[at], here[at], here[at + 1]);
      if (z > 0) join(runs, below[at], below[at + 1], here[at], here[at + 1]);
    }
    below.swap(here);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].piece = root_of(runs, i);
  return runs;
}

// Takes from the held solids those that have gone. It tells if the others are held for sure.
bool LoosePieces::still_hold(const state::Volume& volume) {
  const state::Grid grid = volume.grid;
  const std::size_t row_words = held_.row_words();
  for (int z = 0; z < grid.z; ++z) {
    const Words now = slice_of(volume.solid, grid, z), before = slice_of(held_, grid, z);
    if (std::ranges::equal(now, before)) continue;  // fast, and true of most slices in each step
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i] == before[i]) continue;
      rest_ |= (now[i] & ~before[i]) != 0;
      const int y = static_cast<int>(i / row_words), word = static_cast<int>(i % row_words);
      for (std::uint64_t gone = before[i] & ~now[i]; gone != 0; gone &= gone - 1) {
        const int x = 64 * word + std::countr_zero(gone);
        held_.set(x, y, z, false);
        if (!is_locally_one(held_, volume.inert, grid, x, y, z)) return false;
      }
    }
  }
  return true;
}

// Searches all solids.
void LoosePieces::search(const state::Volume& volume) {
  ++searches_;
  const state::BitPlane loose = state::loose_solids(volume);
  held_ = volume.solid;
  inert_ = volume.inert;
  rest_ = false;
  loose_.clear();
  if (is_clear(loose.words())) return;
  rest_ = true;
  std::uint64_t* const held = held_.data();
  const Words words = loose.words();
  for (std::size_t i = 0; i < words.size(); ++i) put(held[i], held[i] & ~words[i]);
  loose_ = runs_of(loose, volume.grid);
}

bool LoosePieces::touches_held(const state::Volume& volume, const Run& run) const {
  const auto holds = [&](int x, int y, int z) {
    return volume.grid.contains(x, y, z) && (held_.test(x, y, z) || volume.inert.test(x, y, z));
  };
  if (run.y == 0 || holds(run.x0 - 1, run.y, run.z) || holds(run.x1, run.y, run.z)) return true;
  for (int x = run.x0; x < run.x1; ++x)
    if (holds(x, run.y - 1, run.z) || holds(x, run.y + 1, run.z) || holds(x, run.y, run.z - 1) ||
        holds(x, run.y, run.z + 1))
      return true;
  return false;
}

// Finds which of the solids that were not held are held now.
void LoosePieces::look_at_the_rest(const state::Volume& volume) {
  state::BitPlane rest = volume.solid;
  const Words held = held_.words();
  for (std::size_t i = 0; i < held.size(); ++i) put(rest.data()[i], rest.data()[i] & ~held[i]);
  loose_ = runs_of(rest, volume.grid);
  std::vector<char> lands(loose_.size(), 0);  // by the first run of a piece
  for (const Run& run : loose_)
    if (lands[run.piece] == 0 && touches_held(volume, run)) lands[run.piece] = 1;
  const auto landed = [&](const Run& run) { return lands[run.piece] != 0; };
  for (const Run& run : loose_)
    for (int x = run.x0; landed(run) && x < run.x1; ++x) held_.set(x, run.y, run.z, true);
  std::erase_if(loose_, landed);
}

const state::ChangedRows& LoosePieces::fall(const FallOfPieces& how, std::uint32_t step,
                                            state::Volume& volume) {
  changed_.clear();
  rest_ = false;
  if (held_.empty() || volume.inert != inert_ || !still_hold(volume))
    search(volume);
  else if (rest_)
    look_at_the_rest(volume);
  if (!rest_ || loose_.empty()) return changed_;
  mark_moving(how, step, volume);
  turn_columns(volume);
  return changed_;
}

void LoosePieces::mark_moving(const FallOfPieces& how, std::uint32_t step, const state::Volume& volume) {
  moving_ = state::BitPlane(volume.grid);
  std::vector<Run>& runs = loose_;
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.piece != b.piece ? a.piece < b.piece : a.y < b.y; });
  std::vector<Layer> layers;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    layers.clear();
    for (end = begin; end < runs.size() && runs[end].piece == runs[begin].piece; ++end) {
      if (end == begin || runs[end].y != runs[end - 1].y) layers.emplace_back();
      layers.back() += look(volume, runs[end]);
    }
    if (!moves(how, step, layers)) continue;
    for (std::size_t i = begin; i < end; ++i)
      for (int x = runs[i].x0; x < runs[i].x1; ++x) moving_.set(x, runs[i].y, runs[i].z, true);
  }
}

// Turns the cells of each set that follow each other in a column, and the one below, round once.
void LoosePieces::turn_columns(state::Volume& volume) {
  const state::Grid grid = volume.grid;
  const auto swap_with_below = [&](int x, int y, int z) {
    const state::Slot at = volume.at(x, y, z), below = volume.at(x, y - 1, z);
    for (auto* field : {&volume.amount, &volume.energy, &volume.heat}) {
      const std::uint16_t upper = (*field)[at], lower = (*field)[below];
      put((*field)[at], lower);
      put((*field)[below], upper);
    }
    if (!volume.material.empty()) std::swap(volume.material[at], volume.material[below]);
  };
  // From below on, each row changes places with what has come up to it.
  for (int z = 0; z < grid.z; ++z) {
    if (is_clear(slice_of(moving_, grid, z))) continue;
    for (int y = 1; y < grid.y; ++y) {
      const Words moving = moving_.row(y, z);
      std::uint64_t words = 0;
      for (std::size_t w = 0; w < moving.size(); ++w) {
        if (moving[w] == 0) continue;
        words |= std::uint64_t{1} << w;
        for (std::uint64_t left = moving[w]; left != 0; left &= left - 1)
          swap_with_below(static_cast<int>(64 * w) + std::countr_zero(left), y, z);
        for (auto* plane : {&volume.solid, &volume.liquid}) {
          std::uint64_t &upper = plane->row(y, z)[w], &lower = plane->row(y - 1, z)[w];
          const std::uint64_t both = (upper ^ lower) & moving[w];
          upper ^= both;
          lower ^= both;
        }
      }
      if (words == 0) continue;
      changed_.push_back({y, z, words});
      changed_.push_back({y - 1, z, words});
    }
  }
}

}  // namespace voxmelt::parallel
