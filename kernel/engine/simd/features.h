// The features of a scene are those that change the inner loops. A kernel is compiled for each combination,
// and a scene runs the one that has the features it needs and nothing else.
#pragma once

namespace voxmelt::simd {

struct GravityFeatures {
  bool hot;     // heat travels with liquid
  bool guided;  // walls hold, drops hang, or falling changes energy (beta, printed reading)
};

struct SpreadFeatures {
  bool hot;
  bool eight;    // eight neighbours, else four
  bool thermal;  // shares by heat
  bool general;  // shares by pattern, the printed reading, or no `downhill`
  bool support;  // for `pattern`: a cell that stands on nothing gives nothing
};

struct HeatFeatures {
  bool latent;           // temperature is not heat
  bool radiation;        // used by `exchange`
  bool air;              // used by `exchange`
  bool palette = false;  // solids are of several materials
};

struct MeltFeatures {
  bool paper;    // fresh liquid gets energy
  bool freezes;  // cold liquid freezes, or is set
  bool palette;  // solids are of several materials
};

struct ViscousFeatures {
  bool hot;
  bool guided;           // walls hold, or drops hang
  bool relaxed = false;  // heads relax; used by `exchange_pairs`
};

// Tells what this build can do. It is everything, unless the CMake option VOXMELT_WITHOUT leaves features out
// to measure their price (bench/feature_cost.py). A scene that uses a missing feature runs wrongly there.
#ifndef VOXMELT_WITHOUT
#define VOXMELT_WITHOUT
#endif
struct Built {
  bool heat = true, latent = true, materials = true, freezing = true, walls = true, radiation = true,
       air = true, convection = true, edges = true, corners = true;
  bool viscous = true, guided = true, thermal = true;                              // for both laws
  bool eight = true, general = true, support = true, slump = true, reheat = true;  // for the paper's law
};
constexpr Built kBuilt{VOXMELT_WITHOUT};

}  // namespace voxmelt::simd
