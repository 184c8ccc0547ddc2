#include "kernel/run/io/columns.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::io {
namespace {

void append_row(std::string& rows, const state::BitPlane& plane, int y, int z, std::size_t width) {
  const std::size_t first = rows.size();
  rows.resize(first + width);
  const auto words = plane.row(y, z);
  for (std::size_t w = 0; w < words.size(); ++w)
    for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
      rows[first + 64 * w + std::countr_zero(left)] = 1;
}
template <class T>
void append_row(std::string& rows, const state::Field<T>& field, int y, int z, std::size_t width) {
  rows.append(reinterpret_cast<const char*>(field.row(y, z)), width * sizeof(T));
}

}  // namespace

std::vector<Column> columns_of(const state::Volume& volume) {
  const std::size_t width = volume.grid.x;
  std::vector<Column> columns;
  state::for_each_field([&](const auto& row) {
    const auto& cells = volume.*row.column;
    if (cells.empty()) return;
    const bool wide = row.bits > 8;
    columns.push_back(
        {std::string(row.name), wide ? "<u2" : "|u1", wide ? "UInt16" : "UInt8",
         wide ? std::size_t{2} : std::size_t{1},
         [&cells, width](std::string& rows, int y, int z) { append_row(rows, cells, y, z, width); }});
  });
  return columns;
}

void for_each_piece(const Column& column, state::Grid g, const Poll& poll,
                    const std::function<void(std::string_view)>& take) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  std::string rows;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      column.append_row(rows, y, z);
      if (rows.size() < piece) continue;
      take(rows);
      rows.clear();
      if (poll) poll();
    }
  take(rows);
}

std::string npy_header(const Column& column, state::Grid g) {
  std::string text = std::string("{'descr': '") + column.npy_type + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(g.z) + ", " + std::to_string(g.y) + ", " + std::to_string(g.x) + "), }";
  constexpr std::size_t preamble = 10;  // magic, version, header length
  text.append(63 - (preamble + text.size()) % 64, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(text.size() & 0xFF);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace voxmelt::io
