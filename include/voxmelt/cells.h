/// @file
/// Cells may be drawn as boxes in false colours, whole or cut open. Such a picture shows what the picture of
/// the materials does not, and none of its smooth surfaces, shadows and light.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxmelt {

/// Names what the colour of a cell tells.
enum class CellColours {
  phase,        ///< solid, liquid or inert
  temperature,  ///< 0..1 of the scene's range of temperatures
  sleep,        ///< whether the next step works on the cell's tile, as far as that is known before it
};

/// Names the axis to which a cut plane is perpendicular.
enum class Axis {
  x,  ///< the first axis of the grid
  y,  ///< upwards
  z,  ///< the outermost axis
};

/// Takes away all cells on one side of a plane: the side of the eye.
struct CellCut {
  Axis axis = Axis::x;  ///< the plane is perpendicular to it
  int at = 0;           ///< the plane lies at this coordinate, 0 to the grid's side
};

/// Describes how cells are drawn. Each cell with matter is a whole box, however little matter it has.
struct CellView {
  CellColours colours = CellColours::phase;  ///< what the colours tell
  std::optional<CellCut> cut;                ///< where the volume is cut open; faces there are not shaded
};

/// Explains a colour. If the name is a number, it is a place of a scale, and colours between are mixed.
struct LegendMark {
  std::string name;                   ///< "solid", "0.25", "awake", ...
  std::array<std::uint8_t, 3> rgb{};  ///< red, green and blue in sRGB
};

/// Returns what the colours mean. The marks of a scale come first, in its order.
std::vector<LegendMark> legend(CellColours colours);

}  // namespace voxmelt
