// Each block of the pipeline has a kind, and belongs to a phase of a step or to none. The names are for
// people.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "kernel/automaton/step/phase.h"

namespace voxmelt::hwmodel {

// The kinds stand in the order of the stream. Reader, writer and feeds are no stages of a time step, but are
// reported like them.
enum class StageKind : std::uint8_t {
  reader,
  fall,  // of pieces; before all phases
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
  feed,       // irradiance
  fall_feed,  // which cells fall
  writer,
};

struct StageKindInfo {
  std::string_view name;
  std::optional<step::Phase> phase;  // none for reader, feeds and writer, and for what precedes all phases
};

// A value that is no enumerator has no name.
constexpr StageKindInfo info_of(StageKind kind) {
  using enum StageKind;
  using step::Phase;
  switch (kind) {
    case reader:
      return {"reader", {}};
    case fall:
      return {"fall", {}};
    case source:
      return {"source", Phase::source};
    case conduction:
      return {"conduction", Phase::heat};
    case edges:
      return {"edges", Phase::heat};
    case corners:
      return {"corners", Phase::heat};
    case convection:
      return {"convection", Phase::heat};
    case exchange:
      return {"exchange", Phase::heat};
    case melt:
      return {"melt", Phase::melt};
    case walls:
      return {"walls", Phase::gravity};
    case gravity:
      return {"gravity", Phase::gravity};
    case pattern:
      return {"pattern", Phase::spread};
    case apply:
      return {"apply", Phase::spread};
    case settle:
      return {"settle", Phase::excess};
    case viscous_spread:
      return {"spread", Phase::spread};
    case feed:
      return {"feed", {}};
    case fall_feed:
      return {"fall feed", {}};
    case writer:
      return {"writer", {}};
  }
  return {};
}

constexpr std::string_view name_of(StageKind kind) { return info_of(kind).name; }
constexpr std::optional<step::Phase> phase_of(StageKind kind) { return info_of(kind).phase; }

constexpr bool is_feed(StageKind kind) { return kind == StageKind::feed || kind == StageKind::fall_feed; }
// Returns true for a stage of a time step.
constexpr bool is_stage(StageKind kind) { return kind == StageKind::fall || phase_of(kind).has_value(); }

constexpr std::string_view name_of(step::Phase phase) { return step::kPhaseNames[step::index_of(phase)]; }
constexpr std::string_view name_of(std::optional<step::Phase> phase) {
  return phase ? name_of(*phase) : std::string_view{};
}

}  // namespace voxmelt::hwmodel
