/// @file
/// The state of a volume is read in place, through views of masks and of fields of numbers, without a copy.
///
/// The x axis is fastest, y points up (gravity acts along -y), z is outermost. Rows are contiguous. Padding
/// lies between rows and slices, so a whole field is not one span. docs/automaton.md, section 1, defines all
/// values.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace voxmelt {

/// Gives the size of a volume in cells, each 1..4096.
struct Grid {
  int x = 0;  ///< cells along x, the fastest axis
  int y = 0;  ///< cells along y, upwards
  int z = 0;  ///< cells along z, the outermost axis

  /// Returns the number of cells, x * y * z.
  std::size_t cells() const { return static_cast<std::size_t>(x) * y * z; }
  friend bool operator==(const Grid&, const Grid&) = default;  ///< all three sides are equal
};

/// Shows one unsigned number per cell. Coordinates are not checked: 0 <= x < grid.x, and so on.
template <class Number>
class NumberView {
 public:
  /// Takes strides in numbers: `row` from (x, y, z) to (x, y + 1, z), and `slice` to (x, y, z + 1).
  NumberView(const Number* data, Grid grid, std::size_t row, std::size_t slice)
      : data_(data), grid_(grid), row_(row), slice_(slice) {}

  /// Returns the grid.x numbers of one row, contiguous.
  std::span<const Number> row(int y, int z) const {
    return {data_ + z * slice_ + y * row_, static_cast<std::size_t>(grid_.x)};
  }
  /// Returns the number of one cell.
  Number at(int x, int y, int z) const { return row(y, z)[static_cast<std::size_t>(x)]; }

  const Number* data() const { return data_; }         ///< address of the cell (0, 0, 0)
  std::size_t row_stride() const { return row_; }      ///< numbers from a row to the next along y
  std::size_t slice_stride() const { return slice_; }  ///< numbers from a row to the next along z
  Grid grid() const { return grid_; }                  ///< the size of the volume

 private:
  const Number* data_;
  Grid grid_;
  std::size_t row_, slice_;
};

/// Shows 16 bits per cell: amount, energy or heat.
using FieldView = NumberView<std::uint16_t>;
/// Shows 8 bits per cell.
using ByteView = NumberView<std::uint8_t>;

/// Shows one bit per cell, 64 cells to a word along x. Coordinates are not checked: 0 <= x < grid.x, and so
/// on.
class MaskView {
 public:
  /// Takes the words of all rows, one row after another, rows along y first. Each row begins a new word.
  MaskView(const std::uint64_t* data, Grid grid) : data_(data), grid_(grid) {}

  /// Returns the words of one row. Bit b of word w is the cell x = 64 w + b. Bits beyond the grid are 0.
  std::span<const std::uint64_t> row(int y, int z) const {
    const std::size_t words = (static_cast<std::size_t>(grid_.x) + 63) / 64;
    return {data_ + (static_cast<std::size_t>(z) * grid_.y + y) * words, words};
  }
  /// Tells if the bit of this cell is set.
  bool test(int x, int y, int z) const {
    return (row(y, z)[static_cast<std::size_t>(x) / 64] >> (x & 63)) & 1;
  }

  /// Counts the cells whose bit is set, in a pass over the mask.
  std::size_t count() const {
    std::size_t total = 0;
    for (int z = 0; z < grid_.z; ++z)
      for (int y = 0; y < grid_.y; ++y)
        for (const std::uint64_t word : row(y, z)) total += std::popcount(word);
    return total;
  }
  Grid grid() const { return grid_; }  ///< the size of the volume

 private:
  const std::uint64_t* data_;
  Grid grid_;
};

/// Gives one field of a state by its name, for programs that go over all of them.
struct NamedField {
  std::string_view name;  ///< "solid", "amount", ...: as in the files of an export
  std::string_view unit;  ///< unit of its numbers; empty for a mask
  std::variant<MaskView, ByteView, FieldView> cells;  ///< view of its width: 1, 8 or 16 bits

  /// Returns the number of one cell. In a mask it is 0 or 1.
  std::uint32_t at(int x, int y, int z) const {
    if (const auto* mask = std::get_if<MaskView>(&cells)) return mask->test(x, y, z);
    if (const auto* bytes = std::get_if<ByteView>(&cells)) return bytes->at(x, y, z);
    return std::get<FieldView>(cells).at(x, y, z);
  }
};

/// Shows everything that the automaton knows of a volume. The views point into a Simulation. They are valid
/// until it steps, is moved from or ends. At most one of the three masks is set in a cell.
struct State {
  Grid grid;        ///< size of everything below
  MaskView solid;   ///< meltable solid
  MaskView liquid;  ///< exactly the cells that are neither solid nor inert and hold an amount
  MaskView inert;   ///< floor and terrain, which never melt and never move
  /// Holds UQ4.12 numbers: 4096 is a full cell, 65535 the most. In an inert cell the number is no mass but
  /// the height of the bed. The surface lies (amount - 2048) / 4096 cells above the cell's upper face.
  FieldView amount;
  /// Holds the potential of liquid to expand: UQ4.12, at most the amount. It is 0 everywhere under the
  /// viscous law.
  FieldView energy;
  /// Holds heat contents: 0..65535 for 0..1 of the scene's range of temperatures, latent heat included
  /// (section 6). They are 0 in air, in inert cells that are no isothermal wall, and in scenes without
  /// [heat].
  FieldView heat;
  /// Lists the same fields again, and those that only some scenes have, in the order of an export.
  std::vector<NamedField> fields;
};

}  // namespace voxmelt
