// These faults can be planted in the model, to see that the lock-step checker finds them: `voxmelt list
// faults`, `voxmelt verify SCENE --plant NAME`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "hwmodel/check/fault_plan.h"

namespace voxmelt::hwmodel {

enum class Fault : std::uint8_t {
  none,
  // These strike the stage `fall`.
  fall_not_passed,
  fall_late,
  fall_lane,
  fall_below_lost,
  fall_heat_stays,
  fall_material_stays,
  // These strike the stage `source`.
  vent_rate,
  drain_energy,
  // These strike the phase `heat`.
  conduction_sign,
  conduction_dither,
  conduction_stale_row,
  conduction_first,
  conduction_mean,
  distant_wrong_axis,
  wall_drifts,
  axis_uncounted,
  touch_untold,
  side_missed,
  convection_downwards,
  irradiance_lane,
  air_axis_missed,
  glow_square,
  air_first,
  air_warmth,
  // These strike the phase `melt`.
  melt_stuck,
  melt_energy,
  melt_material,
  melt_heat,
  freeze_warm,
  freeze_film,
  set_untold,
  // These strike the phase `gravity`.
  gravity_one_more,
  gravity_wall_missed,
  gravity_room,
  gravity_column_wrap,
  gravity_mix,
  gravity_set_falls,
  // These strike the phase `spread` of the paper law.
  pattern_random_lane,
  pattern_diagonal_open,
  pattern_margin,
  pattern_set_gives,
  apply_flow_lost,
  apply_diagonal_whole,
  apply_alpha,
  // These strike the phases `excess` and `spread` of the viscous law.
  settle_run_broken,
  settle_sum_carry,
  settle_mix,
  settle_reversal,
  settle_run_untold,
  settle_head,
  settle_bed,
  settle_bed_first,
  settle_mobility,
  settle_limit,
  settle_dead_zone,
  settle_shut,
  settle_roof,
  settle_slack,
  settle_set_lost,
  viscous_dead_zone,
  viscous_shut,
  viscous_set_gives,
  viscous_dither,
  viscous_slope,
  viscous_across,
  viscous_mean,
  viscous_substep,
  viscous_layer,
  viscous_flow_lost,
  viscous_side_missed,
  viscous_run_forgotten,
  // These strike tiles.
  tile_vent,
  tile_coordinate,
  tile_halo_narrow,
  tile_halo_stale,
  tile_overwritten,
  tile_counted_twice,
  // These strike feeds.
  feed_early,
  feed_mask,
  feed_word_lost,
  feed_falls_stale,
  // These strike the occupancy code.
  code_lane_missed,
  code_bit_moved,
  code_token_lost,
  code_bit_early,
  // These strike buffers and channels.
  buffer_bit,
  fifo_overwrite,
  fifo_stale,
  fifo_swap_lanes,
  fifo_never_ready,
  end,  // marks the end of the list, and is no fault
};

inline bool is_of_tiles(Fault fault) {
  return fault >= Fault::tile_vent && fault <= Fault::tile_counted_twice;
}

// Such a fault strikes where pieces fall.
inline bool is_of_pieces(Fault fault) {
  return (fault >= Fault::fall_not_passed && fault <= Fault::fall_material_stays) ||
         fault == Fault::feed_falls_stale;
}

// Such a fault strikes in scenes of several materials.
inline bool is_of_materials(Fault fault) {
  using enum Fault;
  for (const Fault one : {fall_material_stays, conduction_first, conduction_mean, air_first, air_warmth,
                          melt_material, melt_heat, settle_bed_first})
    if (fault == one) return true;
  return false;
}

inline bool is_of_feeds(Fault fault) {
  return fault >= Fault::feed_early && fault <= Fault::feed_falls_stale;
}

inline bool is_of_the_code(Fault fault) {
  return fault >= Fault::code_lane_missed && fault <= Fault::code_bit_early;
}

// Names the first cell that leaves a stage, or a channel, wrong.
struct StruckCell {
  std::string where;
  std::uint32_t step = 0;
  int x = 0, y = 0, z = 0;
};

using FaultInfo = check::FaultInfo<Fault>;
using FaultPlan = check::FaultPlan<Fault, StruckCell>;

std::span<const FaultInfo> all_faults();
const FaultInfo* find_fault(std::string_view name);  // null: no fault has this name

}  // namespace voxmelt::hwmodel
