#include "hwmodel/pipeline/streams/memory_streams.h"

#include <algorithm>
#include <cstddef>

#include "hwmodel/pipeline/model/fall_stream.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"

namespace voxmelt::hwmodel {

std::int64_t stream_bytes(const Design& design, bool coded) {
  const Shape& shape = design.shape;
  const std::int64_t word = std::int64_t{shape.lanes} * design.cell_bits();
  const std::int64_t state =
      coded || shape.tiled() ? ColumnSlots(design, coded, 0).bytes() : (shape.tokens() * word + 7) / 8;
  const std::int64_t words = 3 + shape.lanes;  // words of irradiance per token: the mask has two at most
  const std::int64_t falls =
      design.parameters.pieces.fall ? (FallStream::bits_of_tile(shape) + 7) / 8 + memory::kBurst : 0;
  return state + shape.tiles() * (shape.tokens() * words * IrradianceStream::kWordBits / 8 + falls) +
         2 * memory::kBurst;
}

MemoryStreams::MemoryStreams(const Design& design, int cascade, const memory::Parameters& parameters,
                             int clock_mhz)
    : design_(design),
      parameters_(parameters),
      clock_mhz_(clock_mhz),
      token_(std::int64_t{design.shape.lanes} * design.cell_bits()),
      tokens_(design.shape.tokens()),
      feeds_(cascade + (design.parameters.pieces.fall ? 1 : 0)) {}

MemoryStreams::MemoryStreams(const Design& design, int cascade, memory::Memory& shared, std::int64_t base)
    : MemoryStreams(design, cascade, memory::Parameters{}, 0) {
  memory_ = &shared;
  base_ = base;
}

void MemoryStreams::open_ports() {
  if (memory_ == nullptr || own_ != nullptr) {
    before_ = all_counts();
    if (own_ != nullptr) cycles_before_ += own_->memory_cycles();
    own_ = std::make_unique<memory::Dram>(parameters_, clock_mhz_);
    if (traces_ != nullptr) traces_->attach(*own_, cycles_before_);
    memory_ = own_.get();
  } else if (opened_) {
    return;
  }
  opened_ = true;
  writer_ = memory_->open_port(nullptr);
  reader_ = memory_->open_port(nullptr);
  feed_ports_.clear();
  for (std::size_t t = 0; t < feeds_.size(); ++t) feed_ports_.push_back(memory_->open_port(nullptr));
}

void MemoryStreams::begin_train(const Train& train) {
  open_ports();
  coded_ = train.columns[0] != nullptr;
  slots_.reset();
  if (coded_ || design_.shape.tiled()) slots_.emplace(design_, coded_, base_);
  tokens_written_ = handed_ = wanted_ = tokens_read_ = tokens_put_ = 0;
  last_written_ = -1;
  unwritten_ = {};
  if (slots_) {
    written_columns_.begin(*slots_, *memory_, writer_);
    columns_.begin(*slots_, train.columns, *memory_, reader_);
  } else {
    state_ = {};
    state_.port = reader_;
    state_.pass = tokens_ * token_;
  }
  lay_out(train);
  for (std::size_t t = 0; t < feeds_.size(); ++t) {
    feeds_[t] = {};
    feeds_[t].port = feed_ports_[t];
    feeds_[t].laid = &irradiance_;
  }
  anything_falls_ = train.falls != nullptr;
  if (anything_falls_) feeds_.back().laid = &falls_;
  add_pass(train.tile, train.fed);
}

// The state lies at the begin, irradiance behind it, and then the cells that fall.
void MemoryStreams::lay_out(const Train& train) {
  const std::int64_t align = memory_->alignment();
  const std::int64_t all = slots_ ? slots_->bytes() : burst_bits(tokens_ * token_) / 8;
  std::int64_t at = base_ + (all + align - 1) / align * align;
  const auto lay = [&](Laid& laid, const auto& bits_of) {
    laid = {};
    for (int tile = 0; tile < design_.shape.tiles(); ++tile) {
      laid.bits.push_back(bits_of(tile));
      laid.at.push_back(at);
      at += burst_bits(laid.bits.back()) / 8;
    }
  };
  lay(irradiance_, [&](int tile) { return train.irradiance == nullptr ? 0 : train.irradiance->bits(tile); });
  lay(falls_,
      [&](int /*tile*/) { return train.falls == nullptr ? 0 : FallStream::bits_of_tile(design_.shape); });
  memory_->require(std::max(at, base_ + all), "the pipeline's state and irradiance");
}

void MemoryStreams::add_pass(int tile, int fed) {
  if (slots_) {
    columns_.add(tile);
    written_columns_.add(tile);
  } else
    wanted_ += burst_bits(state_.pass);
  for (int t = 0; t < fed; ++t) feeds_[t].add(tile);
  if (anything_falls_) feeds_.back().add(tile);
}

void MemoryStreams::Feed::add(int tile) {
  tiles.push_back(tile);
  pass = laid->bits[tiles.front()];
}

void MemoryStreams::Feed::use(std::int64_t bits, bool ends, std::int64_t now) {
  Input::use(bits, ends, now);
  if (!ends) return;
  tiles.pop_front();
  if (asking > 0)
    --asking;
  else
    asked_of_tile = 0;
  if (!tiles.empty()) pass = laid->bits[tiles.front()];
}

void MemoryStreams::take(Input& from, std::int64_t now) {
  std::int64_t come = from.come[now & 1];
  while (memory_->reply(from.port) != nullptr) {
    memory_->take(from.port);
    come += kBurstBits;
  }
  from.come[(now + 1) & 1] = come;
}

void MemoryStreams::ask(Input& from, std::int64_t address) {
  memory_->put(from.port, {address, 0, false, memory::kBurst});
  from.asked += kBurstBits;
}

void MemoryStreams::fetch(Feed& from, std::int64_t now) {
  take(from, now);
  for (; from.asking < from.tiles.size(); ++from.asking, from.asked_of_tile = 0) {
    const std::size_t tile = from.tiles[from.asking];
    while (from.asked_of_tile < from.laid->bits[tile]) {
      if (!room(from, now)) return;
      ask(from, from.laid->at[tile] + from.asked_of_tile / 8);
      from.asked_of_tile += kBurstBits;
    }
  }
}

void MemoryStreams::cycle(std::int64_t now) {
  if (slots_) {
    written_columns_.cycle(now);
    columns_.cycle(written_columns_, now);
  } else {
    cycle_state(now);
  }
  for (Feed& feed : feeds_) fetch(feed, now);
  if (own_ != nullptr) own_->cycle();
}

bool MemoryStreams::has_come(const Input& from) const {
  return from.asked == std::max(from.come[0], from.come[1]);
}

bool MemoryStreams::settled() const {
  if (own_ != nullptr) return true;
  if (!std::all_of(feeds_.begin(), feeds_.end(), [this](const Feed& feed) { return has_come(feed); }))
    return false;
  if (slots_) return written_columns_.settled() && columns_.settled();
  return has_come(state_) && handed_ == tokens_written_ / tokens_ * burst_bits(state_.pass);
}

void MemoryStreams::cycle_state(std::int64_t now) {
  // Bursts are written whole, so the last one of a pass may have unused bits. A burst may be read again when
  // it has been handed on, because the memory keeps the order of requests to it.
  const std::int64_t pass = burst_bits(state_.pass);
  const std::int64_t written = tokens_written_ - (last_written_ == now ? 1 : 0);
  const std::int64_t bits = written / tokens_ * pass + written % tokens_ * token_;
  while (handed_ + kBurstBits <= bits && memory_->ready(writer_)) {
    memory_->put(writer_, {base_ + handed_ % pass / 8, 0, true, memory::kBurst});
    handed_ += kBurstBits;
  }
  unwritten_[(now + 1) & 1] = bits - handed_;
  take(state_, now);
  const std::int64_t limit = std::min(pass + handed_, wanted_);
  while (state_.asked < limit && room(state_, now)) ask(state_, base_ + state_.asked % pass / 8);
}

}  // namespace voxmelt::hwmodel
