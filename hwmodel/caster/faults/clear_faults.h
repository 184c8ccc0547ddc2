// Rays go through clear matter wrongly, or their sums are wrong. No fault of the sums lets less light pass
// than there is. Otherwise the ray might end too early, which is found in another stage.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/faults/planted.h"

namespace voxmelt::hwmodel::raycast {

class ClearFaults : public Planted {
 public:
  using Planted::Planted;

  void told(Surface& event) {
    ClearEvent& clear_event = event.clear;
    if (event.kind == Surface::Kind::way) {
      if (!counts(clear_event)) return;
      if (armed(Fault::stretch_way)) replace("stretch", event.id, clear_event.way, clear_event.way + 1);
      if (armed(Fault::stretch_place))
        replace("stretch", event.id, event.position, event.position + event.step);
    } else if (event.kind == Surface::Kind::matter && clear_event.event == 0) {
      if (armed(Fault::stretch_side)) replace("stretch", event.id, clear_event.leaves, !clear_event.leaves);
    }
  }

  void passed(const LookRegisters& look, const Passage& before, const Surface& event, Passage& passage) {
    Passage wrong = passage;
    if (event.kind == Surface::Kind::way) {
      const auto with = [&](std::int64_t way, std::int64_t obstacle) {
        wrong = before;
        pass_way(look, wrong, way, event.sum, obstacle);
      };
      if (armed(Fault::passed_way)) with(std::max(event.clear.way - 1, 0), event.mixture.w);
      if (armed(Fault::passed_obstacle)) with(event.clear.way, 0);
    } else {
      const Rgb &gleam = event.clear.gleam, &body = event.sum;
      const auto with = [&](const LookRegisters& other, std::int64_t more) {
        wrong = before;
        pass_surface(other, wrong, gleam, body, more, event.mixture.w);
      };
      LookRegisters other = look;
      other.frost = 0;
      if (armed(Fault::passed_frost)) with(other, event.mirrored.more);
      if (armed(Fault::passed_mirror)) with(look, 0);
      if (armed(Fault::passed_order))
        for (std::size_t c = 0; c < 3; ++c)
          wrong.mirrored[c] = before.mirrored[c] +
                              static_cast<std::int32_t>((std::int64_t{passage.passed[c]} * gleam[c]) >> 15);
    }
    if (same(wrong, passage)) return;
    passage = wrong;
    strike("passed", event.id);
  }

  void seen_through(const LookRegisters& look, const PassedToken& ray, PressedToken& token) {
    Rgb wrong = token.pressed;
    if (armed(Fault::press_behind) && !ray.on_ground)
      wrong = raycast::seen_through(look, ray.passage, true, ray.behind);
    if (armed(Fault::press_nothing)) wrong = raycast::seen_through(look, ray.passage, ray.on_ground, {});
    replace("press", token.id, token.pressed, wrong);
  }

 private:
  // Something must still pass on the ray behind its first surface. Otherwise the event changes nothing.
  bool counts(const ClearEvent& event) const {
    return event.event <= 1 && !registers().look.obstacles && registers().look.frost <= 2048;
  }
  static bool same(const Passage& a, const Passage& b) {
    return a.left.surfaces == b.left.surfaces && a.left.way == b.left.way && a.passed == b.passed &&
           a.mirrored == b.mirrored && a.scattered == b.scattered;
  }
};

}  // namespace voxmelt::hwmodel::raycast
