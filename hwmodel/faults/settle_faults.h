// Runs that end too early or lose a bit of their sum, and columns that leave upside down.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/faults/planted.h"
#include "hwmodel/stream/settle_stage.h"

namespace voxmelt::hwmodel {

class SettleFaults : public Planted {
 public:
  using Faulty = Settle<SettleFaults>;

  SettleFaults(FaultPlan& plan, const Design& design)
      : Planted(plan), column_(design.shape.lanes, static_cast<std::size_t>(design.shape.column())) {}

  void summed(Faulty& stage, const Cell* in) {
    const bool carry = armed(stage, Fault::settle_sum_carry);
    if (!carry && !armed(stage, Fault::settle_run_broken)) return;
    column_.shift();
    if (in != nullptr) std::copy_n(in, stage.lanes(), column_.tap(0));
    if (stage.came().ordinal == 0) return;
    for (std::size_t lane = 0; lane < stage.size(); ++lane) {
      const SettleWord& word = stage.words_[lane];
      if (word.kind != SettleKind::top && (!carry || word.kind != SettleKind::single)) continue;
      const Broken broken = carry ? without_highest_bit(word) : without_top(stage, word, lane);
      const std::int64_t wrong = first_wrong(word, broken);
      if (wrong >= 0) return damage(stage, lane, broken, wrong);
    }
  }

  // Reads the column that is to leave as it lies, from the top, if that makes a difference.
  void turned(Faulty& stage) {
    if (stage.leaving().y != 0 || !armed(stage, Fault::settle_reversal)) return;
    std::vector<ShowScan> right = stage.shows_, wrong = stage.shows_;
    for (std::int64_t y = 0; y < stage.height_; ++y)
      for (std::size_t lane = 0; lane < stage.size(); ++lane) {
        Cell expected, found;
        const auto show = [&](ShowScan& scan, std::int64_t from, Cell& cell) {
          scan.next(stage.upwards_.will_give(from)[lane], static_cast<int>(y), stage.flow_, stage.pace_,
                    stage.widths_, cell);
        };
        show(right[lane], y, expected);
        show(wrong[lane], stage.height_ - 1 - y, found);
        if (expected.state == found.state && expected.amount == found.amount && expected.heat == found.heat)
          continue;
        strike(stage, stage.leaving().x + static_cast<int>(lane), static_cast<int>(y), stage.leaving().z);
        return stage.upwards_.miss_turn();
      }
  }

 private:
  // The record of a run that is wrong, and the cell that the run lost.
  struct Broken {
    std::int64_t sum, last, heat;
    std::int64_t above_amount = 0, above_heat = 0;
  };

  static Broken without_highest_bit(const SettleWord& word) {
    const std::int64_t highest = std::int64_t{1}
                                 << (std::bit_width(static_cast<std::uint64_t>(word.sum)) - 1);
    return {word.sum - highest, word.last, word.heat};
  }

  Broken without_top(const Faulty& stage, const SettleWord& word, std::size_t lane) {
    const Cell& top = column_.tap(1)[lane];
    Broken broken{word.sum - top.amount, word.last - 1, word.heat, top.amount, top.heat};
    std::int64_t content = 0;
    for (std::int64_t below = 1; below <= word.last; ++below) {
      const Cell& cell = column_.tap(static_cast<std::size_t>(1 + below))[lane];
      content += cell.amount * cell.heat;
    }
    if (stage.hot_) broken.heat = mix(content, broken.sum, stage.dither_);
    return broken;
  }

  // The lowest cell of the run that settles wrong; -1: none.
  static std::int64_t first_wrong(const SettleWord& right, const Broken& broken) {
    for (std::int64_t k = 0; k <= right.last; ++k) {
      const bool lost = k > broken.last;
      const std::int64_t amount = settled_amount(right.sum, right.last, k);
      const std::int64_t other = lost ? broken.above_amount : settled_amount(broken.sum, broken.last, k);
      const std::int64_t heat = lost ? broken.above_heat : broken.heat;
      if (amount != other || (amount > 0 && heat != right.heat)) return k;
    }
    return -1;
  }

  // `wrong`: the first cell of the run that this leaves wrong.
  void damage(Faulty& stage, std::size_t lane, const Broken& broken, std::int64_t wrong) {
    SettleWord& word = stage.words_[lane];
    const Place place = place_of(stage.shape(), stage.came().ordinal - 1);
    strike(stage, place.x + static_cast<int>(lane), place.y - static_cast<int>(word.last - wrong), place.z);
    if (broken.last == word.last) {
      word.sum = broken.sum;
      return;
    }
    // The record belongs to the cell below, and this one is outside.
    SettleWord& below = stage.downwards_.newest()[lane];
    const SettleKind kind = below.kind == SettleKind::first ? SettleKind::single : SettleKind::top;
    below = {kind, broken.sum, broken.last, broken.heat};
    word = {SettleKind::outside, broken.above_amount, 0, broken.above_heat};
  }

  TapLine<Cell> column_;  // what has come lately
};

}  // namespace voxmelt::hwmodel
