// The settle stage runs the phase `excess` of the viscous law (docs/automaton.md, section 10). A run's sums
// are known at its uppermost cell, and are needed at its lowest one. So the column is turned round twice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/fabric/column_reverser.h"
#include "hwmodel/pipeline/model/settle_scans.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Settle final : public Stage {
 public:
  explicit Settle(const Design& design, Faults faults = {})
      : Stage(StageKind::settle, design, 2 * design.shape.column() + 1),
        faults_(faults),
        hot_(design.hot()),
        flow_(design.parameters.flow),
        widths_(design),
        solids_(design),
        height_(design.shape.column()),
        sums_(size()),
        records_(size()),
        shows_(size()),
        words_(size()),
        turned_(size()),
        downwards_(lanes(), height_),
        upwards_(lanes(), height_) {}

  Wires side_bands() const override {
    return Wires{Wire::in_run, Wire::head, Wire::mobility, Wire::limit, Wire::dead, Wire::shut}.add(
        Wire::set, design().freezes());
  }
  int width_of(Wire wire) const override { return wire == Wire::head ? widths_.head : Stage::width_of(wire); }
  std::vector<BufferCost> buffers() const override {
    std::vector<BufferCost> buffers{
        downwards_.cost("column reverser down", SettleWord::bits_upwards(widths_, design())),
        upwards_.cost("column reverser up", SettleWord::bits(widths_, design()))};
    if (hot_) add_table(buffers, "beds of the materials", design(), SolidBed::kRowBits);
    return buffers;
  }

  // Multipliers serve depth squared, the mobility in two parts, and four its change by
  // heat. With heat, two serve the
  // mixture (amount x heat and rounding), and two the way up (flow x heat and rounding). Three serve the way
  // down (amount x heat, flow x heat and rounding), and two the bed of a solid. Dividers serve the limit, the
  // dead zone and, with heat, the mixture. Each is used once per run, at most every second cycle. With heat
  // there is one more on each way, used every cycle.
  Units units() const override {
    return {3 + (flow_.thermal_viscosity ? 4 : 0) + (hot_ ? 2 + 2 + 3 + 2 : 0), 2 + (hot_ ? 1 + 2 : 0), 0};
  }

 protected:
  void begin_step() override {
    // No two sub-steps round their mixtures alike.
    dithers_.next(UInt<16>::truncated(dither_of(moment().step) + dither_of(moment().substep)));
    paces_.next(pace_of(flow_, moment().substeps));
    if (overlaps()) return;  // columns are whole
    downwards_.restart();
    upwards_.restart();
    std::fill(sums_.begin(), sums_.end(), SumScan{});
  }

  void advance(const Cell* in, Cell* out) override {
    const Cell border;
    const bool bottom = came().y == 0;
    dither_ = at(dithers_, 1);
    pace_ = at(paces_, lag());
    for (const int each : each_lane(1)) {  // a cell's word is known when the next cell comes
      const std::size_t lane = each;
      words_[lane] = sums_[lane].next(in != nullptr ? in[lane] : border, bottom, hot_, dither_);
      if (sums_[lane].mixed()) hold_in_register(4, 0);
    }
    faults_.summed(*this, in);
    if (filled() == 0) return;  // the scan looks one token ahead
    downwards_.exchange(words_.data(), turned_.data());
    if (filled() <= height_) return;
    dither_ = at(dithers_, turned_delay());
    for (const int each : each_lane(turned_delay())) {
      const std::size_t lane = each;
      words_[lane] = records_[lane].next(turned_[lane], tokens_above() == 0, dither_);
      if (records_[lane].mixed()) hold_in_register(29, 0);  // 23 of the first scan, and 6
    }
    faults_.lowered(*this);

    compute_at(lag(), 0);
    if (out != nullptr) faults_.turned(*this);
    upwards_.exchange(words_.data(), turned_.data());
    if (out == nullptr) return;
    for (const int each : each_lane(lag())) {
      const std::size_t lane = each;
      shows_[lane].next(turned_[lane], leaving().y, flow_, pace_, widths_, solids_, out[lane]);
      faults_.shown(*this, each, out[lane]);
    }
  }

 private:
  friend Faults;

  // Returns how many tokens of its column lie above the one that has been turned round once. The column is
  // the one before that of the token that came, top first.
  std::int64_t tokens_above() const { return (came().ordinal + height_ - 1) % height_; }
  // Returns how long ago that token came.
  std::int64_t turned_delay() const { return 2 * (tokens_above() + 1); }

  std::size_t size() const { return lanes(); }

  [[no_unique_address]] Faults faults_;
  bool hot_;
  const rule::Flow& flow_;
  RunWidths widths_;
  SolidBed solids_;
  std::int64_t height_;
  OfTwoPasses<UInt<16>> dithers_;
  OfTwoPasses<UInt<36>> paces_;  // the mobility parameter of one sub-step
  UInt<16> dither_;              // dither of the words in work
  UInt<36> pace_;
  std::vector<SumScan> sums_;
  std::vector<RecordScan> records_;
  std::vector<ShowScan> shows_;
  std::vector<SettleWord> words_, turned_;
  ColumnReverser<SettleWord> downwards_, upwards_;
};

}  // namespace voxmelt::hwmodel
