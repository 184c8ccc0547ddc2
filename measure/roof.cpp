#include "measure/roof.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace voxmelt::measure {
namespace {

// Prices are in operations on 16-bit lanes. Bit planes cost nothing: 16 cells fit where one amount does.
constexpr double kWideAdd = 2;     // 32 bits: two lanes
constexpr double kTerm = 3;        // a term of a ledger: a difference, summed in 32 bits
constexpr double kRoundedMul = 2;  // (a w + R) >> 16 with R > 0 needs the low half of the product as well,
constexpr double kRoundedAdd = 2;  // its sum with R, and the carry
// A quotient takes a multiply by a reciprocal that costs nothing, one back, difference, comparison,
// correction.
constexpr double kDivideMul = 2, kDivideAdd = 3;

class Counting {
 public:
  void add(std::string what, double multiplies, double others) {
    work_.multiplies += multiplies;
    work_.others += others;
    Count& count = work_.counts.emplace_back();
    count.what = std::move(what);
    count.multiplies = multiplies;
    count.others = others;
  }
  void append(const Work& other) {
    for (const Count& count : other.counts) add(count.what, count.multiplies, count.others);
  }
  // A product of 16 x 16 to 32 bits counts once: multiply-and-add instructions make a lane's worth of them.
  void mix(const std::string& where, int parts) {
    add(where + ": mix: " + std::to_string(parts) + " products amount x heat and their sum", parts,
        kWideAdd * (parts - 1) / 2.0);
    add(where + ": mix: A D >> 16, added", 1, kWideAdd);
    add(where + ": mix: division", kDivideMul, kDivideAdd);
    add(where + ": mix: ledger `rounded`", 0, kTerm);
  }
  Work bytes(double bytes, std::string text) {
    work_.bytes = bytes;
    work_.bytes_text = std::move(text);
    return work_;
  }

 private:
  Work work_;
};

// Counts every field once per step: 2 bytes for a number, 1/8 for a bit.
Work with_bytes(Counting& counting, bool energy, bool hot) {
  std::string text = "A";
  if (energy) text += ", E";
  if (hot) text += ", h";
  const double numbers = 4.0 * (1 + energy + hot);
  return counting.bytes(numbers + 0.5,
                        text + " read and written, solid and inert read, liquid read and written");
}

Work gravity_work(const rule::Parameters& p) {
  Counting c;
  const bool paper = p.flow.law == rule::Law::paper;
  c.add("gravity: a_q > 0, a_p < ONE", 0, 2);
  if (p.flow.fall.factor < 65536 || p.flow.fall.wall_factor < 65536)
    c.add("gravity: factor or wall factor, (a_q g) >> 16, + minimum, min", 1, 3);
  if (p.flow.fall.hang > 0) c.add("gravity: a_q < hang, what is ready then", 0, 2);
  c.add("gravity: f = min(ready, ONE - a_p) where it may fall; moved", 0, 5);
  if (paper) {
    c.add("gravity: or up: a_p > ONE (instead of down, at about the same price)", 0, 1);
    c.add("gravity: m = min(E_q, f), room, min(b, room), moved, E_q cut", 0, 6);
    if (p.flow.paper.beta != 65536) c.add("gravity: b = (m beta) >> 16", 1, 0);
    c.add("gravity: ledgers `accelerated`, `capped`", 0, 2 * kTerm);
  }
  if (p.heat.enabled) c.mix("gravity", 2);
  return with_bytes(c, paper, p.heat.enabled);
}

Work paper_spread_work(const rule::Parameters& p) {
  Counting c;
  const rule::PaperLaw& law = p.flow.paper;
  const int n = law.neighbours;
  const bool diagonals = n == 8;
  c.add("spread: E > threshold", 0, 1);
  if (law.slump > 0) c.add("spread: margin or slump", 0, diagonals ? 2 : 1);
  if (p.flow.thermal_viscosity && !law.use_table)
    c.add("spread: share x mobility_table[h >> 11] >> 15, min", 1, 4);
  c.add("spread: F = min(scaled(A, sh), CAP); the same with E; e = min(f, e)", 2, 3);
  if (diagonals) c.add("spread: a quarter for diagonals", 0, 2);
  if (law.downhill) {
    c.add("spread: A - max(F, G), for faces" + std::string(diagonals ? ", for diagonals" : ""), 0,
          diagonals ? 4 : 2);
    c.add("spread: comparison with each neighbour", 0, n);
  }
  c.add("spread: A < LIM", 0, 1);
  c.add("spread: random byte: 10 rounds of 5 operations on 2 x 32 bits for 8 cells", 0, 10 * 5 * 2 / 8.0);
  if (law.use_table)
    c.add("spread: factor of the pattern, product with A and with E, per direction", 2.0 * n - 2, n);
  c.add("spread: sums of amounts and energies, given and taken", 0, 4.0 * n);
  c.add("spread: alpha of the cell below", 0, 2);
  c.add("spread: g = scaled(sum e_in, alpha, D)", kRoundedMul, kRoundedAdd);
  c.add("spread: A', E', min(E', A'), A' > 0", 0, 6);
  c.add("spread: ledgers `dissipated`, `capped`", 0, 2 * kTerm);
  if (p.heat.enabled) c.mix("spread", n + 1);
  return with_bytes(c, true, p.heat.enabled);
}

// Every pair counts for one of its two cells, which makes 4 pairs per cell. Heads belong to runs and cost a
// cell nothing.
Work viscous_spread_work(const rule::Parameters& p) {
  Counting c;
  const double pairs = 4;
  c.add("settle: M + A, M > n ONE, clamp(M - k ONE, 0, ONE)", 0, 2 * kWideAdd + 3);
  if (p.heat.enabled)
    c.add("settle: sum of products amount x heat; every cell its run's heat", 1, kWideAdd + 1);
  c.add("spread: drop = head_i - head_j; which cell gives; its mobility, amount, dead", 0,
        pairs * (kWideAdd + 4));
  c.add("spread: drop > z, min(drop, 256)", 0, pairs * 2);
  c.add("spread: c = min(65535, ((g + mobility_j) A_i) >> 12): both halves of the product", pairs * 2,
        pairs * 5);
  c.add("spread: w = (c drop + ...) >> 13: both halves", pairs * 2, pairs * 4);
  c.add("spread: A >> 3, room >> 3", 0, 3);
  c.add("spread: f = min(w, A_i >> 3, room >> 3), moved", 0, pairs * 4);
  c.add("spread: A' > 0", 0, 1);
  if (p.heat.enabled) c.mix("spread", 5);
  return with_bytes(c, false, p.heat.enabled);
}

Work heat_work(const rule::Parameters& p) {
  Counting c;
  const rule::Heat& heat = p.heat;
  const int passes = heat.neighbours == 6 ? 1 : heat.neighbours == 18 ? 2 : 3;
  const int pairs = heat.neighbours / 2;
  double bytes = 4 + 2 + 0.5;
  std::string text =
      "h read and written, A read (ledger), solid, inert and liquid read, solid and liquid written";
  bytes += 1.0 / 8;
  if (p.material.latent_heat > 0) c.add("heat: T(h) before each pass", 0, 3.0 * passes);
  c.add("heat: conduction: T(q) - T(p) of " + std::to_string(pairs) + " pairs", 0, pairs);
  c.add("heat: conduction: scaled(.., weight, D)", kRoundedMul * pairs, kRoundedAdd * pairs);
  c.add("heat: conduction: moved", 0, 2.0 * pairs);
  c.add("heat: ledger `conducted`: A x change", 1, kTerm);
  if (heat.convection > 0) {
    c.add("heat: convection: T(p) > T(q), scaled difference, moved", kRoundedMul, 4 + kRoundedAdd);
    c.add("heat: ledger `convected`", 1, kTerm);
  }
  if (heat.radiation) {
    c.add("heat: radiation: (4096 I + D) >> 16, added up to 65535", 1, kRoundedAdd + 1);
    c.add("heat: ledger `radiated`", 1, kTerm);
    bytes += 2;
    text += ", irradiance read";
  }
  if (heat.air) {
    c.add("heat: air: exposed axes, their w, scaled(air - T(h), w, D), added up to 65535", kRoundedMul,
          3 + 1 + kRoundedAdd + 1);
    c.add("heat: ledgers `warmed`, `cooled`", 1, kTerm);
  }
  c.add("melt: h >= Tm + L", 0, 1);
  if (p.flow.paper.reheat > 0 && p.flow.law == rule::Law::paper) {
    c.add("melt: reheat", 1, 2);
    bytes += 4;
    text += ", E read and written";
  }
  return c.bytes(bytes, text);
}

}  // namespace

std::string_view name_of(Subject subject) {
  constexpr std::string_view names[] = {"gravity", "spread", "flow", "heat"};
  return names[static_cast<int>(subject)];
}

Work work_of(Subject subject, const rule::Parameters& parameters) {
  const bool paper = parameters.flow.law == rule::Law::paper;
  const auto spread = paper ? paper_spread_work : viscous_spread_work;
  switch (subject) {
    case Subject::gravity:
      return gravity_work(parameters);
    case Subject::spread:
      return spread(parameters);
    case Subject::heat:
      return heat_work(parameters);
    case Subject::flow:
      break;
  }
  Counting all;
  all.append(gravity_work(parameters));
  all.append(spread(parameters));
  return with_bytes(all, paper, parameters.heat.enabled);
}

Roof roof_of(const Work& work, const LaneRates& rates, const Bandwidth& bandwidth) {
  // Multiplies have a limit of their own, besides that of all operations.
  return {std::min(rates.multiply / work.multiplies, rates.add / work.operations()),
          bandwidth.best() / work.bytes, rates.multiply / work.operations()};
}

}  // namespace voxmelt::measure
