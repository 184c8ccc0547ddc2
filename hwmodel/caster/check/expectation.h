// The software's reference gives the numbers of a ray's trace (docs/picture/trace.md), in the terms of the
// ray caster's tokens.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/tokens.h"
#include "render/packet/draw_picture.h"
#include "render/reference/picture_scene.h"
#include "render/rule/camera.h"

namespace voxmelt::hwmodel::raycast {

// Holds what comes along a ray through clear matter. If nothing passes any more, the reference ends there.
struct ExpectedClear {
  std::vector<picture::Crossing> entries, exits;  // even one that lies behind the ground
  std::vector<Surface> events;                    // surfaces and ways
  bool dark = false;
  Passage passage;

  // Returns a ray's crossing number `span`, or null if there is none.
  const picture::Crossing* entry(int span) const { return at(entries, span); }
  const picture::Crossing* exit(int span) const { return at(exits, span); }
  static const picture::Crossing* at(const std::vector<picture::Crossing>& all, int span) {
    const std::size_t i = span;
    return i < all.size() ? &all[i] : nullptr;
  }
};

struct ExpectedRay {
  picture::Ray ray;
  picture::Crossing matter;
  picture::GroundCrossing ground;
  bool shaded = false;  // the members below are filled in
  Surface surface;      // state behind the last stage that adds to it
  picture::Vector ground_normal;
  Rgb pressed{};
  ExpectedClear clear;  // only if matter is clear
};

class Expectation {
 public:
  Expectation(const render::PictureScene& scene, const picture::Camera& camera, render::Setting setting);

  // Returns the ray through a place of the picture, in 64ths of a pixel, and what it meets.
  ExpectedRay ray(std::int64_t across, std::int64_t down) const;
  void shade(ExpectedRay& ray) const;

  picture::Vector at(const ExpectedRay& ray, std::int64_t k) const { return ray.ray.at(k); }
  std::int32_t level(std::int64_t x, std::int64_t y, std::int64_t z) const { return scene_.levels(x, y, z); }
  std::int32_t sample(picture::Vector position) const;
  std::int64_t above_ground(picture::Vector position) const;  // 2^-12 cells
  const picture::View& view() const { return view_; }
  bool clear() const { return scene_.paint.clear; }

 private:
  void meet(ExpectedRay& ray, picture::Vector position) const;
  picture::Light light_before(picture::Vector position, picture::Vector normal) const;
  void shade_ground(ExpectedRay& ray) const;
  void shade_matter(ExpectedRay& ray) const;
  void follow(ExpectedRay& ray) const;  // through clear matter, in clear_expectation.cpp
  static Rgb pressed(const Rgb& sum);
  picture::Crossing first_crossing(const picture::Ray& ray) const;

  const render::PictureScene& scene_;
  picture::View view_;
  int spacing_;
  // Fills `air_` for lower cells -1 .. n - 1 with the distance to matter: cells along the farthest axis.
  // Matter is near if one of the eight levels around a sample is matter. A sample is never outside the range
  // of its levels.
  void measure_air();
  std::vector<std::uint8_t> air_;
  std::size_t row_ = 0, slice_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
