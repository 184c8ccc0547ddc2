// What a mirror would see: a photographer's studio with a bright sky, a big lamp and a strip light.
#pragma once

#include "render/image/vector.h"

namespace voxmelt::render {

struct Environment {
  Vec to_light;       // where the big lamp stands
  Vec ground;         // colour of what lies below
  float blur = 0.2f;  // of the mirror, 0 sharp .. 1 dull

  Vec seen(Vec direction) const;
};

}  // namespace voxmelt::render
