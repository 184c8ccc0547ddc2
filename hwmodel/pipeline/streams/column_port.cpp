#include "hwmodel/pipeline/streams/column_port.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace voxmelt::hwmodel {
namespace {

std::int64_t bursts_of(std::int64_t bits) { return CodeLayout::up(bits) / CodeLayout::kBurstBits; }

}  // namespace

ColumnSlots::ColumnSlots(const Design& design, bool is_coded, std::int64_t first)
    : shape(design.shape), coded(is_coded), base(first), copies(design.shape.tiled() ? 2 : 1) {
  const CodeLayout layout(design);
  columns = layout.columns();
  head_bursts = coded ? bursts_of(layout.head_bits()) : 0;
  slot_bursts = coded ? bursts_of(layout.slot_bits()) : bursts_of(layout.height() * layout.token_bits());
}

void ColumnWalk::begin(const ColumnSlots& slots, bool owned) {
  *this = {};
  shape_ = slots.shape;
  owned_ = owned;
}

void ColumnWalk::add(int tile) {
  if (any_ && tile == 0) ++passes_;
  any_ = true;
  tiles_.push_back({tile, passes_});
  if (tiles_.size() == 1) {
    z_ = 0;
    begin_row();
  }
}

void ColumnWalk::begin_row() {
  const int tile = tiles_.front().tile, first = shape_.first_block(tile);
  block_ = owned_ ? shape_.owned_begin(tile) : first;
  end_ = owned_ ? shape_.owned_end(tile) : first + shape_.blocks();
}

ColumnWalk::Column ColumnWalk::now() const {
  return {std::int64_t{z_} * shape_.grid_blocks() + block_, tiles_.front().pass};
}

void ColumnWalk::next() {
  if (++block_ < end_) return;
  if (++z_ == shape_.grid.z) {
    z_ = 0;
    tiles_.pop_front();
  }
  if (!tiles_.empty()) begin_row();
}

void ColumnInput::begin(const ColumnSlots& slots, std::array<const StoredColumns*, 2> stored,
                        memory::Memory& memory, int port) {
  *this = {};
  memory_ = &memory;
  stored_ = stored;
  port_ = port;
  slots_ = slots;
  walk_.begin(slots, false);
}

bool ColumnInput::has(std::int64_t bits, std::int64_t now) const {
  const std::size_t at = done_ - first_;
  if (at >= ahead_.size()) return false;
  const std::vector<std::int64_t>& come = ahead_[at].come;
  const std::size_t needed = bursts_of(bits);
  return come.size() >= needed && come[needed - 1] < now;
}

void ColumnInput::use(std::int64_t bits, bool ends, std::int64_t now) {
  freed_before_ = freed_;
  last_used_ = now;
  const std::int64_t all = ahead_[done_ - first_].bursts;
  const std::int64_t done = ends ? all : bits / CodeLayout::kBurstBits;
  freed_ += done - freed_of_column_;
  freed_of_column_ = done;
  if (!ends) return;
  ++done_;
  last_done_ = now;
  freed_of_column_ = 0;
}

void ColumnInput::take(std::int64_t now) {
  while (memory_->reply(port_) != nullptr) {
    memory_->take(port_);
    Column& column = ahead_[under_way_.front() - first_];
    under_way_.pop_front();
    column.come.push_back(now);
    if (slots_->coded && std::ssize(column.come) == slots_->head_bursts)
      column.bursts = bursts_of(stored_[column.at.pass % slots_->copies]->bits_of(column.at.number));
  }
}

void ColumnInput::ask(Column& column, std::int64_t number, std::int64_t bursts, std::int64_t now) {
  const std::int64_t slot = slots_->address(column.at.number, column.at.pass);
  while (column.asked < bursts && room(now)) {
    memory_->put(port_, {slot + column.asked * memory::kBurst, 0, false, memory::kBurst});
    ++column.asked;
    ++asked_;
    under_way_.push_back(number);
  }
}

void ColumnInput::cycle(const ColumnOutput& written, std::int64_t now) {
  for (; first_ < done_before(now); ++first_) ahead_.pop_front();
  take(now);
  // The rest of the oldest columns comes first, and then the begin of one more.
  std::int64_t number = first_, begun = 0;
  for (Column& column : ahead_) {
    ask(column, number, std::max(column.bursts, slots_->head_bursts), now);
    begun += column.bursts == 0 ? slots_->head_bursts : 0;
    ++number;
  }
  // Begins of columns take a quarter of the buffer at most, because the rest of the oldest one must find
  // room.
  const std::size_t most = slots_->coded ? kColumnsAhead : kBurstsAhead;
  while (!walk_.done() && room(now) && ahead_.size() < most &&
         (ahead_.empty() || begun + slots_->head_bursts <= kBurstsAhead / 4)) {
    const ColumnWalk::Column at = walk_.now();
    if (written.passes(at.number) < at.pass) break;
    walk_.next();
    Column& column = ahead_.emplace_back(Column{at, slots_->coded ? 0 : slots_->slot_bursts});
    ask(column, number, std::max(column.bursts, slots_->head_bursts), now);
    begun += slots_->head_bursts;
    ++number;
  }
}

void ColumnOutput::begin(const ColumnSlots& slots, memory::Memory& memory, int port) {
  *this = {};
  memory_ = &memory;
  port_ = port;
  slots_ = slots;
  walk_.begin(slots, true);
  passes_.resize(slots.columns);
  full_ = slots.head_bursts;
}

void ColumnOutput::fill(const Event& event) {
  const ColumnWalk::Column at = walk_.now();
  const std::int64_t slot = slots_->address(at.number, at.pass + 1);
  const std::int64_t full = event.ends ? bursts_of(event.bits) : event.bits / CodeLayout::kBurstBits;
  for (; full_ < full; ++full_) bursts_.push_back({slot + full_ * memory::kBurst, -1});
  if (!event.ends) return;
  for (std::int64_t head = 0; head < slots_->head_bursts; ++head)
    bursts_.push_back({slot + head * memory::kBurst, -1});
  bursts_.back().column = at.number;
  walk_.next();
  full_ = slots_->head_bursts;
}

void ColumnOutput::cycle(std::int64_t now) {
  while (!events_.empty() && events_.front().cycle < now) {
    fill(events_.front());
    events_.pop_front();
  }
  while (!bursts_.empty() && memory_->ready(port_)) {
    memory_->put(port_, {bursts_.front().address, 0, true, memory::kBurst});
    if (bursts_.front().column >= 0) ++passes_[bursts_.front().column];
    bursts_.pop_front();
  }
  waiting_[(now + 1) & 1] = bursts_.size();
}

}  // namespace voxmelt::hwmodel
