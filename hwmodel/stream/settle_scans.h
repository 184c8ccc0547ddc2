// The three scans of settling, one lane each: up the column to sum each run, down to bring the sums to its
// first cell, and up again to share them out. Between two scans a ColumnReverser turns the column round.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/stream/viscous_run.h"

namespace voxmelt::hwmodel {

// Of a cell between two scans. A run's record lies in one of its words: the uppermost one's after the first
// scan, the lowest one's after the second; the other words of a run need no payload at all.
enum class SettleKind : std::uint8_t { solid, inert, outside, inner, first, top, single };
inline constexpr int kSettleKindBits = 3;

struct SettleWord {
  SettleKind kind = SettleKind::inert;
  UInt<28> sum = kFlatBed;  // of the record; cells outside runs: their amount
  UInt<12> last;            // of the record: the number of cells less one
  UInt<16> heat;            // of the record: the mixture's; cells outside runs: their own

  bool blocked() const { return kind == SettleKind::solid || kind == SettleKind::inert; }

  static int bits(const RunWidths& widths, bool hot) {
    return kSettleKindBits + widths.sum + widths.count + (hot ? 16 : 0);
  }
};

// First scan, upwards. A cell's part is known when the next one comes: one token of look-ahead.
class SumScan {
 public:
  // Takes the next cell (`bottom`: of another column) and gives the word of the one before.
  SettleWord next(const Cell& cell, bool bottom, bool hot, std::int64_t dither) {
    const bool was_in_run = held_.kind == SettleKind::first || held_.kind == SettleKind::inner;
    const SettleKind kind = kind_of(cell, bottom, was_in_run);
    SettleWord done = held_;
    if (was_in_run) {
      done = {held_.kind, 0, 0, 0};
      if (kind != SettleKind::inner) {
        done.kind = held_.kind == SettleKind::first ? SettleKind::single : SettleKind::top;
        done.sum = sum_, done.last = last_;
        if (hot) done.heat = mix(content_, sum_, dither);
      }
    }
    held_ = {kind, std::int64_t{cell.amount}, 0, cell.heat};
    if (kind == SettleKind::first)
      sum_ = 0, content_ = 0, last_ = 0;
    else if (kind == SettleKind::inner)
      last_ = last_ + 1;
    else
      return done;
    sum_ = sum_ + cell.amount;
    if (hot) content_ = content_ + cell.amount * cell.heat;
    return done;
  }

 private:
  SettleKind kind_of(const Cell& cell, bool bottom, bool was_in_run) const {
    if (cell.blocked()) return cell.state == State::solid ? SettleKind::solid : SettleKind::inert;
    if (bottom || held_.blocked()) return cell.amount > 0 ? SettleKind::first : SettleKind::outside;
    const bool crowded = sum_ > (last_ + 1) * kOne;
    const bool joined = held_.sum >= kOne / 2 && cell.amount > 0;
    return was_in_run && (crowded || joined) ? SettleKind::inner : SettleKind::outside;
  }

  SettleWord held_;
  UInt<28> sum_;
  UInt<12> last_;
  UInt<44> content_;
};

// Second scan, downwards: takes the record along to the first cell.
class RecordScan {
 public:
  SettleWord next(const SettleWord& word) {
    switch (word.kind) {
      case SettleKind::top:
        record_ = word;
        return {SettleKind::inner, 0, 0, 0};
      case SettleKind::first:
        return {SettleKind::first, record_.sum, record_.last, record_.heat};
      case SettleKind::single:
        return {SettleKind::first, word.sum, word.last, word.heat};
      default:
        return word;
    }
  }

 private:
  SettleWord record_;
};

// Third scan, upwards: gives every cell its amount and its heat, and cells in a run what they show. (What
// cells outside runs show, the readers of the next stage work out: see run_reader.h.)
class ShowScan {
 public:
  void next(const SettleWord& word, int y, const rule::Flow& flow, std::int64_t pace, const RunWidths& widths,
            Cell& cell) {
    if (y == 0) bed_ = kFlatBed;
    cell = {};
    if (word.blocked()) {
      cell.state = word.kind == SettleKind::solid ? State::solid : State::inert;
      cell.amount = std::int64_t{word.sum};
      cell.heat = word.heat;
      bed_ = word.kind == SettleKind::inert ? std::int64_t{word.sum} : kFlatBed;
      return;
    }
    cell.amount = 0;
    if (word.kind == SettleKind::outside)
      cell.amount = std::int64_t{word.sum}, cell.heat = word.heat;
    else
      settle(word, y, flow, pace, widths, cell);
    cell.state = State::liquid;
    cell.settle_state();
    if (!cell.in_run) return;
    cell.head = show_.head, cell.dead = show_.dead;
    cell.mobility = show_.mobility, cell.limit = show_.limit;
  }

 private:
  void settle(const SettleWord& word, int y, const rule::Flow& flow, std::int64_t pace,
              const RunWidths& widths, Cell& cell) {
    if (word.kind == SettleKind::first) {
      show_ = shown(word.sum, word.last, bed(y), word.heat, flow, pace, widths);
      level_ = word.sum;
      // x 61439 is two shifts and two subtractions
      spare_ = std::min(over_of(word.sum, word.last) - kOverMax * word.last, kOverMax);
      heat_ = word.heat;
    }
    cell.amount = std::min<std::int64_t>(level_, kOne) + std::max<std::int64_t>(spare_, 0);
    cell.heat = heat_;
    cell.in_run = cell.amount > 0;  // an emptied cell has left the run
    level_ = std::max<std::int64_t>(0, level_ - kOne);
    spare_ = std::min(spare_ + kOverMax, kOverMax);
  }

  std::int64_t bed(int y) const { return 256 * y + ((std::int64_t{bed_} - kFlatBed) >> 4); }

  UInt<16> bed_ = kFlatBed;  // of the blocked cell below
  RunShow show_;
  UInt<28> level_;  // of the run's amount, less ONE for each cell below
  SInt<30> spare_;  // of the amount beyond ONE per cell, less what the cells above can hold
  UInt<16> heat_;
};

}  // namespace voxmelt::hwmodel
