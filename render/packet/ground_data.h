// The ground as packets of rays read it, as plain data.
#pragma once

namespace voxmelt::render {

struct GroundData {
  bool any = false;
};

}  // namespace voxmelt::render
