// The tokens of a machine are written to a file, and read back. The file is text, with one record a line. The
// cells of a line are separated by a blank:
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

// Reports a line that cannot be read. The message begins with its number.
class TraceError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct TokenTrace {
  struct Event {
    int train = 0;
    std::int64_t cycle = 0;
    std::size_t channel = 0;  // index in `channels`
    bool enters = true;       // false: it leaves
    std::size_t first = 0;    // index of its first value
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

// Notes every token of a source. The recorder is the source's probe as long as it lives.
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
  std::int64_t last_ = 0;  // the last cycle that was heard of
};

// Plays a trace in the place of the machine that made it. A probe hears only of the channels in which
// something moves. A trace does not say when the others were ready or valid.
class TracePlayer final : public TokenSource {
 public:
  explicit TracePlayer(const TokenTrace& trace) : trace_(trace) {}

  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override { probe_ = probe; }
  std::int64_t cycle() const override { return cycle_; }
  void stop() override { stopped_ = true; }

  // Plays the next train. Returns false if there is none.
  bool play_train();
  // Plays all trains that are left, unless it is stopped.
  void play() {
    while (!stopped_ && play_train()) continue;
  }

 private:
  const TokenTrace& trace_;
  ChannelProbe* probe_ = nullptr;
  std::size_t next_ = 0;  // index of the next event
  std::int64_t cycle_ = 0;
  bool stopped_ = false;
};

}  // namespace voxmelt::hwmodel
