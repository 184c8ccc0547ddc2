#include "hwmodel/machine/dram_streams.h"

#include <algorithm>
#include <cstddef>

#include "hwmodel/pipeline/model/irradiance_stream.h"

namespace voxmelt::hwmodel {

DramStreams::DramStreams(const Design& design, int cascade, const memory::Parameters& parameters,
                         int clock_mhz)
    : design_(design),
      parameters_(parameters),
      clock_mhz_(clock_mhz),
      token_(std::int64_t{design.shape.lanes} * design.cell_bits()),
      tokens_(design.shape.tokens()),
      feeds_(static_cast<std::size_t>(cascade)) {}

void DramStreams::begin_train(const Train& train) {
  dram_ = std::make_unique<memory::Dram>(parameters_, clock_mhz_);
  coded_ = train.columns[0] != nullptr;
  slots_.reset();
  if (coded_ || design_.shape.tiled()) slots_.emplace(design_, coded_);
  if (slots_)
    written_columns_.begin(*slots_, *dram_);
  else
    writer_ = dram_->open_port(nullptr);
  tokens_written_ = handed_ = wanted_ = tokens_read_ = tokens_put_ = 0, last_written_ = -1;
  unwritten_ = {};
  if (slots_) {
    columns_.begin(*slots_, train.columns, *dram_);
  } else {
    state_ = {};
    state_.port = dram_->open_port(nullptr), state_.pass = tokens_ * token_;
  }
  // The state at the begin, irradiance behind it, at a row of every bank.
  const std::int64_t rows =
      parameters_.row_bytes() * parameters_.banks_of_rank() * parameters_.ranks * parameters_.channels;
  const std::int64_t all = slots_ ? slots_->bytes() : burst_bits(tokens_ * token_) / 8;
  const std::int64_t base = (all + rows - 1) / rows * rows;
  irradiance_bits_.clear(), irradiance_at_.clear();
  std::int64_t at = base;
  for (int tile = 0; tile < design_.shape.tiles(); ++tile) {
    irradiance_bits_.push_back(train.irradiance == nullptr ? 0 : train.irradiance->bits(tile));
    irradiance_at_.push_back(at);
    at += burst_bits(irradiance_bits_.back()) / 8;
  }
  for (Feed& feed : feeds_) {
    feed = {};
    feed.port = dram_->open_port(nullptr), feed.bits_of_tile = &irradiance_bits_;
  }
  add_pass(train.tile, train.fed);
}

void DramStreams::add_pass(int tile, int fed) {
  if (slots_)
    columns_.add(tile), written_columns_.add(tile);
  else
    wanted_ += burst_bits(state_.pass);
  for (std::size_t t = 0; t < static_cast<std::size_t>(fed); ++t) feeds_[t].add(tile);
}

void DramStreams::Feed::add(int tile) {
  tiles.push_back(tile);
  pass = (*bits_of_tile)[static_cast<std::size_t>(tiles.front())];
}

void DramStreams::Feed::use(std::int64_t bits, bool ends, std::int64_t now) {
  Input::use(bits, ends, now);
  if (!ends) return;
  tiles.pop_front();
  if (asking > 0)
    --asking;
  else
    asked_of_tile = 0;
  if (!tiles.empty()) pass = (*bits_of_tile)[static_cast<std::size_t>(tiles.front())];
}

void DramStreams::take(Input& from, std::int64_t now) {
  std::int64_t come = from.come[static_cast<std::size_t>(now & 1)];
  while (dram_->reply(from.port) != nullptr) {
    dram_->take(from.port);
    come += kBurstBits;
  }
  from.come[static_cast<std::size_t>((now + 1) & 1)] = come;
}

void DramStreams::ask(Input& from, std::int64_t address) {
  dram_->put(from.port, {address, 0, false});
  from.asked += kBurstBits;
}

void DramStreams::fetch(Feed& from, std::int64_t now) {
  take(from, now);
  for (; from.asking < from.tiles.size(); ++from.asking, from.asked_of_tile = 0) {
    const auto tile = static_cast<std::size_t>(from.tiles[from.asking]);
    while (from.asked_of_tile < irradiance_bits_[tile]) {
      if (!room(from, now)) return;
      ask(from, irradiance_at_[tile] + from.asked_of_tile / 8);
      from.asked_of_tile += kBurstBits;
    }
  }
}

void DramStreams::cycle(std::int64_t now) {
  if (slots_) {
    written_columns_.cycle(now);
    columns_.cycle(written_columns_, now);
  } else {
    cycle_state(now);
  }
  for (Feed& feed : feeds_) fetch(feed, now);
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
  take(state_, now);
  const std::int64_t limit = std::min(pass + handed_, wanted_);
  while (state_.asked < limit && room(state_, now)) ask(state_, state_.asked % pass / 8);
}

}  // namespace voxmelt::hwmodel
