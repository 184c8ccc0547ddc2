/// @file
/// Pictures of a state are described here: the camera, the frame as bytes, and the hit of a pixel
/// (docs/picture/definition.md defines every byte).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "voxmelt/sources.h"

namespace voxmelt {

/// Tells how carefully a picture is drawn.
enum class Quality {
  fast,    ///< one sample per pixel
  normal,  ///< eight samples where a pixel differs from a neighbour
  best,    ///< thirty-two samples where it differs, along shorter steps
};

/// Tells how space becomes a picture.
enum class Projection {
  perspective,   ///< distant things look smaller
  orthographic,  ///< all rays are parallel; everything is as large as a perspective shows it at the target
};

/// Tells from where a picture is seen.
struct Camera {
  Position target{};          ///< place looked at, in cells
  double distance = 0;        ///< cells from the target to the eye, 0..262144; 0 makes the grid fit
  double azimuth = 35;        ///< degrees around the vertical, -360..360; 0 from the front, 90 from +x
  double elevation = 28;      ///< degrees above the horizon, -89..89
  double field_of_view = 30;  ///< angle of the picture's height, in degrees, 1..120
  Projection projection = Projection::perspective;  ///< perspective, or parallel rays
};

/// Describes a picture of a state. The scene supplies everything that is not set here.
struct Picture {
  std::optional<Camera> camera;       ///< where it is seen from
  std::optional<int> width;           ///< pixels, 16..16384
  std::optional<int> height;          ///< pixels, 16..16384
  std::optional<double> azimuth;      ///< degrees, in place of the camera's
  std::optional<double> elevation;    ///< degrees, in place of the camera's
  Quality quality = Quality::normal;  ///< how carefully it is drawn
  bool depth = false;                 ///< a frame has depths, too; they cost as much as a fast picture
  int row_alignment = 1;              ///< rows of a frame begin at multiples of so many bytes, 1..4096
};

/// Holds a picture in memory. Rows follow each other from the top.
struct Frame {
  int width = 0;                  ///< pixels in a row
  int height = 0;                 ///< rows
  std::size_t stride = 0;         ///< bytes from a row to the next: 3 x width, rounded up to `row_alignment`
  std::vector<std::uint8_t> rgb;  ///< red, green, blue of each pixel, in sRGB; bytes between rows are 0
  /// Holds the cells from the eye to what the middle of each pixel shows, along the direction of view. A
  /// pixel of the background has infinity. There are width x height depths, or none.
  std::vector<float> depth;
  /// Is the point from which depths count, if there are any. Parallel rays have their eye before the whole
  /// grid.
  Position eye{};
};

/// Names a cell of the volume: 0 <= x < grid.x, and so on.
struct Cell {
  int x = 0;                                                   ///< along x
  int y = 0;                                                   ///< upwards
  int z = 0;                                                   ///< along z
  friend bool operator==(const Cell&, const Cell&) = default;  ///< the same cell
};

/// Names the things that a pixel may show.
enum class Shown {
  solid,     ///< matter that has not melted
  liquid,    ///< matter that flows
  obstacle,  ///< inert cells above the ground
  ground,    ///< floor or terrain
};

/// Describes where the ray through a pixel's middle first meets something (docs/picture/definition.md,
/// section 9). Clear matter counts, and things behind its surface do not.
struct Hit {
  Shown shown = Shown::solid;  ///< the largest part of what the picture mixes there
  Position position{};         ///< place of the hit, in cells
  Position normal{};           ///< normal of the surface there, outwards, of length 1
  double depth = 0;            ///< cells from the eye, as in a frame
  Cell cell;                   ///< cell that contains the place
  /// Names the first cell from there on along the ray that is not air. The drawn surface is smooth, so it may
  /// run through a cell of air beside the matter. This is `cell` if no such cell comes within four cells.
  Cell matter;
};

}  // namespace voxmelt
