// A state written for other programs: one file per field, and the resolved parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::io {

// Called now and then; what it throws ends the export.
using Poll = std::function<void()>;

// solid, liquid, inert as u8 and amount, energy, heat as u16: FIELD.npy, C order, axes (z, y, x).
void export_npy(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll = {});

// The same fields as cell data of one VTK image: volume.vti (raw appended, little endian).
void export_vti(const state::Volume& volume, const std::filesystem::path& folder, const Poll& poll = {});

// Everything that the rules depend on besides the state (docs/automaton.md, "Parameters").
std::string parameters_json(const rule::Parameters& parameters, state::Grid grid, std::uint32_t step);

}  // namespace voxmelt::io
