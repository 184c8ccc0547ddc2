// Each table of a scene file that becomes rule parameters is checked, then rounded to the automaton's
// integers. All functions throw InputError. `warnings` grows by things that are odd but usable.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

rule::Material read_material(Reader& root);  // [material]
rule::Pieces read_pieces(Reader& root);      // [pieces]
// Reads [[materials]]. The rows begin with that of [material]; there are none if the scene has no others. The
// names begin with "". It needs the other tables to be read.
struct Palette {
  std::vector<std::string> names;
  std::vector<std::optional<std::array<double, 3>>> colors;  // none: as [look] says
  std::vector<rule::SolidMaterial> rows;
};
Palette read_palette(Reader& root, const rule::Material& material, const rule::Heat& heat);
// Reads [heat], [heat.air] and [[heat_source]].
rule::Heat read_heat(Reader& root, int ny, std::vector<std::string>& warnings);
std::vector<rule::HeatSource> read_heat_sources(Reader& root);  // [[heat_source]] alone
std::vector<rule::Vent> read_vents(Reader& root);               // [[vent]]
std::vector<rule::Drain> read_drains(Reader& root);             // [[drain]]
rule::Region read_region(Reader& table);                        // at, radius
rule::Temperature read_temperature(Reader& table);              // of what a vent brings
// Reads [flow] and its tables.
rule::Flow read_flow(Reader& root, std::vector<std::string>& warnings);

}  // namespace voxmelt::scene
