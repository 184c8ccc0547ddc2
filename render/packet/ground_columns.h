// A ground map is kept in the order in which packets of rays read it (docs/picture/ground.md).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/ground/ground_map.h"
#include "render/packet/ground_data.h"

namespace voxmelt::render {

class GroundColumns {
 public:
  // Takes over all of a map.
  void update(const GroundMap& map);
  // Takes over the changes of GroundMap::lower.
  void lower(const GroundMap& map);
  // Returns pointers into this object and the map that was taken over.
  GroundData data(const GroundMap& map) const;

 private:
  std::vector<std::int32_t> around(const ColumnHeights& heights) const;

  GroundData shape_;
  std::vector<std::int32_t> drawn_, bare_;  // with kGroundBefore and kGroundBehind columns more
  std::vector<std::uint32_t> texels_;
  std::vector<std::int32_t> bands_;
  std::array<std::vector<std::int32_t>, 4> bends_;
};

}  // namespace voxmelt::render
