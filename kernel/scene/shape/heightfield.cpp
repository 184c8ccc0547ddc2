#include "kernel/scene/shape/heightfield.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "kernel/scene/shape/geometry.h"
#include "kernel/scene/text/ascii.h"

namespace voxmelt::scene {
namespace {

std::array<double, 4> spline_weights(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
          t * t * t / 6};
}

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), lower_case);
  return ending;
}

}  // namespace

double Elevation::at(int column, int row) const {
  const int c = std::clamp(column, 0, columns - 1), r = std::clamp(row, 0, rows - 1);
  return value[place(c, r)];
}

bool is_height_file(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".asc" || ending == ".tif" || ending == ".tiff" || ending == ".png";
}

Elevation read_elevation(const std::filesystem::path& file, const Place& place) {
  const std::string ending = ending_of(file);
  if (ending == ".png") return read_png_heights(file, place);
  if (ending == ".tif" || ending == ".tiff") return read_tiff_heights(file, place);
  return read_esri_ascii(file, place);
}

bool fill_missing(Elevation& elevation) {
  const double lowest = *std::ranges::min_element(elevation.value);
  if (lowest == kNoElevation) return false;
  for (double& value : elevation.value)
    if (value == kNoElevation) {
      value = lowest;
      ++elevation.missing;
    }
  return true;
}

void smooth(Elevation& elevation, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const Elevation before = elevation;
    for (int r = 0; r < before.rows; ++r)
      for (int c = 0; c < before.columns; ++c) {
        const auto row = [&](int k) {
          return before.at(c - 1, k) + 2 * before.at(c, k) + before.at(c + 1, k);
        };
        elevation.value[before.place(c, r)] = (row(r - 1) + 2 * row(r) + row(r + 1)) / 16;
      }
  }
}

std::vector<double> resample(const Elevation& elevation, int nx, int nz) {
  const double lowest = *std::min_element(elevation.value.begin(), elevation.value.end());
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(nx) * nz);
  for (int z = 0; z < nz; ++z) {
    const double v = (z + 0.5) / nz * elevation.rows - 0.5;
    const int row = floor_of(v);
    const auto row_weights = spline_weights(v - row);
    for (int x = 0; x < nx; ++x) {
      const double u = (x + 0.5) / nx * elevation.columns - 0.5;
      const int column = floor_of(u);
      const auto column_weights = spline_weights(u - column);
      double sum = 0;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          sum += row_weights[j] * column_weights[i] * elevation.at(column - 1 + i, row - 1 + j);
      result.push_back(sum - lowest);
    }
  }
  return result;
}

}  // namespace voxmelt::scene
