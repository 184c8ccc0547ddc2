// The rules of a scene depend on its state and on these parameters alone. All numbers are integers, resolved
// once from the scene file. `voxmelt export` writes exactly these as parameters.json (docs/automaton.md,
// "Parameters"). The functions derive what follows from the parameters alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::rule {

enum class Law : std::uint8_t { paper, viscous };
enum class EnergyReading : std::uint8_t { text, printed };

// Positions and radii of sources are in sixteenths of a cell. The centre of cell c is 16 c + 8.
inline constexpr std::int64_t kPositionUnit = 16;

struct Position {
  std::int64_t x = 0, y = 0, z = 0;
};

// Returns the place of an enumerator in a table that has a row for each, in their order.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::size_t index_of(Enum one) { return static_cast<std::size_t>(one); }

enum class SourceKind : std::uint8_t { point, sphere, directional, sky };

// Gives the name of a kind in scenes and exports, and the keys that it has beside step and power.
struct SourceKindRow {
  SourceKind kind;
  std::string_view name;
  bool at = false, radius = false, direction = false;
};
// The rows are in the order of SourceKind. A source without a kind is of the first one. Their rays are in
// source_kinds.h.
inline constexpr std::array kSourceKinds{
    SourceKindRow{.kind = SourceKind::point, .name = "point", .at = true},
    SourceKindRow{.kind = SourceKind::sphere, .name = "sphere", .at = true, .radius = true},
    SourceKindRow{.kind = SourceKind::directional, .name = "directional", .direction = true},
    SourceKindRow{.kind = SourceKind::sky, .name = "sky"},
};
constexpr const SourceKindRow& row_of(SourceKind kind) { return kSourceKinds[index_of(kind)]; }

// Between two keys, all numbers of a source change linearly in the step. Numbers that its kind lacks are 0.
struct SourceKey {
  std::uint32_t step = 0;
  Position at{};
  // Is the irradiance x squared distance: 1/16 temperature unit per step x (1/16 cell)^2. For a sun or a sky
  // it is the irradiance of a face turned to it, x 256.
  std::uint64_t power = 0;
  std::int64_t radius = 0;
  Position direction{};  // points towards a directional source, any length
};

struct HeatSource {
  std::vector<SourceKey> keys;  // at least one, ascending in step
  SourceKind kind = SourceKind::point;
};

struct Heat {
  bool enabled = false;
  int neighbours = 6;               // in Eq. 1: 6, 18 or 26
  std::uint16_t weight_face = 0;    // floor(65536 gamma / (pi l^2)), l = 1
  std::uint16_t weight_edge = 0;    // l^2 = 2
  std::uint16_t weight_corner = 0;  // l^2 = 3
  std::uint16_t convection = 0;     // upward exchange in liquid, 1/65536, at most 32767; 0 is off
  bool walls = false;               // isothermal walls: inert cells whose heat is not 0
  bool radiation = false;           // heat sources present
  std::uint32_t visibility_every = 8;
  int rays_per_face = 1;       // 1, 4 or 16: from the centres of equal squares
  std::uint64_t ray_seed = 1;  // the scene's seed, for the places where rays end
  std::vector<HeatSource> sources;
  bool air = false;                          // exchange with moving air at exposed cells (oven, or cooling)
  std::uint16_t air_exchange = 0;            // 1/65536 per step and unit area, at most 43690
  std::vector<Temperature> air_temperature;  // one per y
  // Exposed cells glow, too: 1/65536 of the range of heat per step and unit area at the highest temperature.
  std::uint16_t air_glow = 0;  // at most 10922
  Temperature air_sky = 0;     // temperature of what they glow at

  VOXMELT_RULE bool radiates() const { return enabled && radiation; }
  // Returns how many steps ago the irradiance of this step was computed. It is 0 if nothing radiates.
  VOXMELT_RULE std::uint32_t visibility_age(std::uint32_t step) const {
    return radiates() ? step % visibility_every : 0;
  }
  // Tells if the irradiance is computed anew before this step.
  VOXMELT_RULE bool is_visibility_step(std::uint32_t step) const {
    return radiates() && visibility_age(step) == 0;
  }
};

struct Material {
  Temperature melting_point = 32768;
  Temperature latent_heat = 0;     // extra `latent_heat`: temperature units absorbed at the melting point
  Temperature freezing_point = 0;  // extra `freezing`: colder liquid freezes or sets; 0 is off
};

struct Region {  // all cells whose centre is within radius
  Position at;
  std::int64_t radius = 0;
};

struct Vent {
  Region region;
  Amount rate = 0;  // added per cell and step
  Temperature temperature = 0;
  Energy energy = 4096;                         // per kOne of amount
  std::uint32_t from = 0, until = 0xFFFFFFFFu;  // open while from <= step < until
};

struct Drain {
  Region region;
  Amount rate = 0;
  std::uint32_t from = 0, until = 0xFFFFFFFFu;
};

// Vertical motion is alike in both laws: a cell gives min(A, (A x factor >> 16) + minimum). A factor of 65536
// gives all.
struct Fall {
  std::uint32_t factor = 65536;       // free air
  std::uint32_t wall_factor = 65536;  // extra `adhesion`: one of the four sides is blocked
  Amount minimum = 32;                // a smaller amount moves whole
  Amount hang = 0;                    // extra `drip`: an overhanging film below this amount waits; 0 is off

  // Tells if the outflow of a cell depends on what stands beside it.
  VOXMELT_RULE bool sees_sides() const { return hang > 0 || wall_factor != factor; }
  // Tells if every cell gives all that it holds.
  VOXMELT_RULE bool is_free() const { return factor == 65536 && !sees_sides(); }
};

// Spreading is bounded by the number of neighbours (docs/proofs.md, "Amounts stay in 0..AMAX"). Nothing gives
// more than it has: with 8 neighbours a cell gives 4 shares and, to its diagonals, 4 quarters of one.
VOXMELT_RULE std::int32_t most_shares(int neighbours) { return neighbours == 8 ? 5 : 4; }
VOXMELT_RULE std::int32_t largest_share(int neighbours) { return 65536 / most_shares(neighbours); }
// Nothing overflows. With 8 neighbours a receiver below 11 takes at most 4 x 1 + 4 x 1/4. With 4 neighbours
// one below 8 takes at most 4 x 2.
VOXMELT_RULE std::int32_t flow_cap(int neighbours) { return neighbours == 8 ? kOne : 2 * kOne; }
VOXMELT_RULE std::int32_t receiver_limit(int neighbours) { return (neighbours == 8 ? 11 : 8) * kOne; }

struct PaperLaw {
  int neighbours = 8;           // 4 or 8 (8 is the extra `diagonal`)
  std::uint16_t threshold = 0;  // energy above which a cell spreads (Eqs. 7-10)
  bool use_table = false;       // factors per pattern (paper, 4 neighbours) instead of one share
  std::array<std::array<std::uint16_t, 4>, 16> table{};  // [pattern][direction], 1/65536
  std::uint16_t share = 8192;                            // 1/65536 of the amount per axis direction
  bool downhill = true;  // neighbours receive only if they hold less than the giver
  Amount margin = 256;   // less by more than this
  bool support = false;  // extra `support`: only cells that stand on something spread
  Amount slump = 0;      // extra `slump`: margin at which a starved cell still yields; 0 is off
  EnergyReading reading = EnergyReading::text;
  std::uint32_t beta = 65536;                                                    // Eqs. 5, 6; 1/65536
  std::uint16_t alpha_liquid = 65535, alpha_solid = 65535, alpha_floor = 65535;  // Eqs. 16-20; 1/65536
  std::uint16_t reheat = 0;  // extra `reheat`: (A - E) x reheat / 65536 at or above the melting point
};

struct ViscousLaw {
  std::uint64_t mobility = 0;  // kq = (2/3)(kappa/3), 1/2^32: docs/automaton.md, section 10
  std::uint32_t yield = 0;     // yield stress: depth x head difference that rests, 1/65536
  std::uint8_t stiffness = 8;  // K: 1..8, of closed conduits
  // The law settles and spreads so often in a step, 1..1024. With 0 it is as often as the state needs.
  std::uint16_t substeps = 1;
  std::uint16_t substeps_max = 1024;  // upper bound if `substeps` is 0
  std::uint16_t stages_max = 1;       // upper bound of the stages by which heads relax, 1..16; 1 is off

  bool counts_substeps() const { return substeps == 0; }
  bool relaxes() const { return stages_max > 1; }
};

struct Flow {
  Law law = Law::paper;
  Fall fall;
  PaperLaw paper;
  ViscousLaw viscous;
  bool thermal_viscosity = false;                  // extra: mobility or share times the table / 32768
  std::array<std::uint16_t, 32> mobility_table{};  // of the paper's law, by T >> 11; 32768 is 1
  std::uint16_t mobility_reference = 0;            // of the viscous law: temperature at which it is 1
  std::uint16_t mobility_rate = 0;                 // 1/64 octave over the range of temperatures
};

// One of the materials that solids may be of, with the weights of its pairs with the others. The first one is
// that of all liquid: it has the numbers of Material and of Heat.
inline constexpr int kMostMaterials = 16;
inline constexpr std::uint32_t kWarmthOne = 65536;
struct SolidMaterial {
  using Weights = std::array<std::uint16_t, kMostMaterials>;
  Temperature melting_point = 0, latent_heat = 0;
  std::uint32_t warmth = kWarmthOne;  // temperature that a unit of heat gives, 1/65536: 4096..65536
  std::uint16_t air_exchange = 0;     // as in Heat
  Weights weight_face{}, weight_edge{}, weight_corner{};

  // Returns the least heat at which a solid that does not melt has a temperature.
  VOXMELT_RULE std::int64_t heat_at(Temperature temperature) const {
    return (65536 * std::int64_t{temperature} + warmth - 1) / warmth;
  }
};

// Solid pieces that nothing holds fall.
inline constexpr std::int64_t kDensityOne = 65536;
struct Pieces {
  bool fall = false;
  std::int32_t in_liquid = 1;          // steps per cell
  std::int64_t density = kDensityOne;  // over the liquid's, 1/65536; kDensityOne never floats
};

struct Parameters {
  std::uint64_t seed = 1;
  Heat heat;
  Material material;
  std::vector<SolidMaterial> materials;  // none, or 2..16
  Pieces pieces;
  std::vector<Vent> vents;
  std::vector<Drain> drains;
  bool open_border = false;  // all liquid of the outermost cells along x and z leaves, after the drains
  Flow flow;

  // Tells if cold liquid freezes, or sets and clings.
  bool freezes() const { return heat.enabled && material.freezing_point > 0; }
  // Tells if solids may be of several materials.
  VOXMELT_RULE bool has_materials() const { return !materials.empty(); }
  // Tells if the outflow of a falling cell depends on what stands beside it.
  bool falls_by_sides() const { return flow.fall.sees_sides() || freezes(); }
  // Tells if phase `source` may do anything.
  bool has_openings() const { return !vents.empty() || !drains.empty() || open_border; }
};

}  // namespace voxmelt::rule
