// Each field of a state has a row in this table. Code that merely carries a state goes over the table:
// equality, digest, files, checkpoints, views, comparisons. Rules and engines name the fields that they
// compute with.
//
// A new field is a member of Volume and a row here. It may be as wide as the others or narrower. A mask is a
// BitPlane, and a number of 8 bits a Field<std::uint8_t>.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

struct FieldInfo {
  std::string_view name;     // in files, blocks, views and messages; at most 8 letters
  int bits = 0;              // per cell: 1 for a mask, else 8 or 16
  std::string_view unit{};   // unit of a number
  int digest_bit = 0;        // lowest of its bits in a cell's word of the digest
  std::uint32_t border = 0;  // value of a cell outside the grid
  // Tells which scenes have the field. Null stands for all. In the others it is 0 everywhere, and `missing`
  // says why.
  bool (*present)(const rule::Parameters&) = nullptr;
  std::string_view missing{};
  // An optional field has address space, and a place in files, only in a volume of a scene that has it, or
  // whose start.fields had it. Empty pages of the other fields take no memory.
  bool optional = false;
};

template <auto kColumn>
struct FieldRow : FieldInfo {
  static constexpr auto column = kColumn;  // the member: volume.*row.column
};

namespace field {
inline constexpr bool has_energy(const rule::Parameters& p) { return p.flow.law == rule::Law::paper; }
inline constexpr bool has_heat(const rule::Parameters& p) { return p.heat.enabled; }
inline constexpr bool has_materials(const rule::Parameters& p) { return p.has_materials(); }
}  // namespace field

// The rows are in the order of files.
inline constexpr std::tuple kFields{
    FieldRow<&Volume::solid>{{.name = "solid", .bits = 1, .digest_bit = 48}},
    FieldRow<&Volume::liquid>{{.name = "liquid", .bits = 1, .digest_bit = 49}},
    FieldRow<&Volume::inert>{{.name = "inert", .bits = 1, .digest_bit = 50, .border = 1}},
    FieldRow<&Volume::amount>{{.name = "amount",
                               .bits = 16,
                               .unit = "1/4096 of a full cell",
                               .digest_bit = 0,
                               .border = rule::kBedHalf}},
    FieldRow<&Volume::energy>{{.name = "energy",
                               .bits = 16,
                               .unit = "1/4096 of a full cell",
                               .digest_bit = 16,
                               .present = field::has_energy,
                               .missing = "the viscous law has no energy"}},
    FieldRow<&Volume::heat>{{.name = "heat",
                             .bits = 16,
                             .unit = "1/65535 of the scene's range",
                             .digest_bit = 32,
                             .present = field::has_heat,
                             .missing = "the scene has no [heat]"}},
    FieldRow<&Volume::material>{{.name = "material",
                                 .bits = 8,
                                 .unit = "number of the solid's material",
                                 .digest_bit = 51,
                                 .present = field::has_materials,
                                 .missing = "the scene has no [[materials]]",
                                 .optional = true}},
};

// Calls visit(row) for every field, in the order of the table.
template <class Visit>
constexpr void for_each_field(const Visit& visit) {
  std::apply([&](const auto&... row) { (visit(row), ...); }, kFields);
}

// Returns the number of a cell, whatever the width. The field must not be empty.
inline std::uint32_t value_at(const BitPlane& plane, int x, int y, int z) { return plane.test(x, y, z); }
template <class T>
std::uint32_t value_at(const Field<T>& field, int x, int y, int z) {
  return field[field.layout().at(x, y, z)];
}

// Sets the number, and leaves memory alone if the cell has it already. So empty pages stay without memory.
inline void set_value(BitPlane& plane, int x, int y, int z, std::uint32_t value) {
  if (value_at(plane, x, y, z) != value) plane.set(x, y, z, value != 0);
}
template <class T>
void set_value(Field<T>& field, int x, int y, int z, std::uint32_t value) {
  T& cell = field[field.layout().at(x, y, z)];
  if (cell != value) cell = static_cast<T>(value);
}

// Copies all fields of a volume of the same size. The record of the changes of `to` stays as it is.
void copy_fields(const Volume& from, Volume& to);

}  // namespace voxmelt::state
