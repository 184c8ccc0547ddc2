#include "hwmodel/pipeline/faults/faults.h"

#include <array>

namespace voxmelt::hwmodel {
namespace {

using enum Fault;
constexpr std::array kFaults{
    FaultInfo{vent_rate, "vent-rate", "source", "a vent adds one unit more than its rate"},
    FaultInfo{drain_energy, "drain-energy", "source",
              "a drain leaves one unit of energy above the amount that is left"},
    // The faults of conduction strike in the last pass (conduction, edges or corners), and only where the
    // cell behind is sure to be wrong at the end of the phase. See conduction_faults.h.
    FaultInfo{conduction_sign, "conduction-sign", "conduction",
              "a flux arrives at the cell behind with the wrong sign"},
    FaultInfo{conduction_dither, "conduction-dither", "conduction",
              "a flux to the cell behind uses the dither of the next axis"},
    FaultInfo{conduction_stale_row, "conduction-stale-row", "conduction",
              "the plane memory is read one row too late for the flux to the cell behind"},
    FaultInfo{distant_wrong_axis, "distant-wrong-axis", "edges",
              "a flux between edge or corner neighbours takes the cell at the wrong height"},
    FaultInfo{wall_drifts, "wall-drifts", "conduction",
              "an isothermal wall loses the heat that it gives (in the last pass of conduction)"},
    FaultInfo{axis_uncounted, "axis-uncounted", "conduction",
              "air at the faces along z does not expose a cell"},
    FaultInfo{
        touch_untold, "touch-untold", "conduction",
        "liquid on the floor of the grid is not told that it touches something (where a scene freezes)"},
    FaultInfo{side_missed, "side-missed", "conduction",
              "the end of the grid does not count as a side (without heat: in walls)"},
    FaultInfo{convection_downwards, "convection-downwards", "convection",
              "heat rises into the warmer cell (from one that is not at air which exchanges)"},
    FaultInfo{irradiance_lane, "irradiance-lane", "exchange",
              "a cell gets the irradiance of the next lane (needs two lanes)"},
    FaultInfo{air_axis_missed, "air-axis-missed", "exchange", "one exposed axis is not counted"},
    FaultInfo{glow_square, "glow-square", "exchange",
              "a cell glows by the square of its temperature, not by the fourth power"},
    FaultInfo{melt_stuck, "melt-stuck", "melt", "a hot solid stays solid"},
    FaultInfo{melt_energy, "melt-energy", "melt", "fresh liquid has one unit of energy too little"},
    FaultInfo{freeze_warm, "freeze-warm", "melt",
              "liquid above the freezing point, and below the melt's heat, freezes or sets"},
    FaultInfo{freeze_film, "freeze-film", "melt", "a cold cell freezes however little it holds"},
    FaultInfo{set_untold, "set-untold", "melt", "a cold cell that does not freeze is not set"},
    FaultInfo{gravity_one_more, "gravity-one-more", "gravity", "one unit more arrives than falls"},
    FaultInfo{gravity_wall_missed, "gravity-wall-missed", "gravity", "a cell beside a wall falls freely"},
    FaultInfo{gravity_room, "gravity-room", "gravity",
              "a falling flow ignores that the cell below is nearly full"},
    FaultInfo{
        gravity_column_wrap, "gravity-column-wrap", "gravity",
        "the counter of heights wraps late: the next column's lowest cell falls into this one's highest"},
    FaultInfo{gravity_mix, "gravity-mix", "gravity", "falling liquid does not bring its heat"},
    FaultInfo{gravity_set_falls, "gravity-set-falls", "gravity", "a set cell that touches something falls"},
    FaultInfo{pattern_random_lane, "pattern-random-lane", "pattern",
              "a cell uses the random byte of the next one"},
    FaultInfo{pattern_diagonal_open, "pattern-diagonal-open", "pattern",
              "a diagonal between two walls is open"},
    FaultInfo{pattern_margin, "pattern-margin", "pattern", "a neighbour that stands as high is given to"},
    FaultInfo{pattern_set_gives, "pattern-set-gives", "pattern", "a set cell chooses directions"},
    FaultInfo{apply_flow_lost, "apply-flow-lost", "apply", "a flow leaves its cell and never arrives"},
    FaultInfo{apply_diagonal_whole, "apply-diagonal-whole", "apply", "a diagonal flow is not quartered"},
    FaultInfo{apply_alpha, "apply-alpha", "apply", "the friction of the wrong ground"},
    FaultInfo{settle_run_broken, "settle-run-broken", "settle", "a run ends one cell too early"},
    FaultInfo{settle_sum_carry, "settle-sum-carry", "settle", "the sum of a run loses its highest bit"},
    FaultInfo{settle_mix, "settle-mix", "settle", "the lowest cell of a run keeps its heat"},
    FaultInfo{settle_reversal, "settle-reversal", "settle",
              "the column memory is read in the wrong direction"},
    FaultInfo{settle_run_untold, "settle-run-untold", "settle", "a cell is not told that it is in a run"},
    FaultInfo{settle_head, "settle-head", "settle", "a run shows a head that is one unit too low"},
    FaultInfo{settle_bed, "settle-bed", "settle", "a solid's bed is taken as flat"},
    FaultInfo{settle_mobility, "settle-mobility", "settle", "a run shows half its mobility"},
    FaultInfo{settle_limit, "settle-limit", "settle", "a run shows a limit that is one unit too low"},
    FaultInfo{settle_dead_zone, "settle-dead-zone", "settle", "a run shows a dead zone one unit too small"},
    FaultInfo{settle_shut, "settle-shut", "settle", "a shut run is not told that it is shut"},
    FaultInfo{settle_roof, "settle-roof", "settle", "a full run without a ceiling is shut"},
    FaultInfo{settle_slack, "settle-slack", "settle",
              "a run under a ceiling is shut only if it is full to the unit"},
    FaultInfo{settle_set_lost, "settle-set-lost", "settle", "a place is set no more behind settle"},
    FaultInfo{viscous_dead_zone, "viscous-dead-zone", "spread", "a difference inside the dead zone flows"},
    FaultInfo{viscous_shut, "viscous-shut", "spread", "two shut runs flow into each other"},
    FaultInfo{viscous_set_gives, "viscous-set-gives", "spread", "liquid flows out of a set cell"},
    FaultInfo{viscous_dither, "viscous-dither", "spread", "an axis uses the dither of the next one"},
    FaultInfo{viscous_slope, "viscous-slope", "spread", "a pair on a slope flows as on a level bed"},
    FaultInfo{viscous_mean, "viscous-mean", "spread",
              "between level beds the giver's amount alone counts, not the mean"},
    FaultInfo{viscous_substep, "viscous-substep", "spread",
              "a pair uses the dither of the next sub-step (needs two)"},
    FaultInfo{viscous_layer, "viscous-layer", "spread", "a layer uses the dither of the next one"},
    FaultInfo{viscous_flow_lost, "viscous-flow-lost", "spread", "a flow leaves its cell and never arrives"},
    FaultInfo{viscous_side_missed, "viscous-side-missed", "spread",
              "the end of the grid does not count as a side"},
    FaultInfo{viscous_run_forgotten, "viscous-run-forgotten", "spread", "a cell forgets that it is in a run"},
    // Faults of tiles strike in grids that are cut (hw.tile).
    FaultInfo{tile_vent, "tile-vent", "source",
              "a vent or drain takes coordinates in the tile for those in the grid (needs hw.tile)"},
    FaultInfo{tile_coordinate, "tile-coordinate", "pattern",
              "random bits go by the cell's place in the tile, not in the grid (needs hw.tile)"},
    FaultInfo{tile_halo_narrow, "tile-halo-narrow", "reader",
              "the halo of a tile is one column too narrow (needs hw.tile)"},
    FaultInfo{tile_halo_stale, "tile-halo-stale", "reader",
              "a tile begins before its halo has been written (needs hw.tile)"},
    FaultInfo{tile_overwritten, "tile-overwritten", "writer",
              "a tile writes a cell of its halo over that of the owner (needs hw.tile)"},
    FaultInfo{tile_counted_twice, "tile-counted-twice", "writer",
              "a cell of a halo is counted in the sums of a pass, too (needs hw.tile)"},
    FaultInfo{feed_early, "feed-early", "feed",
              "a count of dark tokens is one too small: irradiance comes a token too early"},
    FaultInfo{feed_mask, "feed-mask", "feed", "a mask of irradiance is shifted by a lane (needs two lanes)"},
    FaultInfo{feed_word_lost, "feed-word-lost", "feed", "a feed takes one word too few for a token"},
    // Faults of the code strike with hw.coded.
    FaultInfo{code_lane_missed, "code-lane-missed", "writer",
              "a token is left out as air, though its last lane holds something (needs hw.coded)"},
    FaultInfo{code_bit_moved, "code-bit-moved", "writer",
              "the bits that tell which tokens are stored change places (needs hw.coded)"},
    FaultInfo{code_token_lost, "code-token-lost", "writer",
              "a stored token takes the place of the one before it (needs hw.coded)"},
    FaultInfo{code_bit_early, "code-bit-early", "reader",
              "the reader takes the bit of the next token (needs hw.coded)"},
    FaultInfo{buffer_bit, "buffer-bit", "plane memory", "a bit of an amount flips in the first plane memory"},
    FaultInfo{fifo_overwrite, "fifo-overwrite", "channel",
              "a channel's write pointer stands still: a token takes the place of the one before it (needs "
              "stalls)"},
    FaultInfo{fifo_stale, "fifo-stale", "channel", "a channel stores the token before once more"},
    FaultInfo{fifo_swap_lanes, "fifo-swap-lanes", "channel", "the lanes of a token are rotated"},
    FaultInfo{fifo_never_ready, "fifo-never-ready", "channel",
              "a channel is never ready again: everything hangs"},
};

static_assert(check::lists_all(kFaults), "a row for each fault, in the order of the enumerators");

}  // namespace

std::span<const FaultInfo> all_faults() { return kFaults; }

const FaultInfo* find_fault(std::string_view name) { return check::find_fault(all_faults(), name); }

}  // namespace voxmelt::hwmodel
