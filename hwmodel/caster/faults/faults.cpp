#include "hwmodel/caster/faults/faults.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace voxmelt::hwmodel::raycast {
namespace {

using enum Fault;
constexpr const char* kChannel = "texture -> matter";  // that every ray passes, halfway
constexpr std::array kFaults{
    FaultInfo{tiles_threshold, "tiles-threshold", "tiles",
              "a pixel is drawn again whose bytes differ by just the most that is allowed"},
    FaultInfo{tiles_neighbour, "tiles-neighbour", "tiles", "the neighbour below a pixel is forgotten"},
    FaultInfo{set_up_sample, "set-up-sample", "set-up", "a ray goes through the place of the next sample"},
    FaultInfo{set_up_floor, "set-up-floor", "set-up", "the step of a ray is rounded down"},
    FaultInfo{ground_bound, "ground-bound", "ground",
              "a bound of heights is too low: a sample in the ground is left out"},
    FaultInfo{ground_lost, "ground-lost", "ground", "a ray passes the ground that it meets"},
    FaultInfo{ground_part, "ground-part", "ground", "the search for the ground ends one part too late"},
    FaultInfo{ground_face, "ground-face", "ground", "the low side of the slab is taken for the high one"},
    FaultInfo{walk_first_sample, "walk-first-sample", "walk", "a ray in matter begins one sample too late"},
    FaultInfo{walk_box, "walk-box", "walk", "a ray enters the box of what is occupied one sample too late"},
    FaultInfo{walk_block, "walk-block", "walk", "a ray leaves an empty block by one sample too far"},
    FaultInfo{walk_rise, "walk-rise", "walk", "a ray goes one sample farther than the slope bound allows"},
    FaultInfo{walk_stale_position, "walk-stale-position", "walk",
              "the position of the sample before is sampled"},
    FaultInfo{walk_passes, "walk-passes", "walk", "a sample in matter is taken for air"},
    FaultInfo{cache_wrong_way, "cache-wrong-way", "levels", "a line is read from another way of its set"},
    FaultInfo{cache_tag_bits, "cache-tag-bits", "levels",
              "tags hold twelve bits: lines 4096 apart are taken for each other"},
    FaultInfo{cache_stale_line, "cache-stale-line", "levels",
              "a line that comes does not replace the old one"},
    FaultInfo{cache_reads_early, "cache-reads-early", "levels", "a line is read before it has come"},
    FaultInfo{cache_early_release, "cache-early-release", "levels",
              "a line that loses its tag is overwritten while a request waits for it"},
    FaultInfo{cache_lost_miss, "cache-lost-miss", "levels",
              "a miss does not reach the memory: everything hangs"},
    FaultInfo{levels_bank_swap, "levels-bank-swap", "levels", "the words of two banks change places"},
    FaultInfo{levels_border, "levels-border", "levels",
              "a place beyond a line's border is read from that line"},
    FaultInfo{sample_weight_x, "sample-weight-x", "sample", "the weight along x is one too large"},
    FaultInfo{sample_weight_y, "sample-weight-y", "sample", "the weight along y is one too large"},
    FaultInfo{sample_weight_z, "sample-weight-z", "sample", "the weight along z is one too large"},
    FaultInfo{sample_rounding, "sample-rounding", "sample", "the last blend is rounded down"},
    FaultInfo{crossing_halvings, "crossing-halvings", "crossing", "the bisection ends after two halvings"},
    FaultInfo{crossing_quotient, "crossing-quotient", "crossing",
              "the part of the crossing is one too large"},
    FaultInfo{crossing_ends, "crossing-ends", "crossing", "the crossing is measured from the inner end"},
    FaultInfo{met_compare, "met-compare", "met", "of ground and matter the farther one is taken"},
    FaultInfo{met_depth, "met-depth", "met", "the depth is one too large"},
    FaultInfo{met_eye, "met-eye", "met", "the direction to the eye points away from it"},
    FaultInfo{normal_axes, "normal-axes", "normal", "the normal's x and z change places"},
    FaultInfo{normal_root, "normal-root", "normal", "the table of inverse roots is read one entry too far"},
    FaultInfo{paint_side, "paint-side", "paint", "the normal of the slab's side points inwards"},
    FaultInfo{paint_band, "paint-band", "paint", "the table of bands is read one entry too far"},
    FaultInfo{paint_top, "paint-top", "paint", "the slopes of the ground along x and z change places"},
    FaultInfo{texture_bump, "texture-bump", "texture", "the bump of a texel has the wrong sign along x"},
    FaultInfo{texture_texel, "texture-texel", "texture", "the nearest lower texel is taken as it is"},
    FaultInfo{matter_share, "matter-share", "matter", "liquid and heat change places"},
    FaultInfo{matter_place, "matter-place", "matter", "obstacles are looked for at the crossing itself"},
    FaultInfo{light_cell, "light-cell", "light", "a cell of light is read instead of the next one along x"},
    FaultInfo{light_side, "light-side", "light", "openness to low x and to high x change places"},
    FaultInfo{light_glow, "light-glow", "light", "glow from below and from above change places"},
    FaultInfo{arriving_shadow, "arriving-shadow", "arriving", "the shadow is forgotten"},
    FaultInfo{arriving_glow, "arriving-glow", "arriving", "the light of the glow is missing"},
    FaultInfo{material_liquid, "material-liquid", "material", "the shares of solid and liquid change places"},
    FaultInfo{material_obstacle, "material-obstacle", "material", "the share of an obstacle is missing"},
    FaultInfo{mirror_sky, "mirror-sky", "mirror", "the table of surroundings is read one entry too far"},
    FaultInfo{mirror_highlight, "mirror-highlight", "mirror",
              "the table of highlights is read one entry too far"},
    FaultInfo{mirror_ray, "mirror-ray", "mirror", "the mirrored direction has the wrong sign"},
    FaultInfo{colour_fresnel, "colour-fresnel", "colour", "at a grazing angle no more is mirrored"},
    FaultInfo{colour_emission, "colour-emission", "colour", "what glows gives no light of its own"},
    FaultInfo{press_tone, "press-tone", "press", "the table of tones is read one entry too far"},
    FaultInfo{pixel_byte, "pixel-byte", "pixel", "the table of bytes is read one entry too far"},
    FaultInfo{pixel_mean, "pixel-mean", "pixel", "the mean of the samples is rounded down"},
    FaultInfo{pixel_channels, "pixel-channels", "pixel", "red and blue change places"},
    FaultInfo{write_place, "write-place", "write", "a burst is written to the next tile's place"},
    FaultInfo{write_burst, "write-burst", "write", "the next burst of the tile is written"},
    FaultInfo{write_early, "write-early", "write", "a tile is written before its last pixel has come"},
    FaultInfo{channel_lost, "channel-lost", kChannel, "a token is lost in a channel"},
    FaultInfo{channel_twice, "channel-twice", kChannel, "a token comes again in place of the next one"},
    FaultInfo{channel_swap, "channel-swap", kChannel, "two tokens of a channel change places"},
    FaultInfo{channel_bit, "channel-bit", kChannel, "a bit of a surface's normal changes in a channel"},
    FaultInfo{channel_never_ready, "channel-never-ready", kChannel,
              "a channel takes no token any more: everything hangs"},
    FaultInfo{dealer_twice, "dealer-twice", "dealer", "a tile is dealt again in place of the next one"},
    FaultInfo{dealer_never, "dealer-never", "dealer", "a tile is never dealt: everything hangs"},
    FaultInfo{memory_client, "memory-client", "memory", "a line of heights is given to the cache of texels"},
    FaultInfo{memory_pipe, "memory-pipe", "memory", "a pipe gets the line of another one"},
    FaultInfo{memory_bit, "memory-bit", "levels", "a bit of a line changes on its way from the memory"},
    FaultInfo{stretch_way, "stretch-way", "stretch", "a way in clear matter is one too long"},
    FaultInfo{stretch_place, "stretch-place", "stretch",
              "what is in clear matter is looked for at the next sample"},
    FaultInfo{stretch_side, "stretch-side", "stretch", "a ray that enters clear matter is said to leave it"},
    FaultInfo{passed_way, "passed-way", "passed", "a way in clear matter is taken for a shorter one"},
    FaultInfo{passed_obstacle, "passed-obstacle", "passed", "an obstacle in clear matter hides nothing"},
    FaultInfo{passed_frost, "passed-frost", "passed", "the frost of a surface is forgotten"},
    FaultInfo{passed_mirror, "passed-mirror", "passed", "at a grazing angle no less passes"},
    FaultInfo{passed_order, "passed-order", "passed",
              "what a surface mirrors is weighed with what passes behind it"},
    FaultInfo{press_behind, "press-behind", "press",
              "the background behind clear matter is pressed like a surface"},
    FaultInfo{press_nothing, "press-nothing", "press", "nothing is seen behind clear matter"},
};

// A fault that the table lacks would never be tested.
constexpr bool has_all_in_order() {
  auto expected = static_cast<std::size_t>(none);
  for (const FaultInfo& one : kFaults)
    if (static_cast<std::size_t>(one.fault) != ++expected) return false;
  return ++expected == static_cast<std::size_t>(end);
}
static_assert(has_all_in_order(), "a row for each fault, in the order of the enumerators");

}  // namespace

FaultPlan::FaultPlan(Fault fault, std::string channel)
    : fault_(fault), channel_(channel.empty() ? kChannel : std::move(channel)) {}

std::span<const FaultInfo> all_faults() { return kFaults; }

const FaultInfo* find_fault(std::string_view name) {
  const auto found =
      std::find_if(kFaults.begin(), kFaults.end(), [&](const FaultInfo& one) { return one.name == name; });
  return found == kFaults.end() ? nullptr : &*found;
}

}  // namespace voxmelt::hwmodel::raycast
