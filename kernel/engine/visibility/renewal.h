// The renewal of some rows finds rays to cast, and cells whose irradiance may be another one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/visibility/lit_cells.h"
#include "kernel/engine/visibility/ray_batch.h"

namespace voxmelt::visibility {

// Tells if a ray's fate is known. A ray that sees goes on to see. One that met a cell stays dark while that
// cell is opaque.
inline bool known(const Opaque& opaque, Fate fate) {
  const bool met = fate < kNone;  // no branch, because nothing foretells it
  return (met & opaque.holds(met ? fate : 0)) | (!met & (fate != kDark));
}

struct Renewal {
  struct Stale {
    std::size_t source, cell, fate;  // a cell whose value must be found, and the first of its fates
  };

  Renewal(const Caster& caster, const Opaque& opaque) : batch(caster, opaque) {}

  void touch(const LitCells& cells) {
    for (const Lit& lit : cells.cells) touched.push_back(lit.place);
  }

  // Returns the places of the fates that are not known, until the next call. Every call of the provider looks
  // at all fates, so this loop is short.
  const std::vector<std::uint32_t>& find_unknown(const Opaque& opaque, const std::vector<Fate>& fates) {
    unknown.resize(fates.size() + 1);
    std::size_t count = 0;
    for (std::size_t at = 0; at < fates.size(); ++at) {
      unknown[count] = static_cast<std::uint32_t>(at);
      count += known(opaque, fates[at]) ? 0 : 1;
    }
    unknown.resize(count);
    return unknown;
  }

  RayBatch batch;
  std::vector<Stale> stale;
  std::vector<std::uint32_t> touched;  // places of cells
  std::vector<std::uint32_t> unknown;  // working memory
};

}  // namespace voxmelt::visibility
