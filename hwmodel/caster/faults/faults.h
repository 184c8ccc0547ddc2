// Faults can be planted in the ray caster, to see that the lock-step checker finds them: `voxmelt list
// faults`, `voxmelt verify SCENE --picture --plant NAME`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "hwmodel/check/fault_plan.h"

namespace voxmelt::hwmodel::raycast {

enum class Fault : std::uint8_t {
  none,
  // These strike tiles, set-up and ground.
  tiles_threshold,
  tiles_neighbour,
  set_up_sample,
  set_up_floor,
  ground_bound,
  ground_margin,
  ground_lost,
  ground_part,
  ground_face,
  // These strike the walk.
  walk_first_sample,
  walk_box,
  walk_block,
  walk_rise,
  walk_margin,
  walk_stands,
  walk_stale_position,
  walk_passes,
  // These strike the levels.
  cache_wrong_way,
  cache_tag_bits,
  cache_stale_line,
  cache_reads_early,
  cache_early_release,
  cache_lost_miss,
  levels_bank_swap,
  levels_border,
  // These strike sample, crossing and met.
  sample_weight_x,
  sample_weight_y,
  sample_weight_z,
  sample_rounding,
  crossing_halvings,
  crossing_quotient,
  crossing_ends,
  crossing_stale,
  met_compare,
  met_depth,
  met_eye,
  // These strike normal, paint and texture.
  normal_axes,
  normal_root,
  paint_side,
  paint_band,
  paint_top,
  texture_bump,
  texture_texel,
  // These strike matter and light.
  matter_share,
  matter_place,
  light_cell,
  light_side,
  light_glow,
  // These strike arriving, mirror and colour.
  arriving_shadow,
  arriving_glow,
  material_liquid,
  material_obstacle,
  material_tone,
  mirror_sky,
  mirror_highlight,
  mirror_ray,
  colour_fresnel,
  colour_emission,
  // These strike the stages that make bytes.
  press_tone,
  pixel_byte,
  pixel_mean,
  pixel_channels,
  write_place,
  write_burst,
  write_early,
  // These strike channels, the dealer and the memory.
  channel_lost,
  channel_twice,
  channel_swap,
  channel_bit,
  channel_never_ready,
  dealer_twice,
  dealer_never,
  memory_client,
  memory_pipe,
  memory_bit,
  // These strike rays in clear matter.
  stretch_way,
  stretch_place,
  stretch_side,
  passed_way,
  passed_obstacle,
  passed_frost,
  passed_mirror,
  passed_order,
  press_behind,
  press_nothing,
  end,  // no fault, but the end of the list
};

// Names the stage that a fault leaves wrong, and its pixel or line.
struct StruckPixel {
  std::string stage;
  std::int32_t x = 0, y = 0;  // pixel, or the first one of a written tile
  int sample = 0;
  std::int64_t address = -1;  // line in memory
};

using FaultInfo = check::FaultInfo<Fault>;
using FaultPlan = check::FaultPlan<Fault, StruckPixel>;

std::span<const FaultInfo> all_faults();
const FaultInfo* find_fault(std::string_view name);  // null if unknown

// A fault of channels strikes in this one, unless another is named, because every ray passes it halfway.
inline constexpr const char* kUsualChannel = "texture -> matter";

}  // namespace voxmelt::hwmodel::raycast
