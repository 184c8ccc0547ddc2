#include "accuracy/measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "accuracy/cells.h"

namespace voxmelt::accuracy {

Columns::Columns(const state::Volume& volume)
    : nx(volume.grid.x), nz(volume.grid.z), depth(static_cast<std::size_t>(nx) * nz) {
  for_each_cell(volume.grid, [&](int x, int y, int z) {
    if (volume.liquid.test(x, y, z)) depth[z * nx + x] += volume.amount[volume.at(x, y, z)] / kOne;
  });
}

Moments moments(const Columns& columns) {
  double sum = 0, sum_x = 0, sum_z = 0, sum_r2 = 0, sum_r4 = 0, four = 0;
  for (int z = 0; z < columns.nz; ++z)
    for (int x = 0; x < columns.nx; ++x) {
      const double h = columns.at(x, z), dx = columns.x_of(x), dz = columns.z_of(z), r2 = dx * dx + dz * dz;
      sum += h;
      sum_x += h * dx;
      sum_z += h * dz;
      sum_r2 += h * r2;
      sum_r4 += h * r2 * r2;
      four += h * (r2 * r2 - 8 * dx * dx * dz * dz);
    }
  return {sum, sum_x / sum, sum_z / sum, std::sqrt(sum_r2 / sum), 1 + 2.0 / 3 * four / sum_r4};
}

double wet_radius(const Columns& columns, double depth) {
  const auto wet =
      std::count_if(columns.depth.begin(), columns.depth.end(), [depth](double h) { return h >= depth; });
  return std::sqrt(static_cast<double>(wet) / std::numbers::pi);
}

double profile_error(const Columns& columns, const std::function<double(double)>& exact) {
  double squares = 0, sum = 0;
  int count = 0;
  for (int z = 0; z < columns.nz; ++z)
    for (int x = 0; x < columns.nx; ++x) {
      const double h = columns.at(x, z), e = exact(std::hypot(columns.x_of(x), columns.z_of(z)));
      if (h == 0 && e == 0) continue;
      squares += (h - e) * (h - e);
      sum += e;
      ++count;
    }
  return std::sqrt(squares / count) / (sum / count);
}

std::vector<double> radial_profile(const Columns& columns) {
  std::vector<double> sum, count;
  for (int z = 0; z < columns.nz; ++z)
    for (int x = 0; x < columns.nx; ++x) {
      const std::size_t ring = std::lround(std::hypot(columns.x_of(x), columns.z_of(z)));
      if (ring >= sum.size()) {
        sum.resize(ring + 1);
        count.resize(ring + 1);
      }
      sum[ring] += columns.at(x, z);
      count[ring] += 1;
    }
  for (std::size_t ring = 0; ring < sum.size(); ++ring) sum[ring] /= std::max(1.0, count[ring]);
  return sum;
}

double heat_second_moment(const state::Volume& volume) {
  double sum = 0, sum_r2 = 0;
  const state::Grid g = volume.grid;
  for_each_cell(g, [&](int x, int y, int z) {
    const double dx = x - (g.x - 1) / 2.0, dy = y - (g.y - 1) / 2.0, dz = z - (g.z - 1) / 2.0;
    const double h = volume.heat[volume.at(x, y, z)];
    sum += h;
    sum_r2 += h * (dx * dx + dy * dy + dz * dz);
  });
  return sum_r2 / sum;
}

double melted_cells(const state::Volume& volume, double melting_point, double latent_heat) {
  double sum = 0;
  for_each_cell(volume.grid, [&](int x, int y, int z) {
    if (volume.inert.test(x, y, z)) return;
    sum += std::clamp((volume.heat[volume.at(x, y, z)] - melting_point) / latent_heat, 0.0, 1.0);
  });
  return sum;
}

}  // namespace voxmelt::accuracy
