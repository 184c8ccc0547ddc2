// With an occupancy code (hw.coded), the state in memory has one bit for a token of air, and nothing else.
//
// Every column of a block has a slot of its own, which begins with a burst. First comes a bit for each of the
// column's tokens, the lowest token first. It tells if the token is stored. The stored tokens follow one
// behind another, each as wide as without the code. So a column may be written without knowing the others,
// and its place does not depend on what it holds. Only bursts that hold something move. Lanes beyond the grid
// are stored with their token, and mean nothing.
//
// Where a scene freezes, a step of several passes keeps which places are set. A set token is no token of air.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// Tells where the parts of a slot lie, in bits.
class CodeLayout {
 public:
  static constexpr std::int64_t kBurstBits = 512;

  explicit CodeLayout(const Design& design);

  int lanes() const { return lanes_; }
  int height() const { return height_; }
  int blocks() const { return blocks_; }  // blocks of the grid along x
  std::int64_t columns() const { return columns_; }
  std::int64_t token_bits() const { return std::int64_t{lanes_} * cell_bits_; }
  std::int64_t head_bits() const { return height_; }
  std::int64_t slot_bits() const { return up(head_bits() + height_ * token_bits()); }
  std::int64_t column_of(const Place& place) const {
    return std::int64_t{place.z} * blocks_ + place.x / lanes_;
  }
  // Returns the place of a lane of a token. `stored` tokens of the column are stored before it.
  std::int64_t at(std::int64_t stored, int lane) const {
    return head_bits() + stored * token_bits() + std::int64_t{lane} * cell_bits_;
  }
  static std::int64_t up(std::int64_t bits) { return (bits + kBurstBits - 1) / kBurstBits * kBurstBits; }

  void put(const Cell& cell, std::uint64_t* slot, std::int64_t at) const;
  Cell get(const std::uint64_t* slot, std::int64_t at) const;

 private:
  int lanes_, height_, blocks_, cell_bits_;
  std::int64_t columns_;
  KeptFields kept_;
  bool keeps_set_;
};

// The reader asks for the bits of so many columns before it needs them.
inline constexpr int kColumnsAhead = 8;

// Returns the memories that the reader and the writer need for the code. The reader holds the bits of columns
// ahead. The writer holds the bits of the present column, and the bursts in which they lie.
std::vector<BufferCost> reader_buffers(const CodeLayout& layout);
std::vector<BufferCost> writer_buffers(const CodeLayout& layout);

inline bool bit_of(const std::uint64_t* slot, std::int64_t at) {
  return (slot[at / 64] >> (at % 64) & 1) != 0;
}
inline void set_bit(std::uint64_t* slot, std::int64_t at, bool on) {
  const std::uint64_t bit = std::uint64_t{1} << (at % 64);
  slot[at / 64] = on ? slot[at / 64] | bit : slot[at / 64] & ~bit;
}

// Describes the columns that lie in the memory.
class StoredColumns {
 public:
  virtual ~StoredColumns() = default;
  virtual std::int64_t bits_of(std::int64_t column) const = 0;  // without the padding of the last burst
};

// Holds the slots of all columns.
class CodedState final : public StoredColumns {
 public:
  explicit CodedState(const CodeLayout& layout);

  const CodeLayout& layout() const { return layout_; }
  std::uint64_t* slot(std::int64_t column) { return words_.data() + slot_words_ * column; }
  const std::uint64_t* slot(std::int64_t column) const { return words_.data() + slot_words_ * column; }
  std::int64_t bits_of(std::int64_t column) const override;

  std::int64_t moved_bits() const;  // sum over all columns, in whole bursts

  // Does the host's part. `set` has the places that are set; null: none is.
  void store(const state::Volume& volume, const state::BitPlane* set = nullptr);
  // Reads a column back as the host does it.
  void load(const Shape& shape, const Place& place, state::Volume& volume,
            state::BitPlane* set = nullptr) const;

 private:
  CodeLayout layout_;
  std::int64_t slot_words_;
  std::vector<std::uint64_t> words_;
};

// Lets a planted fault spoil the code.
class CodeFault {
 public:
  virtual ~CodeFault() = default;
  // These are called while a column of a pass is written. `judged` tells if a token is air, `stored` where
  // the next stored one goes. `ended` comes when the column is complete.
  virtual void judged(std::int64_t pass, const Place& place, const Cell* lanes, bool& air) = 0;
  virtual void stored(std::int64_t pass, const Place& place, const Cell* lanes, std::int64_t& at) = 0;
  virtual void ended(std::int64_t pass, const Place& place, std::uint64_t* slot) = 0;
  // This is called while a column is read. It tells if the token is stored.
  virtual void found(std::int64_t pass, const Place& place, const std::uint64_t* slot, bool& stored) = 0;
};

// Puts the tokens of a column into its slot, one a cycle. Its bits are kept until the column is complete.
class ColumnWriter {
 public:
  explicit ColumnWriter(const CodeLayout& layout) : layout_(layout), head_(layout.height() / 64 + 1) {}

  // Takes a token with `cells` lanes in the grid.
  void put(const Cell* lanes, int cells, const Place& place, std::uint64_t* slot, CodeFault* fault,
           std::int64_t pass);
  std::int64_t bits() const { return layout_.at(stored_, 0); }  // size of the present column so far

 private:
  CodeLayout layout_;
  std::vector<std::uint64_t> head_;
  std::int64_t stored_ = 0;  // tokens of the present column
};

// Makes tokens of a column, one a cycle.
class ColumnReader {
 public:
  explicit ColumnReader(const CodeLayout& layout) : layout_(layout) {}

  // Returns how many bits of the slot must be there before the token at `place` can be made.
  std::int64_t needs(const Place& place, const std::uint64_t* slot) const {
    return layout_.at((place.y == 0 ? 0 : stored_) + (bit_of(slot, place.y) ? 1 : 0), 0);
  }
  std::int64_t used() const { return layout_.at(stored_, 0); }
  void get(Cell* lanes, int cells, const Place& place, const std::uint64_t* slot, CodeFault* fault,
           std::int64_t pass);

 private:
  CodeLayout layout_;
  std::int64_t stored_ = 0;  // tokens of the present column that have been taken
};

}  // namespace voxmelt::hwmodel
