// Phase `heat` conducts (Eq. 1) among matter and from isothermal walls in one pass per neighbour distance. It
// then convects in liquid. Last come radiation received, exchange with air and glow, cell by cell.
#include "kernel/automaton/rule/heat.h"

#include <cstdint>
#include <span>
#include <utility>

#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Makes one pass over a set of axes. Books the changes of the sum of amount x heat.
void conduct(std::span<const rule::Offset> axes, std::int32_t weight, std::uint32_t step,
             const rule::Material& material, const ActiveRows& rows, state::Volume& volume,
             state::Field<std::uint16_t>& next, state::HeatLedger& ledger) {
  const Cells cells(volume);
  const int parts = static_cast<int>(axes.size());
  next = volume.heat;

  rows.for_each([&](int x, int y, int z) {
    if (!cells.matter(x, y, z)) return;
    const std::int32_t own = rule::temperature_of(cells.heat(x, y, z), material);
    std::int32_t from_matter = 0, from_walls = 0;
    // The cell gains flux(temperature there).
    const auto neighbour = [&](int nx, int ny, int nz, const auto& flux) {
      const bool wall = cells.isothermal(nx, ny, nz);
      if (!wall && !cells.matter(nx, ny, nz)) return;
      (wall ? from_walls : from_matter) += flux(rule::temperature_of(cells.heat(nx, ny, nz), material));
    };
    for (int part = 0; part < parts; ++part) {
      const rule::Offset d = axes[part];
      const std::int32_t offset = rule::dither(step, part, parts);
      neighbour(x + d.dx, y + d.dy, z + d.dz,
                [&](std::int32_t there) { return rule::conducted(own, there, weight, offset); });
      neighbour(x - d.dx, y - d.dy, z - d.dz,
                [&](std::int32_t there) { return -rule::conducted(there, own, weight, offset); });
    }
    const state::Slot i = cells.at(x, y, z);
    add(next[i], from_matter + from_walls);
    ledger.conducted += std::int64_t{from_matter} * volume.amount[i];
    ledger.walls += std::int64_t{from_walls} * volume.amount[i];
  });
  std::swap(volume.heat, next);
}

std::int64_t convect(std::int32_t weight, std::uint32_t step, const rule::Material& material,
                     const ActiveRows& rows, state::Volume& volume, state::Field<std::uint16_t>& next) {
  const Cells cells(volume);
  const std::int32_t offset = rule::dither(step);
  next = volume.heat;
  std::int64_t change = 0;

  const auto rising = [&](int x, int y, int z) {  // through the upper face of (x, y, z)
    if (!cells.liquid(x, y, z) || !cells.liquid(x, y + 1, z)) return 0;
    return rule::convected(rule::temperature_of(cells.heat(x, y, z), material),
                           rule::temperature_of(cells.heat(x, y + 1, z), material), weight, offset);
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
  const rule::Material& material = parameters_.material;
  if (!heat.enabled) return;
  const ActiveRows rows(volume);
  state::Field<std::uint16_t>& next = next_.heat;

  // Conduction goes first, with the nearest neighbours before the others.
  const auto pass = [&](std::span<const rule::Offset> axes, std::int32_t weight) {
    conduct(axes, weight, step, material, rows, volume, next, ledger.heat);
  };
  pass(rule::kFaceAxes, heat.weight_face);
  if (heat.neighbours >= 18) pass(rule::kEdgeAxes, heat.weight_edge);
  if (heat.neighbours >= 26) pass(rule::kCornerAxes, heat.weight_corner);

  if (heat.convection > 0)
    ledger.heat.convected += convect(heat.convection, step, material, rows, volume, next);

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
      const std::int32_t gain =
          rule::exchanged(h, heat.air_temperature[y], heat.air_exchange, axes, offset, material);
      h += gain;
      book_exchange(gain * amount, ledger.heat);
      if (heat.air_glow > 0) {
        const std::int32_t glow = rule::glowed(h, heat.air_sky, heat.air_glow, axes, offset, material);
        h += glow;
        book_exchange(glow * amount, ledger.heat);
      }
    }
    volume.heat[i] = static_cast<std::uint16_t>(h);
  });
}

}  // namespace voxmelt::scalar
