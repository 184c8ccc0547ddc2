// The wires of a token are a table, with one row for each field of a cell. Widths of channels, words in
// memory, what the checker compares and what a waveform shows follow from this table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <type_traits>

#include "hwmodel/fabric/index_of.h"
#include "hwmodel/pipeline/model/cell.h"

namespace voxmelt::hwmodel {

// Names the wires, in the order of the table.
enum class Wire : std::uint8_t {
  state,
  amount,
  energy,
  heat,
  material,
  exposed_axes,
  pattern,
  beside_wall,
  touches,
  set,
  in_run,
  head,
  mobility,
  limit,
  dead,
  shut,
};

struct CellWire {
  Wire wire;
  std::string_view name;   // in a waveform
  std::string_view label;  // name for people
  int bits;                // at most; Stage::width_of says what a scene needs
  bool has_sign;
  bool in_memory;  // false: a side band, from the stage that makes it to the last that reads it
  std::int64_t (*get)(const Cell&);
  void (*set)(Cell&, std::int64_t);
};

template <class Field, class Of>
Field type_of(Field Of::*member);

template <auto Member>
constexpr CellWire cell_wire(Wire wire, std::string_view name, std::string_view label, bool in_memory) {
  using Field = decltype(type_of(Member));
  return {wire,
          name,
          label,
          Field::kBits,
          std::is_same_v<Field, SInt<Field::kBits>>,
          in_memory,
          [](const Cell& cell) { return static_cast<std::int64_t>(cell.*Member); },
          [](Cell& cell, std::int64_t value) { cell.*Member = value; }};
}

inline constexpr std::array kCellWires{
    CellWire{Wire::state, "state", "state", 2, false, true,
             [](const Cell& cell) { return static_cast<std::int64_t>(cell.state); },
             [](Cell& cell, std::int64_t value) { cell.state = static_cast<State>(value); }},
    cell_wire<&Cell::amount>(Wire::amount, "amount", "amount", true),
    cell_wire<&Cell::energy>(Wire::energy, "energy", "energy", true),          // under the paper's law
    cell_wire<&Cell::heat>(Wire::heat, "heat", "heat", true),                  // in scenes with heat
    cell_wire<&Cell::material>(Wire::material, "material", "material", true),  // where there are several
    // Each side band goes from the stage that makes it to those that read it:
    // conduction -> exchange
    cell_wire<&Cell::exposed_axes>(Wire::exposed_axes, "exposed_axes", "exposed axes", false),
    // pattern -> apply
    cell_wire<&Cell::pattern>(Wire::pattern, "pattern", "pattern", false),
    // conduction, walls or viscous spread -> gravity
    cell_wire<&Cell::beside_wall>(Wire::beside_wall, "beside_wall", "beside a wall", false),
    // conduction -> melt
    cell_wire<&Cell::touches>(Wire::touches, "touches", "touches", false),
    // melt -> gravity -> pattern, or melt -> settle -> viscous spread -> gravity. It shares the bits of the
    // state: what is not blocked is air or liquid by its amount, so the two codes of these tell if it is set.
    cell_wire<&Cell::set>(Wire::set, "set", "set", false),
    // settle -> viscous spread -> gravity
    cell_wire<&Cell::in_run>(Wire::in_run, "in_run", "in a run", false),
    // settle -> viscous spread
    cell_wire<&Cell::head>(Wire::head, "head", "head", false),
    cell_wire<&Cell::mobility>(Wire::mobility, "mobility", "mobility", false),
    cell_wire<&Cell::limit>(Wire::limit, "limit", "limit", false),
    cell_wire<&Cell::dead>(Wire::dead, "dead", "dead zone", false),
    cell_wire<&Cell::shut>(Wire::shut, "shut", "shut", false),
};
inline constexpr const CellWire& row_of(Wire wire) { return kCellWires[index_of(wire)]; }

constexpr bool wires_are_in_order() {
  for (std::size_t i = 0; i < kCellWires.size(); ++i)
    if (index_of(kCellWires[i].wire) != i) return false;
  return true;
}
static_assert(wires_are_in_order());

// A set of wires has one bit for each.
class Wires {
 public:
  constexpr Wires(std::initializer_list<Wire> wires = {}) {
    for (const Wire wire : wires) add(wire);
  }
  constexpr Wires& add(Wire wire, bool really = true) {
    if (really) bits_ |= 1u << index_of(wire);
    return *this;
  }
  constexpr bool has(Wire wire) const { return (bits_ >> index_of(wire) & 1u) != 0; }

 private:
  std::uint32_t bits_ = 0;
};

// Tells which fields a scene has, of those that not all scenes have.
struct KeptFields {
  bool energy, heat, material;
};

// Returns true if memory holds this field of a cell. Every channel carries it then, too.
constexpr bool is_in_memory(const CellWire& row, const KeptFields& kept) {
  if (row.wire == Wire::energy) return kept.energy;
  if (row.wire == Wire::heat) return kept.heat;
  if (row.wire == Wire::material) return kept.material;
  return row.in_memory;
}
constexpr int bits_in_memory(const KeptFields& kept) {
  int bits = 0;
  for (const CellWire& row : kCellWires) bits += is_in_memory(row, kept) ? row.bits : 0;
  return bits;
}

}  // namespace voxmelt::hwmodel
