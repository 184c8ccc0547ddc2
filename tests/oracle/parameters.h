// The parameters are those that parameters.json names (docs/automaton.md section 14).
#pragma once
#include "arithmetic.h"
#include "material.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace oracle {

using Point = std::array<Int, 3>;  // x, y, z in sixteenths of a cell

struct Kind;  // kinds.h

struct Key {
  Int step = 0;
  Point at{};
  Int radius = 0;
  Point direction{};
  Int power = 0;
};

struct RadiationSource {
  const Kind* kind = nullptr;  // never null once it is read
  std::vector<Key> keys;
};

struct Region {
  Point at{};
  Int radius = 0;
  Int rate = 0;
  Int from = 0;
  Int until = 0;
  Int temperature = 0;  // vents only
  Int energy = 0;       // vents only
};

struct Heat {
  bool enabled = false;
  Int neighbours = 6;
  Int weight_face = 0, weight_edge = 0, weight_corner = 0;
  Int convection = 0;
  bool walls = false;  // the first state has an isothermal wall
  bool radiation = false;
  Int visibility_every = 1;
  Int rays_per_face = 1;
  std::vector<RadiationSource> sources;
  bool air = false;
  Int air_exchange = 0;
  std::vector<Int> air_temperature;
  Int air_glow = 0, air_sky = 0;
};

struct PiecesFall {
  bool fall = false;
  Int in_liquid = 1, density = 65536;
};

struct Fall {
  Int factor = 0, wall_factor = 0, minimum = 0, hang = 0;
};

struct PaperFlow {
  Int neighbours = 8;
  Int threshold = 0;
  bool use_table = false;
  std::vector<std::vector<Int>> table;
  Int share = 0;
  bool downhill = false;
  Int margin = 0;
  bool support = false;
  Int slump = 0;
  bool printed = false;  // the reading: `energy` is "printed", not "text"
  Int beta = 0;
  Int alpha_liquid = 0, alpha_solid = 0, alpha_floor = 0;
  Int reheat = 0;
};

struct ViscousFlow {
  Int mobility = 0, yield = 0, stiffness = 1;
  Int substeps = 1;  // 0: as many as the state needs, at most substeps_max
  Int substeps_max = 1;
  Int stages_max = 1;
};

struct Parameters {
  std::array<Int, 3> grid{};
  bool open_border = false;
  Int step = 0;
  std::uint64_t seed = 0;
  // One at least: without `materials` that of `material` and `heat` alone.
  std::vector<Material> materials;
  bool several_materials = false;  // the scene has `materials`
  Int top = 65535;                 // the highest temperature (section 6)
  Int freezing_point = 0;          // 0: nothing freezes
  PiecesFall pieces;
  Heat heat;
  std::vector<Region> vents, drains;
  bool paper_law = true;
  Fall fall;
  PaperFlow paper;
  ViscousFlow viscous;
  bool thermal_viscosity = false;
  std::vector<Int> mobility_table;                // the paper's law only
  Int mobility_reference = 0, mobility_rate = 0;  // the viscous law only
};

Parameters read_parameters(const std::string& path);

}  // namespace oracle
