#include "hwmodel/machine/coded_port.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::hwmodel {
namespace {

std::int64_t bursts_of(std::int64_t bits) { return CodeLayout::up(bits) / CodeLayout::kBurstBits; }

}  // namespace

void CodedInput::begin(const CodeLayout& layout, const StoredColumns& memory, memory::Dram& dram) {
  *this = {};
  dram_ = &dram, memory_ = &memory;
  port_ = dram.open_port(nullptr);
  columns_ = layout.columns(), head_bursts_ = bursts_of(layout.head_bits());
  slot_bytes_ = layout.slot_bits() / 8;
}

bool CodedInput::has(std::int64_t bits, std::int64_t now) const {
  const auto at = static_cast<std::size_t>(done_ - first_);
  if (at >= ahead_.size()) return false;
  const std::vector<std::int64_t>& come = ahead_[at].come;
  const auto needed = static_cast<std::size_t>(bursts_of(bits));
  return come.size() >= needed && come[needed - 1] < now;
}

void CodedInput::use(std::int64_t bits, bool ends, std::int64_t now) {
  freed_before_ = freed_, last_used_ = now;
  const std::int64_t all = ahead_[static_cast<std::size_t>(done_ - first_)].bursts;
  const std::int64_t done = ends ? all : bits / CodeLayout::kBurstBits;
  freed_ += done - freed_of_column_;
  freed_of_column_ = done;
  if (!ends) return;
  ++done_, last_done_ = now, freed_of_column_ = 0;
}

bool CodedInput::ask(Column& column, std::int64_t number) {
  if (!dram_->ready(port_)) return false;
  dram_->put(port_, {number % columns_ * slot_bytes_ + column.asked * memory::kBurst, 0, false});
  ++column.asked, ++asked_;
  under_way_.push_back(number);
  return true;
}

void CodedInput::cycle(std::int64_t readable, std::int64_t now) {
  for (; first_ < done_before(now); ++first_) ahead_.pop_front();
  while (dram_->reply(port_) != nullptr) {
    dram_->take(port_);
    const std::int64_t number = under_way_.front();
    under_way_.pop_front();
    Column& column = ahead_[static_cast<std::size_t>(number - first_)];
    column.come.push_back(now);
    if (static_cast<std::int64_t>(column.come.size()) == head_bursts_)
      column.bursts = bursts_of(memory_->bits_of(number % columns_));
  }
  // The rest of the oldest columns first; else the begin of one more.
  std::int64_t number = first_, begun = 0;
  const auto room = [&] { return asked_ - freed_before(now) < kBurstsAhead && dram_->ready(port_); };
  for (Column& column : ahead_) {
    const std::int64_t known = std::max(column.bursts, head_bursts_);
    while (column.asked < known && room()) ask(column, number);
    begun += column.bursts == 0 ? head_bursts_ : 0;
    ++number;
  }
  readable = std::min(readable, wanted_);
  // Begins of columns take a quarter of the buffer at most: the rest of the oldest one must find room.
  while (number < readable && room() && static_cast<int>(ahead_.size()) < kColumnsAhead &&
         (ahead_.empty() || begun + head_bursts_ <= kBurstsAhead / 4)) {
    Column& column = ahead_.emplace_back();
    while (column.asked < head_bursts_ && room()) ask(column, number);
    begun += head_bursts_;
    ++number;
  }
}

void CodedOutput::begin(const CodeLayout& layout, memory::Dram& dram) {
  *this = {};
  dram_ = &dram;
  port_ = dram.open_port(nullptr);
  columns_ = layout.columns(), head_bursts_ = bursts_of(layout.head_bits());
  slot_bytes_ = layout.slot_bits() / 8;
  full_ = head_bursts_;
}

void CodedOutput::fill(const Event& event) {
  const std::int64_t slot = column_ % columns_ * slot_bytes_;
  const std::int64_t full = event.ends ? bursts_of(event.bits) : event.bits / CodeLayout::kBurstBits;
  for (; full_ < full; ++full_) bursts_.push_back({slot + full_ * memory::kBurst, false});
  if (!event.ends) return;
  for (std::int64_t head = 0; head < head_bursts_; ++head)
    bursts_.push_back({slot + head * memory::kBurst, head + 1 == head_bursts_});
  ++column_, full_ = head_bursts_;
}

void CodedOutput::cycle(std::int64_t now) {
  while (!events_.empty() && events_.front().cycle < now) {
    fill(events_.front());
    events_.pop_front();
  }
  while (!bursts_.empty() && dram_->ready(port_)) {
    dram_->put(port_, {bursts_.front().address, 0, true});
    handed_ += bursts_.front().last ? 1 : 0;
    bursts_.pop_front();
  }
  waiting_[(now + 1) & 1] = static_cast<std::int64_t>(bursts_.size());
}

}  // namespace voxmelt::hwmodel
