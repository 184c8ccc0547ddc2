// The baseline takes the parameters of a scene as real numbers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::baseline {

template <class Real>
struct Numbers {
  // Heat takes these numbers.
  bool heat = false;
  int neighbours = 6;                   // neighbours of Eq. 1
  Real face = 0, edge = 0, corner = 0;  // gamma / (pi l^2)
  Real convection = 0;                  // share of the difference that rises in liquid
  bool air = false;                     // exchange with air of a temperature per height
  std::array<Real, 4> air_exchange{};   // indexed by the number of axes on which a cell touches air
  std::vector<Real> air_temperature;    // one per y
  Real melting_point = 0, reheat = 0;

  // Gravity takes these numbers.
  Real factor = 1, wall_factor = 1, minimum = 0, hang = 0, beta = 1;

  // Spreading takes these numbers.
  int directions = 8;
  std::array<std::array<Real, 8>, 256> factors{};  // [pattern][direction]: factor1, 2, ... of Eqs. 11-20
  Real share = 0;                                  // share of a face neighbour, 0 if the factors are a table
  Real threshold = 0, margin = 0, slump = 0;
  bool downhill = true, support = false;
  Real alpha_liquid = 1, alpha_solid = 1, alpha_floor = 1;
  bool thermal_viscosity = false;
  std::array<Real, 32> mobility{};  // indexed by temperature
  Real mobility_limit = 0;          // above it a cell could give more than it has

  std::uint32_t seed = 0;
};

// Throws std::invalid_argument for what the baseline leaves out: the viscous law, the printed reading of the
// energy equations, latent heat.
template <class Real>
Numbers<Real> numbers_of(const rule::Parameters& parameters);

}  // namespace voxmelt::baseline
