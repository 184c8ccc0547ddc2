#include "hwmodel/pipeline/model/coded_state.h"

#include <algorithm>

#include "hwmodel/pipeline/model/volume_port.h"

namespace voxmelt::hwmodel {
namespace {

void put_bits(std::uint64_t* words, std::int64_t at, int bits, std::uint64_t value) {
  const std::uint64_t ones = (std::uint64_t{1} << bits) - 1;  // a cell has at most 54 bits
  const std::int64_t shift = at % 64;
  std::uint64_t* word = words + at / 64;
  word[0] = (word[0] & ~(ones << shift)) | value << shift;
  if (shift + bits <= 64) return;
  word[1] = (word[1] & ~(ones >> (64 - shift))) | value >> (64 - shift);
}

std::uint64_t get_bits(const std::uint64_t* words, std::int64_t at, int bits) {
  const std::uint64_t ones = (std::uint64_t{1} << bits) - 1;
  const std::int64_t shift = at % 64;
  const std::uint64_t* word = words + at / 64;
  std::uint64_t value = word[0] >> shift;
  if (shift + bits > 64) value |= word[1] << (64 - shift);
  return value & ones;
}

bool is_air(const Cell& cell) {
  return cell.air() && cell.set == 0 && cell.amount == 0 && cell.energy == 0 && cell.heat == 0;
}

bool all_air(const Cell* lanes, int cells) { return std::all_of(lanes, lanes + cells, is_air); }

Cell air() {
  Cell cell;
  cell.state = State::air;
  cell.amount = 0;
  return cell;
}

int cells_of(const Shape& shape, const Place& place) { return std::min(shape.lanes, shape.grid.x - place.x); }

// A cell that is not blocked is air or liquid by its amount. So the codes of these two tell if it is set.
State with_set(const Cell& cell) {
  if (cell.blocked()) return cell.state;
  return cell.set > 0 ? State::liquid : State::air;
}

void take_set(Cell& cell) {
  if (cell.blocked()) return;
  cell.set = cell.state == State::liquid;
  cell.state = cell.amount > 0 ? State::liquid : State::air;
}

}  // namespace

CodeLayout::CodeLayout(const Design& design)
    : lanes_(design.shape.lanes),
      height_(design.shape.grid.y),
      blocks_(design.shape.grid_blocks()),
      cell_bits_(design.cell_bits()),
      columns_(std::int64_t{design.shape.grid_blocks()} * design.shape.grid.z),
      kept_(design.kept()),
      keeps_set_(design.keeps_set()) {}

void CodeLayout::put(const Cell& cell, std::uint64_t* slot, std::int64_t at) const {
  std::uint64_t value = 0;
  int bits = 0;
  Cell stored = cell;
  if (keeps_set_) stored.state = with_set(cell);
  for (const CellWire& row : kCellWires) {
    if (!is_in_memory(row, kept_)) continue;
    const std::uint64_t number = row.get(stored);
    value |= number << bits;
    bits += row.bits;
  }
  put_bits(slot, at, bits, value);
}

Cell CodeLayout::get(const std::uint64_t* slot, std::int64_t at) const {
  std::uint64_t value = get_bits(slot, at, cell_bits_);
  Cell cell;
  for (const CellWire& row : kCellWires) {
    if (!is_in_memory(row, kept_)) continue;
    row.set(cell, value & ((std::uint64_t{1} << row.bits) - 1));
    value >>= row.bits;
  }
  if (keeps_set_) take_set(cell);
  return cell;
}

std::vector<BufferCost> reader_buffers(const CodeLayout& layout) {
  return {{"tokens of columns ahead", kColumnsAhead, 1, layout.head_bits()}};
}

std::vector<BufferCost> writer_buffers(const CodeLayout& layout) {
  constexpr std::int64_t kBurst = CodeLayout::kBurstBits;
  return {{"tokens of a column", 1, 1, layout.head_bits()},
          {"bursts held back", CodeLayout::up(layout.head_bits()) / kBurst, 1, kBurst}};
}

CodedState::CodedState(const CodeLayout& layout)
    : layout_(layout), slot_words_(layout.slot_bits() / 64), words_(slot_words_ * layout.columns()) {}

std::int64_t CodedState::bits_of(std::int64_t column) const {
  const std::uint64_t* words = slot(column);
  std::int64_t stored = 0;
  for (int y = 0; y < layout_.height(); ++y) stored += bit_of(words, y) ? 1 : 0;
  return layout_.at(stored, 0);
}

std::int64_t CodedState::moved_bits() const {
  std::int64_t bits = 0;
  for (std::int64_t column = 0; column < layout_.columns(); ++column) bits += CodeLayout::up(bits_of(column));
  return bits;
}

void CodedState::store(const state::Volume& volume, const state::BitPlane* set) {
  Shape shape{volume.grid, layout_.lanes()};
  ColumnWriter writer(layout_);
  std::vector<Cell> lanes(shape.lanes);
  for (Place place = begin_of(shape, 0); place.ordinal < shape.tokens(); place.next(shape)) {
    read_token(volume, shape, place, lanes.data(), set);
    writer.put(lanes.data(), cells_of(shape, place), place, slot(layout_.column_of(place)), nullptr, 0);
  }
}

void CodedState::load(const Shape& shape, const Place& place, state::Volume& volume,
                      state::BitPlane* set) const {
  const std::uint64_t* from = slot(layout_.column_of(place));
  ColumnReader reader(layout_);
  std::vector<Cell> lanes(shape.lanes);
  Place at = place;
  for (at.y = 0; at.y < shape.grid.y; ++at.y) {
    reader.get(lanes.data(), cells_of(shape, at), at, from, nullptr, 0);
    write_token(lanes.data(), shape, at, volume, set);
  }
}

void ColumnWriter::put(const Cell* lanes, int cells, const Place& place, std::uint64_t* slot,
                       CodeFault* fault, std::int64_t pass) {
  if (place.y == 0) stored_ = 0;
  bool leave_out = all_air(lanes, cells);
  if (fault != nullptr) [[unlikely]]
    fault->judged(pass, place, lanes, leave_out);
  set_bit(head_.data(), place.y, !leave_out);
  if (!leave_out) {
    if (fault != nullptr) [[unlikely]]
      fault->stored(pass, place, lanes, stored_);
    for (int lane = 0; lane < layout_.lanes(); ++lane)
      layout_.put(lane < cells ? lanes[lane] : Cell{}, slot, layout_.at(stored_, lane));
    ++stored_;
  }
  if (place.y + 1 < layout_.height()) return;
  for (int y = 0; y < layout_.height(); ++y) set_bit(slot, y, bit_of(head_.data(), y));
  if (fault != nullptr) [[unlikely]]
    fault->ended(pass, place, slot);
}

void ColumnReader::get(Cell* lanes, int cells, const Place& place, const std::uint64_t* slot,
                       CodeFault* fault, std::int64_t pass) {
  if (place.y == 0) stored_ = 0;
  bool stored = bit_of(slot, place.y);
  if (fault != nullptr) [[unlikely]]
    fault->found(pass, place, slot, stored);
  for (int lane = 0; lane < layout_.lanes(); ++lane)
    lanes[lane] = lane >= cells ? Cell{} : stored ? layout_.get(slot, layout_.at(stored_, lane)) : air();
  if (stored) ++stored_;
}

}  // namespace voxmelt::hwmodel
