// Pixels of the picture are computed in integers, by render/rule (docs/picture/definition.md). They have the
// same bytes as the reference, which the tests hold them against. Any step and any places of samples will do,
// and samples in air are left out.
#pragma once

#include <cstdint>
#include <span>

#include "accuracy/picture/exact_field.h"
#include "render/image/image.h"
#include "render/reference/picture_scene.h"
#include "render/rule/antialias.h"
#include "render/rule/camera.h"
#include "render/rule/crossing.h"

namespace voxmelt::accuracy {

class IntegerPixels {
 public:
  // Takes steps of 2^-spacing cells, or less where the camera is near (picture::halvings_of). `field` says
  // where air is.
  IntegerPixels(const render::PictureScene& scene, const ExactField& field, const picture::Camera& camera,
                int spacing);

  render::Rgb pixel(int x, int y, std::span<const picture::Sub> samples) const;

 private:
  picture::Crossing first_crossing(const picture::Ray& ray) const;
  picture::Color light(std::int64_t across, std::int64_t down) const;

  const render::PictureScene& scene_;
  const ExactField& field_;
  picture::View view_;
  int spacing_;
};

}  // namespace voxmelt::accuracy
