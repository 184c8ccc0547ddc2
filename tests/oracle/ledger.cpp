// The ledgers follow docs/automaton.md section 12.
#include "ledger.h"

#include "state.h"

#include <algorithm>
#include <initializer_list>

namespace oracle {
namespace {

struct Held {
  Sum mass = 0, energy = 0, heat = 0;
};

Held held_by(const State& state) {
  Held held;
  for (const Cell& cell : state.cells) {
    if (cell.solid == 0 && cell.liquid == 0) continue;
    held.mass += cell.amount;
    held.energy += cell.energy;
    held.heat += Sum{cell.amount} * cell.heat;
  }
  return held;
}

std::string decimal(Sum value) {
  if (value < 0) return "-" + decimal(-value);
  std::string digits;
  do {
    digits += static_cast<char>('0' + static_cast<int>(value % 10));
    value /= 10;
  } while (value > 0);
  std::reverse(digits.begin(), digits.end());
  return digits;
}

std::string line(const std::string& name, std::initializer_list<Sum> numbers) {
  std::string text = name;
  for (const Sum number : numbers) text += " " + decimal(number);
  return text + "\n";
}

}  // namespace

void open_ledgers(State& state) {
  const Held held = held_by(state);
  state.ledgers.mass.start = held.mass;
  state.ledgers.energy.start = held.energy;
  state.ledgers.heat.start = held.heat;
}

void close_ledgers(State& state) {
  const Held held = held_by(state);
  state.ledgers.mass.held = held.mass;
  state.ledgers.energy.held = held.energy;
  state.ledgers.heat.held = held.heat;
}

std::string ledger_lines(const Ledgers& ledgers) {
  const MassLedger& m = ledgers.mass;
  const EnergyLedger& e = ledgers.energy;
  const HeatLedger& h = ledgers.heat;
  return line("ledger mass", {m.start, m.added, m.removed, m.held}) +
         line("ledger energy", {e.start, e.melted, e.frozen, e.added, e.removed, e.reheated, e.accelerated,
                                e.dissipated, e.capped, e.held}) +
         line("ledger heat", {h.start, h.conducted, h.walls, h.convected, h.radiated, h.warmed, h.cooled,
                              h.melted, h.added, h.removed, h.rounded, h.held});
}

std::string counters_line(const Counters& counters) {
  return line("counters", {counters.cells, counters.mass, counters.limited_cells, counters.limited_mass});
}

std::string pairs_line(const PairCounts& counts) {
  return line("pairs", {counts.relaxed, counts.back, counts.shut});
}

std::string pieces_line(const PieceCounts& counts) {
  return line("pieces", {counts.falls, counts.wades, counts.floats});
}

std::string freeze_line(const FreezeCounts& counts) {
  return line("freeze",
              {counts.frozen, counts.set, counts.kept, counts.hung, counts.not_back, counts.melted_again});
}

std::string materials_line(const MaterialCounts& counts) {
  return line("materials",
              {counts.pairs, counts.walls, counts.bound, counts.raised, counts.kept, counts.lowered,
               counts.cut, counts.beds, counts.molten_beds, counts.moved, counts.aired});
}

Sum mass_held(const State& state) { return held_by(state).mass; }

}  // namespace oracle
