// The ground as a smooth height field with upright sides: a floor slab or a terrain.
#pragma once

#include <optional>
#include <vector>

#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/raycast/surface.h"

namespace voxmelt::render {

struct GroundHit {
  Hit hit;
  bool side = false;  // of the slab
};

class Ground {
 public:
  // Heights come from the terrain, or from the field where the terrain does not fit it; a ground of height 0
  // everywhere is no ground. The heights get the low-pass filter of the field, so that both fit. Under wet
  // columns the ground is drawn lower, or it would stick out of thin films.
  Ground(const scene::Terrain& terrain, const DensityField& field);

  bool empty() const { return size_x_ == 0; }
  bool textured() const { return textured_; }
  float lowest() const { return lowest_; }
  float highest() const { return highest_; }

  std::optional<GroundHit> find(const Ray& ray) const;

  // 1 in full light, 0 behind a hill, with a soft edge.
  float light_reaching(Vec point, Vec to_light) const;
  // Ambient light that reaches the ground here: less in hollows, 0..1.
  float openness(float x, float z) const;

 private:
  using Heights = std::vector<float>;
  float spline(const Heights& heights, float x, float z) const;
  float linear(const Heights& heights, float x, float z) const;
  Vec normal(float x, float z) const;
  Heights blurred(const Heights& heights, int passes) const;

  int size_x_ = 0, size_z_ = 0;
  bool textured_ = false;
  bool uneven_ = false;  // heights differ: slopes and hill shadows matter
  float lowest_ = 0, highest_ = 0;
  Heights height_;       // filtered
  Heights drawn_;        // height_ less the lowering under wet columns
  Heights surrounding_;  // mean height around each column
};

}  // namespace voxmelt::render
