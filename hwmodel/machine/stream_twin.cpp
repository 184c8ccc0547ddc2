#include "hwmodel/machine/stream_twin.h"

#include <algorithm>

namespace voxmelt::hwmodel {
namespace {

// Part i of n equal parts of a whole number; together they are the whole.
std::int64_t part(std::int64_t whole, std::int64_t i, std::int64_t n) {
  return whole * (i + 1) / n - whole * i / n;
}

}  // namespace

StreamWork operator-(const StreamWork& a, const StreamWork& b) {
  StreamWork of = a;
  of.passes -= b.passes, of.cycles -= b.cycles, of.tokens -= b.tokens;
  of.read_bits -= b.read_bits, of.fed_bits -= b.fed_bits, of.written_bits -= b.written_bits;
  return of;
}

void StreamTwin::begin_pass() {
  at_ = -latency_;
  end_ = done() ? 0 : part(work_.cycles, pass_, work_.passes);
}

std::int64_t StreamTwin::cycle(bool has_room) {
  if (done()) return 0;
  ++cycles_;
  if (!has_room) {
    ++waited_;
    return 0;
  }
  const std::int64_t lag = std::min(work_.lag, end_ - 1), window = end_ - lag;
  const auto in_pass = [&](std::int64_t bits) { return part(bits, pass_, work_.passes); };
  if (at_ >= 0 && at_ < window) bits_ += part(in_pass(work_.read_bits) + in_pass(work_.fed_bits), at_, window);
  if (at_ >= lag) bits_ += part(in_pass(work_.written_bits), at_ - lag, window);
  if (++at_ == end_) {
    ++pass_;
    begin_pass();
  }
  const std::int64_t bytes = (done() ? bits_ + 7 : bits_) / 8 - moved_;
  moved_ += bytes;
  return bytes;
}

std::int64_t cycles_alone(StreamTwin& twin, const raycast::Configuration& memory) {
  raycast::Memory bytes;  // nobody else asks for any
  raycast::MemoryBlock block(bytes, memory.latency, memory.bus_bytes);
  block.share(&twin);
  for (std::int64_t now = 0; !twin.done(); ++now) block.cycle(now);
  return twin.cycles();
}

}  // namespace voxmelt::hwmodel
