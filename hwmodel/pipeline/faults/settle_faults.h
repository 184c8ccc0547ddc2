// These faults end runs too early, lose a bit of their sum, do not mix them, mistake which are shut, or show
// something wrong. Another one lets columns leave upside down.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/run_reader.h"
#include "hwmodel/pipeline/model/settle_stage.h"

namespace voxmelt::hwmodel {

class SettleFaults : public Planted {
 public:
  using Faulty = Settle<SettleFaults>;

  SettleFaults(FaultPlan& plan, const Design& design)
      : Planted(plan),
        column_(design.shape.lanes, design.shape.column()),
        beds_(static_cast<std::size_t>(design.shape.lanes)) {}

  void summed(Faulty& stage, const Cell* in) {
    if (!armed(stage, Fault::settle_run_broken)) return;
    column_.shift();
    if (in != nullptr) std::copy_n(in, stage.lanes(), column_.tap(0));
    if (stage.filled() == 0) return;
    for (int lane = 0; lane < stage.lanes(); ++lane) {
      const SettleWord& word = stage.words_[lane];
      if (word.kind != SettleKind::top) continue;
      std::vector<Cell> cells;  // cells of the run, from its bottom
      for (std::int64_t below = word.last + 1; below > 0; --below) cells.push_back(column_.tap(below)[lane]);
      const Cell top = cells.back();
      const std::vector<Held> right = settled(stage, cells).cells;
      cells.pop_back();
      Outcome broken = settled(stage, cells);
      broken.cells.push_back({std::int64_t{top.amount}, std::int64_t{top.heat}});
      const auto wrong =
          std::mismatch(right.begin(), right.end(), broken.cells.begin()).first - right.begin();
      if (wrong == std::ssize(right)) continue;
      // Under a cell of its own, that has left it, the broken run is not shut.
      const bool roofed = in == nullptr || stage.came().y == 0 || in[lane].blocked();
      const bool alike = show_alike(stage, word, broken.record) && !(roofed && is_full(word.sum, word.last));
      return part(stage, lane, top, broken.record, alike ? static_cast<int>(wrong) : 0);
    }
  }

  // Spoils a record that has come to the first cell of its run.
  void lowered(Faulty& stage) {
    if (armed(stage, Fault::settle_roof)) return retell(stage, SettleKind::first, SettleKind::shut);
    if (armed(stage, Fault::settle_slack)) return retell(stage, SettleKind::shut, SettleKind::first);
    const bool carry = armed(stage, Fault::settle_sum_carry);
    if (!carry && !armed(stage, Fault::settle_mix)) return;
    for (int lane = 0; lane < stage.lanes(); ++lane) {
      SettleWord& word = stage.words_[lane];
      if (!word.lowest()) continue;
      if (!carry) {
        if (word.heat == stage.turned_[lane].heat) continue;
        word.heat = stage.turned_[lane].heat;
        return strike_turned(stage, lane, 0);
      }
      const std::int64_t sum = std::int64_t{word.sum} - std::bit_floor<std::uint64_t>(word.sum);
      const SettleWord right = word;
      word.sum = sum;
      int k = 0;
      if (show_alike(stage, right, word))
        while (settled_amount(sum, word.last, k) == settled_amount(right.sum, word.last, k)) ++k;
      return strike_turned(stage, lane, k);
    }
  }

  // Reads the column that is to leave in the wrong direction, from the top, if that makes a difference.
  void turned(Faulty& stage) {
    if (stage.leaving().y != 0 || !armed(stage, Fault::settle_reversal)) return;
    std::vector<ShowScan> right = stage.shows_, wrong = stage.shows_;
    for (int y = 0; y < stage.height_; ++y)
      for (int lane = 0; lane < stage.lanes(); ++lane) {
        Cell expected, found;
        const auto show = [&](ShowScan& scan, std::int64_t from, Cell& cell) {
          scan.next(stage.upwards_.will_give(from)[lane], y, stage.flow_, stage.pace_, stage.widths_,
                    stage.solids_, cell);
        };
        show(right[lane], y, expected);
        show(wrong[lane], stage.height_ - 1 - y, found);
        if (alike(expected, found)) continue;
        strike(stage, stage.leaving().x + lane, y, stage.leaving().z);
        return stage.upwards_.miss_turn();
      }
  }

  // Spoils what a cell of a run shows. Every change is seen behind the smaller of two limits.
  void shown(const Faulty& stage, int lane, Cell& cell) {
    const auto [sinks, strange] = note_bed(stage, lane, cell);
    if (cell.set > 0 && armed(stage, Fault::settle_set_lost)) {
      cell.set = 0;
      return strike_lane(stage, stage.leaving(), lane);
    }
    if (cell.in_run == 0) return;
    if (armed(stage, Fault::settle_run_untold))
      cell.in_run = 0;
    else if (armed(stage, Fault::settle_head))
      cell.head = cell.head - 1;
    else if (sinks != 0 && armed(stage, Fault::settle_bed))
      cell.head = cell.head + sinks;
    else if (strange != 0 && armed(stage, Fault::settle_bed_first))
      cell.head = cell.head + strange;
    else if (armed(stage, Fault::settle_mobility) && cell.mobility > 0)
      cell.mobility = cell.mobility >> 1;
    else if (armed(stage, Fault::settle_limit) && cell.limit > 1)
      cell.limit = cell.limit - 1;
    else if (armed(stage, Fault::settle_dead_zone))
      cell.dead = cell.dead - 1;
    else if (armed(stage, Fault::settle_shut) && cell.shut == 1)
      cell.shut = 0;
    else
      return;
    strike_lane(stage, stage.leaving(), lane);
  }

 private:
  struct Held {
    std::int64_t amount, heat;
    bool operator==(const Held&) const = default;
  };
  struct Outcome {
    std::vector<Held> cells;
    SettleWord record;  // in the word of the uppermost cell
  };

  // Tells how far below a flat bed the bed lies upon which a cell stands, and how far below that of the first
  // material, if it is a solid.
  struct Bed {
    std::int64_t sinks = 0, strange = 0;
  };
  Bed note_bed(const Faulty& stage, int lane, const Cell& cell) {
    Bed& bed = beds_[static_cast<std::size_t>(lane)];
    if (stage.leaving().y == 0 || cell.blocked()) bed = {};
    if (cell.state != State::solid) return bed;
    const std::int64_t rise = stage.solids_.rise(cell.amount, cell.heat, cell.material);
    bed = {kFlatRise - rise, stage.solids_.rise(cell.amount, cell.heat) - rise};
    return bed;
  }

  // Compares what the next stage can tell apart. Mobilities are never used without a limit.
  static bool alike(Cell a, Cell b) {
    const auto limited = [](const RunPace& pace) { return std::array{pace.limited(), pace.exposed()}; };
    const bool same_pace =
        limited({a.mobility, a.limit, a.dead, a.shut}) == limited({b.mobility, b.limit, b.dead, b.shut});
    a.mobility = b.mobility;
    return same_pace && a == b;
  }
  static bool show_alike(const Faulty& stage, const SettleWord& one, const SettleWord& other) {
    const auto cell = [&](const SettleWord& record) {
      const RunShow show =
          hwmodel::shown(record.sum, record.last, 0, record.mean, stage.flow_, stage.pace_, stage.widths_);
      Cell shows;
      shows.head = show.head;
      shows.mobility = show.mobility;
      shows.limit = show.limit;
      shows.dead = show.dead;
      return shows;
    };
    return alike(cell(one), cell(other));
  }

  // Computes the outcome of a run of these cells.
  static Outcome settled(const Faulty& stage, const std::vector<Cell>& cells) {
    SumScan up;
    RecordScan down;
    Outcome outcome;
    std::vector<SettleWord> words;
    words.reserve(cells.size() + 1);
    for (const Cell& cell : cells) words.push_back(up.next(cell, words.empty(), stage.hot_, stage.dither_));
    words.erase(words.begin());  // word of the cell before the first one
    words.push_back(outcome.record = up.next(Cell{}, false, stage.hot_, stage.dither_));
    outcome.cells.resize(cells.size());
    for (std::size_t k = cells.size(); k-- > 0;) {
      const SettleWord& record = outcome.record;
      const std::int64_t heat = down.next(words[k], false, stage.dither_).heat;
      const std::int64_t amount = settled_amount(record.sum, record.last, k);
      outcome.cells[k] = {amount, amount > 0 ? heat : 0};
    }
    return outcome;
  }

  // Gives the record to the cell below, and leaves this cell outside the run. `wrong` counts from the lowest
  // cell of the run to the first one that is wrong then.
  void part(Faulty& stage, int lane, const Cell& top, const SettleWord& record, int wrong) {
    SettleWord& word = stage.words_[lane];
    const Place place = stage.place_at(1);
    strike(stage, place.x + lane, place.y - static_cast<int>(word.last) + wrong, place.z);
    stage.downwards_.newest()[lane] = record;
    word = {SettleKind::outside, std::int64_t{top.amount}, 0, top.heat, 0, 0, 0, word.set};
  }

  // Lets a full run be shut that is not, for it has no ceiling; or a shut one not be, for it is not quite
  // full.
  void retell(Faulty& stage, SettleKind right, SettleKind wrong) {
    for (int lane = 0; lane < stage.lanes(); ++lane) {
      SettleWord& word = stage.words_[lane];
      const bool whole = word.sum == (word.last + 1) * kOne;
      const bool told = right == SettleKind::first ? is_full(word.sum, word.last) : !whole;
      if (word.kind != right || !told) continue;
      word.kind = wrong;
      return strike_turned(stage, lane, 0);
    }
  }

  // Strikes `above` cells above the one that has come on its way down.
  void strike_turned(const Faulty& stage, int lane, int above) {
    const Place place = stage.place_at(stage.turned_delay());
    strike(stage, place.x + lane, place.y + above, place.z);
  }

  TapLine<Cell> column_;   // the latest tokens
  std::vector<Bed> beds_;  // of each lane
};

}  // namespace voxmelt::hwmodel
