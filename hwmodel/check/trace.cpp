#include "hwmodel/check/trace.h"

#include <algorithm>
#include <istream>
#include <sstream>
#include <string>
#include <utility>

namespace voxmelt::hwmodel {
namespace {

constexpr const char* kFirstLine = "voxmelt trace 1";

// Reads the lines, and knows the number of the present one.
class TraceReader {
 public:
  explicit TraceReader(std::istream& from) : from_(from) {}

  TokenTrace all() {
    if (!next() || line_ != kFirstLine) fail(std::string("\"") + kFirstLine + "\" is expected");
    while (next()) take();
    return std::move(trace_);
  }

 private:
  bool next() {
    ++number_;
    return static_cast<bool>(std::getline(from_, line_));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw TraceError("line " + std::to_string(number_) + ": " + what);
  }

  void take() {
    std::istringstream cells(line_);
    std::string word;
    cells >> word;
    if (word == "channel") return take_channel(cells);
    if (word == "wire") return take_wire(cells);
    if (word == "train") {
      ++train_;
      last_ = 0;
      return;
    }
    take_token();
  }

  void take_channel(std::istringstream& cells) {
    if (train_ >= 0) fail("a channel stands behind a train");
    TokenChannel channel;
    if (!(cells >> channel.number >> channel.type.lanes >> channel.depth) || channel.type.lanes < 1)
      fail("a channel has a number, lanes, a depth and a name");
    std::getline(cells >> std::ws, channel.name);
    if (index_of(channel.number) != trace_.channels.size())
      fail("channel " + std::to_string(channel.number) + " comes twice");
    trace_.channels.push_back(std::move(channel));
  }

  void take_wire(std::istringstream& cells) {
    TokenWire wire;
    std::string sign;
    if (trace_.channels.empty() || train_ >= 0) fail("a wire stands behind its channel");
    if (!(cells >> wire.bits >> sign >> wire.name) || (sign != "u" && sign != "s") || wire.bits < 1 ||
        wire.bits > 64)
      fail("a wire has 1..64 bits, u or s, and a name");
    wire.has_sign = sign == "s";
    trace_.channels.back().type.wires.push_back(std::move(wire));
  }

  void take_token() {
    std::istringstream cells(line_);
    TokenTrace::Event event;
    int number = 0;
    std::string kind;
    if (!(cells >> event.cycle >> number >> kind) || (kind != "put" && kind != "get"))
      fail("a token has a cycle, a channel, put or get, and its values");
    if (train_ < 0) fail("a token stands before the first train");
    event.channel = index_of(number);
    if (event.channel == trace_.channels.size()) fail("there is no channel " + std::to_string(number));
    if (event.cycle < last_) fail("the cycle is before the last one");
    last_ = event.cycle;
    event.train = train_;
    event.enters = kind == "put";
    event.first = trace_.values.size();
    const std::size_t count = trace_.channels[event.channel].type.values();
    for (std::int64_t value = 0; cells >> value;) trace_.values.push_back(value);
    if (!cells.eof() || trace_.values.size() - event.first != count)
      fail("a token of this channel has " + std::to_string(count) + " values");
    trace_.events.push_back(event);
  }

  std::size_t index_of(int number) const {
    return std::find_if(trace_.channels.begin(), trace_.channels.end(),
                        [&](const TokenChannel& one) { return one.number == number; }) -
           trace_.channels.begin();
  }

  std::istream& from_;
  TokenTrace trace_;
  std::string line_;
  int number_ = 0, train_ = -1;
  std::int64_t last_ = 0;
};

// Returns the type of a token as a player hands it on: `read` copies the values.
TokenType readable(TokenType type) {
  type.read = [count = type.values()](const void* token, std::int64_t* values) {
    std::copy_n(static_cast<const std::int64_t*>(token), count, values);
  };
  return type;
}

}  // namespace

void write_trace(const TokenTrace& trace, std::ostream& to) {
  to << kFirstLine << '\n';
  for (const TokenChannel& channel : trace.channels) {
    to << "channel " << channel.number << ' ' << channel.type.lanes << ' ' << channel.depth << ' '
       << channel.name << '\n';
    for (const TokenWire& wire : channel.type.wires)
      to << "wire " << wire.bits << (wire.has_sign ? " s " : " u ") << wire.name << '\n';
  }
  int train = -1;
  for (const TokenTrace::Event& event : trace.events) {
    for (; train < event.train; ++train) to << "train\n";
    to << event.cycle << ' ' << trace.channels[event.channel].number << (event.enters ? " put" : " get");
    for (const std::int64_t value : trace.token(event)) to << ' ' << value;
    to << '\n';
  }
}

TokenTrace read_trace(std::istream& from) { return TraceReader(from).all(); }

TraceRecorder::TraceRecorder(TokenSource& source) : source_(source), channels_(source.token_channels()) {
  trace_.channels = channels_;
  for (TokenChannel& channel : trace_.channels) {
    channel.type.read = {};
    const std::size_t number = channel.number;
    if (number >= by_number_.size()) by_number_.resize(number + 1);
    by_number_[number] = &channel - trace_.channels.data();
  }
  source.probe(this);
}

void TraceRecorder::cycle(int channel, const Sides& sides, const void* in, const void* out) {
  const std::int64_t now = source_.cycle();
  if (now < last_) ++train_;
  last_ = now;
  const std::size_t at = by_number_[channel];
  if (sides.put) note(at, true, in);
  if (sides.get) note(at, false, out);
}

void TraceRecorder::note(std::size_t channel, bool enters, const void* token) {
  trace_.events.push_back({train_, last_, channel, enters, trace_.values.size()});
  const TokenType& type = channels_[channel].type;
  trace_.values.resize(trace_.values.size() + type.values());
  type.read(token, trace_.values.data() + trace_.events.back().first);
}

std::vector<TokenChannel> TracePlayer::token_channels() const {
  std::vector<TokenChannel> channels = trace_.channels;
  for (TokenChannel& channel : channels) channel.type = readable(std::move(channel.type));
  return channels;
}

bool TracePlayer::play_train() {
  if (next_ == trace_.events.size()) return false;
  const int train = trace_.events[next_].train;
  while (next_ < trace_.events.size() && trace_.events[next_].train == train) {
    const TokenTrace::Event& event = trace_.events[next_];
    if (stopped_ && event.cycle != cycle_) break;
    cycle_ = event.cycle;
    ++next_;
    if (probe_ == nullptr) continue;
    const void* token = trace_.token(event).data();
    probe_->cycle(trace_.channels[event.channel].number,
                  {event.enters, event.enters, !event.enters, !event.enters, event.enters ? 0 : 1},
                  event.enters ? token : nullptr, event.enters ? nullptr : token);
  }
  return true;
}

}  // namespace voxmelt::hwmodel
