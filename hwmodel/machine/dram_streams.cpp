#include "hwmodel/machine/dram_streams.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::hwmodel {

DramStreams::DramStreams(const Design& design, int cascade, const memory::Parameters& parameters,
                         int clock_mhz)
    : parameters_(parameters),
      clock_mhz_(clock_mhz),
      layout_(design),
      feeds_(static_cast<std::size_t>(cascade)) {
  token_ = std::int64_t{design.shape.lanes} * design.cell_bits();
}

void DramStreams::begin_train(std::int64_t tokens, int fed, std::int64_t irradiance_bits,
                              const StoredColumns* columns) {
  dram_ = std::make_unique<memory::Dram>(parameters_, clock_mhz_);
  tokens_ = tokens;
  coded_ = columns != nullptr;
  if (coded_)
    written_columns_.begin(layout_, *dram_);
  else
    writer_ = dram_->open_port(nullptr);
  tokens_written_ = handed_ = 0, last_written_ = -1;
  unwritten_ = {};
  // The state at the begin, irradiance behind it, at a row of every bank.
  const std::int64_t rows =
      parameters_.row_bytes() * parameters_.banks_of_rank() * parameters_.ranks * parameters_.channels;
  const std::int64_t all = coded_ ? layout_.slot_bits() * layout_.columns() : burst_bits(tokens * token_);
  const std::int64_t base = (all / 8 + rows - 1) / rows * rows;
  const auto begin = [&](Input& input, std::int64_t at, std::int64_t bits) {
    input = {};
    input.base = at, input.pass = bits;
    input.port = dram_->open_port(nullptr);
  };
  if (coded_)
    columns_.begin(layout_, *columns, *dram_);
  else
    begin(state_, 0, tokens * token_);
  for (Input& feed : feeds_) begin(feed, base, irradiance_bits);
  add_pass(fed);
}

void DramStreams::add_pass(int fed) {
  columns_.add_pass();
  state_.wanted += burst_bits(state_.pass);
  for (std::size_t t = 0; t < static_cast<std::size_t>(fed); ++t)
    feeds_[t].wanted += burst_bits(feeds_[t].pass);
}

// Takes what has come, and asks for more.
void DramStreams::fetch(Input& from, std::int64_t limit, std::int64_t now) {
  std::int64_t come = from.come[static_cast<std::size_t>(now & 1)];
  while (dram_->reply(from.port) != nullptr) {
    dram_->take(from.port);
    come += kBurstBits;
  }
  from.come[static_cast<std::size_t>((now + 1) & 1)] = come;
  limit = std::min(limit, from.wanted);
  while (from.asked < limit && from.asked - from.used_before(now) < kAhead && dram_->ready(from.port)) {
    dram_->put(from.port, {from.address(from.asked), 0, false});
    from.asked += kBurstBits;
  }
}

void DramStreams::cycle(std::int64_t now) {
  if (coded_) {
    written_columns_.cycle(now);
    columns_.cycle(layout_.columns() + written_columns_.handed(), now);
  } else {
    cycle_state(now);
  }
  for (Input& feed : feeds_) fetch(feed, feed.wanted, now);
  dram_->cycle();
}

void DramStreams::cycle_state(std::int64_t now) {
  // Whole bursts; the last one of a pass may be none. A burst may be read again when it has been handed on:
  // the memory keeps the order of requests to it.
  const std::int64_t pass = burst_bits(state_.pass);
  const std::int64_t written = tokens_written_ - (last_written_ == now ? 1 : 0);
  const std::int64_t bits = written / tokens_ * pass + written % tokens_ * token_;
  while (handed_ + kBurstBits <= bits && dram_->ready(writer_)) {
    dram_->put(writer_, {handed_ % pass / 8, 0, true});
    handed_ += kBurstBits;
  }
  unwritten_[static_cast<std::size_t>((now + 1) & 1)] = bits - handed_;
  fetch(state_, pass + handed_, now);
}

}  // namespace voxmelt::hwmodel
