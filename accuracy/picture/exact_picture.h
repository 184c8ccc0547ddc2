// The converged picture is the definition of docs/picture/definition.md in double, without roundings, without
// steps, with 64 samples a pixel. The error of a drawn picture is its distance from this one.
#pragma once

#include <span>

#include "accuracy/picture/exact_field.h"
#include "accuracy/picture/exact_ground.h"
#include "accuracy/picture/exact_shade.h"
#include "accuracy/picture/exact_vector.h"
#include "kernel/engine/cpu/workers.h"
#include "render/image/image.h"
#include "render/reference/picture_scene.h"
#include "render/rule/antialias.h"
#include "render/rule/camera.h"

namespace voxmelt::accuracy {

// Holds all of a scene that no camera changes. It refers to the scene.
struct ExactScene {
  explicit ExactScene(const render::PictureScene& scene)
      : field(scene),
        ground(scene),
        shade(scene),
        background(exact({scene.look.background[0], scene.look.background[1], scene.look.background[2]},
                         picture::kLight)) {}
  ExactField field;
  ExactGround ground;
  ExactShade shade;
  Exact background;
};

class ExactPicture {
 public:
  // The camera's distance must be given.
  ExactPicture(const ExactScene& scene, const picture::Camera& camera, picture::Vector cells);

  // Returns the ray through a place of the picture, in pixels from the upper left corner.
  ExactRay ray(double across, double down) const;
  // Returns pressed light, in which 1 is white.
  Exact light(double across, double down) const;
  struct Seen {
    double depth = -1;  // in cells from the near plane; negative if nothing is met
    Exact position, normal;
  };
  Seen matter(double across, double down) const;  // as if there were no ground

  // Returns the mean of some samples, in bytes. Their places count in 1 / `one` of a pixel.
  render::Rgb pixel(int x, int y, std::span<const picture::Sub> samples, double one = picture::kPixel) const;
  // Draws the picture with 64 samples a pixel.
  render::Image draw(cpu::Workers& workers) const;

 private:
  const ExactScene& scene_;
  Exact eye_, forward_, right_, up_;
  double width_ = 0, height_ = 0, distance_ = 0, tangent_ = 0, near_ = 0;
  bool parallel_ = false;
};

}  // namespace voxmelt::accuracy
