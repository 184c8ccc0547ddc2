// Each tile of a picture has one box for all of its rays, outside of which there is no matter. So rays begin
// near the matter, and tiles beside it look at none.
#pragma once

#include <vector>

#include "render/packet/picture_data.h"
#include "render/packet/visible_area.h"

namespace voxmelt::render {

// Holds the boxes of tiles of `side` pixels a side. The first tile is the upper left one, and rows follow
// each other.
class TileBoxes {
 public:
  TileBoxes(const PictureData& data, const Projection& projection, int side);

  int across() const { return across_; }
  int count() const { return static_cast<int>(boxes_.size()); }
  // Narrows the box of `field` to what the tile shows. Tells whether anything is left.
  bool narrow(int tile, FieldData& field) const;

 private:
  int across_, down_;
  std::vector<BlockBox> boxes_;
};

}  // namespace voxmelt::render
