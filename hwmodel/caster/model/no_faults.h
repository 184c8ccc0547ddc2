// The points of the ray caster's stages at which a fault may be planted. A stage is a template over its fault
// policy, and tells it at each point what it works on, and the value that may be made wrong. This policy
// plants nothing, is empty, and compiles to nothing; hwmodel/caster/faults has the one that does.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::raycast {

struct NoFaults {
  // a channel between stages; those of pipe `number` to the dealer and from the memory
  static void made(auto&&...) {}
  static void connected(auto&&...) {}
  // tiles: the pixels that are to be drawn; set-up: the ray that leaves; ground: how many samples it leaves
  // out, and what it met
  static void chosen(auto&&...) {}
  static void set_up(auto&&...) {}
  static void passes_blocks(auto&&...) {}
  static void grounded(auto&&...) {}
  // walk: a ray that begins; how many samples it leaves out; what it asks for; is its sample in matter?
  static void begun(auto&&...) {}
  static void leaps(auto&&...) {}
  static void asked(auto&&...) {}
  static void judged(auto&&...) {}
  // levels: how a line is named in the cache; what else may go wrong there; the words that were fetched
  static std::int64_t tag_of(std::int64_t line) { return line; }
  static constexpr bool releases_early() { return false; }
  static constexpr bool loses_miss(auto&&...) { return false; }
  static constexpr bool keeps_old_line() { return false; }
  static constexpr bool reads_early() { return false; }
  static void came(auto&&...) {}  // the bytes of a line
  static void fetched(auto&&...) {}
  // sample, crossing, normal: what they compute; met: is the ground first? the surface that leaves
  static void sampled(auto&&...) {}
  static void crossed(auto&&...) {}
  static void compared(auto&&...) {}
  static void met(auto&&...) {}
  static void inclined(auto&&...) {}
  // paint, texture, matter, light: the surface to which something was added
  static void painted(auto&&...) {}
  static void textured(auto&&...) {}
  static void known(auto&&...) {}
  static void lighted(auto&&...) {}
  // arriving, mirror, colour, press: the same
  static void arrived(auto&&...) {}
  static void mirrored(auto&&...) {}
  static void coloured(auto&&...) {}
  static void pressed(auto&&...) {}
  // stretch: an event that leaves; passed: a ray behind an event; press: the light of such a ray
  static void told(auto&&...) {}
  static void passed(auto&&...) {}
  static void seen_through(auto&&...) {}
  // pixel: its bytes; write: is a tile with so many pixels left taken for complete? a burst of a tile
  static void totalled(auto&&...) {}
  static constexpr bool writes_early(auto&&...) { return false; }
  static void written(auto&&...) {}
};

}  // namespace voxmelt::hwmodel::raycast
