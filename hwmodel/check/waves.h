// What the wires of a machine carried in the last cycles, for a waveform viewer: both sides of every channel,
// the tokens that enter and leave, the state of every stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/check/token_source.h"

namespace voxmelt::hwmodel {

class Waves final : public ChannelProbe {
 public:
  static constexpr std::int64_t kCycles = 64;

  // Without `from` it keeps the cycles around the first difference: ask `wants_more` when there is one.
  // Otherwise those from cycle `from` of the run on.
  // `machine`: its name, for the reader of the waves.
  Waves(TokenSource& source, std::string machine, std::optional<std::int64_t> from);

  void cycle(int channel, const Sides& sides, const void* in, const void* out) override;
  void begin_train(std::int64_t cycles_before);  // of the run
  void end_cycle();                              // every block has run its cycle
  // Half of the cycles come after the difference. True until they have come.
  bool wants_more();

  void end();  // of the run
  bool empty() const { return kept_.empty(); }
  std::string vcd() const;  // Value Change Dump, IEEE 1364; a cycle is 10 ns, the clock rises at its begin

 private:
  struct Signal {
    std::string scope, name;  // the scope with dots
    int bits;
  };
  using Values = std::vector<std::optional<std::int64_t>>;  // one for each signal; none: nothing is there

  void add_channel(const TokenChannel& channel);
  void put_token(const TokenType& type, const void* token, std::size_t at);
  bool keeps(std::int64_t cycle) const { return !from_ || (cycle >= *from_ && cycle < *from_ + kCycles); }

  struct Channel {
    TokenType type;
    std::size_t first;  // of its signals
  };

  TokenSource& source_;
  std::string machine_;
  std::optional<std::int64_t> from_;
  std::vector<Signal> signals_;
  std::vector<Channel> channels_;
  std::map<int, std::size_t> numbers_;  // of a channel: which of them it is
  std::vector<std::int64_t> token_;     // in work
  std::size_t of_stages_ = 0;
  // Channels between blocks tell their cycle in any order with its end. So it is kept when the next one
  // begins.
  Values now_;
  std::int64_t now_at_ = 0, cycles_before_ = 0;
  bool is_new_ = false;
  std::vector<std::int64_t> before_;                  // accounts of all stages, a cycle ago
  std::deque<std::pair<std::int64_t, Values>> kept_;  // by cycle of the run
  std::int64_t more_ = -1;                            // cycles that shall still come
};

}  // namespace voxmelt::hwmodel
