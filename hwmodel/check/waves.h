// The waves are what the wires of a machine carried in the last cycles, for a waveform viewer. They show both
// sides of every channel, the tokens that enter and leave, and the state of every stage.
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

  // Without `from`, keeps the cycles around the first difference. Call `wants_more` when there is one. With
  // `from`, keeps the cycles of the run from that one on. `machine` is the machine's name for the reader.
  Waves(TokenSource& source, std::string machine, std::optional<std::int64_t> from);

  void cycle(int channel, const Sides& sides, const void* in, const void* out) override;
  // Begins a train before which the run had so many cycles.
  void begin_train(std::int64_t cycles_before);
  void end_cycle();  // is called when every block has run its cycle
  // Returns true until half of the kept cycles have come after the difference.
  bool wants_more();

  void end();  // ends the run
  bool empty() const { return kept_.empty(); }
  std::string vcd() const;  // Value Change Dump, IEEE 1364; a cycle is 10 ns, the clock rises at its begin

 private:
  struct Signal {
    std::string scope, name;  // the scope has dots between its levels
    int bits;
  };
  using Values = std::vector<std::optional<std::int64_t>>;  // one for each signal; empty: no token is there

  void add_channel(const TokenChannel& channel);
  void put_token(const TokenType& type, const void* token, std::size_t at);
  bool keeps(std::int64_t cycle) const { return !from_ || (cycle >= *from_ && cycle < *from_ + kCycles); }

  struct Channel {
    TokenType type;
    std::size_t first;  // index of its first signal
  };

  TokenSource& source_;
  std::string machine_;
  std::optional<std::int64_t> from_;
  std::vector<Signal> signals_;
  std::vector<Channel> channels_;
  std::map<int, std::size_t> numbers_;  // from a channel's number to its index
  std::vector<std::int64_t> token_;     // scratch
  // Gives the index of the first signal of the stages.
  std::size_t of_stages_ = 0;
  // Channels between blocks report their cycle at its end, in any order. So a cycle is kept when the next one
  // begins.
  Values now_;
  std::int64_t now_at_ = 0, cycles_before_ = 0;
  bool is_new_ = false;
  std::vector<std::int64_t> before_;                  // counts of all stages, a cycle ago
  std::deque<std::pair<std::int64_t, Values>> kept_;  // each with its cycle of the run
  std::int64_t more_ = -1;                            // cycles still to come; -1: no difference yet
};

}  // namespace voxmelt::hwmodel
