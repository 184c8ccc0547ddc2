// A state written for other programs: one file per field, and the resolved parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::io {

// Called now and then; what it throws ends the export.
using Poll = std::function<void()>;

// What the fields of a state can be written as. `write` makes files in a folder that is there; it throws
// OutputError.
struct Format {
  std::string_view name;         // as users give it
  std::string_view description;  // a few words
  void (*write)(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll);
};

std::span<const Format> formats();                 // all of them; the first one is what nobody asked for
const Format* find_format(std::string_view name);  // null for an unknown name

// The format `npy`: FIELD.npy, C order, axes (z, y, x); masks as u8, numbers as u16.
void export_npy(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll = {});

// What the files of these fields hold: axes, bits and units.
std::string fields_json(const state::Volume& volume);

// Everything that the rules depend on besides the state (docs/automaton.md, "Parameters").
std::string parameters_json(const rule::Parameters& parameters, state::Grid grid, std::uint32_t step);

}  // namespace voxmelt::io
