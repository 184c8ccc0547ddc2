// The streams of the pipeline go to and from a memory. Words are packed into bursts of 64 bytes, and each
// stream has a buffer. A pass reads where the last one wrote, and never ahead of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "hwmodel/fabric/memory_port.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/trace.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/pipeline/model/stream_memory.h"
#include "hwmodel/pipeline/streams/column_port.h"

namespace voxmelt::hwmodel {

// Returns the most bytes that the state and what the feeds read take.
std::int64_t stream_bytes(const Design& design, bool coded);

class MemoryStreams final : public StreamMemory {
 public:
  // Makes a DRAM of its own, which is new with each train.
  MemoryStreams(const Design& design, int cascade, const memory::Parameters& parameters, int clock_mhz);
  // Uses a memory that others use, too, from `base` of its addresses on. Its owner ends its cycles.
  MemoryStreams(const Design& design, int cascade, memory::Memory& shared, std::int64_t base);

  void begin_train(const Train& train) override;
  void add_pass(int tile, int fed) override;
  bool may_read(std::int64_t bits, std::int64_t now) const override {
    if (coded_) return columns_.has(bits, now);
    return slots_ ? columns_.has((tokens_read_ + 1) * token_, now)
                  : state_.has(state_.used_of_pass() + token_, now);
  }
  bool may_feed(int t, std::int64_t bits, std::int64_t now) const override { return feed(t).has(bits, now); }
  bool may_write(std::int64_t now) const override {
    return slots_ ? written_columns_.may_write(now) : unwritten_[now & 1] <= kAhead;
  }
  void read(std::int64_t bits, bool ends, std::int64_t now) override {
    if (slots_) return columns_.use(of_column(bits, ends, tokens_read_), ends, now);
    const std::int64_t used = state_.used_of_pass() + token_;
    state_.use(used, used == state_.pass, now);
  }
  void fed(int t, std::int64_t bits, bool ends, std::int64_t now) override { feeds_[t].use(bits, ends, now); }
  void written(std::int64_t bits, bool ends, std::int64_t now) override {
    if (slots_) return written_columns_.written(of_column(bits, ends, tokens_put_), ends, now);
    ++tokens_written_;
    last_written_ = now;
  }
  void cycle(std::int64_t now) override;

  // Returns true if a shared memory has been given all that was written, and all that was asked for has come.
  // So the next train finds nothing of this one under way.
  bool settled() const override;
  bool works() const override { return memory_ != nullptr && memory_->works(); }

  memory::Counts counts() const { return own_->counts(); }  // for the last train, on a DRAM of its own
  // Sums over all trains, each on a DRAM of its own.
  memory::Counts all_counts() const {
    memory::Counts all = before_;
    if (own_ != nullptr) all += own_->counts();
    return all;
  }
  // Logs what a DRAM of its own does in all trains from now on.
  void log(memory::TraceFiles& traces) { traces_ = &traces; }

  static constexpr std::int64_t kBurstBits = 8 * memory::kBurst;
  static constexpr std::int64_t kAhead = 128 * kBurstBits;  // of a stream's buffer: 8 KiB

 private:
  static std::int64_t burst_bits(std::int64_t bits) {
    return (bits + kBurstBits - 1) / kBurstBits * kBurstBits;
  }
  // A stream that is read ahead has such an input. Counts are bits, and run on over all passes. A pass begins
  // with a burst.
  struct Input {
    int port = -1;
    std::int64_t pass = 0;  // bits of the present pass, which may be none
    std::int64_t asked = 0;
    std::array<std::int64_t, 2> come{};  // at the begin of even and of odd cycles
    std::int64_t begun = 0, used = 0, before = 0, last_used = -1;

    std::int64_t used_of_pass() const { return used - begun; }
    // Returns true if the first `bits` of the present pass have come.
    bool has(std::int64_t bits, std::int64_t now) const { return begun + bits <= come[now & 1]; }
    // Says that the first `bits` are not needed any more. `ends` says that the rest of the pass is not,
    // either.
    void use(std::int64_t bits, bool ends, std::int64_t now) {
      before = used;
      last_used = now;
      used = begun + bits;
      if (ends) used = begun += burst_bits(pass);
    }
    std::int64_t used_before(std::int64_t now) const { return last_used == now ? before : used; }
  };
  // Tells for each tile where what a feed reads lies: its bits, and its first address.
  struct Laid {
    std::vector<std::int64_t> bits, at;
  };
  // A feed has a stretch for each tile of each pass. All of them stay in memory.
  struct Feed : Input {
    std::deque<int> tiles;  // tile of the present stretch, and further ones
    std::size_t asking = 0;
    std::int64_t asked_of_tile = 0;
    const Laid* laid = nullptr;

    void add(int tile);
    void use(std::int64_t bits, bool ends, std::int64_t now);
  };
  void open_ports();
  void lay_out(const Train& train);
  void cycle_state(std::int64_t now);
  bool has_come(const Input& from) const;
  const Feed& feed(int t) const { return feeds_[t]; }
  void take(Input& from, std::int64_t now);
  bool room(const Input& from, std::int64_t now) const {
    return from.asked - from.used_before(now) < kAhead && memory_->ready(from.port);
  }
  void ask(Input& from, std::int64_t address);
  void fetch(Feed& from, std::int64_t now);
  // Returns the bits of a column so far. Without the code all tokens take as many.
  std::int64_t of_column(std::int64_t bits, bool ends, std::int64_t& tokens) const {
    if (coded_) return bits;
    const std::int64_t before = tokens;
    tokens = ends ? 0 : before + 1;
    return (before + 1) * token_;
  }

  Design design_;
  memory::Parameters parameters_;  // for a DRAM of its own
  int clock_mhz_ = 0;
  std::unique_ptr<memory::Dram> own_;
  memory::Counts before_{};         // of the trains before the last one
  std::int64_t cycles_before_ = 0;  // of the memory
  memory::TraceFiles* traces_ = nullptr;
  memory::Memory* memory_ = nullptr;
  std::int64_t base_ = 0;
  bool opened_ = false;            // the ports of a memory that is shared
  int reader_ = -1, writer_ = -1;  // ports
  std::vector<int> feed_ports_;
  bool coded_ = false;
  std::int64_t token_ = 0, tokens_ = 0;  // bits of a token; tokens of a pass
  // The state lies in memory by columns if it is coded, or the grid is in tiles.
  std::optional<ColumnSlots> slots_;
  ColumnInput columns_;
  ColumnOutput written_columns_;
  std::int64_t tokens_read_ = 0, tokens_put_ = 0;  // in the present column, without the code
  // Otherwise it lies in memory in the order of its stream.
  Input state_;
  std::int64_t wanted_ = 0;                                           // bits of all passes
  std::int64_t tokens_written_ = 0, last_written_ = -1, handed_ = 0;  // tokens; bits given to the memory
  std::array<std::int64_t, 2> unwritten_{};  // bits, at the begin of even and of odd cycles

  std::vector<Feed> feeds_;  // one of each time step, and with pieces that fall another one
  Laid irradiance_, falls_;
  bool anything_falls_ = false;  // in this train
};

}  // namespace voxmelt::hwmodel
