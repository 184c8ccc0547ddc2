// In phase `excess` of the viscous law runs settle, and show their neighbours head and mobility
// (docs/automaton.md, section 10). The code does one slice, a few words of columns at a time. It goes upwards
// to sum the runs, downwards to write them, and once more for the cells outside runs. It is free of
// kernel/automaton/rule on purpose.
//
// A column is processed whole if one of its tiles is asked for. Settling is not idempotent (a run that comes
// to rest may then reach liquid above it). But it is a function of the column alone, and of the dither only
// if parts of different heats come together. So if a settle has changed nothing, and nothing has since,
// another one changes nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/mix.h"
#include "kernel/engine/simd/run_data.h"
#include "kernel/engine/simd/run_order.h"
#include "kernel/engine/simd/show_outside.h"

namespace voxmelt::simd {

template <class Arch, ViscousFeatures kFeatures>
class Settle {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;
  using W = typename L::W;
  using Wide = typename L::Wide;
  static constexpr int kGroup = kSettleGroup;

 public:
  [[gnu::always_inline]] Settle(const View& view, const Step& step, int z, const Runs& runs, void* scratch,
                                Books& books)
      : v_(view),
        r_(runs),
        data_(step),
        beds_(*step.parameters),
        mix_(step.dither),
        z_(z),
        records_(static_cast<EndedRuns*>(scratch)),
        taken_(static_cast<std::uint64_t*>(
            static_cast<void*>(records_ + kGroup * static_cast<std::ptrdiff_t>(view.ny)))),
        books_(books) {}

  [[gnu::always_inline]] void run(const TileRow* tiles, TileRow* changed) {
    TileRow columns = 0;
    for (int t = 0; t << v_.tile_shift < v_.ny; ++t) columns |= tiles[t];
    if (v_.words < 64) columns &= (TileRow{1} << v_.words) - 1;
    const ShowOutside<Arch> outside(v_, beds_, z_, r_);
    for (int base = 0; base < v_.words; base += kGroup) {
      const TileRow group = columns >> base & ((TileRow{1} << kGroup) - 1);
      if (group == 0) continue;
      base_ = base;
      for (Limits& limits : limits_) limits = {};
      const Rows rows = gather(group, changed);
      for (int y = rows.last; y >= rows.first; --y) {
        changed[y >> v_.tile_shift] |= write(group, y) << base;
        if ((y & 1023) == 0) close();  // mixing is summed over so many rows
      }
      close();
      note_limits(group);
      // Cells outside runs show something else only if they, or the cells below, have changed since.
      TileRow below = 0;
      for (int t = 0; t < v_.tile_rows(); ++t) {
        for (int y = v_.tile_begin(t); y < v_.tile_end(t); ++y) {
          const TileRow anew = ((tiles[t] | changed[t]) >> base & group) | below;
          below = 0;
          if (anew == 0) break;  // rows above, up to the next tile, show the same
          changed[t] |= outside.row(anew, base, y) << base;
        }
        below = (tiles[t] | changed[t]) >> base & group;
      }
    }
  }

 private:
  using Limits = state::LimitCounts<std::int64_t>;

  // Books the difference to the last call.
  [[gnu::always_inline]] void note_limits(TileRow group) const {
    for (; group != 0; group &= group - 1) {
      const int g = __builtin_ctzll(group);
      Limits& old = r_.limits[z_ * v_.words + base_ + g];
      const Limits& now = limits_[g];
      books_.limit.add(now);
      books_.limit.add(Limits{-old.cells, -old.limited_cells, -old.mass, -old.limited_mass});
      old = now;
    }
  }

  // Sums the runs in progress. The vectors are in the order in which unpacking leaves them.
  struct Sums {
    Wide excess[L::kParts], low[L::kParts], high[L::kParts];
    V first[L::kParts], bed[L::kParts];
  };

  struct Rows {
    int first, last;
  };

  [[gnu::always_inline]] void close() {
    if constexpr (kFeatures.hot) books_.heat.rounded += mix_.flush();
  }

  // Goes upwards. It finds the cells that runs take, the sums of those that end, and the parts that move up.
  // It returns the rows in which there is, or was, a run.
  [[gnu::always_inline]] Rows gather(TileRow group, TileRow* changed) {
    Rows rows{v_.ny, -1};
    Sums sums[kGroup];
    std::uint64_t goes_on[kGroup] = {}, blocked[kGroup];
    for (int g = 0; g < kGroup; ++g) {
      blocked[g] = ~std::uint64_t{0};
      used_[g] = 0;
      open_[g] = false;
      for (int part = 0; part < L::kParts; ++part) {
        const Wide none{W(0), W(0)};
        sums[g].excess[part] = sums[g].low[part] = sums[g].high[part] = none;
        sums[g].first[part] = sums[g].bed[part] = L::zero();
      }
    }
    for (int y = 0; y < v_.ny; ++y)
      for (TileRow left = group; left != 0; left &= left - 1) {
        const int g = __builtin_ctzll(left), w = base_ + g;
        const std::uint64_t below = blocked[g];
        blocked[g] = v_.blocked(w, y, z_);
        const std::uint64_t start = v_.liquid[v_.word(w, y, z_)] & ~blocked[g] & below;
        const std::uint64_t taken = start | goes_on[g];
        taken_[y * kGroup + g] = taken;
        if ((taken | r_.in_run[v_.word(w, y, z_)]) != 0) {
          rows.first = std::min(rows.first, y);
          rows.last = y;
        }
        if (taken == 0) continue;
        if (start != 0) {
          if (open_[g] && (record(g, used_[g] - 1).columns & start) != 0) open_[g] = false;
          begin(sums[g], g, start, w, y);
        }
        goes_on[g] = take(sums[g], g, taken, w, y, changed);
        if ((taken & ~goes_on[g]) != 0) keep(sums[g], g, taken & ~goes_on[g], w, y);
      }
    if constexpr (kFeatures.hot)
      for (RunOrder<Arch>& order : orders_) books_.heat.rounded += order.flush();
    return rows;
  }

  // Adds the cells of a word that runs take. It returns those whose run goes on above.
  [[gnu::always_inline]] std::uint64_t take(Sums& sums, int g, std::uint64_t taken, int w, int y,
                                            TileRow* changed) {
    const std::uint64_t ceiling = v_.blocked(w, y + 1, z_);
    std::uint64_t over = 0, half = 0;
    bool moves = false;
    const std::size_t cell = v_.cell(w, y, z_);
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(taken, part)) continue;
      const std::size_t at = cell + static_cast<std::size_t>(part * L::kCount);
      const int shift = part * L::kCount;
      const V amount = L::load(v_.amount + at);
      Wide& excess = sums.excess[part];
      if constexpr (kFeatures.hot) orders_[g].meet(part, excess);
      excess = L::sum(excess, L::widen(amount));
      excess = {excess.low - W(4096), excess.high - W(4096)};
      const V too_much = L::narrow(excess);
      over |= L::to_bits(L::less(L::zero(), too_much)) << shift;
      half |= L::to_bits(L::less(L::set(2047), amount)) << shift;
      if constexpr (kFeatures.hot) {
        const V heat = L::load(v_.heat + at);
        sums.low[part] = L::sum(sums.low[part], L::widen(L::low(amount, heat)));
        sums.high[part] = L::sum(sums.high[part], L::widen(L::high(amount, heat)));
        const std::uint64_t rises = over & taken & ~ceiling;
        if (L::in_part(rises, part) || orders_[g].moves(part)) {
          const V up = L::keep(L::from_bits(rises, part), too_much);
          orders_[g].lift(part, mix_, up, v_.amount + at, v_.heat + at);
          moves = true;
        }
      }
    }
    const std::uint64_t wet = y + 1 < v_.ny ? v_.liquid[v_.word(w, y + 1, z_)] : 0;
    if (moves) changed[y >> v_.tile_shift] |= TileRow{1} << w;
    return taken & ~ceiling & (over | (half & wet));
  }

  [[gnu::always_inline]] void begin(Sums& sums, int g, std::uint64_t start, int w, int y) {
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(start, part)) continue;
      const M which = L::from_bits(start, part);
      const V old = L::select(which, L::zero(), L::set(0xFFFF));
      const Wide kept = L::unpack(old, old);
      sums.excess[part] = {sums.excess[part].low & kept.low, sums.excess[part].high & kept.high};
      if constexpr (kFeatures.hot) {
        sums.low[part] = {sums.low[part].low & kept.low, sums.low[part].high & kept.high};
        sums.high[part] = {sums.high[part].low & kept.low, sums.high[part].high & kept.high};
        orders_[g].begin(part, kept);
      }
      sums.first[part] = L::select(which, L::set(y), sums.first[part]);
      sums.bed[part] = L::select(which, beds_.below(v_, w, y, z_, part), sums.bed[part]);
    }
  }
  // Keeps the sums of ended runs. Runs of different columns share a record until one of its columns begins
  // another run. So on the way down a record is wanted at its top, when all runs of later records have been
  // written.
  [[gnu::always_inline]] void keep(const Sums& sums, int g, std::uint64_t ended, int w, int y) {
    if (!open_[g]) {
      open_[g] = true;
      EndedRuns& fresh = record(g, used_[g]++);
      fresh.columns = fresh.ordered = fresh.roofed = 0;
    }
    EndedRuns& to = record(g, used_[g] - 1);
    to.columns |= ended;
    to.roofed |= ended & v_.blocked(w, y + 1, z_);
    to.top = y;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(ended, part)) continue;
      const int lane = part * L::kCount;
      const M which = L::from_bits(ended, part);
      const auto add = [&](std::uint16_t* field, V value) {
        L::store(field + lane, L::select(which, value, L::load(field + lane)));
      };
      const auto add_wide = [&](std::uint16_t* low, std::uint16_t* high, Wide value) {
        add(low, low_half(value));
        add(high, high_half(value));
      };
      add_wide(to.excess_low, to.excess_high, sums.excess[part]);
      add(to.first, sums.first[part]);
      add(to.last, L::set(y));
      add(to.bed, sums.bed[part]);
      if constexpr (kFeatures.hot) {
        add_wide(to.content[0], to.content[1], sums.low[part]);
        add_wide(to.content[2], to.content[3], sums.high[part]);
        to.ordered |= orders_[g].end(part, which, sums.excess[part]) << lane;
      }
    }
  }
  [[gnu::always_inline]] EndedRuns& record(int g, int i) const {
    return records_[static_cast<std::ptrdiff_t>(g) * v_.ny + i];
  }
  [[gnu::always_inline]] static V low_half(Wide wide) {
    return L::narrow({wide.low & W(0xFFFF), wide.high & W(0xFFFF)});
  }
  [[gnu::always_inline]] static V high_half(Wide wide) {
    return L::narrow({(wide.low >> 16) & W(0xFFFF), (wide.high >> 16) & W(0xFFFF)});
  }

  // Goes downwards. It writes amounts and heats of the cells taken, and what those of a run show.
  [[gnu::always_inline]] TileRow write(TileRow group, int y) {
    TileRow changed = 0;
    while (group != 0) {  // from the last on, as y goes down: so memory is foreseen
      const int g = 63 - __builtin_clzll(group), w = base_ + g;
      group &= ~(TileRow{1} << g);
      const std::uint64_t taken = taken_[y * kGroup + g];
      const std::size_t word = v_.word(w, y, z_);
      if ((taken | r_.in_run[word]) == 0) continue;
      TileRow& deep = r_.deep[z_ * v_.ny + y];
      deep &= ~(TileRow{1} << w);
      std::uint64_t in_run = 0;
      bool differs = false;
      if (taken != 0) {
        if (used_[g] > 0 && record(g, used_[g] - 1).top == y)
          books_.heat.rounded += data_.settle(record(g, --used_[g]), settled_[g], limits_[g]);
        for (int part = 0; part < L::kParts; ++part)
          if (L::in_part(taken, part))
            in_run |= vectors(w, y, part, taken, g, deep, differs) << (part * L::kCount);
        v_.liquid[word] = (v_.liquid[word] & ~taken) | in_run;
      }
      const std::uint64_t shut = in_run & settled_[g].shut;
      if (r_.in_run[word] != in_run || r_.shut[word] != shut) {
        r_.in_run[word] = in_run;
        r_.shut[word] = shut;
        differs = true;
      }
      if (differs) changed |= TileRow{1} << g;
    }
    return changed;
  }

  // Writes one part of a word. It returns the lanes that are in a run.
  [[gnu::always_inline]] std::uint64_t vectors(int w, int y, int part, std::uint64_t taken, int g,
                                               TileRow& deep, bool& differs) {
    const SettledRuns& settled = settled_[g];
    const int lane = part * L::kCount;
    const std::size_t at = v_.cell(w, y, z_) + lane;
    const V height = L::set(y + 1), pivot = L::load(settled.pivot + lane);
    const V higher =
        L::select(L::equal(height, pivot), L::load(settled.at + lane), L::load(settled.above + lane));
    const V value = L::select(L::less(height, pivot), L::set(4096), higher);
    const M takes = L::from_bits(taken, part);
    const M in_run = L::less(L::zero(), L::keep(takes, value));

    const V old = L::load(v_.amount + at), amount = L::select(takes, value, old);
    Wide head = L::unpack(L::load(settled.head_low + lane), L::load(settled.head_high + lane));
    head = {head.low - W(512 * y), head.high - W(512 * y)};
    const V cut = L::keep(in_run, L::narrow(head));
    const V old_head = L::load(r_.head + at), new_head = L::select(in_run, cut, old_head);
    const V old_mobility = L::load(r_.mobility + at), old_dead = L::load(r_.dead + at),
            old_bed = L::load(r_.bed + at);
    const V mobility = L::select(in_run, L::load(settled.mobility + lane), old_mobility);
    const V dead = L::select(in_run, L::load(settled.dead + lane), old_dead);
    const V bed = L::select(in_run, L::load(settled.shown_bed + lane), old_bed);
    const V old_fine = L::load(r_.fine + at), old_limit = L::load(r_.limit + at);
    const V fine = L::select(in_run, L::load(settled.fine + lane), old_fine);
    const V limit = L::select(in_run, L::load(settled.limit + lane), old_limit);
    V difference = (old ^ amount) | (old_head ^ new_head) | (old_mobility ^ mobility) | (old_dead ^ dead) |
                   (old_bed ^ bed) | (old_fine ^ fine) | (old_limit ^ limit);
    if (r_.filled != nullptr) {
      const V old_filled = L::load(r_.filled + at);
      L::store(r_.filled + at, L::select(in_run, L::load(settled.filled + lane), old_filled));
    }
    if constexpr (kFeatures.hot) {
      // If no amount changes and nothing comes from above, no heat changes in runs that keep their order.
      const std::uint64_t ordered = taken & settled.ordered, mixed = taken & ~settled.ordered;
      if (L::in_part(mixed, part) || orders_[g].moves(part) || L::nonzero(old ^ amount)) {
        const V old_heat = L::load(v_.heat + at);
        const M keeps = L::from_bits(ordered, part);
        const V own = orders_[g].sink(part, mix_, keeps, old, old_heat, value);
        const V heat = L::select(keeps, own, L::load(settled.heat + lane));
        const V new_heat = L::select(takes, L::keep(in_run, heat), old_heat);
        difference = difference | (old_heat ^ new_heat);
        L::store(v_.heat + at, new_heat);
      }
    }
    if (L::to_bits(L::equal(cut, L::set(0xFFFF))) != 0) {
      deep |= TileRow{1} << w;
      difference = difference | plumb(at, head);
    }
    if (L::to_bits(L::equal(difference, L::zero())) != kAll) {
      differs = true;
      L::store(v_.amount + at, amount);
      L::store(r_.head + at, new_head);
      L::store(r_.mobility + at, mobility);
      L::store(r_.dead + at, dead);
      L::store(r_.bed + at, bed);
      L::store(r_.fine + at, fine);
      L::store(r_.limit + at, limit);
    }
    return L::to_bits(in_run);
  }

  // Writes heads that 16 bits do not hold. It returns the changes.
  [[gnu::always_inline]] V plumb(std::size_t at, Wide head) const {
    const V old_low = L::load(r_.deep_low + at), old_high = L::load(r_.deep_high + at);
    const V low = low_half(head), high = high_half(head);
    L::store(r_.deep_low + at, low);
    L::store(r_.deep_high + at, high);
    return (old_low ^ low) | (old_high ^ high);
  }

  static constexpr std::uint64_t kAll = (std::uint64_t{1} << L::kCount) - 1;
  const View v_;
  const Runs r_;
  const RunData<Arch, kFeatures.hot> data_;
  const Beds<Arch> beds_;
  Mix<Arch> mix_;
  const int z_;
  EndedRuns* const records_;    // [group][at most ny], stacks
  std::uint64_t* const taken_;  // [y][group]
  Books& books_;
  SettledRuns settled_[kGroup] = {};
  RunOrder<Arch> orders_[kGroup];
  Limits limits_[kGroup];  // counts of the words of a group
  int base_ = 0;
  int used_[kGroup];   // records in use
  bool open_[kGroup];  // the last record may take more columns
};

}  // namespace voxmelt::simd
