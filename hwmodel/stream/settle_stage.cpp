// Phase `excess` of the viscous law (docs/automaton.md, section 10). A run's sums are known at its uppermost
// cell, and are needed at its lowest one: so the column is turned round twice.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/channel/column_reverser.h"
#include "hwmodel/stream/settle_scans.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

class Settle final : public Stage {
 public:
  explicit Settle(const Design& design)
      : Stage("settle", "excess", design, 2 * design.shape.column() + 1),
        hot_(design.hot()),
        flow_(design.parameters.flow),
        widths_(design),
        height_(design.shape.column()),
        sums_(size()),
        records_(size()),
        shows_(size()),
        words_(size()),
        turned_(size()),
        downwards_(lanes(), height_),
        upwards_(lanes(), height_) {}

  int output_bits() const override {  // in_run, head, mobility, exposed, dead
    return design().cell_bits() + 1 + widths_.head + 14 + 14 + 25;
  }
  std::vector<BufferCost> buffers() const override {
    const std::int64_t bits = SettleWord::bits(widths_, hot_);
    return {downwards_.cost("column reverser down", bits), upwards_.cost("column reverser up", bits)};
  }

  // Depth squared, the mobility, its table; with heat amount x heat and the mixture's rounding. Dividers:
  // the limit and the dead zone, and the mixture; each is used once per run, at most every second cycle.
  Units units() const override {
    return {2 + (flow_.thermal_viscosity ? 1 : 0) + (hot_ ? 2 : 0), 2 + (hot_ ? 1 : 0), 0};
  }

 protected:
  void begin_step() override {
    dither_ = dither_of(step());
    downwards_.restart();
    upwards_.restart();
    std::fill(sums_.begin(), sums_.end(), SumScan{});
  }

  void advance(const Cell* in, Cell* out) override {
    const Cell border;
    const bool bottom = came().y == 0;
    for (std::size_t lane = 0; lane < size(); ++lane)
      words_[lane] = sums_[lane].next(in != nullptr ? in[lane] : border, bottom, hot_, dither_);
    if (came().ordinal == 0) return;  // the scan looks one token ahead
    if (armed(Fault::settle_run_broken) || armed(Fault::settle_sum_carry)) [[unlikely]]
      damage_record();
    downwards_.exchange(words_.data(), turned_.data());
    if (came().ordinal <= height_) return;
    for (std::size_t lane = 0; lane < size(); ++lane) words_[lane] = records_[lane].next(turned_[lane]);

    if (out != nullptr && leaving().y == 0 && armed(Fault::settle_reversal)) [[unlikely]]
      damage_direction();
    upwards_.exchange(words_.data(), turned_.data());
    if (out == nullptr) return;
    for (std::size_t lane = 0; lane < size(); ++lane)
      shows_[lane].next(turned_[lane], leaving().y, flow_, widths_, out[lane]);
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(lanes()); }

  // A run as its record has it, and where it lies.
  struct Broken {
    std::int64_t sum, last, heat;
    std::int64_t above_amount = 0, above_heat = 0;  // of the cell that it lost
  };

  void damage_record() {
    const Place place = place_of(shape(), came().ordinal - 1);
    for (std::size_t lane = 0; lane < size(); ++lane) {
      SettleWord& word = words_[lane];
      if (word.kind != SettleKind::top && word.kind != SettleKind::single) continue;
      Broken broken{word.sum, word.last, word.heat};
      if (armed(Fault::settle_sum_carry)) {
        broken.sum -= std::int64_t{1} << (std::bit_width(static_cast<std::uint64_t>(broken.sum)) - 1);
      } else {
        if (word.kind == SettleKind::single) continue;
        const SettleWord& top = sums_[lane].top_cell();
        broken.sum -= top.sum, broken.last -= 1;
        if (hot_) broken.heat = mix(sums_[lane].content() - top.sum * top.heat, broken.sum, dither_);
        broken.above_amount = top.sum, broken.above_heat = top.heat;
      }
      const std::int64_t wrong = first_wrong(word, broken);
      if (wrong < 0) continue;
      const int bottom = place.y - static_cast<int>(word.last);
      strike(place.x + static_cast<int>(lane), bottom + static_cast<int>(wrong), place.z);
      if (broken.last < word.last) {  // the record belongs to the cell below, and this one is outside
        SettleWord& below = downwards_.newest()[lane];
        const SettleKind kind = below.kind == SettleKind::first ? SettleKind::single : SettleKind::top;
        below = {kind, broken.sum, broken.last, broken.heat};
        word = {SettleKind::outside, broken.above_amount, 0, broken.above_heat};
      } else {
        word.sum = broken.sum;
      }
      return;
    }
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

  // Reads the column that is to leave as it lies, from the top, if that makes a difference.
  void damage_direction() {
    std::vector<ShowScan> right = shows_, wrong = shows_;
    for (std::int64_t y = 0; y < height_; ++y)
      for (std::size_t lane = 0; lane < size(); ++lane) {
        Cell expected, found;
        const int height = static_cast<int>(y);
        right[lane].next(upwards_.will_give(y)[lane], height, flow_, widths_, expected);
        wrong[lane].next(upwards_.will_give(height_ - 1 - y)[lane], height, flow_, widths_, found);
        if (expected.state == found.state && expected.amount == found.amount && expected.heat == found.heat)
          continue;
        strike(leaving().x + static_cast<int>(lane), height, leaving().z);
        upwards_.miss_turn();
        return;
      }
  }

  bool hot_;
  const rule::Flow& flow_;
  RunWidths widths_;
  std::int64_t height_;
  UInt<16> dither_;
  std::vector<SumScan> sums_;
  std::vector<RecordScan> records_;
  std::vector<ShowScan> shows_;
  std::vector<SettleWord> words_, turned_;
  ColumnReverser<SettleWord> downwards_, upwards_;
};

}  // namespace

std::unique_ptr<Stage> make_settle(const Design& design) { return std::make_unique<Settle>(design); }

}  // namespace voxmelt::hwmodel
