#include "hwmodel/pipeline/check/waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace voxmelt::hwmodel {
namespace {

// A name that every viewer takes.
std::string identifier(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 4, " -> ") == 0)
      out += "_to_", i += 3;
    else if (std::isalnum(static_cast<unsigned char>(text[i])) != 0)
      out += text[i];
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  return out;
}

// "!", "\"" ... "~", "!!", ...: the short names of a VCD.
std::string code(std::size_t number) {
  std::string out;
  do {
    out += static_cast<char>('!' + number % 94);
    number /= 94;
  } while (number-- != 0);
  return out;
}

std::string value_text(const std::optional<std::int64_t>& value, int bits, const std::string& of) {
  if (bits == 1) return (!value ? "x" : *value != 0 ? "1" : "0") + of + '\n';
  if (!value) return "bx " + of + '\n';
  std::string digits;
  for (int bit = bits - 1; bit >= 0; --bit) {
    const bool one = (static_cast<std::uint64_t>(*value) >> bit & 1) != 0;
    if (one || !digits.empty() || bit == 0) digits += one ? '1' : '0';
  }
  return 'b' + digits + ' ' + of + '\n';
}

}  // namespace

Waves::Waves(Pipeline& pipeline, std::optional<std::int64_t> from)
    : pipeline_(pipeline), from_(from), lanes_(pipeline.design().shape.lanes) {
  for (const ChannelReport& channel : pipeline.channels())
    if (channel.producer != StageKind::feed) add_channel(channel);
  of_stages_ = signals_.size();
  int number = 0;
  for (const StageReport& stage : pipeline.stages()) {
    const std::string scope = fmt::format("stages.s{:02}_step_{}_{}", number++, stage.cascade,
                                          identifier(std::string(name_of(stage.kind))));
    for (const char* name : kCycleClasses) signals_.push_back({scope, name, 1});
  }
  now_.resize(signals_.size());
  before_ = pipeline.accounts();
}

void Waves::add_channel(const ChannelReport& channel) {
  of_channel_.push_back(signals_.size());
  const std::string scope =
      fmt::format("channels.c{:02}_{}", of_channel_.size() - 1, identifier(channel.name));
  for (const char* name : {"ready", "put", "valid", "get"}) signals_.push_back({scope, name, 1});
  signals_.push_back({scope, "count", 11});
  for (const char* side : {"in", "out"})
    for (int lane = 0; lane < lanes_; ++lane)
      for (const CellWire& row : kCellWires)
        signals_.push_back(
            {fmt::format("{}.{}.lane_{}", scope, side, lane), std::string(row.name), row.bits});
}

void Waves::cycle(int channel, const Sides& sides, const Cell* in, const Cell* out) {
  const std::int64_t now = cycles_before_ + pipeline_.cycle();
  if (now != now_at_) end();
  if (!keeps(now)) return;
  std::size_t at = of_channel_[static_cast<std::size_t>(channel)];
  for (const bool wire : {sides.ready, sides.put, sides.valid, sides.get}) now_[at++] = wire;
  now_[at++] = sides.count;
  for (const Cell* token : {in, out})
    for (int lane = 0; lane < lanes_; ++lane)
      for (const CellWire& row : kCellWires)
        now_[at++] = token != nullptr ? std::optional(row.get(token[lane])) : std::nullopt;
}

void Waves::begin_train(std::int64_t cycles_before) {
  end();
  cycles_before_ = cycles_before;
}

void Waves::end_cycle() {
  end();
  now_at_ = cycles_before_ + pipeline_.cycle();
  const std::vector<StageCycles> accounts = pipeline_.accounts();
  std::size_t at = of_stages_;
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    for (const auto part : StageCycles::kParts) now_[at++] = accounts[i].*part > before_[i].*part;
  }
  before_ = accounts;
  is_new_ = true;
}

void Waves::end() {
  if (!is_new_) return;
  is_new_ = false;
  if (!keeps(now_at_)) return;
  kept_.emplace_back(now_at_, now_);
  if (!from_ && more_ < 0 && static_cast<std::int64_t>(kept_.size()) > kCycles) kept_.pop_front();
}

bool Waves::wants_more() {
  if (from_) return false;
  if (more_ < 0) {
    more_ = kCycles / 2;
    while (static_cast<std::int64_t>(kept_.size()) >= kCycles / 2) kept_.pop_front();
  }
  return more_-- > 0;
}

std::string Waves::vcd() const {
  std::string text =
      "$comment The hardware pipeline of voxmelt; a time unit is a nanosecond, a cycle takes ten. $end\n"
      "$timescale 1 ns $end\n$scope module pipeline $end\n$var wire 1 ! clock $end\n";
  text += "$var wire 64 " + code(1) + " cycle $end\n";
  std::vector<std::string> open;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    std::vector<std::string> path;
    const std::string& scope = signals_[i].scope;
    for (std::size_t from = 0; from <= scope.size();) {
      const std::size_t dot = std::min(scope.find('.', from), scope.size());
      path.push_back(scope.substr(from, dot - from));
      from = dot + 1;
    }
    std::size_t same = 0;
    while (same < open.size() && same < path.size() && open[same] == path[same]) ++same;
    for (std::size_t k = open.size(); k > same; --k) text += "$upscope $end\n";
    for (std::size_t k = same; k < path.size(); ++k) text += "$scope module " + path[k] + " $end\n";
    open = path;
    text += fmt::format("$var wire {} {} {} $end\n", signals_[i].bits, code(i + 2), signals_[i].name);
  }
  for (std::size_t k = 0; k < open.size(); ++k) text += "$upscope $end\n";
  text += "$upscope $end\n$enddefinitions $end\n";
  const Values* last = nullptr;
  for (const auto& [cycle, values] : kept_) {
    text += fmt::format("#{}\n1!\n", 10 * cycle) + value_text(cycle, 64, code(1));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (last == nullptr || values[i] != (*last)[i])
        text += value_text(values[i], signals_[i].bits, code(i + 2));
    text += fmt::format("#{}\n0!\n", 10 * cycle + 5);
    last = &values;
  }
  if (!kept_.empty()) text += fmt::format("#{}\n", 10 * (kept_.back().first + 1));
  return text;
}

}  // namespace voxmelt::hwmodel
