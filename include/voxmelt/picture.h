/// @file
/// Pictures of a state: where they are seen from, frames as bytes, and what a pixel shows
/// (docs/picture/definition.md defines every byte).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "voxmelt/sources.h"

namespace voxmelt {

/// How carefully a picture is drawn.
enum class Quality {
  fast,    ///< one sample per pixel
  normal,  ///< eight where a pixel differs from a neighbour
  best,    ///< thirty-two where it differs, along shorter steps
};

/// How space becomes a picture.
enum class Projection {
  perspective,   ///< what is farther away is smaller
  orthographic,  ///< all rays are parallel; everything is as large as a perspective shows it at the target
};

/// Where a picture is seen from.
struct Camera {
  Position target{};          ///< the place looked at, in cells
  double distance = 0;        ///< from the target to the eye, in cells, 0..262144; 0: so that the grid fits
  double azimuth = 35;        ///< degrees around the vertical, -360..360; 0 from the front, 90 from +x
  double elevation = 28;      ///< degrees above the horizon, -89..89
  double field_of_view = 30;  ///< of the picture's height, in degrees, 1..120
  Projection projection = Projection::perspective;  ///< perspective, or parallel rays
};

/// A picture of a state. What is not set here is taken from the scene.
struct Picture {
  std::optional<Camera> camera;       ///< where it is seen from
  std::optional<int> width;           ///< pixels, 16..16384
  std::optional<int> height;          ///< pixels, 16..16384
  std::optional<double> azimuth;      ///< degrees, in place of the camera's
  std::optional<double> elevation;    ///< degrees, in place of the camera's
  Quality quality = Quality::normal;  ///< how carefully it is drawn
  bool depth = false;                 ///< does a frame have depths? They cost as much as a fast picture
  int row_alignment = 1;              ///< rows of a frame begin at multiples of so many bytes, 1..4096
};

/// A picture in memory. Rows follow each other from the top.
struct Frame {
  int width = 0;                  ///< pixels in a row
  int height = 0;                 ///< rows
  std::size_t stride = 0;         ///< bytes from a row to the next: 3 x width, rounded up to `row_alignment`
  std::vector<std::uint8_t> rgb;  ///< red, green, blue of each pixel, in sRGB; what lies between rows is 0
  /// Cells from the eye to what the middle of each pixel shows, along the direction of view; infinity where
  /// that is the background. width x height of them, or none.
  std::vector<float> depth;
  /// From where depths count, if there are any. Parallel rays have their eye before the whole grid.
  Position eye{};
};

/// A cell of the volume: 0 <= x < grid.x, and so on.
struct Cell {
  int x = 0;                                                   ///< along x
  int y = 0;                                                   ///< upwards
  int z = 0;                                                   ///< along z
  friend bool operator==(const Cell&, const Cell&) = default;  ///< the same cell
};

/// What a pixel may show.
enum class Shown {
  solid,     ///< what has not melted
  liquid,    ///< what flows
  obstacle,  ///< inert cells above the ground
  ground,    ///< floor or terrain
};

/// Where the ray through a pixel's middle first meets something (docs/picture/definition.md, section 9).
/// Clear matter counts: what is behind its surface does not.
struct Hit {
  Shown shown = Shown::solid;  ///< of what the picture mixes there, the largest part
  Position position{};         ///< the place, in cells
  Position normal{};           ///< of the surface there, outwards, of length 1
  double depth = 0;            ///< cells from the eye, as in a frame
  Cell cell;                   ///< that has the place in it
  /// The first cell from there on along the ray that is not air. The drawn surface is smooth, so that it may
  /// run through a cell of air beside the matter. It is `cell` where no such cell comes within four cells.
  Cell matter;
};

}  // namespace voxmelt
