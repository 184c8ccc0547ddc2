// Three scans settle the runs of a column, one lane each. The first goes up and sums each run. The second
// goes down and brings the sums to the run's first cell. The third goes up again and shares them out. On the
// first two ways heat moves with what moves. Between two scans a ColumnReverser turns the column round.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/model/viscous_run.h"

namespace voxmelt::hwmodel {

// Tells what a cell is between two scans. A run's record lies in one of its words: the uppermost one after
// the first scan, the lowest one after the second. The other words of a run hold the cell's heat, and after
// the first scan its amount. After the second one the lowest word is `shut` or `first`, and none is `top` or
// `single`.
enum class SettleKind : std::uint8_t { solid, inert, outside, inner, first, top, single, shut };
inline constexpr int kSettleKindBits = 3;

struct SettleWord {
  SettleKind kind = SettleKind::inert;
  UInt<28> sum = kFlatBed;  // record: the run's sum; other words: the cell's amount
  UInt<12> last;            // record: number of cells less one
  UInt<16> heat;            // the cell's; in the uppermost cell of a run that mixes: the mixture's
  // The following belong to the record, with heat.
  UInt<1> ordered;  // the run keeps its order (not after the second scan)
  UInt<16> top;     // amount of the uppermost cell of such a run (not after the second scan)
  UInt<16> mean;    // mean heat, with thermal viscosity

  UInt<1> set;           // of the place, in scenes that freeze
  UInt<4> material = 0;  // of a solid, in scenes with several; such a word has no record

  bool blocked() const { return kind == SettleKind::solid || kind == SettleKind::inert; }
  // After the second scan this tells where a record lies.
  bool lowest() const { return kind == SettleKind::first || kind == SettleKind::shut; }

  // `bits` counts those of a word after the second scan, `bits_upwards` those of a word after the first. A
  // solid's material takes those of a record.
  static int bits(const RunWidths& widths, const Design& design) {
    return std::max(record_bits(widths, design), solid_bits(design)) + (design.freezes() ? 1 : 0);
  }
  static int bits_upwards(const RunWidths& widths, const Design& design) {
    const int record = record_bits(widths, design) + (design.hot() ? 1 + 16 : 0);
    return std::max(record, solid_bits(design)) + (design.freezes() ? 1 : 0);
  }

 private:
  static int record_bits(const RunWidths& widths, const Design& design) {
    const bool thermal = design.hot() && design.parameters.flow.thermal_viscosity;
    return kSettleKindBits + widths.sum + widths.count + (design.hot() ? 16 : 0) + (thermal ? 16 : 0);
  }
  static int solid_bits(const Design& design) {
    return kSettleKindBits + 16 + (design.hot() ? 16 : 0) + (design.of_materials() ? 4 : 0);
  }
};

// Holds what comes through a face of a run to the next cell of a scan.
struct SettleFlow {
  UInt<16> amount, heat;

  // Returns the heat of a cell to which this comes.
  UInt<16> into(std::int64_t held, std::int64_t own, std::int64_t dither) const {
    if (amount == 0) return own;
    return mix(held * own + std::int64_t{amount} * heat, held + amount, dither);
  }
};

// The first scan goes up, sums each run, and moves up what is too much below. A cell's part is known when the
// next one comes, so the scan looks one token ahead.
class SumScan {
 public:
  // Takes the next cell and returns the word of the one before. `bottom` says that another column begins.
  SettleWord next(const Cell& cell, bool bottom, bool hot, std::int64_t dither) {
    const bool was_in_run = held_.kind == SettleKind::first || held_.kind == SettleKind::inner;
    const SettleKind kind = kind_of(cell, bottom, was_in_run);
    const SInt<29> excess = std::int64_t{sum_} - (last_ + 1) * kOne;  // at the face between the two cells
    SettleFlow up;
    SettleWord done = held_;
    mixed_ = false;
    if (kind == SettleKind::inner) {
      // No cell may hold more than kAmountMax. Otherwise the excess at its upper face is beyond its range,
      // too, or there is no such face and the run is under pressure.
      ordered_ =
          ordered_ && excess >= -kOverMax && cell.amount + std::max<std::int64_t>(0, excess) <= kAmountMax;
      if (hot && ordered_) up = {std::max<std::int64_t>(0, excess), held_.heat};
      mixed_ = up.amount > 0;
      done.sum = done.sum - up.amount;
    } else if (was_in_run) {
      done = record(excess, hot, dither);
    }
    held_ = {
        kind,         cell.amount + up.amount, 0, up.into(cell.amount, cell.heat, dither), 0, 0, 0, cell.set,
        cell.material};
    add(cell, kind, hot);
    return done;
  }
  // Tells if heat moved up into the cell that came last. That is a division.
  bool mixed() const { return mixed_; }

 private:
  SettleKind kind_of(const Cell& cell, bool bottom, bool was_in_run) const {
    if (cell.blocked()) return cell.state == State::solid ? SettleKind::solid : SettleKind::inert;
    if (bottom || held_.blocked()) return cell.amount > 0 ? SettleKind::first : SettleKind::outside;
    const bool crowded = sum_ > (last_ + 1) * kOne;
    const bool joined = amount_ >= kOne / 2 && cell.amount > 0;
    return was_in_run && (crowded || joined) ? SettleKind::inner : SettleKind::outside;
  }

  SettleWord record(std::int64_t excess, bool hot, std::int64_t dither) const {
    const bool ordered = hot && ordered_ && excess <= 0;
    SettleWord word{held_.kind == SettleKind::first ? SettleKind::single : SettleKind::top,
                    sum_,
                    last_,
                    0,
                    0,
                    0,
                    0,
                    held_.set};
    if (!hot) return word;
    word.heat = ordered ? held_.heat : mix(content_, sum_, dither);
    word.ordered = ordered;
    word.top = ordered ? std::int64_t{held_.sum} : 0;
    word.mean = mix(content_, sum_, 0);  // the same division, not rounded
    return word;
  }

  void add(const Cell& cell, SettleKind kind, bool hot) {
    amount_ = cell.amount;
    if (kind == SettleKind::first) {
      sum_ = 0;
      content_ = 0;
      last_ = 0;
      ordered_ = 1;
    } else if (kind == SettleKind::inner)
      last_ = last_ + 1;
    else
      return;
    sum_ = sum_ + cell.amount;
    if (hot) content_ = content_ + cell.amount * cell.heat;
  }

  SettleWord held_;
  UInt<16> amount_;  // amount of the cell held, as it came
  UInt<28> sum_;
  UInt<12> last_;
  UInt<44> content_;
  UInt<1> ordered_;  // the run has kept its order so far
  bool mixed_ = false;
};

// The second scan goes down, takes the record along to the first cell, and moves down what is missing below.
// It has just seen the cell above a run, and so tells if the run is shut.
class RecordScan {
 public:
  // `top` says that another column begins, under the border.
  SettleWord next(const SettleWord& word, bool top, std::int64_t dither) {
    const bool shut = (top || under_blocked_) && is_full(word.sum, word.last);
    const SettleKind lowest = shut ? SettleKind::shut : SettleKind::first;
    under_blocked_ = word.blocked();
    mixed_ = false;
    switch (word.kind) {
      case SettleKind::top:
        record_ = word;
        record_.kind = lowest;
        flow_ = {};
        level_ = std::int64_t{word.sum} - word.last * kOne;
        return {SettleKind::inner, 0, 0, lower(word.top, word.heat, dither), 0, 0, 0, word.set};
      case SettleKind::inner:
        return {SettleKind::inner, 0, 0, lower(word.sum, word.heat, dither), 0, 0, 0, word.set};
      case SettleKind::first:
        return {record_.kind, record_.sum, record_.last, lower(word.sum, word.heat, dither), 0, 0,
                record_.mean, word.set};
      case SettleKind::single:
        return {lowest, word.sum, word.last, word.heat, 0, 0, word.mean, word.set};
      default:
        return word;
    }
  }
  // Tells if heat moved down into the cell that came last.
  bool mixed() const { return mixed_; }

 private:
  // A cell of the run takes what comes from above, keeps its settled amount and gives the rest.
  UInt<16> lower(std::int64_t amount, std::int64_t heat, std::int64_t dither) {
    if (!record_.ordered) return record_.heat;
    mixed_ = flow_.amount > 0;
    const UInt<16> own = flow_.into(amount, heat, dither);
    flow_ = {amount + flow_.amount - std::clamp<std::int64_t>(level_, 0, kOne), std::int64_t{own}};
    level_ = level_ + kOne;
    return own;
  }

  SettleWord record_;      // its kind is that of the run's lowest word
  UInt<1> under_blocked_;  // the cell above is blocked
  SettleFlow flow_;
  SInt<29> level_;  // the run's amount, less ONE for each cell below
  bool mixed_ = false;
};

// The third scan goes up. It gives every cell its amount and its heat, and cells in a run what they show. The
// readers of the next stage work out what cells outside runs show (run_reader.h).
class ShowScan {
 public:
  void next(const SettleWord& word, int y, const rule::Flow& flow, std::int64_t pace, const RunWidths& widths,
            const SolidBed& solids, Cell& cell) {
    if (y == 0) rise_ = kFlatRise;
    cell = {};
    if (word.blocked()) {
      cell.state = word.kind == SettleKind::solid ? State::solid : State::inert;
      cell.amount = std::int64_t{word.sum};
      cell.heat = word.heat;
      cell.material = word.material;
      rise_ = cell.state == State::solid ? std::int64_t{solids.rise(cell.amount, cell.heat, cell.material)}
                                         : std::int64_t{rise_of_inert(cell.amount)};
      return;
    }
    cell.amount = 0;
    if (word.kind == SettleKind::outside) {
      cell.amount = std::int64_t{word.sum};
      cell.heat = word.heat;
    } else
      settle(word, y, flow, pace, widths, cell);
    cell.state = State::liquid;
    cell.settle_state();
    cell.set = word.set;
    if (!cell.in_run) return;
    cell.head = show_.head;
    cell.dead = show_.dead;
    cell.shut = shut_;
    cell.mobility = show_.mobility;
    cell.limit = show_.limit;
  }

 private:
  void settle(const SettleWord& word, int y, const rule::Flow& flow, std::int64_t pace,
              const RunWidths& widths, Cell& cell) {
    if (word.lowest()) {
      shut_ = word.kind == SettleKind::shut;
      show_ = shown(word.sum, word.last, bed_head(y, rise_), word.mean, flow, pace, widths);
      level_ = word.sum;
      // The product with kOverMax = 61439 takes two shifts and two subtractions.
      spare_ = std::min(over_of(word.sum, word.last) - kOverMax * word.last, kOverMax);
    }
    cell.amount = std::min<std::int64_t>(level_, kOne) + std::max<std::int64_t>(spare_, 0);
    cell.heat = word.heat;
    cell.in_run = cell.amount > 0;  // an emptied cell has left the run
    level_ = std::max<std::int64_t>(0, level_ - kOne);
    spare_ = std::min(spare_ + kOverMax, kOverMax);
  }

  UInt<14> rise_ = kFlatRise;  // of the bed, the blocked cell below
  RunShow show_;
  UInt<1> shut_;
  UInt<28> level_;  // the run's amount, less ONE for each cell below
  SInt<30> spare_;  // the amount beyond ONE per cell, less what the cells above can hold
};

}  // namespace voxmelt::hwmodel
