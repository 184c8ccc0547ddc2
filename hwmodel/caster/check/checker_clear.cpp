// Rays through clear matter are compared behind every stage. After nothing passes any more, a ray changes no
// byte. So the rest of its way is not compared.
#include <cstdint>

#include "hwmodel/caster/check/checker.h"
#include "hwmodel/caster/check/compare.h"
#include "hwmodel/caster/host/keep.h"

namespace voxmelt::hwmodel::raycast {

// The token comes from the walk into matter, or from a stretch to the air behind it.
void Checker::compare_clear(const HitToken& token) {
  const ExpectedRay& ray = shaded(token.ray.id);
  const picture::Crossing* expected = token.leaves ? ray.clear.exit(token.span) : ray.clear.entry(token.span);
  if (expected == nullptr && ray.clear.dark) return;
  const Vec position = from_lattice(token.at);
  compare(token.leaves ? "stretch" : "walk", token.ray.id,
          token.leaves ? "the last sample in matter" : "the first sample in matter",
          expected != nullptr ? expected->sample : -1, token.k, &position);
}

void Checker::compare_clear(const MetToken& token) {
  const ExpectedRay& ray = shaded(token.id);
  const picture::Crossing* expected = token.leaves ? ray.clear.exit(token.span) : ray.clear.entry(token.span);
  if (!token.matter.found) {
    const bool hidden =
        expected != nullptr && ray.ground.found && expected->sample > (ray.ground.part >> 8) + 1;
    compare("walk", token.id, "matter found", expected != nullptr && !hidden, false);
  } else if (expected != nullptr) {
    compare_crossing(token.id, *expected, token.matter);
  } else if (!ray.clear.dark) {
    compare("crossing", token.id, "found", false, true);
  }
}

void Checker::compare_clear(Channel behind, const Surface& token) {
  const ExpectedRay& ray = shaded(token.id);
  const ExpectedClear& clear = ray.clear;
  const auto events = static_cast<std::int32_t>(clear.events.size()), event = token.clear.event;
  const bool goes_on = token.kind == Surface::Kind::matter || token.kind == Surface::Kind::way;
  if (goes_on && event < events) return compare_surface(behind, clear.events[event], token, ray);
  if (clear.dark && event >= events) return;
  compare("stretch", token.id, "events", events, goes_on ? event + 1 : event);
  compare_surface(behind, ray.surface, token, ray);
}

void Checker::entered(int, std::int64_t, const PassedToken* token) {
  const ExpectedRay& ray = shaded(token->id);
  const Passage &e = ray.clear.passage, &a = token->passage;
  const auto same = [&](const char* name, const auto& expected, const auto& actual) {
    compare("passed", token->id, name, expected, actual);
  };
  same("left", std::int64_t{e.left.surfaces}, std::int64_t{a.left.surfaces});
  same("way", std::int64_t{e.left.way}, std::int64_t{a.left.way});
  same("passed", e.passed, a.passed);
  same("mirrored", e.mirrored, a.mirrored);
  same("scattered", e.scattered, a.scattered);
}

}  // namespace voxmelt::hwmodel::raycast
