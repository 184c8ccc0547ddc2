// What a scene uses, as far as it changes the inner loops: a kernel is compiled for each combination, and a
// scene runs the one that has what it needs and nothing else.
#pragma once

namespace voxmelt::simd {

struct GravityFeatures {
  bool hot;     // heat travels with liquid
  bool guided;  // walls hold, drops hang, or falling changes energy by beta or by the printed reading
};

struct SpreadFeatures {
  bool hot;
  bool eight;    // neighbours, else four
  bool thermal;  // shares by heat
  bool general;  // shares by pattern, the printed reading, or no `downhill`
};

struct HeatFeatures {
  bool latent;     // temperature is not heat
  bool radiation;  // of `exchange`
  bool air;        // of `exchange`
};

struct ViscousFeatures {
  bool hot;
  bool guided;  // walls hold, or drops hang
};

}  // namespace voxmelt::simd
