// A stage of the pipeline takes one token per cycle and gives one per cycle, `lag` tokens later. It moves
// only when its input has a token and its output has room (ready/valid). So any stall is harmless.
//
// Passes may follow one another without a gap. Then the stage takes tokens of a new pass while it still gives
// those of the last one, and has two time steps at its two ends. In a grid of several tiles, each tile is
// such a pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/fabric/fifo.h"
#include "hwmodel/fabric/tap_line.h"
#include "hwmodel/pipeline/model/arithmetic.h"
#include "hwmodel/pipeline/model/cell.h"
#include "hwmodel/pipeline/model/cell_wires.h"
#include "hwmodel/pipeline/model/no_faults.h"
#include "hwmodel/pipeline/model/shape.h"
#include "hwmodel/pipeline/model/stage_kind.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::hwmodel {

using CellFifo = Fifo<Cell>;
using HeatFifo = Fifo<UInt<16>>;  // irradiance, 1/16 temperature unit per step
using FallFifo = Fifo<UInt<1>>;   // does the cell fall?

// Holds what all stages of a design share.
struct Design {
  rule::Parameters parameters;
  Shape shape;
  int substeps = 1;        // copies of settle and spread in a time step of the viscous law
  bool registers = false;  // stages have those of their circuits (lag.h)

  bool paper() const { return parameters.flow.law == rule::Law::paper; }
  bool hot() const { return parameters.heat.enabled; }
  bool freezes() const { return parameters.freezes(); }
  bool needs_walls() const {  // does falling depend on the four sides of a cell?
    const rule::Fall& fall = parameters.flow.fall;
    return fall.hang > 0 || fall.wall_factor != fall.factor || freezes();
  }
  // Does falling depend on the cell above?
  bool needs_ceilings() const { return parameters.flow.fall.hang > 0 || freezes(); }
  // Memory keeps which places are set between the passes of one step.
  bool keeps_set() const { return freezes() && !paper(); }
  // The paper law uses the sides before melt, which conduction has in its window. Without heat nothing melts,
  // and a separate stage finds them.
  bool walls_in_conduction() const { return paper() && hot() && needs_walls(); }
  bool of_materials() const { return parameters.has_materials(); }
  int materials() const { return of_materials() ? static_cast<int>(parameters.materials.size()) : 1; }
  KeptFields kept() const { return {paper(), hot(), of_materials()}; }
  // Returns the bits of a cell between two stages without side bands.
  int cell_bits() const { return bits_in_memory(kept()); }
};

// Every cycle of a stage is exactly one of these. `fill_drain` cycles come before its first token, after its
// last one, and while it gives without taking. In `bypassed` cycles it hands on a token in a pass that has no
// time step for the stage. In `memory` cycles a reader, feed or writer waits for a DRAM.
struct StageCycles {
  std::int64_t busy = 0, starved = 0, blocked = 0, fill_drain = 0, bypassed = 0, memory = 0;
  std::int64_t total() const { return busy + starved + blocked + fill_drain + bypassed + memory; }
  StageCycles& operator+=(const StageCycles& more) {
    for (const auto part : kParts) this->*part += more.*part;
    return *this;
  }
  StageCycles& operator-=(const StageCycles& less) {
    for (const auto part : kParts) this->*part -= less.*part;
    return *this;
  }
  static const std::array<std::int64_t StageCycles::*, 6> kParts;
};
inline constexpr std::array<std::int64_t StageCycles::*, 6> StageCycles::kParts{
    &StageCycles::busy,   &StageCycles::starved,    &StageCycles::blocked,
    &StageCycles::memory, &StageCycles::fill_drain, &StageCycles::bypassed};
// The names stand in the same order.
inline constexpr std::array<const char*, 6> kCycleClasses{"busy",   "starved",    "blocked",
                                                          "memory", "fill_drain", "bypassed"};

// Counts the arithmetic units of the stage as it is written. A synthesis should find the same.
struct Units {
  int multipliers = 0, dividers = 0;  // per lane
  int random_blocks = 0;              // per 8 lanes
};

// Describes one pass of one tile, as a stage sees it. In bypass the stage hands its tokens on, without lag.
struct StagePass {
  step::Moment moment{0};
  bool bypass = false;
  int tile = 0;
};

// Holds a value that depends on the time step, for the pass that comes and for the one before it.
template <class T>
struct OfTwoPasses {
  T now{}, last{};
  void next(const T& value) {
    last = now;
    now = value;
  }
};

// Tells where a stage computes: the token, and the lane of the cell in it.
struct Spot {
  Place token;
  int lane = 0;
};

// Goes through the lanes of a token, one after another. The present lane is noted, for messages.
class Lanes {
 public:
  class Iterator {
   public:
    Iterator(int lane, int& noted) : lane_(lane), noted_(&noted) {}
    int operator*() const { return *noted_ = lane_; }
    Iterator& operator++() {
      ++lane_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return lane_ != other.lane_; }

   private:
    int lane_;
    int* noted_;
  };
  Lanes(int end, int& noted) : end_(end), noted_(noted) {}
  Iterator begin() const { return {0, noted_}; }
  Iterator end() const { return {end_, noted_}; }

 private:
  int end_;
  int& noted_;
};

class Stage {
 public:
  // `lag` counts tokens, without those in its registers.
  Stage(StageKind kind, const Design& design, std::int64_t lag);
  virtual ~Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  void connect(CellFifo& in, CellFifo& out) {
    in_ = &in;
    out_ = &out;
  }
  // A second input: `exchange` has one of irradiance, and `fall` one of the cells that fall.
  virtual void feed(HeatFifo& /*feed*/) {}
  virtual void feed_falls(FallFifo& /*feed*/) {}

  // A pass streams one tile once. The first one of a train finds the stage empty. Those that are added while
  // it runs follow without a gap.
  void begin_pass(step::Moment moment, bool bypass, int tile = 0);
  void add_pass(step::Moment moment, bool bypass, int tile = 0) { passes_.push_back({moment, bypass, tile}); }
  virtual bool cycle();  // true if the stage moved
  bool done() const { return leaving_ == passes_.size() && waiting_ == 0; }

  StageKind kind() const { return kind_; }
  std::string name() const { return std::string(name_of(kind_)); }
  const Design& design() const { return design_; }
  const Shape& shape() const { return design_.shape; }
  int lanes() const { return design_.shape.lanes; }
  std::int64_t lag() const { return lag_; }
  int registers() const { return registers_; }  // tokens that it gives later, as its circuit does
  std::uint32_t step() const { return moment().step; }
  const step::Moment& moment() const { return passes_[coming_].moment; }  // moment of the pass that comes
  std::uint32_t working_step() const { return step_at(spot_delay_); }     // step of the cell it computes
  // Return the places of the token that comes and of the one that leaves. came() runs on beyond the last
  // plane, into the border.
  const Place& came() const { return came_; }
  const Place& leaving() const { return left_; }
  const StageCycles& cycles() const { return cycles_; }
  std::int64_t held_cycles() const { return held_cycles_; }  // in which a serial divider worked
  std::int64_t spot_delay() const { return spot_delay_; }
  Spot spot() const { return {place_at(spot_delay_), spot_lane_}; }  // place of the latest computation
  Place place_at(std::int64_t delay) const;  // place of the token that came `delay` moves ago
  int tile_at(std::int64_t delay) const { return passes_[coming_ - (of_last_pass(delay) ? 1 : 0)].tile; }
  // Returns the wires that the stage adds to a cell for later stages.
  virtual Wires side_bands() const { return {}; }
  virtual int width_of(Wire wire) const { return wire == Wire::set ? 0 : row_of(wire).bits; }
  // Returns the bits of a lane that leaves the stage, side bands included.
  virtual int output_bits() const {
    int bits = design_.cell_bits();
    for (const CellWire& row : kCellWires) bits += side_bands().has(row.wire) ? width_of(row.wire) : 0;
    return bits;
  }
  virtual std::vector<BufferCost> buffers() const { return {}; }
  // Returns the memories of its circuit (hwmodel/rtl), where they are cut in another way.
  virtual std::vector<BufferCost> circuit_buffers() const { return buffers(); }
  virtual Units units() const { return {}; }

 protected:
  // Makes one move. `in` is the token that comes. It is null after the last one, and then the border comes.
  // `out` is the token that leaves, to be filled. It is null while the stage fills.
  virtual void advance(const Cell* in, Cell* out) = 0;
  virtual void begin_step() {}  // moment() has changed; memories hold an old pass, or still the last one
  virtual bool side_input_ready() { return true; }  // for a stage with a second input

  // Returns true if the token that came `delay` moves ago belongs to the pass before the one that comes.
  bool of_last_pass(std::int64_t delay) const { return coming_ > 0 && came_.ordinal < delay; }
  template <class T>
  const T& at(const OfTwoPasses<T>& value, std::int64_t delay) const {
    return of_last_pass(delay) ? value.last : value.now;
  }
  std::uint32_t step_at(std::int64_t delay) const {
    return passes_[coming_ - (of_last_pass(delay) ? 1 : 0)].moment.step;
  }
  // Returns true if tokens of the last pass are still in the memories.
  bool overlaps() const { return leaving_ != coming_; }
  // Returns true if the plane that came before is the last one of its pass. For it, the border comes now.
  bool ends_last_pass() const { return overlaps() && came_.z == 0; }
  std::int64_t filled() const { return filled_; }  // moves since the memories were empty

  // Says that what is computed next belongs to a lane of the token that came `delay` moves ago.
  Lanes each_lane(std::int64_t delay = 0) {
    spot_delay_ = delay;
    return {lanes(), spot_lane_};
  }
  // Holds the stage as its circuit is held by a serial divider, which needs so many cycles. It begins when
  // the token that came `ago` moves ago is in this register.
  void hold_in_register(int number, int ago) {
    if (registers_ > 0) holds_ |= std::uint64_t{1} << (number - 1 - ago);
  }
  static constexpr int kDividerCycles = 23;
  void compute_at(std::int64_t delay, int lane) {
    spot_delay_ = delay;
    spot_lane_ = lane;
  }

 private:
  StageKind kind_;
  const Design& design_;
  std::int64_t lag_;
  bool may_take_next() const;
  bool empty_registers();
  void count_move();

  std::int64_t moves_ = 0;  // since the first token of the pass that leaves came
  std::int64_t filled_ = 0;
  std::int64_t spot_delay_ = 0;
  int spot_lane_ = 0;

  // The registers that its circuit has more than its model. A token waits in them for so many moves.
  int registers_, waiting_ = 0;
  int behind_ = 0;        // moves behind the last token
  std::size_t next_ = 0;  // place of the next token
  std::vector<Cell> waits_;
  Cell* wait_at(std::size_t place) { return &waits_[place * lanes()]; }
  std::uint64_t holds_ = 0;  // bit n: n + 1 moves from now it is held
  int held_ = 0;             // cycles left

 protected:  // for a stage whose cycles are not those of a model
  CellFifo* in_ = nullptr;
  CellFifo* out_ = nullptr;
  std::vector<StagePass> passes_;
  std::size_t coming_ = 0, leaving_ = 0;  // the passes at its two ends
  Place came_, left_;
  StageCycles cycles_;
  std::int64_t held_cycles_ = 0;
};

}  // namespace voxmelt::hwmodel
