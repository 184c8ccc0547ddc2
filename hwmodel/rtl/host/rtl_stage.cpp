#include "hwmodel/rtl/host/rtl_stage.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "hwmodel/pipeline/model/lag.h"
#include "hwmodel/pipeline/model/viscous_run.h"
#include "hwmodel/rtl/host/rtl_ports.h"

namespace voxmelt::hwmodel {
namespace {

// A cell of the channels in SystemVerilog has so many bits (voxmelt_pkg.sv). The lowest 64 hold all
// fields but three bits.
constexpr std::size_t kCellBits = 67;

struct CellBits {
  std::uint64_t low;
  std::uint32_t high;
};

// A solid has no energy, and its material stands there.
CellBits bits_of(const Cell& cell) {
  const auto at = [](std::int64_t value, int bit) { return static_cast<std::uint64_t>(value) << bit; };
  return {static_cast<std::uint64_t>(cell.state) | at(cell.amount, 2) | at(cell.energy | cell.material, 18) |
              at(cell.heat, 34) | at(cell.exposed_axes, 54) | at(cell.pattern, 56),
          static_cast<std::uint32_t>(cell.beside_wall | cell.touches << 1 | cell.set << 2)};
}

Cell cell_of(const CellBits& bits) {
  const auto part = [&](int bit, std::uint64_t mask) {
    return static_cast<std::int64_t>(bits.low >> bit & mask);
  };
  Cell cell;
  cell.state = static_cast<State>(bits.low & 3);
  cell.amount = part(2, 0xFFFF);
  if (cell.state == State::solid)
    cell.material = part(18, 15);
  else
    cell.energy = part(18, 0xFFFF);
  cell.heat = part(34, 0xFFFF);
  cell.exposed_axes = part(54, 3);
  cell.pattern = part(56, 255);
  cell.beside_wall = bits.high & 1;
  cell.touches = bits.high >> 1 & 1;
  cell.set = bits.high >> 2 & 1;
  return cell;
}

// Put and get `bits` (at most 32) of a wide port, from bit `at` on.
void put_bits(std::uint32_t* words, std::size_t at, int bits, std::uint32_t value) {
  const std::uint64_t mask = ((std::uint64_t{1} << bits) - 1) << (at % 32);
  const std::uint64_t moved = std::uint64_t{value} << (at % 32);
  std::uint32_t* word = words + at / 32;
  word[0] = (word[0] & ~static_cast<std::uint32_t>(mask)) | static_cast<std::uint32_t>(moved);
  if (mask >> 32 != 0)
    word[1] = (word[1] & ~static_cast<std::uint32_t>(mask >> 32)) | static_cast<std::uint32_t>(moved >> 32);
}
std::uint32_t get_bits(const std::uint32_t* words, std::size_t at, int bits) {
  const std::uint64_t high = at % 32 + bits > 32 ? words[at / 32 + 1] : 0;
  return static_cast<std::uint32_t>((high << 32 | words[at / 32]) >> (at % 32) &
                                    ((std::uint64_t{1} << bits) - 1));
}

}  // namespace

RtlStage::RtlStage(std::unique_ptr<Stage> model, std::unique_ptr<RtlModel> rtl)
    : Stage(model->kind(), model->design(), model->lag()), model_(std::move(model)), rtl_(std::move(rtl)) {
  in_cells_ = rtl_->wide("in_cells");
  irradiance_ = rtl_->wide("irradiance");
  const RtlPorts ports = rtl_ports(kind(), design());
  if (!ports.refusal.empty()) throw std::logic_error(ports.refusal);
  for (const RtlPort& port : ports.values)
    if (port.name == "lag" && static_cast<std::int64_t>(port.value) != lag() + registers_of(kind(), design()))
      throw std::logic_error(std::string(name_of(kind())) + ": its circuit has another lag than its model");
  is_viscous_ = rtl_->set("substep", 0);
  takes_runs_ = rtl_->set("in_runs", 0);
  reset();
  for (const RtlPort& port : ports.values)
    if (!rtl_->set(port.name, port.value))
      throw std::logic_error(std::string(name_of(kind())) + " has no port " + std::string(port.name));
  for (const auto& [name, words] : ports.wide) std::copy(words.begin(), words.end(), rtl_->wide(name));
  for (std::size_t i = 0; i < ports.table.size(); ++i) {
    rtl_->set("table_write", 1);
    rtl_->set("table_address", i);
    rtl_->set("table_data", ports.table[i]);
    rtl_->clock();
  }
  if (!ports.table.empty()) rtl_->set("table_write", 0);
  if (kind() == StageKind::exchange)  // a scene without sources has no feed
    take_irradiance(std::vector<UInt<16>>(lanes()).data());
}

void RtlStage::reset() {
  rtl_->set("rst", 1);
  rtl_->settle({});
  for (int i = 0; i < 2; ++i) rtl_->clock();
  rtl_->set("rst", 0);
}

// Returns true if the pass after the one that comes may push its tokens out.
bool RtlStage::follows() const {
  return coming_ + 1 < passes_.size() && !passes_[coming_].bypass && !passes_[coming_ + 1].bypass;
}

void RtlStage::take(const Cell* in) {
  for (int lane = 0; lane < lanes(); ++lane) {
    const CellBits bits = bits_of(in[lane]);
    const std::size_t at = kCellBits * lane;
    put_bits(in_cells_, at, 32, static_cast<std::uint32_t>(bits.low));
    put_bits(in_cells_, at + 32, 32, static_cast<std::uint32_t>(bits.low >> 32));
    put_bits(in_cells_, at + 64, 3, bits.high);
  }
  if (!takes_runs_) return;
  std::uint64_t runs = 0;
  for (int lane = 0; lane < lanes(); ++lane)
    runs |= static_cast<std::uint64_t>(std::int64_t{in[lane].in_run}) << lane;
  rtl_->set("in_runs", runs);
  if (rtl_->in_shows() != nullptr) take_shows(in);
}

// Settle tells spread so many bits of a cell's run: {shut, dead, limit, mobility, head}, the lowest bits
// last.
constexpr std::size_t kShowBits = 92;

void RtlStage::take_shows(const Cell* in) {
  for (int lane = 0; lane < lanes(); ++lane) {
    const std::size_t at = kShowBits * lane;
    const auto put = [&](std::size_t from, int bits, std::int64_t value) {
      put_bits(rtl_->in_shows(), at + from, bits,
               static_cast<std::uint32_t>(value) & ((std::uint32_t{1} << bits) - 1));
    };
    put(0, 30, in[lane].head);
    put(30, 22, in[lane].mobility);
    put(52, 14, in[lane].limit);
    put(66, 25, in[lane].dead);
    put(91, 1, in[lane].shut);
  }
}

void RtlStage::take_irradiance(const UInt<16>* irradiance) {
  std::uint64_t narrow = 0;  // up to 4 lanes are one number
  for (int lane = 0; lane < lanes(); ++lane) {
    const auto one = static_cast<std::uint64_t>(std::int64_t{irradiance[lane]});
    if (irradiance_ != nullptr)
      put_bits(irradiance_, 16 * static_cast<std::size_t>(lane), 16, static_cast<std::uint32_t>(one));
    else
      narrow |= one << (16 * lane);
  }
  if (irradiance_ == nullptr) rtl_->set("irradiance", narrow);
}

void RtlStage::take_falls(const UInt<1>* falls) {
  std::uint64_t bits = 0;
  for (int lane = 0; lane < lanes(); ++lane)
    bits |= static_cast<std::uint64_t>(std::int64_t{falls[lane]}) << lane;
  rtl_->set("falls", bits);
}

void RtlStage::give(Cell* out) const {
  for (int lane = 0; lane < lanes(); ++lane) {
    const std::size_t at = kCellBits * lane;
    const std::uint64_t high = get_bits(rtl_->out_cells(), at + 32, 32);
    out[lane] =
        cell_of({high << 32 | get_bits(rtl_->out_cells(), at, 32), get_bits(rtl_->out_cells(), at + 64, 3)});
  }
  const std::uint64_t runs = rtl_->out_runs();
  for (int lane = 0; lane < lanes(); ++lane) out[lane].in_run = runs >> lane & 1;
  if (rtl_->out_shows() != nullptr) give_shows(out);
}

void RtlStage::give_shows(Cell* out) const {
  for (int lane = 0; lane < lanes(); ++lane) {
    const auto part = [&](std::size_t from, int bits) {
      return std::int64_t{get_bits(rtl_->out_shows(), kShowBits * lane + from, bits)};
    };
    const std::int64_t head = part(0, 30);
    out[lane].head = head >> 29 != 0 ? head - (std::int64_t{1} << 30) : head;
    out[lane].mobility = part(30, 22);
    out[lane].limit = part(52, 14);
    out[lane].dead = part(66, 25);
    out[lane].shut = part(91, 1);
  }
}

void RtlStage::count_left() {
  left_.next(shape());
  if (left_.ordinal < shape().tokens()) return;
  ++leaving_;
  if (!done()) left_ = begin_of(shape(), passes_[leaving_].tile);
  if (coming_ >= leaving_ || done()) return;
  coming_ = leaving_;
  came_ = begin_of(shape(), passes_[coming_].tile);
}

// A pass without a time step for the stage goes past it.
bool RtlStage::hand_on() {
  if (!in_->valid()) {
    ++(coming_ == 0 && came_.ordinal == 0 ? cycles_.fill_drain : cycles_.starved);
    return false;
  }
  if (!out_->ready()) {
    ++cycles_.blocked;
    return false;
  }
  ++cycles_.bypassed;
  const Cell* in = in_->get();
  std::copy(in, in + lanes(), out_->put());
  came_.next(shape());
  count_left();
  return true;
}

// Tells a stage of the viscous law which sub-step the pass is whose first token comes next.
void RtlStage::take_substep(const step::Moment& moment) {
  rtl_->set("substep", static_cast<std::uint64_t>(moment.substep));
  rtl_->set("pace", static_cast<std::uint64_t>(pace_of(design().parameters.flow, moment.substeps)));
  rtl_->set("reciprocal", static_cast<std::uint64_t>(Reciprocal(moment.substeps).value()));
  std::uint64_t turns = 0;
  for (int axis = 0; axis < 4; ++axis)
    turns |= static_cast<std::uint64_t>(turn_of(moment.substep, moment.substeps, axis)) << (10 * axis);
  rtl_->set("turns", turns);
}

bool RtlStage::cycle() {
  if (done()) {
    ++cycles_.fill_drain;
    return false;
  }
  if (passes_[leaving_].bypass) return hand_on();
  const bool all_came = came_.ordinal == shape().tokens(), next = all_came && follows();
  const bool fed = (feed_ == nullptr || feed_->valid()) && (falls_ == nullptr || falls_->valid());
  const bool offers = in_->valid() && fed && (!all_came || next);
  if (offers) {
    take(in_->oldest());
    if (feed_ != nullptr) take_irradiance(feed_->oldest());
    if (falls_ != nullptr) take_falls(falls_->oldest());
  }
  const step::Moment& moment = passes_[coming_ + (next ? 1 : 0)].moment;
  if (is_viscous_) take_substep(moment);
  const RtlModel::Outputs outputs = rtl_->settle({offers, out_->ready(), follows(), moment.step});
  const bool takes = offers && outputs.in_ready;
  const bool gives = out_->ready() && outputs.out_valid;
  if (gives) give(out_->put());
  held_cycles_ += outputs.holds ? 1 : 0;
  if (takes) {
    in_->get();
    if (feed_ != nullptr) feed_->get();
    if (falls_ != nullptr) falls_->get();
  }
  rtl_->clock();
  ++(takes               ? cycles_.busy
     : gives || all_came ? cycles_.fill_drain
     : offers            ? cycles_.blocked
                         : cycles_.starved);
  if (takes) {
    if (next) came_ = begin_of(shape(), passes_[++coming_].tile);
    came_.next(shape());
  }
  if (gives) count_left();
  return takes || gives;
}

std::string rtl_refusal(const Design& design, const std::vector<std::string>& only) {
  std::vector<StageKind> kinds = stages_of_step(design);
  if (rtl_lanes().empty()) return "this program was built without Verilator (Debian: `verilator`)";
  const std::vector<int> lanes = rtl_lanes();
  if (std::find(lanes.begin(), lanes.end(), design.shape.lanes) == lanes.end()) {
    std::string list;
    for (const int one : lanes) list += (list.empty() ? "" : ", ") + std::to_string(one);
    return "stages in SystemVerilog are compiled for " + list + " lanes, not for " +
           std::to_string(design.shape.lanes);
  }
  int there = 0;
  for (const StageKind kind : kinds) {
    const bool wanted = only.empty() || std::find(only.begin(), only.end(), name_of(kind)) != only.end();
    if (!rtl_has(kind) || !wanted) continue;
    ++there;
    if (const RtlPorts ports = rtl_ports(kind, design); !ports.refusal.empty())
      return std::string(name_of(kind)) + " in SystemVerilog: " + ports.refusal;
  }
  return there > 0 || !only.empty() ? "" : "no stage of this scene is written in SystemVerilog";
}

StageMaker rtl_stages(std::vector<std::string> only, int seed) {
  return [only = std::move(only), seed](StageKind kind, const Design& design) {
    std::unique_ptr<Stage> model = make_stage(kind, design);
    const bool wanted = only.empty() || std::find(only.begin(), only.end(), name_of(kind)) != only.end();
    std::unique_ptr<RtlModel> rtl = wanted ? make_rtl_model(kind, design.shape.lanes, seed) : nullptr;
    if (rtl == nullptr) return model;
    return std::unique_ptr<Stage>(std::make_unique<RtlStage>(std::move(model), std::move(rtl)));
  };
}

}  // namespace voxmelt::hwmodel
