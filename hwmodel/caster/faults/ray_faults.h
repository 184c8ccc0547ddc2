// Rays begin, step, cross or compare wrongly. Most faults of the walk strike only where they leave out the
// first sample in matter, because elsewhere they change no picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "hwmodel/caster/faults/planted.h"
#include "hwmodel/caster/model/ground_blocks.h"
#include "hwmodel/caster/model/walk_stage.h"

namespace voxmelt::hwmodel::raycast {

class RayFaults : public Planted {
 public:
  using Planted::Planted;

  void set_up(const CameraRegisters& camera, int samples, RayToken& token) {
    const std::int64_t x = 64 * std::int64_t{token.id.x}, y = 64 * std::int64_t{token.id.y};
    if (armed(Fault::set_up_sample)) {
      const Sub next = sub_of(samples, (token.id.sample + 1) % samples);
      const Ray wrong = ray_of(camera, x + next.across, y + next.down);
      if (wrong.start == token.ray.start && wrong.step == token.ray.step) return;
      token.ray = wrong;
      strike("set-up", token.id);
    }
    if (armed(Fault::set_up_floor)) {
      const Sub sub = sub_of(samples, token.id.sample);
      const std::int64_t high = 32 * std::int64_t{camera.height};
      const Vec direction = camera.forward * high + camera.high * (high - y - sub.down) +
                            camera.wide * (x + sub.across - 32 * std::int64_t{camera.width});
      const int shift = bits_of(largest(direction) - 1) - kCellBits + camera.spacing;
      replace("set-up", token.id, token.ray.step, direction >> shift);
    }
  }

  void passes_blocks(const GroundedRay& ray, std::int64_t part, std::optional<std::int64_t>& samples) {
    if (!armed(Fault::ground_bound) || samples || !in_ground(at_part(ray.ray, part))) return;
    samples = 0;
    strike("ground", ray.id);
  }
  // Leaps as if heights were exact. A number that the true bound allows, too, is no fault.
  void passes_slopes(const GroundedRay& ray, const Searcher& searcher, Vec p, std::int64_t above,
                     std::int64_t& samples) {
    if (!armed(Fault::ground_margin)) return;
    const GroundBlock& block = registers().ground.blocks.fine_at(p);
    const Vec slopes{std::int64_t{block.slope_x} << kBoundShift, 0,
                     std::int64_t{block.slope_z} << kBoundShift};
    const std::int64_t nearer = approach_of(slopes, searcher.step);
    if (nearer <= 0) return;
    const std::int64_t wrong = std::min((above << 20) / nearer, samples_in_block(searcher, p, kFineBits));
    const std::int64_t room = (above << 20) - ((slopes.x + slopes.z) << 12) - (std::int64_t{1} << 22);
    if (wrong * nearer > room) replace("ground", ray.id, samples, wrong);
  }
  void grounded(GroundedRay& ray) {
    GroundHit& ground = ray.ground;
    if (!ground.found) return;
    if (armed(Fault::ground_lost)) {
      ground.found = false;
      strike("ground", ray.id);
    }
    if (armed(Fault::ground_part)) {
      ++ground.part;
      strike("ground", ray.id);
    }
    if (armed(Fault::ground_face) && (ground.face == Face::low_x || ground.face == Face::low_z)) {
      ground.face = ground.face == Face::low_x ? Face::high_x : Face::high_z;
      strike("ground", ray.id);
    }
  }

  template <class Context>
  void begun(Context& context) {
    if (!armed(Fault::walk_first_sample) || level_at(context.walker.at) < 0) return;
    context.k = 1;
    context.walker.at = context.walker.at + context.walker.step;
    strike("walk", context.ray.id);
  }
  template <class Context>
  void leaps(const Context& context, Leap leap, std::int64_t& steps) {
    if (armed(Fault::walk_stands)) return replace("walk", context.ray.id, steps, std::int64_t{0});
    if (armed(Fault::walk_margin) && leap == Leap::through_air) return lose_margin(context, steps);
    const Fault fault = leap == Leap::to_box         ? Fault::walk_box
                        : leap == Leap::out_of_block ? Fault::walk_block
                                                     : Fault::walk_rise;
    if (!armed(fault) || context.k + steps > context.most) return;
    if (level_at(context.walker.at + context.walker.step * steps) < 0) return;
    ++steps;
    strike("walk", context.ray.id);
  }
  template <class Context>
  void asked(const Context& context, LevelRequest& request) {
    if (!armed(Fault::walk_stale_position)) return;
    request.at = request.at - context.walker.step;
    strike("walk", context.ray.id);
  }
  template <class Context>
  void judged(const Context& context, bool& matter) {
    if (!matter || !armed(Fault::walk_passes)) return;
    matter = false;
    strike("walk", context.ray.id);
  }

  // Leaps as if levels were exact. A number that the true bound allows, too, is no fault.
  template <class Context>
  void lose_margin(const Context& context, std::int64_t& steps) {
    const int spacing = registers().camera.spacing;
    const std::int64_t rise = (-context.level * kRises[context.slope]) >> (28 - spacing);
    const std::int64_t wrong = std::min(rise + 1, steps_out(context.walker, 1));
    const std::int64_t room = -context.level - 4 - 3 * context.slope;
    if (768 * context.slope * (wrong - 1) > room * (1 << spacing))
      replace("walk", context.ray.id, steps, wrong);
  }

  // Strikes where the sample before was left out, and the crossing lies so near to it that its level counts.
  template <class Context>
  void meets(const Context& context, HitToken& hit) {
    if (!armed(Fault::crossing_stale) || hit.k < 2 || context.known != hit.k - 2) return;
    const Vec before = hit.at - hit.ray.ray.step;
    Bracket right{before, hit.at, level_at(before), hit.level, 0};
    for (int halved = 0; halved < 3; ++halved) halve(right, level_at(middle_of(right)));
    if (right.e != 0) return;
    Bracket wrong = right;
    wrong.a = hit.before;
    if (crossing_of(wrong, hit.k).part == crossing_of(right, hit.k).part) return;
    hit.knows_before = true;
    strike("crossing", context.ray.id);
  }

  void crossed(const HitToken& hit, const Bracket& bracket, Crossing& met) {
    if (hit.k == 0 || hit.leaves) return;
    const RayId& id = hit.ray.id;
    if (armed(Fault::crossing_halvings)) {
      const Vec before = hit.at - hit.ray.ray.step;
      Bracket the_bracket{before, hit.at, level_at(before), hit.level, 0};
      for (int halved = 0; halved < 2; ++halved) halve(the_bracket, level_at(middle_of(the_bracket)));
      const Crossing wrong = crossing_of(the_bracket, hit.k);
      if (wrong.part == met.part && wrong.position == met.position) return;
      met = wrong;
      strike("crossing", id);
    }
    if (armed(Fault::crossing_quotient)) {
      ++met.part;
      strike("crossing", id);
    }
    if (armed(Fault::crossing_ends)) {
      const std::int64_t f = met.part & 255;
      const Vec wrong = bracket.inside + (((bracket.outside - bracket.inside) * f) >> 8);
      replace("crossing", id, met.position, from_lattice(wrong));
    }
  }

  void compared(const MetToken& met, bool& ground) {
    if (!armed(Fault::met_compare) || !met.ground.found || !met.matter.found) return;
    ground = !ground;
    strike("met", met.id);
  }
  void met(Surface& surface) {
    if (armed(Fault::met_depth)) replace("met", surface.id, surface.depth, surface.depth + 1);
    if (armed(Fault::met_eye)) replace("met", surface.id, surface.to_eye, Vec{} - surface.to_eye);
  }
};

}  // namespace voxmelt::hwmodel::raycast
