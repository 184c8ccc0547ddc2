// Terrain: ESRI ASCII grids of elevation, stretched smoothly over the whole grid.
#pragma once

#include <filesystem>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Elevations as in the file: `columns` per row from west to east, rows from north to south.
struct Elevation {
  int columns = 0, rows = 0;
  std::vector<double> value;
  long long missing = 0;          // cells without data, which were given the lowest elevation of the file
  bool names_missing = false;     // does the file say which number means that? Else it is -9999
  double cell_x = 1, cell_y = 1;  // their size, in any unit

  double at(int column, int row) const;  // clamped to the border
};

// Throws InputError naming `place` and file:line: missing, truncated, malformed, sizes outside 2..8192.
Elevation read_esri_ascii(const std::filesystem::path& file, const Place& place);

// Applies `passes` of the 3 x 3 binomial filter, which smooth the terraces of elevations in whole metres.
void smooth(Elevation& elevation, int passes);

// Elevation above the file's lowest at the centres of nx x nz columns (west to +x, north to -z), by a cubic
// B-spline: smooth to the second derivative, and never outside the range of the data. z outermost.
std::vector<double> resample(const Elevation& elevation, int nx, int nz);

}  // namespace voxmelt::scene
