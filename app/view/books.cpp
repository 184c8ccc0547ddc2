#include "app/view/books.h"

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

namespace voxmelt::view {
namespace {

using json = nlohmann::ordered_json;

struct Held {
  double mass = 0, heat = 0;
};

Held held_by(const MaskView& phase, const State& state) {
  constexpr double kFullCell = 4096, kHottest = 65535;
  std::uint64_t mass = 0, heat = 0;  // a grid of 2^32 cells fits
  for (int z = 0; z < state.grid.z; ++z)
    for (int y = 0; y < state.grid.y; ++y) {
      const std::span<const std::uint64_t> words = phase.row(y, z);
      const auto amounts = state.amount.row(y, z), heats = state.heat.row(y, z);
      for (std::size_t w = 0; w < words.size(); ++w)
        for (std::uint64_t left = words[w]; left != 0; left &= left - 1) {
          const std::size_t x = 64 * w + static_cast<std::size_t>(std::countr_zero(left));
          mass += amounts[x];
          heat += std::uint64_t{amounts[x]} * heats[x];
        }
    }
  return {static_cast<double>(mass) / kFullCell, static_cast<double>(heat) / kFullCell / kHottest};
}

}  // namespace

std::string books_of(const Simulation& simulation, std::size_t kept) {
  const State state = simulation.state();
  const Held solid = held_by(state.solid, state), liquid = held_by(state.liquid, state);
  const Ledgers books = simulation.ledgers();
  return json{{"type", "books"},
              {"step", simulation.steps_done()},
              {"mass", {{"solid", solid.mass}, {"liquid", liquid.mass}}},
              {"heat", {{"solid", solid.heat}, {"liquid", liquid.heat}}},
              {"drift",
               {{"mass", to_string(books.mass.drift())},
                {"energy", to_string(books.energy.drift())},
                {"heat", to_string(books.heat.drift())}}},
              {"loose_cells", simulation.loose_cells()},
              {"kept_bytes", kept}}
      .dump();
}

}  // namespace voxmelt::view
