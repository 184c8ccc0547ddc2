// Soft shadows, ambient occlusion and light thrown by glowing liquid: cones through the coarse averages of
// the matter. There are no random numbers, so there is no grain.
#pragma once

#include "render/density/pyramid.h"
#include "render/image/vector.h"

namespace voxmelt::render {

struct Ambient {
  float open = 1;  // share of the surroundings that is not hidden, 0..1
  float glow = 0;  // light that arrives from glowing liquid
};

class Occlusion {
 public:
  explicit Occlusion(const Pyramid& pyramid);

  // Share of the light, seen as a wide lamp in direction `to_light`, that reaches the point, 0..1.
  float light_reaching(Vec point, Vec normal, Vec to_light) const;
  // The same for what is seen along a reflected direction.
  float reflection_reaching(Vec point, Vec normal, Vec direction) const;

  Ambient ambient(Vec point, Vec normal) const;

 private:
  float cone(Vec point, Vec direction, float start, float spread, float reach) const;

  const Pyramid& pyramid_;
  bool any_ = false;  // there is matter at all
  Vec low_, high_;    // the matter lies within this box
};

}  // namespace voxmelt::render
