// What a ray sees through clear matter, by render/rule alone (docs/picture-translucent.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/rule/clear.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

// Scene: a PaintedScene. Follows one ray, and sums up the light that comes along it.
template <class Scene>
class ClearPainter {
 public:
  ClearPainter(const Scene& scene, const picture::Ray& ray, const picture::GroundCrossing& ground,
               int spacing, int halvings)
      : scene_(scene),
        paint_(scene.paint),
        ray_(ray),
        ground_(ground),
        to_eye_(picture::unit_of(picture::Vector{} - ray.step)),
        step_(picture::length_of_step(ray.step, to_eye_)),
        stretch_(std::int64_t{1} << spacing),
        halvings_(halvings),
        last_(ground.found ? ground.part >> picture::kPartBits : std::numeric_limits<std::int64_t>::max()) {}

  // From the first crossing on. Tells whether the ray gets to the ground.
  bool follow(picture::Crossing entry) {
    while (!picture::ground_first(ground_, entry, halvings_)) {
      if (!entry.found) return false;
      if (entry.sample > 0) surface(entry.position, true);
      if (dark()) return false;
      std::int64_t k = entry.sample;
      if (k > last_) {  // the ground follows within the step
        const std::int64_t place = (k - 1) * picture::kPlaces + entry.part;
        walk(ray_.at(k), part_of_step(ground_.part * (picture::kPlaces / picture::kParts) - place, 11));
        return true;
      }
      std::int32_t way = part_of_step(picture::kPlaces - entry.part, 11);
      for (bool out = false; !out; way = 0) {
        for (std::int64_t i = 0; i < stretch_ && k < last_; ++i) {
          out = picture::sample(scene_.levels, ray_.at(k + 1)) < 0;
          if (out) break;
          ++k;
          way += step_;
        }
        picture::Crossing exit;
        if (out) {
          exit = picture::crossing_between(scene_.levels, ray_.at(k + 1), ray_.at(k), k);
          way += part_of_step(picture::kPlaces - exit.part, 11);
        } else if (k == last_) {
          walk(ray_.at(k), way + part_of_step(ground_.part & (picture::kParts - 1), 8));
          return true;
        }
        walk(ray_.at(k), way);
        if (out) surface(exit.position, false);
        if (dark()) return false;
      }
      entry = picture::first_crossing(scene_.levels, scene_.cells, ray_, k + 1);
    }
    return true;
  }

  bool dark() const { return passed() == picture::Color{}; }
  picture::Color passed() const { return picture::passed(paint_.passing, paint_.losses, left_); }
  // With what shines through.
  picture::Color sum(const picture::Color& ground) const {
    const picture::Color share = passed();
    picture::Color of{};
    for (std::size_t c = 0; c < 3; ++c)
      of[c] = mirrored_[c] + ((scattered_[c] + share[c] * ground[c]) >> picture::kPassedBits);
    return of;
  }

 private:
  // a / 2^bits of a step.
  std::int32_t part_of_step(std::int64_t a, int bits) const {
    return static_cast<std::int32_t>((step_ * a) >> bits);
  }

  // The ray enters or leaves matter.
  void surface(picture::Vector position, bool enters) {
    const picture::Vector normal = picture::normal_at(scene_.levels, position);
    const picture::Shine shine =
        picture::shine_of(paint_, enters ? normal : picture::Vector{} - normal, normal, to_eye_,
                          light_before(position, normal), matter_before(position, normal));
    const picture::Color all = passed();
    for (std::size_t c = 0; c < 3; ++c) mirrored_[c] += (all[c] * shine.mirrored[c]) >> picture::kPassedBits;
    left_.surfaces = picture::dimmed(left_.surfaces, shine.more);
    const picture::Color before = passed();
    left_.surfaces =
        picture::dimmed(left_.surfaces, picture::mixed(paint_.frost, picture::kLight, shine.obstacle));
    scatter(before, shine.scattered);
  }

  // A way in matter, with what is at a place of it.
  void walk(picture::Vector position, std::int32_t way) {
    const picture::Matter matter = matter_at(position);
    const picture::Light light =
        picture::light_at(scene_.light, scene_.light_count, scene_.light_shift, position);
    const picture::Color before = passed();
    left_.way = picture::further(left_.way, way);
    left_.surfaces = picture::dimmed(left_.surfaces, picture::obstacle_share(matter));
    scatter(before, picture::inner_color(paint_, light, matter));
  }

  // What no longer passes is seen as `color`.
  void scatter(const picture::Color& before, const picture::Color& color) {
    const picture::Color after = passed();
    for (std::size_t c = 0; c < 3; ++c) scattered_[c] += (before[c] - after[c]) * color[c];
  }

  picture::Light light_before(picture::Vector position, picture::Vector normal) const {
    return picture::light_at(scene_.light, scene_.light_count, scene_.light_shift,
                             picture::before_surface(position, normal, scene_.light_shift));
  }
  picture::Matter matter_before(picture::Vector position, picture::Vector normal) const {
    picture::Matter matter = matter_at(position);
    matter.obstacle = matter_at(position + normal * (std::int64_t{1} << 5)).obstacle;
    return matter;
  }
  picture::Matter matter_at(picture::Vector position) const {
    return picture::matter_at(scene_.matter, scene_.cells, position);
  }

  const Scene& scene_;
  const picture::Paint& paint_;
  const picture::Ray& ray_;
  const picture::GroundCrossing& ground_;
  const picture::Vector to_eye_;
  const std::int32_t step_;
  const std::int64_t stretch_;  // samples between two looks around
  const int halvings_;          // of the step, see rule/camera.h
  const std::int64_t last_;     // sample before the ground
  picture::Left left_;
  picture::Color mirrored_{}, scattered_{};
};

}  // namespace voxmelt::render
