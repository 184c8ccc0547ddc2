// Excess under the viscous law, and the numbers of sub-steps and stages, follow docs/automaton.md section 10.
#include "state.h"

#include <string>
#include <vector>

namespace oracle {
namespace {

// Returns `part` of section 10 for a solid cell: how much of it its heat has left unmelted, in 1/ONE.
Int unmelted_part(const State& state, const Cell& cell) {
  const Material& material = state.material(cell);
  const Int W = larger(material.latent_heat, ONE);
  Int power = 1;  // 2^k
  while (W * power * 2 < 65536) power *= 2;
  const Int w = W * power;
  const Int lack = state.parameters.heat.enabled ? smaller(W, larger(0, material.F - cell.heat)) : W;
  const Int scale = ((Int{1} << 28) + w - 1) / w;
  return (power * lack * scale) >> 16;
}

// Returns b of the cell (x, y, z), which is blocked or the border.
Int bed_offset(const State& state, Int x, Int y, Int z) {
  if (!state.inside(x, y, z)) return FLAT;
  const Cell& cell = state.cells[state.index(x, y, z)];
  if (cell.inert == 1) return cell.amount;
  return ((smaller(cell.amount, 6143) * unmelted_part(state, cell)) >> 12) - 2048;
}

// Returns the height of the surface below the cell (x, y, z), in 1/512 cell.
Int bed_of(const State& state, Int x, Int y, Int z) {
  return 512 * y + ((bed_offset(state, x, y - 1, z) - FLAT) >> 3);
}

// Returns the number of cells of the run that starts at y0.
Int run_length(const State& state, Int x, Int y0, Int z) {
  Int n = 0;
  Int mass = 0;
  for (;;) {
    const Int last = state.cells[state.index(x, y0 + n, z)].amount;
    mass += last;
    ++n;
    if (state.blocked(x, y0 + n, z)) return n;
    const Int next = state.cells[state.index(x, y0 + n, z)].amount;
    if (mass <= n * ONE && !(last >= ONE / 2 && next > 0)) return n;
  }
}

// Holds a run before it settles.
struct Unsettled {
  std::vector<Int> cells;  // their indices, upwards
  Int bed = 0;
  Int M = 0;
  Int over = 0;
  bool shut = false;
  Sum products = 0;  // sum of a h

  Int mean_heat() const { return static_cast<Int>(products / M); }
};

Unsettled find_run(const State& state, Int x, Int y0, Int z) {
  Unsettled run;
  run.bed = bed_of(state, x, y0, z);
  const Int n = run_length(state, x, y0, z);
  for (Int k = 0; k < n; ++k) {
    const Int i = state.index(x, y0 + k, z);
    run.cells.push_back(i);
    run.M += state.cells[i].amount;
    run.products += state.cells[i].amount * state.cells[i].heat;
  }
  const Int excess = run.M - n * ONE;
  run.over = larger(0, excess);
  run.shut = state.blocked(x, y0 + n, z) && larger(excess, -excess) <= ONE / 64;
  return run;
}

// Calls action(run) for every run, in each column upwards. The action may settle it.
template <typename Action>
void for_each_run(const State& state, Action action) {
  for (const Column& column : columns_with_liquid(state)) {
    for (Int y = column.low; y <= column.high; ++y) {
      const Int i = state.index(column.x, y, column.z);
      if (state.blocked(i) || state.cells[i].amount == 0) continue;
      if (!state.blocked(column.x, y - 1, column.z)) continue;
      const Unsettled run = find_run(state, column.x, y, column.z);
      action(run);
      y += static_cast<Int>(run.cells.size()) - 1;
    }
  }
}

// Holds what thermal viscosity multiplies by: e 2^n / 4096.
struct PowerOfTwo {
  Int n, e;
};

// Returns the power of two for a run of the mean heat h.
PowerOfTwo thermal_factor(const Parameters& parameters, Int h) {
  const Int wanted = ((h - parameters.mobility_reference) * parameters.mobility_rate) >> 6;
  const Int x = clamp(wanted, -(Int{1} << 21), (Int{1} << 19) - 1);  // in 1/65536 octave
  const Int n = x >> 16;
  const Int f = x - 65536 * n;  // x mod 65536, not negative
  return {n, 4096 + ((f * (43057 + ((22479 * f) >> 16))) >> 20)};
}

// Returns `raw` in 1/2^24. The first product takes 64 bits without a sign, the second one 53.
Int raw_mobility(const Parameters& parameters, const Unsettled& run, Int pace) {
  const Int M = smaller(run.M, 262144);
  const Int raw = static_cast<Int>((Sum{pace} * (M * M >> 8) + (Sum{1} << 23)) >> 24);
  if (!parameters.thermal_viscosity) return raw;
  const PowerOfTwo factor = thermal_factor(parameters, run.mean_heat());
  return (raw * factor.e) >> (12 - factor.n);
}

// Returns `limit` in 1/2^(16 - bits).
Int limit_of(const Parameters& parameters, const Unsettled& run, const Stages& stages) {
  Int limit = 13107 / ((run.M >> 12) + 1);
  if (run.over > 0) limit /= parameters.viscous.stiffness;
  return larger(1, (limit * stages.reach) >> stages.bits);
}

// Returns what the cells of a run show, `cells` of which are in the run after this settle.
Run shown_by_run(const State& state, const Unsettled& run, Int cells) {
  const Parameters& parameters = state.parameters;
  const ViscousFlow& viscous = parameters.viscous;
  const Int K = state.substeps;
  const Int raw = raw_mobility(parameters, run, (viscous.mobility + K / 2) / K);
  const Int limit = limit_of(parameters, run, state.stages);
  const Int most = limit << (8 + state.stages.bits);
  const Int depth = larger(1, run.M >> 4);
  Run shown;
  shown.member = 1;
  shown.cells = cells;
  shown.shut = run.shut;
  shown.bed = run.bed;
  shown.head = run.bed + (run.M >> 3) + (viscous.stiffness - 1) * (run.over >> 3);
  shown.limit = limit;
  shown.limited = raw > most;
  shown.mobility = smaller(raw, most);
  shown.exposed = smaller(raw, Int{1} << 21);
  shown.dead = larger(1, (2 * viscous.yield + depth / 2) / depth);
  return shown;
}

// Holds the flows through the inner faces of a run. Face k lies above cell k.
struct FaceFlows {
  bool keep_order = false;
  std::vector<Int> up, down;
};

// Returns the flows that settle a run, and tells if they are to be used.
FaceFlows face_flows(const State& state, const Unsettled& run) {
  FaceFlows flows;
  flows.keep_order = run.over == 0;
  Int P = 0;
  for (Int k = 0; k + 1 < static_cast<Int>(run.cells.size()); ++k) {
    P += state.cells[run.cells[k]].amount;
    const Int excess = P - (k + 1) * ONE;
    if (excess < -(AMAX - ONE) || excess > AMAX - ONE) flows.keep_order = false;
    flows.up.push_back(larger(0, excess));
    flows.down.push_back(larger(0, smaller((k + 1) * ONE, run.M) - P));
  }
  return flows;
}

// Checks a promise of docs/proofs.md: no giver lacks what it gives, and no receiver holds more than AMAX.
void move_through_face(State& state, Int from, Int to, Int f) {
  if (f == 0) return;
  Cell& giver = state.cells[from];
  Cell& receiver = state.cells[to];
  if (f > giver.amount || f > AMAX - receiver.amount)
    throw Violation("step " + std::to_string(state.step) + ": a flow of " + std::to_string(f) +
                    " inside a run, from cell " + std::to_string(from) + " to cell " + std::to_string(to));
  mix_heat(state, receiver, giver, f);
  giver.amount -= f;
  receiver.amount += f;
}

void move_through_faces(State& state, const std::vector<Int>& cells, const FaceFlows& flows) {
  const Int faces = static_cast<Int>(flows.up.size());
  for (Int k = 0; k < faces; ++k) move_through_face(state, cells[k], cells[k + 1], flows.up[k]);
  for (Int k = faces - 1; k >= 0; --k) move_through_face(state, cells[k + 1], cells[k], flows.down[k]);
}

// Gives all cells of a run one heat.
void mix_all(State& state, const Unsettled& run) {
  if (!state.parameters.heat.enabled) return;
  const Int h = mixed(static_cast<Int>(run.products), run.M, state.mixture_offset);
  for (const Int i : run.cells) state.cells[i].heat = h;
  state.ledgers.heat.rounded += Sum{run.M} * h - run.products;
}

// Returns the amounts of a run once it has settled, upwards.
std::vector<Int> settled_amounts(const Unsettled& run) {
  const Int n = static_cast<Int>(run.cells.size());
  std::vector<Int> amounts;
  for (Int k = 0; k < n; ++k)
    amounts.push_back(clamp(run.M - k * ONE, 0, ONE) +
                      clamp(run.over - (AMAX - ONE) * (n - 1 - k), 0, AMAX - ONE));
  return amounts;
}

void count(Counters& counters, const Run& shown, Int M) {
  counters.cells += shown.cells;
  counters.mass += M;
  if (!shown.limited) return;
  counters.limited_cells += shown.cells;
  counters.limited_mass += M;
}

void count_bed(State& state, const Unsettled& run) {
  const Place p = state.place(run.cells[0]);
  if (p.y == 0) return;
  const Cell& below = state.cells[state.index(p.x, p.y - 1, p.z)];
  if (below.material == 0) return;
  ++state.material_counts.beds;
  if (unmelted_part(state, below) < ONE) ++state.material_counts.molten_beds;
}

void settle_run(State& state, const Unsettled& run) {
  count_bed(state, run);
  const FaceFlows flows = face_flows(state, run);
  if (flows.keep_order)
    move_through_faces(state, run.cells, flows);
  else
    mix_all(state, run);
  const std::vector<Int> amounts = settled_amounts(run);
  Int held = 0;
  for (const Int amount : amounts)
    if (amount > 0) ++held;
  const Run shown = shown_by_run(state, run, held);
  for (Int k = 0; k < static_cast<Int>(run.cells.size()); ++k) {
    Cell& cell = state.cells[run.cells[k]];
    if (flows.keep_order && cell.amount != amounts[k])
      throw Violation("step " + std::to_string(state.step) + ": cell " + std::to_string(run.cells[k]) +
                      " of a run in order holds " + std::to_string(cell.amount) + ", not " +
                      std::to_string(amounts[k]));
    cell.amount = amounts[k];
    state.touch(run.cells[k]);
    if (amounts[k] > 0) state.runs[run.cells[k]] = shown;
  }
  count(state.counters, shown, run.M);
}

// Returns N, the most sub-steps that a run needs with one stage.
Int needed_substeps(const State& state) {
  const Parameters& parameters = state.parameters;
  Int most = 1;
  for_each_run(state, [&](const Unsettled& run) {
    const Int raw = raw_mobility(parameters, run, parameters.viscous.mobility);
    const Int unit = 256 * limit_of(parameters, run, Stages{});
    most = larger(most, (raw + unit - 1) / unit);
  });
  return most;
}

// Returns the least stages whose reach is `wanted` or more, but at most `most` of them.
Stages stages_for(Int wanted, Int most) {
  Stages stages;
  while (stages.S < most && stages.reach < wanted) {
    ++stages.S;
    stages.reach += stages.S;
  }
  while (stages.reach > Int{1} << stages.bits) ++stages.bits;
  return stages;
}

}  // namespace

void count_substeps(State& state) {
  const ViscousFlow& viscous = state.parameters.viscous;
  const Int N = needed_substeps(state);
  const Int K = viscous.substeps > 0 ? viscous.substeps : smaller(N, viscous.substeps_max);
  state.substeps = K;
  state.stages = stages_for((N + K - 1) / K, viscous.stages_max);
}

void settle(State& state) {
  for (const Int i : state.list) state.runs[i] = Run{};
  for_each_run(state, [&](const Unsettled& run) { settle_run(state, run); });
  finish_phase(state, "after excess");
}

// Outside runs `exposed` and `dead` are not used: only a cell in a run gives. And no cell there is shut.
Run shown_by(const State& state, Int x, Int y, Int z) {
  const Run& own = state.runs[state.index(x, y, z)];
  if (own.member == 1) return own;
  Run shown;
  if (state.blocked(x, y - 1, z)) {
    shown.head = bed_of(state, x, y, z);
    shown.bed = shown.head;
    return shown;
  }
  const Run& below = state.runs[state.index(x, y - 1, z)];
  if (below.member == 1) {
    shown.head = below.head;
    shown.bed = below.bed;
    shown.limit = below.limit;
    shown.mobility = below.mobility;
    return shown;
  }
  shown.head = 512 * (y - 2);
  return shown;
}

}  // namespace oracle
