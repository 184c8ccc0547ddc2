#include "hwmodel/check/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace voxmelt::hwmodel {
namespace {

bool same_type(const TokenType& one, const TokenType& other) {
  return one.lanes == other.lanes &&
         std::equal(one.wires.begin(), one.wires.end(), other.wires.begin(), other.wires.end(),
                    [](const TokenWire& a, const TokenWire& b) {
                      return a.name == b.name && a.bits == b.bits && a.has_sign == b.has_sign;
                    });
}

}  // namespace

std::string text_of(const TokenDifference& difference) {
  using enum TokenDifference::Kind;
  if (difference.kind == channel)
    return fmt::format("channel \"{}\": only one has it, or with other wires", difference.channel);
  const std::string which = fmt::format("channel \"{}\": token {}, which {}", difference.channel,
                                        difference.ordinal, difference.enters ? "enters" : "leaves");
  switch (difference.kind) {
    case missing:
      return fmt::format("{} in cycle {}, is missing", which, difference.expected_cycle);
    case extra:
      return fmt::format("{} in cycle {}, is one too many", which, difference.actual_cycle);
    case cycle:
      return fmt::format("{}: expected in cycle {}, seen in cycle {}", which, difference.expected_cycle,
                         difference.actual_cycle);
    default:
      return fmt::format("{}: {} of lane {}: expected {} (cycle {}), seen {} (cycle {})", which,
                         difference.wire, difference.lane, difference.expected, difference.expected_cycle,
                         difference.actual, difference.actual_cycle);
  }
}

TokenComparison::TokenComparison(TokenSource& expected, TokenSource& actual, Compared how)
    : how_(how), expected_(*this, expected, 0), actual_(*this, actual, 1) {
  match(expected.token_channels(), actual.token_channels());
  expected.probe(&expected_);
  actual.probe(&actual_);
}

TokenComparison::~TokenComparison() {
  expected_.source.probe(nullptr);
  actual_.source.probe(nullptr);
}

// Channels belong together by name, because each machine has numbers of its own.
void TokenComparison::match(const std::vector<TokenChannel>& expected,
                            const std::vector<TokenChannel>& actual) {
  for (const TokenChannel& one : expected) {
    expected_.channels[one.number] = channels_.size();
    expected_.types[one.number] = one.type;
    channels_.push_back(one);
  }
  streams_.resize(channels_.size());
  std::vector<bool> found(channels_.size());
  for (const TokenChannel& one : actual) {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (found[i] || channels_[i].name != one.name || !same_type(channels_[i].type, one.type)) continue;
      found[i] = true;
      actual_.channels[one.number] = i;
      actual_.types[one.number] = one.type;
      break;
    }
    if (!actual_.channels.contains(one.number))
      tell({.kind = TokenDifference::Kind::channel, .channel = one.name});
  }
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (!found[i]) tell({.kind = TokenDifference::Kind::channel, .channel = channels_[i].name});
}

void TokenComparison::Side::cycle(int channel, const Sides& sides, const void* in, const void* out) {
  if (all.difference_ || (!sides.put && !sides.get)) return;
  const TokenType& type = types.at(channel);
  for (const bool enters : {true, false}) {
    if (!(enters ? sides.put : sides.get)) continue;
    Token token{source.cycle(), std::vector<std::int64_t>(type.values())};
    type.read(enters ? in : out, token.values.data());
    all.take(number, channels.at(channel), enters, std::move(token));
  }
}

void TokenComparison::take(std::size_t side, std::size_t channel, bool enters, Token token) {
  if (difference_) return;
  Stream& stream = streams_[channel][enters ? 0 : 1];
  std::deque<Token>& other = stream.ahead[1 - side];
  if (other.empty()) {
    stream.ahead[side].push_back(std::move(token));
    return;
  }
  side == 0 ? compare(channel, enters, token, other.front()) : compare(channel, enters, other.front(), token);
  other.pop_front();
  ++stream.ordinal;
}

void TokenComparison::compare(std::size_t channel, bool enters, const Token& expected, const Token& actual) {
  const TokenType& type = channels_[channel].type;
  ++compared_;
  TokenDifference difference{.channel = channels_[channel].name,
                             .enters = enters,
                             .ordinal = streams_[channel][enters ? 0 : 1].ordinal,
                             .expected_cycle = expected.cycle,
                             .actual_cycle = actual.cycle};
  const auto [one, other] =
      std::mismatch(expected.values.begin(), expected.values.end(), actual.values.begin());
  if (one != expected.values.end()) {
    const std::size_t at = one - expected.values.begin();
    difference.wire = type.wires[at % type.wires.size()].name;
    difference.lane = static_cast<int>(at / type.wires.size());
    difference.expected = *one;
    difference.actual = *other;
    return tell(std::move(difference));
  }
  if (how_ == Compared::in_order || expected.cycle == actual.cycle) return;
  difference.kind = TokenDifference::Kind::cycle;
  tell(std::move(difference));
}

void TokenComparison::tell(TokenDifference difference) {
  if (difference_) return;
  difference_ = std::move(difference);
  expected_.source.stop();
  actual_.source.stop();
}

const std::optional<TokenDifference>& TokenComparison::end() {
  const Token* first = nullptr;
  std::optional<TokenDifference> found;
  for (std::size_t i = 0; i < channels_.size(); ++i)
    for (const bool enters : {true, false}) {
      const Stream& stream = streams_[i][enters ? 0 : 1];
      for (const std::size_t side : {0U, 1U}) {
        if (stream.ahead[side].empty() ||
            (first != nullptr && first->cycle <= stream.ahead[side].front().cycle))
          continue;
        first = &stream.ahead[side].front();
        found =
            TokenDifference{.kind = side == 0 ? TokenDifference::Kind::missing : TokenDifference::Kind::extra,
                            .channel = channels_[i].name,
                            .enters = enters,
                            .ordinal = stream.ordinal,
                            .expected_cycle = side == 0 ? first->cycle : -1,
                            .actual_cycle = side == 0 ? -1 : first->cycle};
      }
    }
  if (found && !difference_) difference_ = std::move(found);
  return difference_;
}

}  // namespace voxmelt::hwmodel
