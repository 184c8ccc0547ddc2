#include "accuracy/front/curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "accuracy/cells.h"

namespace voxmelt::accuracy::front {
namespace {

struct Sums {
  double liquid = 0, mass = 0, heat = 0, height = 0, square = 0;

  void add(const Scale& scale, int x, int y, int z, const Held& held) {
    const double dx = (x + 0.5) / scale.grid - scale.axis_x, dz = (z + 0.5) / scale.grid - scale.axis_z;
    mass += held.amount;
    if (!held.solid) liquid += held.amount;
    heat += held.amount * held.heat;
    height += held.amount * (y + 0.5 - scale.floor) / scale.grid;
    square += held.amount * (dx * dx + dz * dz);
  }
  Sample sample(const Scale& scale) const {
    const double cell = scale.grid * scale.grid * scale.grid;
    if (mass == 0) return {};
    return {liquid / cell, heat / cell, height / mass, std::sqrt(square / mass)};
  }
};

double error(const Curves& found, const Curves& reference, double Sample::*curve) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    difference += std::abs(found[i].*curve - reference[i].*curve);
    size += std::abs(reference[i].*curve);
  }
  return difference == 0 ? 0 : difference / size;
}

}  // namespace

Sample sample_of(const Twin& twin, const Scale& scale) {
  Sums sums;
  twin.for_each_matter([&](int x, int y, int z, const Held& held) { sums.add(scale, x, y, z, held); });
  return sums.sample(scale);
}

Sample sample_of(const state::Volume& volume, const Scale& scale) {
  Sums sums;
  for_each_cell(volume.grid, [&](int x, int y, int z) {
    const bool solid = volume.solid.test(x, y, z);
    if (!solid && !volume.liquid.test(x, y, z)) return;
    const state::Slot i = volume.at(x, y, z);
    sums.add(scale, x, y, z,
             {solid, volume.amount[i] / kOne, volume.energy[i] / kOne, volume.heat[i] / (kHottest + 1)});
  });
  return sums.sample(scale);
}

double Errors::largest() const { return std::max({liquid, heat, height, radius}); }

Errors errors(const Curves& found, const Curves& reference) {
  if (found.size() != reference.size())
    throw std::invalid_argument("curves of different lengths cannot be compared");
  return {error(found, reference, &Sample::liquid), error(found, reference, &Sample::heat),
          error(found, reference, &Sample::height), error(found, reference, &Sample::radius)};
}

}  // namespace voxmelt::accuracy::front
