#include "measure/baseline/numbers.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace voxmelt::baseline {
namespace {

template <class Real>
Real fraction(std::uint32_t sixteen_bits) {
  return static_cast<Real>(sixteen_bits) / 65536;
}
template <class Real>
Real cells(std::uint32_t amount) {
  return static_cast<Real>(amount) / rule::kOne;
}
template <class Real>
Real degrees(std::uint32_t temperature) {
  return static_cast<Real>(temperature) / rule::kTemperatureMax;
}

template <class Real>
void take_heat(const rule::Parameters& parameters, Numbers<Real>& n) {
  const rule::Heat& heat = parameters.heat;
  n.heat = heat.enabled;
  n.neighbours = heat.neighbours;
  n.face = fraction<Real>(heat.weight_face);
  n.edge = fraction<Real>(heat.weight_edge);
  n.corner = fraction<Real>(heat.weight_corner);
  n.convection = fraction<Real>(heat.convection);
  n.air = heat.air;
  for (std::size_t axes = 0; axes < 4; ++axes)
    n.air_exchange[axes] = fraction<Real>(heat.air_exchange) * std::sqrt(static_cast<Real>(axes));
  for (const rule::Temperature t : heat.air_temperature) n.air_temperature.push_back(degrees<Real>(t));
  n.melting_point = degrees<Real>(parameters.material.melting_point);
  n.reheat = fraction<Real>(parameters.flow.paper.reheat);
}

template <class Real>
void take_spread(const rule::Flow& flow, Numbers<Real>& n) {
  const rule::PaperLaw& law = flow.paper;
  n.directions = law.neighbours;
  n.share = law.use_table ? 0 : fraction<Real>(law.share);
  for (std::size_t pattern = 0; pattern < 256; ++pattern)
    for (std::size_t d = 0; d < 8; ++d) {
      if (!(pattern >> d & 1u)) continue;
      if (law.use_table)
        n.factors[pattern][d] = d < 4 ? fraction<Real>(law.table[pattern & 15u][d]) : 0;
      else
        n.factors[pattern][d] = d < 4 ? n.share : n.share / 4;
    }
  n.threshold = cells<Real>(law.threshold);
  n.margin = cells<Real>(law.margin);
  n.slump = cells<Real>(law.slump);
  n.downhill = law.downhill;
  n.support = law.support;
  n.alpha_liquid = fraction<Real>(law.alpha_liquid);
  n.alpha_solid = fraction<Real>(law.alpha_solid);
  n.alpha_floor = fraction<Real>(law.alpha_floor);
  n.thermal_viscosity = flow.thermal_viscosity && !law.use_table;
  for (std::size_t k = 0; k < n.mobility.size(); ++k)
    n.mobility[k] = static_cast<Real>(flow.mobility_table[k]) / 32768;
  n.mobility_limit = n.share > 0 ? static_cast<Real>(law.neighbours == 8 ? 0.2 : 0.25) / n.share : 1;
}

}  // namespace

template <class Real>
Numbers<Real> numbers_of(const rule::Parameters& parameters) {
  const rule::Flow& flow = parameters.flow;
  if (flow.law != rule::Law::paper || flow.paper.reading != rule::EnergyReading::text ||
      (parameters.heat.enabled && parameters.material.latent_heat > 0))
    throw std::invalid_argument("the baseline runs the paper's law, reading `text`, without latent heat");

  Numbers<Real> n;
  take_heat(parameters, n);
  n.factor = fraction<Real>(flow.fall.factor);
  n.wall_factor = fraction<Real>(flow.fall.wall_factor);
  n.minimum = cells<Real>(flow.fall.minimum);
  n.hang = cells<Real>(flow.fall.hang);
  n.beta = fraction<Real>(flow.paper.beta);
  take_spread(flow, n);
  n.seed = static_cast<std::uint32_t>(parameters.seed ^ parameters.seed >> 32);
  return n;
}

template Numbers<float> numbers_of(const rule::Parameters&);
template Numbers<double> numbers_of(const rule::Parameters&);

}  // namespace voxmelt::baseline
