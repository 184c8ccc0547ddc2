// The shade gives light and colour of a picture in double (docs/picture/light.md, sections 5 to 8), without
// roundings. The volumes of light and the tables of the paint are data. Between two entries it interpolates
// linearly.
#pragma once

#include <array>

#include "accuracy/picture/exact_field.h"
#include "accuracy/picture/exact_vector.h"
#include "render/image/image.h"
#include "render/reference/picture_scene.h"

namespace voxmelt::accuracy {

class ExactShade {
 public:
  // Throws std::invalid_argument for a look with clear matter: rays end at the first surface here.
  explicit ExactShade(const render::PictureScene& scene);

  // Returns linear red, green and blue, in which 1 is white.
  Exact matter_color(Exact p, Exact normal, Exact to_eye, const ExactField::Matter& matter) const;
  Exact ground_color(Exact p, Exact normal, Exact color) const;

 private:
  struct Light {
    double lamp = 0;  // 0 .. 255, as are the others
    std::array<double, 6> open{}, glow{};
  };
  Light light_before(Exact p, Exact normal) const;
  Exact arriving(Exact normal, const Light& light, bool lit_by_glow) const;
  Exact mirrored(Exact direction) const;

  const render::LightVolume& light_;
  const picture::Paint& paint_;
};

Exact pressed(Exact light);
render::Rgb bytes_of(Exact light);

}  // namespace voxmelt::accuracy
