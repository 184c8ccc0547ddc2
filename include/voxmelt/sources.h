/// @file
/// What acts on a volume from outside: sources of heat, vents and drains, in the units and ranges of
/// scene files (docs/scenes.md). Lengths are in cells; cell c covers c..c+1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt {

/// x, y, z in cells, each -65536..65536; rounded to sixteenths.
using Position = std::array<double, 3>;

/// For an `until`: never.
inline constexpr std::uint32_t kNever = 0xFFFFFFFFu;

/// What a heat source is.
enum class HeatSourceKind : std::uint8_t {
  point,
  sphere,       ///< a ball that shines: its shadows are soft
  directional,  ///< a sun
  sky,          ///< everything above the horizon, equally bright
};
inline constexpr std::size_t kHeatSourceKinds = 4;  ///< how many kinds there are

/// Where a heat source is at a step, and how strong it is. What its kind does not have is not used.
struct Keyframe {
  std::uint32_t step = 0;  ///< number of the step
  Position at{};           ///< position of a point, centre of a sphere
  /// A surface cell at distance d that faces a point or a sphere gains power / d^2 per step, in temperature
  /// (the scene's range is 0..1). One that faces a sun, or lies open under a sky, gains power;
  /// docs/automaton.md, section 5. 0..4194303.
  double power = 0;
  double radius = 0;     ///< of a sphere, 0..8192
  Position direction{};  ///< towards a directional source, of any length but 0; each -10^6..10^6
};

/// A source of heat. Between two keyframes, all numbers change linearly in the step. Before the first and
/// after the last they are constant.
struct HeatSource {
  std::vector<Keyframe> keyframes;              ///< at least one, steps ascending
  HeatSourceKind kind = HeatSourceKind::point;  ///< what it is

  /// A point source that stays where it is.
  static HeatSource fixed(const Position& at, double power) { return {{{0, at, power}}}; }
};

/// Adds liquid to all cells that are not solid or inert and whose centre is within `radius` of `at`, at steps
/// with from <= step < until; docs/automaton.md, section 4.
struct Vent {
  Position at{};                 ///< centre
  double radius = 1;             ///< more than 0, at most 8192
  double rate = 0.1;             ///< full cells of liquid per cell and step: more than 0, at most 1
  double temperature = 0;        ///< of the liquid, 0..1
  double energy = 1;             ///< of the liquid, as a part of its amount, 0..1; the viscous law has none
  std::uint32_t from = 0;        ///< first step
  std::uint32_t until = kNever;  ///< first step after it, more than `from`
};

/// Takes liquid away, where and when a vent of the same numbers would add it.
struct Drain {
  Position at{};                 ///< centre
  double radius = 1;             ///< more than 0, at most 8192
  double rate = 0.1;             ///< full cells of liquid per cell and step: more than 0, at most 1
  std::uint32_t from = 0;        ///< first step
  std::uint32_t until = kNever;  ///< first step after it, more than `from`
};

}  // namespace voxmelt
