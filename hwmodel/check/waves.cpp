#include "hwmodel/check/waves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace voxmelt::hwmodel {
namespace {

constexpr std::string_view kPlain = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

// Makes a name that every viewer takes.
std::string identifier(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 4, " -> ") == 0) {
      out += "_to_";
      i += 3;
    } else if (kPlain.find(text[i]) != std::string_view::npos)
      out += text[i];
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  return out;
}

// Makes the short names of a VCD: "!", "\"" ... "~", "!!", ...
std::string code(std::size_t number) {
  std::string out;
  do {
    out += static_cast<char>('!' + number % 94);
    number /= 94;
  } while (number-- != 0);
  return out;
}

std::string value_text(const std::optional<std::int64_t>& value, int bits, const std::string& text) {
  if (bits == 1) return (!value ? "x" : *value != 0 ? "1" : "0") + text + '\n';
  if (!value) return "bx " + text + '\n';
  std::string digits;
  for (int bit = bits - 1; bit >= 0; --bit) {
    const bool one = (static_cast<std::uint64_t>(*value) >> bit & 1) != 0;
    if (one || !digits.empty() || bit == 0) digits += one ? '1' : '0';
  }
  return 'b' + digits + ' ' + text + '\n';
}

}  // namespace

Waves::Waves(TokenSource& source, std::string machine, std::optional<std::int64_t> from)
    : source_(source), machine_(std::move(machine)), from_(from) {
  for (const TokenChannel& channel : source.token_channels()) add_channel(channel);
  of_stages_ = signals_.size();
  int number = 0;
  for (const StageClasses& stage : source.stage_classes()) {
    const std::string scope = fmt::format("stages.s{:02}_{}", number++, identifier(stage.name));
    for (const std::string& name : stage.classes) signals_.push_back({scope, name, 1});
  }
  now_.resize(signals_.size());
  before_ = source.stage_counts();
}

void Waves::add_channel(const TokenChannel& channel) {
  const std::string scope = fmt::format("channels.c{:02}_{}", channels_.size(), identifier(channel.name));
  numbers_[channel.number] = channels_.size();
  channels_.push_back({channel.type, signals_.size()});
  token_.resize(std::max(token_.size(), channel.type.values()));
  for (const char* name : {"ready", "put", "valid", "get"}) signals_.push_back({scope, name, 1});
  signals_.push_back({scope, "count", 11});
  for (const char* side : {"in", "out"})
    for (int lane = 0; lane < channel.type.lanes; ++lane)
      for (const TokenWire& wire : channel.type.wires)
        signals_.push_back({fmt::format("{}.{}.lane_{}", scope, side, lane), wire.name, wire.bits});
}

void Waves::cycle(int number, const Sides& sides, const void* in, const void* out) {
  const std::int64_t now = cycles_before_ + source_.cycle();
  if (now != now_at_) end();
  if (!keeps(now)) return;
  const Channel& channel = channels_[numbers_.at(number)];
  std::size_t at = channel.first;
  for (const bool wire : {sides.ready, sides.put, sides.valid, sides.get}) now_[at++] = wire;
  now_[at++] = sides.count;
  put_token(channel.type, in, at);
  put_token(channel.type, out, at + channel.type.values());
}

void Waves::put_token(const TokenType& type, const void* token, std::size_t at) {
  if (token != nullptr) type.read(token, token_.data());
  for (std::size_t i = 0; i < type.values(); ++i)
    now_[at + i] = token != nullptr ? std::optional(token_[i]) : std::nullopt;
}

void Waves::begin_train(std::int64_t cycles_before) {
  end();
  cycles_before_ = cycles_before;
}

void Waves::end_cycle() {
  end();
  now_at_ = cycles_before_ + source_.cycle();
  std::vector<std::int64_t> counts = source_.stage_counts();
  for (std::size_t i = 0; i < counts.size(); ++i) now_[of_stages_ + i] = counts[i] > before_[i];
  before_ = std::move(counts);
  is_new_ = true;
}

void Waves::end() {
  if (!is_new_) return;
  is_new_ = false;
  if (!keeps(now_at_)) return;
  kept_.emplace_back(now_at_, now_);
  if (!from_ && more_ < 0 && std::ssize(kept_) > kCycles) kept_.pop_front();
}

bool Waves::wants_more() {
  if (from_) return false;
  if (more_ < 0) {
    more_ = kCycles / 2;
    while (std::ssize(kept_) >= kCycles / 2) kept_.pop_front();
  }
  return more_-- > 0;
}

std::string Waves::vcd() const {
  std::string text = fmt::format(
      "$comment The hardware {} of voxmelt; a time unit is a nanosecond, a cycle takes ten. $end\n"
      "$timescale 1 ns $end\n$scope module {} $end\n$var wire 1 ! clock $end\n",
      machine_, identifier(machine_));
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
