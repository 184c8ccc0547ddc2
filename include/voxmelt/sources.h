/// @file
/// Sources of heat, vents and drains act on a volume from outside. Their numbers have the units and ranges of
/// scene files (docs/scenes.md). Lengths are in cells, and cell c covers c..c+1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt {

/// Holds x, y, z in cells, each -65536..65536, rounded to sixteenths.
using Position = std::array<double, 3>;

/// Stands for "never" in an `until`.
inline constexpr std::uint32_t kNever = 0xFFFFFFFFu;

/// Names the kinds of heat sources.
enum class HeatSourceKind : std::uint8_t {
  point,
  sphere,       ///< a ball that shines, with soft shadows
  directional,  ///< a sun
  sky,          ///< everything above the horizon, equally bright
};
inline constexpr std::size_t kHeatSourceKinds = 4;  ///< number of kinds

/// Tells where a heat source is at a step, and how strong it is. Numbers that its kind lacks are not used.
struct Keyframe {
  std::uint32_t step = 0;  ///< number of the step
  Position at{};           ///< position of a point, centre of a sphere
  /// A surface cell at distance d that faces a point or a sphere gains power / d^2 per step, in temperature
  /// (the scene's range is 0..1). One that faces a sun, or lies open under a sky, gains `power`
  /// (docs/automaton.md, section 5). The range is 0..4194303.
  double power = 0;
  double radius = 0;     ///< radius of a sphere, 0..8192
  Position direction{};  ///< direction towards a directional source, of any length but 0; each -10^6..10^6
};

/// Describes a source of heat. Between two keyframes, all numbers change linearly in the step. Before the
/// first and after the last they are constant.
struct HeatSource {
  std::vector<Keyframe> keyframes;              ///< at least one, steps ascending
  HeatSourceKind kind = HeatSourceKind::point;  ///< kind of source

  /// Makes a point source that stays in its place.
  static HeatSource fixed(const Position& at, double power) { return {{{0, at, power}}}; }
};

/// Adds liquid to all cells that are not solid or inert and whose centre is within `radius` of `at`. It does
/// so at steps with from <= step < until (docs/automaton.md, section 4).
struct Vent {
  Position at{};           ///< centre
  double radius = 1;       ///< more than 0, at most 8192
  double rate = 0.1;       ///< full cells of liquid per cell and step: more than 0, at most 1
  double temperature = 0;  ///< temperature of the liquid, 0..1
  double energy = 1;       ///< energy of the liquid as a part of its amount, 0..1; unused by the viscous law
  std::uint32_t from = 0;  ///< first step
  std::uint32_t until = kNever;  ///< first step after the last one, more than `from`
};

/// Takes liquid away, where and when a vent of the same numbers would add it.
struct Drain {
  Position at{};                 ///< centre
  double radius = 1;             ///< more than 0, at most 8192
  double rate = 0.1;             ///< full cells of liquid per cell and step: more than 0, at most 1
  std::uint32_t from = 0;        ///< first step
  std::uint32_t until = kNever;  ///< first step after the last one, more than `from`
};

}  // namespace voxmelt
