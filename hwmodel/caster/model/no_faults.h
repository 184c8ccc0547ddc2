// The ray caster's stages have points at which a fault may be planted. A stage is a template over its fault
// policy. At each point it tells the policy what it works on, and the value that may be made wrong. This
// policy plants nothing, is empty, and compiles to nothing. hwmodel/caster/faults has the one that does.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::raycast {

struct NoFaults {
  // These see a channel between stages, and the channels of pipe `number` to the dealer and from the memory.
  static void made(auto&&...) {}
  static void connected(auto&&...) {}
  // These see the pixels that tiles will draw, the ray that leaves the set-up, how many samples the ground
  // leaves out by its blocks and by their slopes, and what the ray met there.
  static void chosen(auto&&...) {}
  static void set_up(auto&&...) {}
  static void passes_blocks(auto&&...) {}
  static void passes_slopes(auto&&...) {}
  static void grounded(auto&&...) {}
  // These see a ray that begins its walk, how many samples it leaves out, what it asks for, if it is in
  // matter, and what leaves for the crossing.
  static void begun(auto&&...) {}
  static void leaps(auto&&...) {}
  static void asked(auto&&...) {}
  static void judged(auto&&...) {}
  static void meets(auto&&...) {}
  // These see how a line is named in the cache of levels, what else may go wrong there, and the fetched
  // words.
  static std::int64_t tag_of(std::int64_t line) { return line; }
  static constexpr bool releases_early() { return false; }
  static constexpr bool loses_miss(auto&&...) { return false; }
  static constexpr bool keeps_old_line() { return false; }
  static constexpr bool reads_early() { return false; }
  static void came(auto&&...) {}  // bytes of a line
  static void fetched(auto&&...) {}
  // These see what sample and crossing compute, if met takes the ground first, the surface that leaves it,
  // and the normal's slope.
  static void sampled(auto&&...) {}
  static void crossed(auto&&...) {}
  static void compared(auto&&...) {}
  static void met(auto&&...) {}
  static void inclined(auto&&...) {}
  // These see the surface to which paint, texture, matter or light has added something.
  static void painted(auto&&...) {}
  static void textured(auto&&...) {}
  static void known(auto&&...) {}
  static void lighted(auto&&...) {}
  // These see the same of arriving, mirror, colour and press.
  static void arrived(auto&&...) {}
  static void mirrored(auto&&...) {}
  static void coloured(auto&&...) {}
  static void pressed(auto&&...) {}
  // These see an event that leaves the stretch, a ray behind an event in passed, and the light of such a ray
  // in press.
  static void told(auto&&...) {}
  static void passed(auto&&...) {}
  static void seen_through(auto&&...) {}
  // These see the bytes of a pixel, if a tile with so many pixels left is taken for complete, and a burst of
  // a tile.
  static void totalled(auto&&...) {}
  static constexpr bool writes_early(auto&&...) { return false; }
  static void written(auto&&...) {}
};

}  // namespace voxmelt::hwmodel::raycast
