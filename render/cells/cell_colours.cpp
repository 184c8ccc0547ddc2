#include "render/cells/cell_colours.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/automaton/rule/materials.h"

namespace voxmelt::render {
namespace {

constexpr std::array<ColourMark, 3> kPhases{
    {{"solid", {107, 118, 130}}, {"liquid", {198, 91, 43}}, {"inert", {201, 180, 143}}}};

// The scale is matplotlib's plasma. Equal steps of temperature look equally large.
constexpr std::size_t kSteps = 4;
constexpr std::array<ColourMark, kSteps + 2> kTemperatures{{{"0", {13, 8, 135}},
                                                            {"0.25", {126, 3, 168}},
                                                            {"0.5", {204, 71, 120}},
                                                            {"0.75", {248, 149, 64}},
                                                            {"1", {240, 249, 33}},
                                                            {"none", {170, 170, 170}}}};

constexpr std::array<ColourMark, 2> kSleep{{{"asleep", {70, 96, 150}}, {"awake", {240, 168, 40}}}};

Rgb on_the_scale(std::int32_t temperature) {
  const auto place = static_cast<std::size_t>(temperature) * kSteps;
  const std::size_t step = place / rule::kTemperatureMax, part = place % rule::kTemperatureMax;
  const Rgb from = kTemperatures[step].colour, to = kTemperatures[step + 1].colour;
  Rgb mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i)
    mixed[i] = static_cast<std::uint8_t>(
        (from[i] * (rule::kTemperatureMax - part) + to[i] * part + rule::kTemperatureMax / 2) /
        rule::kTemperatureMax);
  return mixed;
}

}  // namespace

std::span<const ColourMark> marks_of(CellColours colours) {
  if (colours == CellColours::temperature) return kTemperatures;
  if (colours == CellColours::sleep) return kSleep;
  return kPhases;
}

ColourOf by_phase(const state::Volume& volume) {
  return [&volume](const CellIndex& c) {
    const std::size_t phase = volume.solid.test(c[0], c[1], c[2])    ? 0
                              : volume.liquid.test(c[0], c[1], c[2]) ? 1
                                                                     : 2;
    return kPhases[phase].colour;
  };
}

ColourOf by_temperature(const state::Volume& volume, const rule::Parameters& parameters) {
  return [&volume, materials = rule::Materials(parameters)](const CellIndex& c) {
    const state::Slot at = volume.at(c[0], c[1], c[2]);
    const std::int32_t heat = volume.heat[at];
    if (heat == 0 && volume.inert.test(c[0], c[1], c[2])) return kTemperatures.back().colour;
    return on_the_scale(materials.temperature(heat, volume.material.empty() ? 0 : volume.material[at]));
  };
}

ColourOf by_sleep(step::AwakeTiles awake) {
  return [awake = std::move(awake)](const CellIndex& c) {
    return kSleep[awake.test(c[0], c[1], c[2]) ? 1 : 0].colour;
  };
}

}  // namespace voxmelt::render
