// Phase `heat` conducts (Eq. 1) among matter and from isothermal walls in one pass per neighbour distance. It
// then convects in liquid. Last come radiation received, exchange with air and glow, cell by cell.
#include "kernel/automaton/rule/heat.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Holds what a pass over a set of axes needs. Each pair of materials has a weight.
struct Pass {
  std::span<const rule::Offset> axes;
  std::int32_t weight;  // if there is one material
  rule::SolidMaterial::Weights rule::SolidMaterial::*weights;
  const rule::Parameters& parameters;

  std::int32_t weight_of(int a, int b) const {
    if (!parameters.has_materials()) return weight;
    return (parameters.materials[static_cast<std::size_t>(a)].*weights)[static_cast<std::size_t>(b)];
  }
};

// Makes one pass. Books the changes of the sum of amount x heat.
void conduct(const Pass& pass, std::uint32_t step, const rule::Materials& materials, const ActiveRows& rows,
             state::Volume& volume, state::Field<std::uint16_t>& next, state::HeatLedger& ledger) {
  const Cells cells(volume);
  const int parts = static_cast<int>(pass.axes.size());
  next = volume.heat;

  rows.for_each([&](int x, int y, int z) {
    if (!cells.matter(x, y, z)) return;
    const int material = cells.material(x, y, z);
    const std::int32_t own = materials.temperature(cells.heat(x, y, z), material);
    std::int32_t from_matter = 0, from_walls = 0;
    // The cell gains flux(temperature there, weight).
    const auto neighbour = [&](int nx, int ny, int nz, const auto& flux) {
      const bool wall = cells.isothermal(nx, ny, nz);
      if (!wall && !cells.matter(nx, ny, nz)) return;
      const int other = cells.material(nx, ny, nz);
      const std::int32_t weight = pass.weight_of(material, wall ? material : other);
      (wall ? from_walls : from_matter) += flux(materials.temperature(cells.heat(nx, ny, nz), other), weight);
    };
    for (int part = 0; part < parts; ++part) {
      const rule::Offset d = pass.axes[part];
      const std::int32_t offset = rule::dither(step, part, parts);
      neighbour(x + d.dx, y + d.dy, z + d.dz, [&](std::int32_t there, std::int32_t weight) {
        return rule::conducted(own, there, weight, offset);
      });
      neighbour(x - d.dx, y - d.dy, z - d.dz, [&](std::int32_t there, std::int32_t weight) {
        return -rule::conducted(there, own, weight, offset);
      });
    }
    const state::Slot i = cells.at(x, y, z);
    add(next[i], from_matter + from_walls);
    ledger.conducted += std::int64_t{from_matter} * volume.amount[i];
    ledger.walls += std::int64_t{from_walls} * volume.amount[i];
  });
  std::swap(volume.heat, next);
}

std::int64_t convect(std::int32_t weight, std::uint32_t step, const rule::Materials& materials,
                     const ActiveRows& rows, state::Volume& volume, state::Field<std::uint16_t>& next) {
  const Cells cells(volume);
  const std::int32_t offset = rule::dither(step);
  next = volume.heat;
  std::int64_t change = 0;

  const auto rising = [&](int x, int y, int z) {  // through the upper face of (x, y, z)
    if (!cells.liquid(x, y, z) || !cells.liquid(x, y + 1, z)) return 0;
    return rule::convected(materials.temperature(cells.heat(x, y, z), 0),
                           materials.temperature(cells.heat(x, y + 1, z), 0), weight, offset);
  };
  rows.for_each([&](int x, int y, int z) {
    if (!cells.liquid(x, y, z)) return;
    const std::int32_t gain = rising(x, y - 1, z) - rising(x, y, z);
    const state::Slot i = cells.at(x, y, z);
    add(next[i], gain);
    change += std::int64_t{gain} * volume.amount[i];
  });
  std::swap(volume.heat, next);
  return change;
}

int exposed_axes(const Cells& cells, int x, int y, int z) {
  int axes = 0;
  for (const rule::Offset d : rule::kFaceAxes)
    axes += cells.air(x + d.dx, y + d.dy, z + d.dz) || cells.air(x - d.dx, y - d.dy, z - d.dz);
  return axes;
}

void book_exchange(std::int64_t gain, state::HeatLedger& ledger) {
  (gain > 0 ? ledger.warmed : ledger.cooled) += gain > 0 ? gain : -gain;
}

}  // namespace

void Reference::heat(std::uint32_t step, const step::Irradiance* irradiance, Volume& volume, Ledger& ledger) {
  const rule::Heat& heat = parameters_.heat;
  if (!heat.enabled) return;
  const ActiveRows rows(volume);
  state::Field<std::uint16_t>& next = next_.heat;

  // Conduction goes first, with the nearest neighbours before the others.
  using Row = rule::SolidMaterial;
  const auto pass = [&](std::span<const rule::Offset> axes, std::int32_t weight, Row::Weights Row::*weights) {
    conduct({axes, weight, weights, parameters_}, step, materials_, rows, volume, next, ledger.heat);
  };
  pass(rule::kFaceAxes, heat.weight_face, &Row::weight_face);
  if (heat.neighbours >= 18) pass(rule::kEdgeAxes, heat.weight_edge, &Row::weight_edge);
  if (heat.neighbours >= 26) pass(rule::kCornerAxes, heat.weight_corner, &Row::weight_corner);

  if (heat.convection > 0)
    ledger.heat.convected += convect(heat.convection, step, materials_, rows, volume, next);

  // Radiation and air act on each cell alone.
  if (irradiance == nullptr && !heat.air) return;
  const Cells cells(volume);
  const std::int32_t offset = rule::dither(step);
  rows.for_each([&](int x, int y, int z) {
    if (!cells.matter(x, y, z)) return;
    const state::Slot i = cells.at(x, y, z);
    const std::int64_t amount = volume.amount[i];
    std::int32_t h = volume.heat[i];

    if (irradiance != nullptr && volume.solid.test(x, y, z)) {
      const std::int32_t gain = rule::radiated(h, (*irradiance)[i], offset);
      h += gain;
      ledger.heat.radiated += gain * amount;
    }
    if (const int axes = heat.air ? exposed_axes(cells, x, y, z) : 0; axes > 0) {
      const int material = cells.material(x, y, z);
      const std::int32_t exchange =
          parameters_.has_materials() ? parameters_.materials[static_cast<std::size_t>(material)].air_exchange
                                      : heat.air_exchange;
      const std::int32_t gain = rule::exchanged(h, materials_.temperature(h, material),
                                                heat.air_temperature[y], exchange, axes, offset);
      h += gain;
      book_exchange(gain * amount, ledger.heat);
      if (heat.air_glow > 0) {
        const std::int32_t glow =
            rule::glowed(h, materials_.temperature(h, material), heat.air_sky, heat.air_glow, axes, offset);
        h += glow;
        book_exchange(glow * amount, ledger.heat);
      }
    }
    volume.heat[i] = static_cast<std::uint16_t>(h);
  });
}

}  // namespace voxmelt::scalar
