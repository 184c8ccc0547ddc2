// Every number that a channel carries and a later stage reads has a name and a width. A number that only the
// checker reads is no wire. A visitor gets (name, bits, has a sign, value) of each number. It sums the bits
// (cost.h), shows the values (channel_wires.h), or checks that they fit, as a test does in running pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk_stage.h"
#include "hwmodel/fabric/index_of.h"

namespace voxmelt::hwmodel::raycast {

// Wires depend on the configuration, and on whether matter is clear.
struct ContextBits {
  int rays = 6, buffers = 2;  // bits for numbers of rays under way, and of tile buffers
  bool clear = false;         // a ray goes on through matter, and a surface is an event on it
};

// Names a number, a part of one, or one of several.
struct WireName {
  const char* stem;
  const char* part = "";
  std::int64_t index = -1;

  constexpr WireName(const char* its_stem, const char* its = "", std::int64_t which = -1)
      : stem(its_stem), part(its), index(which) {}
  std::string text() const {
    std::string all = stem;
    all += part;
    if (index >= 0) (all += '_') += std::to_string(index);
    return all;
  }
};

template <class Visit>
void vector_wires(const char* name, const Vec& v, int bits, Visit&& visit) {
  visit(WireName{name, "_x"}, bits, true, v.x);
  visit(WireName{name, "_y"}, bits, true, v.y);
  visit(WireName{name, "_z"}, bits, true, v.z);
}
template <class Visit>
void color_wires(const char* name, const Rgb& c, int bits, Visit&& visit, bool has_sign = false) {
  constexpr const char* kParts[] = {"_red", "_green", "_blue"};
  for (std::size_t i = 0; i < 3; ++i) visit(WireName{name, kParts[i]}, bits, has_sign, std::int64_t{c[i]});
}
template <class Visit>
void wires_of(const RayId& id, const ContextBits& context, Visit&& visit) {
  visit(WireName{"x"}, 13, false, id.x);
  visit(WireName{"y"}, 13, false, id.y);
  visit(WireName{"sample"}, 5, false, id.sample);
  visit(WireName{"buffer"}, context.buffers, false, id.buffer);
}
template <class Visit>
void wires_of(const Ray& ray, Visit&& visit) {
  vector_wires("start", ray.start, 53, visit);
  vector_wires("step", ray.step, 20, visit);
}
template <class Visit>
void wires_of(const GroundHit& hit, Visit&& visit) {
  visit(WireName{"ground_found"}, 1, false, hit.found ? 1 : 0);
  visit(WireName{"ground_part"}, 35, false, hit.found ? hit.part : 0);
  vector_wires("ground_position", hit.position, 32, visit);
  visit(WireName{"ground_face"}, 3, false, index_of(hit.face));
  vector_wires("ground_normal", hit.normal, 16, visit);
}

template <class Visit>
void wires_of(const TileOrder& order, const ContextBits& context, Visit&& visit) {
  visit(WireName{"x"}, 13, false, order.x);
  visit(WireName{"y"}, 13, false, order.y);
  visit(WireName{"buffer"}, context.buffers, false, order.buffer);
  visit(WireName{"samples"}, 6, false, order.samples);
  for (int i = 0; i < 64; ++i) visit(WireName{"pixel", "", i}, 1, false, order.pixels >> i & 1);
}
template <class Visit>
void wires_of(const RayToken& token, const ContextBits& context, Visit&& visit) {
  wires_of(token.id, context, visit);
  wires_of(token.ray, visit);
}
template <class Visit>
void wires_of(const GroundedRay& token, const ContextBits& context, Visit&& visit) {
  wires_of(token.id, context, visit);
  wires_of(token.ray, visit);
  wires_of(token.ground, visit);
}
template <class Visit>
void wires_of(const LevelRequest& request, const ContextBits& context, Visit&& visit) {
  visit(WireName{"asker"}, 2, false, index_of(request.asker));
  visit(WireName{"context"}, context.rays, false, request.context);
  vector_wires("at", request.at, 32, visit);
}
// Visits levels, and the weights of their place.
template <class Visit>
void wires_of(const Levels& levels, const ContextBits& context, Visit&& visit) {
  const LevelRequest& request = levels.request;
  const std::size_t words = request.kind_index() == 1 ? 27 : 8;
  visit(WireName{"asker"}, 2, false, index_of(request.asker));
  visit(WireName{"context"}, context.rays, false, request.context);
  visit(WireName{"weight_x"}, 8, false, weight_of(request.at.x));
  visit(WireName{"weight_y"}, 8, false, weight_of(request.at.y));
  visit(WireName{"weight_z"}, 8, false, weight_of(request.at.z));
  for (std::size_t i = 0; i < words; ++i) visit(WireName("word", "", i), 16, true, levels.words[i]);
}
template <class Visit>
void wires_of(const LevelToken& token, const ContextBits& context, Visit&& visit) {
  visit(WireName{"asker"}, 2, false, index_of(token.request.asker));
  visit(WireName{"context"}, context.rays, false, token.request.context);
  visit(WireName{"level"}, 16, true, token.level);
}
template <class Visit>
void wires_of(const HitToken& hit, const ContextBits& context, Visit&& visit) {
  visit(WireName{"context"}, context.rays, false, hit.context);
  wires_of(hit.ray, context, visit);
  visit(WireName{"k"}, 27, false, hit.k);
  vector_wires("at", hit.at, 32, visit);
  visit(WireName{"level"}, 15, false, hit.level);
  visit(WireName{"knows_before"}, 1, false, hit.knows_before ? 1 : 0);
  visit(WireName{"before"}, 16, true, hit.knows_before ? hit.before : 0);
  if (context.clear) visit(WireName{"first"}, 1, false, hit.span == 0 ? 1 : 0);  // the ray's first matter
}
// Visits the wires of a ray that leaves matter. The rest of it has stayed in the stretch.
template <class Visit>
void wires_of_exit(const HitToken& hit, const ContextBits& context, Visit&& visit) {
  visit(WireName{"context"}, context.rays, false, hit.context);
  vector_wires("step", hit.ray.ray.step, 20, visit);
  visit(WireName{"k"}, 27, false, hit.k);
  vector_wires("at", hit.at, 32, visit);
  visit(WireName{"level"}, 15, false, hit.level);
  visit(WireName{"before"}, 16, true, hit.before);
}
template <class Visit>
void wires_of(const OnwardToken& token, const ContextBits& context, Visit&& visit) {
  visit(WireName{"context"}, context.rays, false, token.context);
  visit(WireName{"k"}, 27, false, token.k);
  vector_wires("at", token.at, 32, visit);
  visit(WireName{"level"}, 16, true, token.level);
}
template <class Visit>
void wires_of(const MetToken& met, const ContextBits& context, Visit&& visit) {
  wires_of(met.id, context, visit);
  vector_wires("step", met.ray.step, 20, visit);
  wires_of(met.ground, visit);
  visit(WireName{"matter_found"}, 1, false, met.matter.found ? 1 : 0);
  visit(WireName{"matter_sample"}, 27, false, met.matter.sample);
  visit(WireName{"matter_part"}, 12, false, met.matter.part);
  vector_wires("matter_position", met.matter.position, 32, visit);
  if (!context.clear) return;
  visit(WireName{"context"}, context.rays, false, met.context);
  visit(WireName{"first"}, 1, false, met.span == 0 ? 1 : 0);
  visit(WireName{"leaves"}, 1, false, met.leaves ? 1 : 0);
  visit(WireName{"level"}, 15, false, met.level);
  vector_wires("at", met.at, 32, visit);
}
template <class Visit>
void wires_of(const PassedToken& token, const ContextBits& context, Visit&& visit) {
  wires_of(token.id, context, visit);
  visit(WireName{"on_ground"}, 1, false, token.on_ground ? 1 : 0);
  color_wires("passed", token.passage.passed, 16, visit);
  color_wires("mirrored", token.passage.mirrored, 31, visit);
  color_wires("scattered", token.passage.scattered, 29, visit, true);
  color_wires("behind", token.behind, 18, visit, true);
}
template <class Visit>
void wires_of(const PressedToken& token, const ContextBits& context, Visit&& visit) {
  wires_of(token.id, context, visit);
  color_wires("pressed", token.pressed, 13, visit);
}
template <class Visit>
void wires_of(const PixelToken& token, const ContextBits& context, Visit&& visit) {
  wires_of(token.id, context, visit);
  color_wires("byte", {token.bytes[0], token.bytes[1], token.bytes[2]}, 8, visit);
}

// Visits one wire for each side of a cell.
template <class Sides, class Visit>
void side_wires(const char* name, const Sides& sides, Visit&& visit) {
  for (std::size_t i = 0; i < sides.size(); ++i)
    visit(WireName(name, "", i), 8, false, std::int64_t{sides[i]});
}

// A surface passes the stages that work on it in this order. Its wires hold what is there and still needed.
enum class Behind : std::uint8_t { met, normal, paint, texture, matter, light, arriving, mirror, colour };
template <class Visit>
void wires_of(const Surface& s, Behind stage, const ContextBits& context, Visit&& visit) {
  const auto from = [&](Behind first) { return stage >= first; };
  const auto until = [&](Behind last) { return stage <= last; };
  wires_of(s.id, context, visit);
  visit(WireName{"kind"}, 2, false, index_of(s.kind));
  if (until(Behind::paint)) {
    visit(WireName{"inside"}, 1, false, s.inside ? 1 : 0);
    visit(WireName{"face"}, 3, false, index_of(s.face));
  }
  if (until(Behind::matter)) vector_wires("position", s.position, 32, visit);
  if (until(Behind::arriving)) vector_wires("to_eye", s.to_eye, 16, visit);
  if (until(Behind::arriving)) vector_wires("normal", s.normal, 16, visit);
  if (from(Behind::paint) && until(Behind::mirror)) color_wires("color", s.color, 13, visit);
  if (from(Behind::matter) && until(Behind::light)) {
    visit(WireName{"liquid"}, 8, false, s.matter.liquid);
    visit(WireName{"heat"}, 8, false, s.matter.heat);
    visit(WireName{"obstacle"}, 8, false, s.matter.obstacle);
  }
  if (stage == Behind::light) {
    visit(WireName{"lamp"}, 8, false, s.light.lamp);
    if (!context.clear)  // clear matter does not glow
      side_wires("glow", s.light.glow, visit);
  }
  if (from(Behind::light) && until(Behind::arriving)) side_wires("open", s.light.open, visit);
  if (from(Behind::arriving) && until(Behind::mirror)) {
    color_wires("arriving", s.arriving.light, 17, visit, true);
    color_wires("diffuse", s.mixture.material.diffuse, 13, visit);
    color_wires("mirror", s.mixture.material.mirror, 13, visit);
    color_wires("highlight", s.mixture.material.highlight, 13, visit);
    if (!context.clear) color_wires("emission", s.mixture.emission, 14, visit);
  }
  if (stage == Behind::arriving || (context.clear && from(Behind::mirror)))
    visit(WireName{"w"}, 13, false, s.mixture.w);
  if (stage == Behind::arriving) {
    visit(WireName{"lamp"}, 9, false, s.arriving.lamp);
    visit(WireName{"facing"}, 16, true, s.arriving.facing);
    visit(WireName{"gloss"}, 12, false, s.mixture.material.gloss);
  }
  if (stage == Behind::mirror) {
    visit(WireName{"peak"}, 13, false, s.mirrored.peak);
    visit(WireName{"free"}, 13, false, s.mirrored.free);
    if (!context.clear) visit(WireName{"eye"}, 15, false, s.mirrored.eye);
    color_wires("around", s.mirrored.around, 15, visit);
  }
  if (stage == Behind::mirror || (context.clear && stage == Behind::colour))
    visit(WireName{"more"}, 13, false, s.mirrored.more);
  if (stage == Behind::colour) color_wires("sum", s.sum, 18, visit, true);
  if (!context.clear) return;
  visit(WireName{"context"}, context.rays, false, s.clear.context);
  visit(WireName{"way"}, 18, false, s.clear.way);
  if (until(Behind::arriving)) visit(WireName{"leaves"}, 1, false, s.clear.leaves ? 1 : 0);
  if (stage == Behind::colour) color_wires("gleam", s.clear.gleam, 15, visit);
}

}  // namespace voxmelt::hwmodel::raycast
