// The tokens of a machine in a file, and back. Text, a line each; cells of a line are parted by a blank:
//
//   voxmelt trace 1
//   channel 0 4 2 step 0: reader -> melt      number, lanes, depth in tokens, name
//   wire 16 u amount                          of the channel above: bits, u or s (has a sign), name
//   train                                     from here on cycles count from 0 again
//   12 0 put 2 4096 0 2 4095 0                cycle, channel, put or get: the token enters or leaves; its
//                                             values, lane by lane, in the order of the wires
//
// All channels stand before the first train. Cycles do not go back within a train.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <span>
#include <stdexcept>
#include <vector>

#include "hwmodel/check/token_source.h"

namespace voxmelt::hwmodel {

// A line that is none; the message begins with its number.
class TraceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct TokenTrace {
  struct Event {
    int train = 0;
    std::int64_t cycle = 0;
    std::size_t channel = 0;  // in `channels`
    bool enters = true;       // else it leaves
    std::size_t first = 0;    // of its values
  };
  std::vector<TokenChannel> channels;  // `read` is empty
  std::vector<Event> events;
  std::vector<std::int64_t> values;

  std::span<const std::int64_t> token(const Event& event) const {
    return {values.data() + event.first, channels[event.channel].type.values()};
  }
};

void write_trace(const TokenTrace& trace, std::ostream& to);
TokenTrace read_trace(std::istream& from);  // throws TraceError

// Notes every token of a source. As long as it lives it is the source's probe.
class TraceRecorder final : public ChannelProbe {
 public:
  explicit TraceRecorder(TokenSource& source);
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;
  ~TraceRecorder() override { source_.probe(nullptr); }

  void cycle(int channel, const Sides& sides, const void* in, const void* out) override;
  const TokenTrace& trace() const { return trace_; }

 private:
  void note(std::size_t channel, bool enters, const void* token);

  TokenSource& source_;
  std::vector<TokenChannel> channels_;
  std::vector<std::size_t> by_number_;
  TokenTrace trace_;
  int train_ = 0;
  std::int64_t last_ = 0;  // cycle that was heard of
};

// A trace in the place of the machine that made it. A probe hears of the channels in which something moves;
// that the others were ready or valid is in no trace.
class TracePlayer final : public TokenSource {
 public:
  explicit TracePlayer(const TokenTrace& trace) : trace_(trace) {}

  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override { probe_ = probe; }
  std::int64_t cycle() const override { return cycle_; }
  void stop() override { stopped_ = true; }

  // Plays the next train. False: there is none.
  bool play_train();
  // All of them that are left, unless it is stopped.
  void play() {
    while (!stopped_ && play_train()) continue;
  }

 private:
  const TokenTrace& trace_;
  ChannelProbe* probe_ = nullptr;
  std::size_t next_ = 0;  // event
  std::int64_t cycle_ = 0;
  bool stopped_ = false;
};

}  // namespace voxmelt::hwmodel
