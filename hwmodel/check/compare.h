// The comparison finds the first difference between what two machines carry. In order, every channel must
// take and give the same tokens at whatever time. In the same cycle, the times must agree, too.
//
// The machines run one after the other, or in turn. The comparison keeps what one is ahead of the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/check/token_source.h"

namespace voxmelt::hwmodel {

struct TokenDifference {
  enum class Kind : std::uint8_t {
    value,    // another value on a wire
    cycle,    // the same token, in another cycle
    missing,  // a token that the actual machine lacks
    extra,    // a token that the expected machine lacks
    channel,  // only one machine has the channel, or the types of its tokens differ
  };
  Kind kind = Kind::value;
  std::string channel{};
  bool enters = true;        // false: it differs when it leaves
  std::int64_t ordinal = 0;  // number of the token in its channel, from 0
  std::string wire{};
  int lane = 0;
  std::int64_t expected = 0, actual = 0;                // values of the wire
  std::int64_t expected_cycle = -1, actual_cycle = -1;  // -1: the token did not come
};

std::string text_of(const TokenDifference& difference);

enum class Compared : std::uint8_t { in_order, in_same_cycle };

// Is the probe of both sources as long as it lives.
class TokenComparison {
 public:
  TokenComparison(TokenSource& expected, TokenSource& actual, Compared how);
  TokenComparison(const TokenComparison&) = delete;
  TokenComparison& operator=(const TokenComparison&) = delete;
  ~TokenComparison();

  // Stops both sources when it finds the first difference.
  const std::optional<TokenDifference>& difference() const { return difference_; }
  // Is called when both have run. A token that only one of them had is a difference, too.
  const std::optional<TokenDifference>& end();
  std::int64_t compared() const { return compared_; }  // tokens; each counts as it enters and as it leaves

 private:
  struct Token {
    std::int64_t cycle;
    std::vector<std::int64_t> values;
  };
  struct Stream {  // tokens that enter a channel, or that leave it
    std::int64_t ordinal = 0;
    std::array<std::deque<Token>, 2> ahead;  // tokens of the expected machine, of the actual one
  };
  struct Side final : ChannelProbe {
    Side(TokenComparison& comparison, TokenSource& from, std::size_t which)
        : all(comparison), source(from), number(which) {}
    void cycle(int channel, const Sides& sides, const void* in, const void* out) override;

    TokenComparison& all;
    TokenSource& source;
    std::size_t number;
    std::map<int, std::size_t> channels;  // from a number to an index of `all.channels_`
    std::map<int, TokenType> types;
  };

  void match(const std::vector<TokenChannel>& expected, const std::vector<TokenChannel>& actual);
  void take(std::size_t side, std::size_t channel, bool enters, Token token);
  void compare(std::size_t channel, bool enters, const Token& expected, const Token& actual);
  void tell(TokenDifference difference);

  Compared how_;
  Side expected_, actual_;
  std::vector<TokenChannel> channels_;  // channels of the expected machine
  std::vector<std::array<Stream, 2>> streams_;
  std::optional<TokenDifference> difference_;
  std::int64_t compared_ = 0;
};

}  // namespace voxmelt::hwmodel
