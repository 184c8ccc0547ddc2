// What the blocks of the pipeline are, and to which phase of a step each belongs. Their names are for people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "kernel/automaton/step/phase.h"

namespace voxmelt::hwmodel {

// In the order of the stream. Reader, writer and feed are no stages of a time step, but are reported like
// them.
enum class StageKind : std::uint8_t {
  reader,
  source,
  conduction,  // through faces; also exposed axes and sides
  edges,
  corners,
  convection,
  exchange,  // radiation and air
  melt,
  walls,  // cold paper law: sides, for gravity
  gravity,
  pattern,
  apply,
  settle,
  viscous_spread,
  feed,  // of irradiance
  writer,
};

constexpr std::string_view name_of(StageKind kind) {
  constexpr std::array<std::string_view, 16> kNames{
      "reader", "source",  "conduction", "edges", "corners", "convection", "exchange", "melt",
      "walls",  "gravity", "pattern",    "apply", "settle",  "spread",     "feed",     "writer"};
  return kNames[static_cast<std::size_t>(kind)];
}

// None for reader, feed and writer.
constexpr std::optional<step::Phase> phase_of(StageKind kind) {
  using enum StageKind;
  switch (kind) {
    case source:
      return step::Phase::source;
    case conduction:
    case edges:
    case corners:
    case convection:
    case exchange:
      return step::Phase::heat;
    case melt:
      return step::Phase::melt;
    case walls:
    case gravity:
      return step::Phase::gravity;
    case pattern:
    case apply:
    case viscous_spread:
      return step::Phase::spread;
    case settle:
      return step::Phase::excess;
    case reader:
    case feed:
    case writer:
      break;
  }
  return std::nullopt;
}

constexpr std::string_view name_of(step::Phase phase) {
  return step::kPhaseNames[static_cast<std::size_t>(phase)];
}
constexpr std::string_view name_of(std::optional<step::Phase> phase) {
  return phase ? name_of(*phase) : std::string_view{};
}

}  // namespace voxmelt::hwmodel
