// A state is written for other programs: one file per field, and the resolved parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::io {

// Is called now and then. Any exception from it ends the export.
using Poll = std::function<void()>;

// A number for each cell, in the order of Grid::index. Cells with `inside` or more are within a surface.
struct Lattice {
  const std::uint16_t* numbers = nullptr;  // null: the amounts of matter
  std::uint16_t inside = 2048;             // half of a full cell
};

// Is what a format writes. A state alone has books that begin with it.
struct Moment {
  Moment(const state::Volume& v) : volume(v) {}  // NOLINT: a volume is a moment
  const state::Volume& volume;
  const state::Ledger* ledger = nullptr;
  std::uint32_t step = 0;                        // steps done
  double seconds_per_step = 0;                   // of the steps before it
  const rule::Parameters* parameters = nullptr;  // null: they are not known
  std::string version, scene;                    // of the program, and the name of the scene; or empty
  Lattice surface;                               // what formats of meshes draw
};

// Describes a format for the fields of a state. `write` makes files in an existing folder, and throws
// OutputError.
struct Format {
  std::string_view name;         // name that users give
  std::string_view description;  // a few words
  void (*write)(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);
  bool of_surface = false;  // it is one of meshes
  std::string (*missing)() =
      nullptr;  // says what it lacks on this machine; nothing, or empty: it lacks nothing
};

std::span<const Format> formats();                 // all of them; the first one is the default
const Format* find_format(std::string_view name);  // null for an unknown name

// Writes the format `npy`: FIELD.npy, C order, axes (z, y, x), masks as u8, numbers as u16.
void export_npy(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll = {});

// Says what the files of these fields hold: axes, bits and units.
std::string fields_json(const state::Volume& volume);

// Is a number, a list, a table or a word, as text for VTK.
struct NamedValue {
  std::string name;  // its path in parameters.json: "flow.fall.factor"
  const char* type;  // "Int64", "Float64" or "String"
  std::size_t components = 1, tuples = 1;
  std::string text{};  // numbers; of a word the bytes, up to a 0
};
NamedValue named_word(std::string name, std::string_view word);
// Returns all that parameters_json has, but the grid and the step. A list of objects becomes a table for each
// of their members.
std::vector<NamedValue> named_values(const rule::Parameters& parameters);

// Returns everything that the rules depend on besides the state (docs/automaton.md, "Parameters").
std::string parameters_json(const rule::Parameters& parameters, state::Grid grid, std::uint32_t step);

}  // namespace voxmelt::io
