// Terrain comes from ESRI ASCII grids or grey pictures of elevation, stretched smoothly over the whole grid.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

inline constexpr int kLargestElevationSide = 8192;
inline constexpr double kHighestElevation = 1e9;
inline constexpr double kNoElevation = 2 * kHighestElevation;  // until fill_missing()

// Holds elevations as in the file: `columns` per row from west to east, rows from north to south.
struct Elevation {
  int columns = 0, rows = 0;
  std::vector<double> value;
  long long missing = 0;          // cells without data, which were given the lowest elevation of the file
  bool names_missing = false;     // the file names the number that means "no data"; if not, it is -9999
  long long unnamed = 0;          // cells of -9999 in such a file
  double cell_x = 1, cell_y = 1;  // size of a cell of the file, in any unit

  std::size_t place(std::size_t column, std::size_t row) const { return row * columns + column; }
  double at(int column, int row) const;  // clamped to the border
};

// Throws InputError with `place` and file:line. The file may be missing, truncated or malformed, or its sizes
// outside 2..8192.
Elevation read_esri_ascii(const std::filesystem::path& file, const Place& place);

// Reads a grey PNG of 1 to 16 bits. Throws InputError with `place` and the file.
Elevation read_png_heights(const std::filesystem::path& file, const Place& place);

// Reads a GeoTIFF of one band: numbers of 8 to 64 bits in strips or tiles, north to south. Throws InputError
// with `place` and the file, in a build without libtiff for every file.
Elevation read_tiff_heights(const std::filesystem::path& file, const Place& place);
bool tiff_is_built_in();

// Tells if the name of a file ends as those of heights do: .asc, .tif, .tiff or .png.
bool is_height_file(const std::filesystem::path& file);

// Reads one of them, by the ending of the name.
Elevation read_elevation(const std::filesystem::path& file, const Place& place);

// Gives the lowest elevation to cells without one. Returns false if no cell has one.
bool fill_missing(Elevation& elevation);

// Applies `passes` of the 3 x 3 binomial filter, which smooth the terraces of elevations in whole metres.
void smooth(Elevation& elevation, int passes);

// Returns elevations above the file's lowest at the centres of nx x nz columns (west to +x, north to -z), z
// outermost. A cubic B-spline makes them smooth to the second derivative, and never outside the range of the
// data.
std::vector<double> resample(const Elevation& elevation, int nx, int nz);

}  // namespace voxmelt::scene
