// A ray walks from cell to cell until it meets one with matter. Bricks without matter are crossed at once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "render/cells/filled_cells.h"
#include "render/rule/camera.h"

namespace voxmelt::render {

// Takes away the cells on one side of a plane between cells: the side of the eye.
struct CellCut {
  int axis = 0;  // 0: x, 1: y, 2: z
  int at = 0;    // the plane lies before the cell of this number
};

struct SeenCell {
  CellIndex cell{};
  int axis = -1;                     // of the face through which the ray came; -1 if it began in the cell
  int outwards = 0;                  // direction of the face's normal along that axis: -1 or 1
  bool cut = false;                  // the face lies on the cut plane
  std::array<double, 3> position{};  // place on the face, in cells
};

class CellCaster {
 public:
  // `filled` must outlive the caster.
  CellCaster(const FilledCells& filled, const picture::View& view, const std::optional<CellCut>& cut);

  // Returns what the ray through a place of the picture meets. Places count as in picture::ray_through.
  std::optional<SeenCell> see(std::int64_t across, std::int64_t down) const;

 private:
  const FilledCells& filled_;
  const picture::View view_;
  CellIndex low_{}, high_{};  // the cells that are left: low <= cell < high
  int cut_axis_ = -1;
};

}  // namespace voxmelt::render
