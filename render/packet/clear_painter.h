// The painter follows a ray through clear matter, by render/rule alone (docs/picture/translucent.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/rule/clear.h"
#include "render/rule/crossing.h"
#include "render/rule/nearer.h"
#include "render/rule/normal.h"
#include "render/rule/ray.h"
#include "render/rule/shade.h"
#include "render/rule/watch.h"

namespace voxmelt::render {

// Follows one ray, and sums up the light that comes along it. Scene is a PaintedScene.
template <class Scene, class Watch = picture::Silent>
class ClearPainter {
 public:
  ClearPainter(const Scene& scene, const picture::Ray& ray, const picture::GroundCrossing& ground,
               int spacing, int halvings, Watch watch = {})
      : scene_(scene),
        paint_(scene.paint),
        ray_(ray),
        ground_(ground),
        to_eye_(picture::unit_of(picture::Vector{} - ray.step, watch)),
        step_(picture::length_of_step(ray.step, to_eye_)),
        stretch_(std::int64_t{1} << spacing),
        halvings_(halvings),
        last_(ground.found ? ground.part >> picture::kPartBits : std::numeric_limits<std::int64_t>::max()),
        watch_(watch) {
    watch_(Stage::met, "to_eye", to_eye_);
    watch_(Stage::clear, "length", step_);
  }

  // Follows the ray from its first crossing on. Tells whether it gets to the ground.
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
          watch_(Stage::sample, "k", k + 1);
          out = picture::sample(levels(), ray_.at(k + 1), watch_) < 0;
          if (out) break;
          ++k;
          way += step_;
        }
        picture::Crossing exit;
        if (out) {
          exit = exit_at(k);
          way += part_of_step(picture::kPlaces - exit.part, 11);
        } else if (k == last_) {
          walk(ray_.at(k), way + part_of_step(ground_.part & (picture::kParts - 1), 8));
          return true;
        }
        walk(ray_.at(k), way);
        if (out) surface(exit.position, false);
        if (dark()) return false;
      }
      entry = picture::first_crossing(levels(), scene_.cells, ray_, k + 1, watch_);
    }
    return true;
  }

  bool dark() const { return passed() == picture::Color{}; }
  picture::Color passed() const { return picture::passed(paint_.passing, paint_.losses, left_); }
  // Returns the light along the ray, with that of the ground that shines through.
  picture::Color sum(const picture::Color& ground) const {
    const picture::Color share = passed();
    picture::Color color{};
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = mirrored_[c] + ((scattered_[c] + share[c] * ground[c]) >> picture::kPassedBits);
    return color;
  }

 private:
  using Stage = picture::Stage;
  template <class Cells>
  auto watched(const Cells& cells, Stage stage) const {
    return picture::Watched{cells, watch_, stage};
  }
  auto levels() const { return watched(scene_.levels, Stage::sample); }

  // Returns a / 2^bits of a step.
  std::int32_t part_of_step(std::int64_t a, int bits) const {
    return static_cast<std::int32_t>((step_ * a) >> bits);
  }

  // Returns the exit after sample k, which is matter. The next sample is air.
  picture::Crossing exit_at(std::int64_t k) const {
    watch_(Stage::crossing, "samples", std::array{k + 1, k});
    const picture::Crossing exit = picture::crossing_between(levels(), ray_.at(k + 1), ray_.at(k), k, watch_);
    watch_(Stage::crossing, "sample", exit.sample);
    watch_(Stage::crossing, "part", exit.part);
    watch_(Stage::crossing, "crossing", exit.position);
    return exit;
  }

  // Takes the ray into matter or out of it.
  void surface(picture::Vector position, bool enters) {
    watch_(Stage::clear, "enters", enters ? 1 : 0);
    watch_(Stage::clear, "position", position);
    const picture::Vector normal =
        picture::normal_at(watched(scene_.levels, Stage::normal), position, watch_);
    watch_(Stage::normal, "normal", normal);
    const picture::Matter matter = matter_before(position, normal);
    const picture::Light light = light_at(picture::before_surface(position, normal, scene_.light_shift));
    const picture::Shine shine = picture::shine_of(paint_, enters ? normal : picture::Vector{} - normal,
                                                   normal, to_eye_, light, matter, watch_);
    watch_(Stage::clear, "gleam", shine.mirrored);
    watch_(Stage::clear, "body", shine.scattered);
    const picture::Color all = passed();
    for (std::size_t c = 0; c < 3; ++c) mirrored_[c] += (all[c] * shine.mirrored[c]) >> picture::kPassedBits;
    left_.surfaces = picture::dimmed(left_.surfaces, shine.more);
    const picture::Color before = passed();
    left_.surfaces =
        picture::dimmed(left_.surfaces, picture::mixed(paint_.frost, picture::kLight, shine.obstacle));
    scatter(before, shine.scattered);
  }

  // Takes the ray along a way in matter, with the values at a place of it.
  void walk(picture::Vector position, std::int32_t way) {
    watch_(Stage::clear, "d", way);
    watch_(Stage::clear, "position", position);
    const picture::Matter matter = matter_at(position);
    const picture::Color color = picture::inner_color(paint_, light_at(position), matter, watch_);
    watch_(Stage::clear, "body", color);
    const picture::Color before = passed();
    left_.way = picture::further(left_.way, way);
    left_.surfaces = picture::dimmed(left_.surfaces, picture::obstacle_share(matter));
    scatter(before, color);
  }

  // Adds light of a colour, in the share that no longer passes.
  void scatter(const picture::Color& before, const picture::Color& color) {
    const picture::Color after = passed();
    for (std::size_t c = 0; c < 3; ++c) scattered_[c] += (before[c] - after[c]) * color[c];
    watch_(Stage::clear, "left", left_.surfaces);
    watch_(Stage::clear, "way", left_.way);
    watch_(Stage::clear, "passed", after);
    watch_(Stage::clear, "mirrored", mirrored_);
    watch_(Stage::clear, "scattered", scattered_);
  }

  picture::Light light_at(picture::Vector position) const {
    return picture::light_at(watched(scene_.light, Stage::light), scene_.light_count, scene_.light_shift,
                             position, watch_);
  }
  picture::Matter matter_before(picture::Vector position, picture::Vector normal) const {
    picture::Matter matter = matter_at(position);
    matter.obstacle = matter_at(position + normal * (std::int64_t{1} << 5)).obstacle;
    return matter;
  }
  picture::Matter matter_at(picture::Vector position) const {
    return picture::matter_at(watched(scene_.matter, Stage::matter), scene_.cells, position, watch_);
  }

  const Scene& scene_;
  const picture::Paint& paint_;
  const picture::Ray& ray_;
  const picture::GroundCrossing& ground_;
  const picture::Vector to_eye_;
  const std::int32_t step_;
  const std::int64_t stretch_;  // samples between two looks around
  const int halvings_;          // halvings of the step, see rule/camera.h
  const std::int64_t last_;     // sample before the ground
  picture::Left left_;
  picture::Color mirrored_{}, scattered_{};
  [[no_unique_address]] const Watch watch_;
};

}  // namespace voxmelt::render
