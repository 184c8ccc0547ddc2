#include "hwmodel/machine/stream_twin.h"

#include <algorithm>
#include <cstdint>
#include <memory>

#include "hwmodel/caster/model/layout.h"
#include "hwmodel/memory/dram.h"

namespace voxmelt::hwmodel {
namespace {

constexpr std::int64_t kBurstBits = 8 * raycast::kBurst;
constexpr std::int64_t kAhead = 128 * kBurstBits;  // of a stream's buffer: 8 KiB

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

void StreamTwin::begin(const StreamWork& work) {
  work_ = work;
  pass_ = bits_ = moved_ = cycles_ = waited_ = unwritten_ = 0;
  begin_pass();
}

void StreamTwin::begin_pass() {
  at_ = -latency_;
  end_ = pass_ == work_.passes ? 0 : part(work_.cycles, pass_, work_.passes);
  for (Input* input : {&state_, &irradiance_}) input->asked = input->come = input->used = 0;
  written_ = 0;
}

std::int64_t StreamTwin::in_pass(std::int64_t bits) const { return part(bits, pass_, work_.passes); }

StreamTwin::Bits StreamTwin::now() const {
  const std::int64_t lag = std::min(work_.lag, end_ - 1), window = end_ - lag;
  Bits of;
  if (at_ >= 0 && at_ < window) {
    of.read = part(in_pass(work_.read_bits), at_, window);
    of.fed = part(in_pass(work_.fed_bits), at_, window);
  }
  if (at_ >= lag) of.written = part(in_pass(work_.written_bits), at_ - lag, window);
  return of;
}

void StreamTwin::end_pass() {
  ++pass_;
  begin_pass();
}

std::int64_t StreamTwin::cycle(bool has_room) {
  if (done()) return 0;
  ++cycles_;
  if (!has_room) {
    ++waited_;
    return 0;
  }
  const Bits of = now();
  bits_ += of.read + of.fed + of.written;
  if (++at_ == end_) end_pass();
  const std::int64_t bytes = (done() ? bits_ + 7 : bits_) / 8 - moved_;
  moved_ += bytes;
  return bytes;
}

void StreamTwin::cycle(memory::Dram& dram, std::int64_t base) {
  if (done()) return;
  ++cycles_;
  if (writer_ < 0) {
    state_.port = dram.open_port(nullptr);
    irradiance_.port = dram.open_port(nullptr);
    writer_ = dram.open_port(nullptr);
  }
  const std::int64_t read = in_pass(work_.read_bits);
  state_.address = base;
  irradiance_.address = base + (read / kBurstBits + 1) * raycast::kBurst;
  fetch(dram, state_, read);
  fetch(dram, irradiance_, in_pass(work_.fed_bits));
  if (at_ < end_) {
    const Bits of = now();
    if (state_.used + of.read > state_.come || irradiance_.used + of.fed > irradiance_.come ||
        unwritten_ > kAhead) {
      ++waited_;
    } else {
      state_.used += of.read, irradiance_.used += of.fed;
      unwritten_ += of.written;
      ++at_;
    }
  }
  write(dram, base);
  if (at_ == end_ && unwritten_ == 0) end_pass();
}

// Takes what has come, and asks for more.
void StreamTwin::fetch(memory::Dram& dram, Input& from, std::int64_t bits) const {
  while (dram.reply(from.port) != nullptr) {
    dram.take(from.port);
    from.come += kBurstBits;
  }
  while (from.asked < bits && from.asked - from.used < kAhead && dram.ready(from.port)) {
    dram.put(from.port, {from.address + from.asked / 8, 0, false});
    from.asked += kBurstBits;
  }
}

// Whole bursts; the last one of a pass may be none.
void StreamTwin::write(memory::Dram& dram, std::int64_t base) {
  const bool last = at_ == end_;
  while ((unwritten_ >= kBurstBits || (last && unwritten_ > 0)) && dram.ready(writer_)) {
    dram.put(writer_, {base + written_, 0, true});
    written_ += raycast::kBurst;
    unwritten_ = std::max<std::int64_t>(unwritten_ - kBurstBits, 0);
  }
}

std::int64_t cycles_alone(const StreamWork& work, const raycast::Configuration& memory) {
  raycast::Configuration untraced = memory;
  untraced.memory_trace.clear();
  raycast::Memory bytes;  // nobody else asks for any
  const std::unique_ptr<raycast::LineMemory> lines = raycast::make_line_memory(bytes, untraced);
  StreamTwin twin(memory.dram ? 0 : memory.latency);
  twin.begin(work);
  lines->share(&twin);
  for (std::int64_t now = 0; !twin.done(); ++now) lines->cycle(now);
  return twin.cycles();
}

}  // namespace voxmelt::hwmodel
