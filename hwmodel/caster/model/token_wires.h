// How wide every number is that a channel carries and a later stage reads. What only the checker reads is no
// wire. A visitor gets (bits, has a sign, value) of each number: it sums the bits (cost.h), or checks that
// the values fit, as a test does in running pictures.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk_stage.h"

namespace voxmelt::hwmodel::raycast {

// What wires depend on: the configuration, and whether matter is clear.
struct ContextBits {
  int rays = 6, buffers = 2;  // numbers of rays under way, and of tile buffers
  bool clear = false;         // a ray goes on through matter, and a surface is an event on it
};

template <class Visit>
void vector_wires(const Vec& v, int bits, Visit&& visit) {
  visit(bits, true, v.x), visit(bits, true, v.y), visit(bits, true, v.z);
}
template <class Visit>
void color_wires(const Rgb& c, int bits, Visit&& visit, bool has_sign = false) {
  for (const std::int32_t one : c) visit(bits, has_sign, std::int64_t{one});
}
template <class Visit>
void wires_of(const RayId& id, const ContextBits& of, Visit&& visit) {
  visit(13, false, id.x), visit(13, false, id.y);
  visit(5, false, id.sample), visit(of.buffers, false, id.buffer);
}
template <class Visit>
void wires_of(const Ray& ray, Visit&& visit) {
  vector_wires(ray.start, 53, visit), vector_wires(ray.step, 20, visit);
}
template <class Visit>
void wires_of(const GroundHit& hit, Visit&& visit) {
  visit(1, false, hit.found ? 1 : 0), visit(35, false, hit.found ? hit.part : 0);
  vector_wires(hit.position, 32, visit);
  visit(3, false, static_cast<std::int64_t>(hit.face));
  vector_wires(hit.normal, 16, visit);
}

template <class Visit>
void wires_of(const TileOrder& order, const ContextBits& of, Visit&& visit) {
  visit(13, false, order.x), visit(13, false, order.y);
  visit(of.buffers, false, order.buffer), visit(6, false, order.samples);
  for (int i = 0; i < 64; ++i) visit(1, false, static_cast<std::int64_t>(order.pixels >> i & 1));
}
template <class Visit>
void wires_of(const RayToken& token, const ContextBits& of, Visit&& visit) {
  wires_of(token.id, of, visit), wires_of(token.ray, visit);
}
template <class Visit>
void wires_of(const GroundedRay& token, const ContextBits& of, Visit&& visit) {
  wires_of(token.id, of, visit), wires_of(token.ray, visit), wires_of(token.ground, visit);
}
template <class Visit>
void wires_of(const LevelRequest& request, const ContextBits& of, Visit&& visit) {
  visit(2, false, static_cast<std::int64_t>(request.asker));
  visit(of.rays, false, request.context);
  vector_wires(request.at, 32, visit);
}
// Levels, and the weights of their place.
template <class Visit>
void wires_of(const Levels& levels, const ContextBits& of, Visit&& visit) {
  const LevelRequest& request = levels.request;
  const std::size_t words = request.kind_index() == 1 ? 27 : 8;
  visit(2, false, static_cast<std::int64_t>(request.asker));
  visit(of.rays, false, request.context);
  for (const std::int64_t at : {request.at.x, request.at.y, request.at.z}) visit(8, false, weight_of(at));
  for (std::size_t i = 0; i < words; ++i) visit(16, true, levels.words[i]);
}
template <class Visit>
void wires_of(const LevelToken& token, const ContextBits& of, Visit&& visit) {
  visit(2, false, static_cast<std::int64_t>(token.request.asker));
  visit(of.rays, false, token.request.context);
  visit(16, true, token.level);
}
template <class Visit>
void wires_of(const HitToken& hit, const ContextBits& of, Visit&& visit) {
  visit(of.rays, false, hit.context);
  wires_of(hit.ray, of, visit);
  visit(27, false, hit.k);
  vector_wires(hit.at, 32, visit);
  visit(15, false, hit.level), visit(1, false, hit.knows_before ? 1 : 0);
  visit(16, true, hit.knows_before ? hit.before : 0);
  if (of.clear) visit(1, false, hit.span == 0 ? 1 : 0);  // the ray's first matter
}
// Of a ray that leaves matter: the rest of it has stayed in the stretch.
template <class Visit>
void wires_of_exit(const HitToken& hit, const ContextBits& of, Visit&& visit) {
  visit(of.rays, false, hit.context);
  vector_wires(hit.ray.ray.step, 20, visit);
  visit(27, false, hit.k);
  vector_wires(hit.at, 32, visit);
  visit(15, false, hit.level), visit(16, true, hit.before);
}
template <class Visit>
void wires_of(const OnwardToken& token, const ContextBits& of, Visit&& visit) {
  visit(of.rays, false, token.context);
  visit(27, false, token.k);
  vector_wires(token.at, 32, visit);
  visit(16, true, token.level);
}
template <class Visit>
void wires_of(const MetToken& met, const ContextBits& of, Visit&& visit) {
  wires_of(met.id, of, visit);
  vector_wires(met.ray.step, 20, visit);
  wires_of(met.ground, visit);
  visit(1, false, met.matter.found ? 1 : 0);
  visit(27, false, met.matter.sample), visit(12, false, met.matter.part);
  vector_wires(met.matter.position, 32, visit);
  if (!of.clear) return;
  visit(of.rays, false, met.context);
  visit(1, false, met.span == 0 ? 1 : 0), visit(1, false, met.leaves ? 1 : 0);
  visit(15, false, met.level);
  vector_wires(met.at, 32, visit);
}
template <class Visit>
void wires_of(const PassedToken& token, const ContextBits& of, Visit&& visit) {
  wires_of(token.id, of, visit);
  visit(1, false, token.on_ground ? 1 : 0);
  color_wires(token.passage.passed, 16, visit);
  color_wires(token.passage.mirrored, 31, visit), color_wires(token.passage.scattered, 29, visit, true);
  color_wires(token.behind, 18, visit, true);
}
template <class Visit>
void wires_of(const PressedToken& token, const ContextBits& of, Visit&& visit) {
  wires_of(token.id, of, visit);
  color_wires(token.pressed, 13, visit);
}
template <class Visit>
void wires_of(const PixelToken& token, const ContextBits& of, Visit&& visit) {
  wires_of(token.id, of, visit);
  for (const std::uint8_t byte : token.bytes) visit(8, false, std::int64_t{byte});
}

// A surface behind the stages that work on it, in their order: what is there and still needed.
enum class Behind : std::uint8_t { met, normal, paint, texture, matter, light, arriving, mirror, colour };
template <class Visit>
void wires_of(const Surface& s, Behind stage, const ContextBits& of, Visit&& visit) {
  const auto from = [&](Behind first) { return stage >= first; };
  const auto until = [&](Behind last) { return stage <= last; };
  wires_of(s.id, of, visit);
  visit(2, false, static_cast<std::int64_t>(s.kind));
  if (until(Behind::paint))
    visit(1, false, s.inside ? 1 : 0), visit(3, false, static_cast<std::int64_t>(s.face));
  if (until(Behind::matter)) vector_wires(s.position, 32, visit);
  if (until(Behind::arriving)) vector_wires(s.to_eye, 16, visit);
  if (until(Behind::arriving)) vector_wires(s.normal, 16, visit);
  if (from(Behind::paint) && until(Behind::mirror)) color_wires(s.color, 13, visit);
  if (from(Behind::matter) && until(Behind::light)) {
    visit(8, false, s.matter.liquid), visit(8, false, s.matter.heat), visit(8, false, s.matter.obstacle);
  }
  if (stage == Behind::light) {
    visit(8, false, s.light.lamp);
    if (!of.clear)  // it does not glow
      for (const std::int32_t glow : s.light.glow) visit(8, false, glow);
  }
  if (from(Behind::light) && until(Behind::arriving))
    for (const std::int32_t open : s.light.open) visit(8, false, open);
  if (from(Behind::arriving) && until(Behind::mirror)) {
    color_wires(s.arriving.light, 17, visit, true);
    color_wires(s.mixture.material.diffuse, 13, visit), color_wires(s.mixture.material.mirror, 13, visit);
    color_wires(s.mixture.material.highlight, 13, visit);
    if (!of.clear) color_wires(s.mixture.emission, 14, visit);
  }
  if (stage == Behind::arriving || (of.clear && from(Behind::mirror))) visit(13, false, s.mixture.w);
  if (stage == Behind::arriving) {
    visit(9, false, s.arriving.lamp), visit(16, true, s.arriving.facing);
    visit(12, false, s.mixture.material.gloss);
  }
  if (stage == Behind::mirror) {
    visit(13, false, s.mirrored.peak), visit(13, false, s.mirrored.free);
    if (!of.clear) visit(15, false, s.mirrored.eye);
    color_wires(s.mirrored.around, 15, visit);
  }
  if (stage == Behind::mirror || (of.clear && stage == Behind::colour)) visit(13, false, s.mirrored.more);
  if (stage == Behind::colour) color_wires(s.sum, 18, visit, true);
  if (!of.clear) return;
  visit(of.rays, false, s.clear.context), visit(18, false, s.clear.way);
  if (until(Behind::arriving)) visit(1, false, s.clear.leaves ? 1 : 0);
  if (stage == Behind::colour) color_wires(s.clear.gleam, 15, visit);
}

}  // namespace voxmelt::hwmodel::raycast
