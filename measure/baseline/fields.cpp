// The functions here build the fields and read them. None of this is timed.
#include "measure/baseline/fields.h"

#include <algorithm>

namespace voxmelt::baseline {
namespace {

// Calls visit(x, y, z, slot), x fastest. This is the only place that knows the layout of the kernel's fields.
template <class Visit>
void for_each_slot(const state::Grid& grid, Visit&& visit) {
  const state::Layout layout(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) visit(x, y, z, layout.at(x, y, z));
}

}  // namespace

template <class Real>
Fields<Real>::Fields(const state::Volume& volume)
    : grid(volume.grid),
      row(static_cast<std::size_t>(grid.x) + 2),
      slice(row * (static_cast<std::size_t>(grid.y) + 2)) {
  const std::size_t cells = slice * (static_cast<std::size_t>(grid.z) + 2);
  for (auto* field :
       {&amount, &energy, &temperature, &next_temperature, &amount_gain, &energy_gain, &heat_gain})
    field->assign(cells, 0);
  for (auto* flags : {&solid, &liquid, &pattern, &intensity, &filtered}) flags->assign(cells, 0);
  inert.assign(cells, 1);  // the border stays inert
  row_marks.assign(cells / row, 0);

  for_each_slot(volume.grid, [&](int x, int y, int z, state::Slot slot) {
    Cell<Real> c;
    c.solid = volume.solid.test(x, y, z);
    c.liquid = volume.liquid.test(x, y, z);
    c.inert = volume.inert.test(x, y, z);
    if (!c.inert) {  // an inert cell's number is the height of the bed, no amount
      c.amount = static_cast<Real>(volume.amount[slot]) / 4096;
      c.energy = static_cast<Real>(volume.energy[slot]) / 4096;
      c.temperature = static_cast<Real>(volume.heat[slot]) / 65535;
    }
    set_cell(x, y, z, c);
  });
}

template <class Real>
Fields<Real>::~Fields() = default;

template <class Real>
Cell<Real> Fields<Real>::cell(int x, int y, int z) const {
  const std::size_t i = at(x, y, z);
  return {amount[i], energy[i], temperature[i], solid[i] != 0, liquid[i] != 0, inert[i] != 0};
}

template <class Real>
void Fields<Real>::set_cell(int x, int y, int z, const Cell<Real>& cell) {
  const std::size_t i = at(x, y, z);
  amount[i] = cell.amount;
  energy[i] = cell.energy;
  temperature[i] = cell.temperature;
  solid[i] = cell.solid;
  liquid[i] = cell.liquid;
  inert[i] = cell.inert;
}

template <class Real>
double Fields<Real>::total(const std::vector<Real>& field) const {
  double sum = 0;
  for (const Real value : field) sum += value;
  return sum;
}

template <class Real>
std::int64_t Fields<Real>::liquid_cells() const {
  return std::count(liquid.begin(), liquid.end(), std::uint8_t{1});
}

template <class Real>
std::vector<Real> irradiance_of(const state::Grid& grid, const state::Field<std::uint16_t>& irradiance) {
  std::vector<Real> result;
  result.reserve(grid.cells());
  for_each_slot(grid, [&](int, int, int, state::Slot slot) {
    result.push_back(static_cast<Real>(irradiance[slot]) / (16 * 65535));
  });
  return result;
}

template struct Fields<float>;
template struct Fields<double>;
template std::vector<float> irradiance_of(const state::Grid&, const state::Field<std::uint16_t>&);
template std::vector<double> irradiance_of(const state::Grid&, const state::Field<std::uint16_t>&);

}  // namespace voxmelt::baseline
