// The watch finds what goes wrong in a run without any error, and says it at the end.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/run/simulation.h"

namespace voxmelt::app {

class Watch {
 public:
  // Holds what it has seen: the amount of such a cell, or two cells.
  struct Seen {
    int largest = 0;
    int x = 0, y = 0, z = 0;
    std::uint32_t step = 0;
  };
  Watch() = default;
  explicit Watch(const Seen& seen) : seen_(seen) {}  // seen by an earlier part of the run
  const Seen& seen() const { return seen_; }

  // Looks for liquid that is compressed in the open: more than two cells in one, and nothing above it but the
  // border. If a vent brings more than flows away, its column reaches the top of the grid and fills up.
  void look(const state::Volume& volume, std::uint32_t step);
  // Tells if a look may find more. `largest` is the amount of such a cell, or less than two cells if there is
  // none. It is nothing if nobody knows.
  bool may_find(std::optional<std::int32_t> largest) const;

  std::vector<std::string> warnings(const run::Simulation& simulation) const;

 private:
  Seen seen_;
};

}  // namespace voxmelt::app
