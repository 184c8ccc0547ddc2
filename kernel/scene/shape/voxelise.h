// Shapes, meshes and terrain become the cells of the initial state.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/shape/coverage.h"
#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/shape/shape.h"
#include "kernel/scene/shape/terrain.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {

enum class Role { solid, liquid, inert };

struct Entry {
  Role role = Role::solid;
  std::string name;                  // "solid.0"
  bool cut = false;                  // taken away from what its list has built so far
  ShapePtr shape;                    // null if the mesh or the coverage is used
  std::optional<Coverage> coverage;  // of a volume
  Mesh mesh;                         // in place in the grid
  Inside inside = Inside::winding;
  std::string mesh_file;
  int material = 0;               // solid: its number in the palette
  double temperature = 0;         // 0..1
  rule::Temperature wall = 0;     // inert: heat content as an isothermal wall; 0: no such wall
  double amount = 1, energy = 1;  // liquid: of a fully covered cell
};

struct Contents {
  std::vector<Entry> entries;
  std::vector<rule::SolidMaterial> materials;  // none: solids are of one
  rule::Temperature ground_wall = 0;           // heat content of the terrain as an isothermal wall; 0: none
  Terrain terrain;                             // floors and height fields; always nx x nz columns
};

// Returns the cells. They are solid from coverage 1/16 on (amount = coverage), and inert from 1/2 on. Inert
// wins over solid, and solid over liquid. The top inert cell of a terrain column holds the height's fraction:
// kBedHalf + (h - round(h)) x kOne, and the top cell of an inert shape what its coverage says. An inert shape
// keeps its temperature inside the ground. A solid is of the material of the last shape that covers at least
// half of what is solid in it.
state::Volume voxelise(const Contents& contents, state::Grid grid, std::vector<std::string>& warnings);

}  // namespace voxmelt::scene
