// Finds where a ray meets the surface of the matter: front to back through the bricks, stopping at the first
// crossing of half intensity.
#pragma once

#include <optional>

#include "render/density/density_field.h"
#include "render/raycast/sampler.h"

namespace voxmelt::render {

struct Hit {
  float distance = 0;
  Vec point, normal;  // normal of length 1, out of the matter
};

class Surface {
 public:
  // `skip_empty` leaves out bricks that cannot hold the surface. The samples lie at the same places either
  // way, so the picture is the same.
  Surface(const DensityField& field, bool skip_empty);

  // The first crossing nearer than `limit`.
  std::optional<Hit> find(const Ray& ray, float limit) const;

  const Sampler& sampler() const { return sampler_; }

 private:
  float refine(const Ray& ray, float outside, float inside) const;
  void find_occupied();
  // Index of the first sample behind the brick of `point` when the brick is empty, otherwise 0.
  int skip_to(const Ray& ray, Vec point, float start) const;

  const DensityField& field_;
  Sampler sampler_;
  bool skip_empty_;
  Vec low_, high_;  // box around all bricks that can hold the surface
};

}  // namespace voxmelt::render
