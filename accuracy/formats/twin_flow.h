// The twin runs sections 4, 8 and 9 of docs/automaton.md in any number format. These are vents, drains and
// an open border, gravity with excess, and the spreading of the paper's law.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "accuracy/formats/twin_cells.h"
#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/random.h"

namespace voxmelt::accuracy::front {

template <class Format>
class FlowRules {
 public:
  using Value = typename Format::Value;
  using Wide = typename Format::Wide;
  using Product = typename Format::Product;

  explicit FlowRules(const rule::Parameters& parameters)
      : parameters_(parameters),
        law_(parameters_.flow.paper),
        keys_(rule::round_keys(parameters.seed)),
        threshold_(amount(law_.threshold)),
        margin_(amount(law_.margin)),
        slump_(amount(law_.slump)),
        minimum_(amount(parameters.flow.fall.minimum)),
        hang_(amount(parameters.flow.fall.hang)),
        cap_(law_.neighbours == 8 ? Format::kOne : 2 * Format::kOne),
        limit_((law_.neighbours == 8 ? 11 : 8) * Format::kOne) {}

  void source(std::uint32_t step, Cells<Format>& cells) const {
    for (const rule::Vent& vent : parameters_.vents)
      if (vent.from <= step && step < vent.until)
        for_region(vent.region, cells, [&](std::size_t i) { pour(vent, rule::dither(step), cells, i); });
    for (const rule::Drain& drain : parameters_.drains)
      if (drain.from <= step && step < drain.until)
        for_region(drain.region, cells, [&](std::size_t i) { take(amount(drain.rate), cells, i); });
    if (parameters_.open_border) empty_border(cells);
  }

  void gravity(std::uint32_t step, Cells<Format>& cells, const Rows& columns) const {
    const std::int64_t dither = rule::dither(step);
    columns.for_each([&](int x, int y, int z) {
      if (y + 1 == cells.grid.y) return;
      const std::size_t low = cells.at(x, y, z), high = Cells<Format>::moved(low, cells.line);
      if (cells.blocked(low) || cells.blocked(high)) return;
      if (cells.amount[high] > 0 && cells.amount[low] < Format::kOne)
        fall(low, high, dither, cells);
      else if (cells.amount[low] > Format::kOne)
        rise(low, high, dither, cells);
    });
    cells.settle(columns);
  }

  void spread(std::uint32_t step, Cells<Format>& cells, const Rows& rows) {
    find_ways(cells);
    pattern_.assign(cells.kind.size(), 0);
    rows.for_each([&](int x, int y, int z) {
      const std::size_t i = cells.at(x, y, z);
      if (!cells.liquid(i)) return;
      const std::uint8_t available = available_to(cells, i);
      if (available == 0) return;
      const std::uint32_t block = rule::random_block_index(x, y, z, cells.grid.x, cells.grid.y);
      pattern_[i] = available & rule::random_byte(rule::random_block(keys_, step, block), x);
    });
    next_amount_ = cells.amount;
    next_energy_ = cells.energy;
    next_heat_ = cells.heat;
    rows.for_each([&](int x, int y, int z) {
      const std::size_t i = cells.at(x, y, z);
      if (!cells.blocked(i)) gather(cells, i, rule::dither(step));
    });
    cells.amount.swap(next_amount_);
    cells.energy.swap(next_energy_);
    cells.heat.swap(next_heat_);
    cells.settle(rows);
  }

 private:
  struct Flow {
    Wide amount = 0, energy = 0;
  };

  static Wide amount(std::int64_t units) { return units > 0 ? Format::of(units) : Wide{0}; }
  static Product product(Wide a, Wide h) { return static_cast<Product>(a) * static_cast<Product>(h); }

  template <class Visit>
  static void for_region(const rule::Region& region, const Cells<Format>& cells, const Visit& visit) {
    for (int z = 0; z < cells.grid.z; ++z)
      for (int y = 0; y < cells.grid.y; ++y)
        for (int x = 0; x < cells.grid.x; ++x) {
          const std::int64_t dx = 16 * x + 8 - region.at.x, dy = 16 * y + 8 - region.at.y,
                             dz = 16 * z + 8 - region.at.z;
          if (dx * dx + dy * dy + dz * dz > region.radius * region.radius) continue;
          if (const std::size_t i = cells.at(x, y, z); !cells.blocked(i)) visit(i);
        }
  }

  void pour(const rule::Vent& vent, std::int64_t dither, Cells<Format>& cells, std::size_t i) const {
    const Wide before = cells.amount[i], added = std::min(amount(vent.rate), Format::kMost - before);
    if (!(added > 0)) return;
    cells.amount[i] = static_cast<Value>(before + added);
    cells.energy[i] = static_cast<Value>(cells.energy[i] + Format::times(added, amount(vent.energy)));
    if (parameters_.heat.enabled)
      mix(cells, i, product(before, cells.heat[i]) + product(added, Format::of(vent.temperature)), dither);
    cells.kind[i] = kLiquid;
  }

  static void empty_border(Cells<Format>& cells) {
    const state::Grid g = cells.grid;
    for (int z = 0; z < g.z; ++z)
      for (int y = 0; y < g.y; ++y)
        for (int x = 0; x < g.x; ++x) {
          const bool outermost = x == 0 || x + 1 == g.x || z == 0 || z + 1 == g.z;
          const std::size_t i = cells.at(x, y, z);
          if (outermost && !cells.blocked(i)) take(cells.amount[i], cells, i);
        }
  }

  static void take(Wide rate, Cells<Format>& cells, std::size_t i) {
    cells.amount[i] = static_cast<Value>(cells.amount[i] - std::min(rate, Wide{cells.amount[i]}));
    cells.energy[i] = std::min(cells.energy[i], cells.amount[i]);
    if (cells.amount[i] > 0) return;
    cells.kind[i] = kAir;
    cells.heat[i] = 0;
  }

  static void mix(Cells<Format>& cells, std::size_t i, Product content, std::int64_t dither) {
    cells.heat[i] = static_cast<Value>(Format::mixed(content, cells.amount[i], dither));
  }

  void move(Cells<Format>& cells, std::size_t from, std::size_t to, Wide flow, std::int64_t dither) const {
    const Product content = product(cells.amount[to], cells.heat[to]) + product(flow, cells.heat[from]);
    cells.amount[from] = static_cast<Value>(cells.amount[from] - flow);
    cells.amount[to] = static_cast<Value>(cells.amount[to] + flow);
    if (parameters_.heat.enabled) mix(cells, to, content, dither);
  }

  void fall(std::size_t low, std::size_t high, std::int64_t dither, Cells<Format>& cells) const {
    const Wide held = cells.amount[high], lower = cells.amount[low];
    bool wall = false;
    for (const std::ptrdiff_t way : {1, -1, cells.slice, -cells.slice})
      wall = wall || (cells.kind[Cells<Format>::moved(high, way)] & (kSolid | kInert | kFresh)) != 0;
    const rule::Fall& rule = parameters_.flow.fall;
    const bool touches = wall || cells.blocked(Cells<Format>::moved(high, cells.line));
    if (hang_ > 0 && held < hang_ && lower == 0 && touches) return;
    const Wide ready = std::min(held, Format::part(held, wall ? rule.wall_factor : rule.factor) + minimum_);
    const Wide flow = std::min(ready, Format::kOne - lower);
    if (!(flow > 0)) return;
    const Wide lost = std::min(Wide{cells.energy[high]}, flow);
    const Wide room = lower + flow - cells.energy[low];
    cells.energy[high] = static_cast<Value>(cells.energy[high] - lost);
    cells.energy[low] = static_cast<Value>(cells.energy[low] + std::min(Format::part(lost, law_.beta), room));
    move(cells, high, low, flow, dither);
    cells.energy[high] = std::min(cells.energy[high], cells.amount[high]);
  }

  void rise(std::size_t low, std::size_t high, std::int64_t dither, Cells<Format>& cells) const {
    const Wide flow = std::min(cells.amount[low] - Format::kOne, Format::kMost - cells.amount[high]);
    if (!(flow > 0)) return;
    const Wide energy = std::min(Wide{cells.energy[low]}, flow);
    cells.energy[low] = static_cast<Value>(cells.energy[low] - energy);
    cells.energy[high] = static_cast<Value>(cells.energy[high] + energy);
    move(cells, low, high, flow, dither);
  }

  void find_ways(const Cells<Format>& cells) {
    for (std::size_t d = 0; d < 8; ++d)
      way_[d] = cells.way({rule::kDirections[d].dx, 0, rule::kDirections[d].dz});
  }

  std::int64_t share_at(const Cells<Format>& cells, std::size_t i, std::size_t d) const {
    if (law_.use_table) return law_.table[pattern_[i]][d];
    return own_share(cells, i);
  }
  std::int64_t own_share(const Cells<Format>& cells, std::size_t i) const {
    if (!parameters_.flow.thermal_viscosity) return law_.share;
    const std::int64_t mobility = parameters_.flow.mobility_table[Format::band(cells.heat[i])];
    return std::min<std::int64_t>((law_.share * mobility) >> 15, law_.neighbours == 8 ? 13107 : 16384);
  }
  Wide shared(Wide held, std::int64_t share, bool diagonal) const {
    const Wide flow = std::min(Format::part(held, share), cap_);
    return diagonal ? Format::quarter(flow) : flow;
  }

  std::uint8_t available_to(const Cells<Format>& cells, std::size_t i) const {
    if (law_.support && cells.is_air(Cells<Format>::moved(i, -cells.line))) return 0;
    const bool lively = cells.energy[i] > threshold_;
    if (!lively && !(slump_ > 0)) return 0;
    const Wide margin = lively ? margin_ : slump_;
    const Wide held = cells.amount[i],
               flow = law_.use_table ? Wide{0} : shared(held, own_share(cells, i), false);
    unsigned available = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(law_.neighbours); ++d) {
      const std::size_t j = Cells<Format>::moved(i, way_[d]);
      if (cells.blocked(j)) continue;
      if (d >= 4 && cells.blocked(Cells<Format>::moved(i, rule::kDirections[d].dx)) &&
          cells.blocked(Cells<Format>::moved(i, std::ptrdiff_t{cells.slice} * rule::kDirections[d].dz)))
        continue;
      const Wide there = cells.amount[j], step = d >= 4 ? Format::nine_eighths(margin) : margin;
      if (!(there < limit_) || (law_.downhill && !(there + std::max(flow, step) < held))) continue;
      available |= 1u << d;
    }
    return static_cast<std::uint8_t>(available);
  }

  Flow given(const Cells<Format>& cells, std::size_t i, std::size_t d) const {
    if (!(pattern_[i] >> d & 1u)) return {};
    const std::int64_t share = share_at(cells, i, d);
    const Wide flow = shared(cells.amount[i], share, d >= 4);
    return {flow, std::min(flow, shared(cells.energy[i], share, d >= 4))};
  }

  std::int64_t alpha_at(const Cells<Format>& cells, std::size_t i) const {
    const std::uint8_t below = cells.kind[Cells<Format>::moved(i, -cells.line)];
    return below == kInert ? law_.alpha_floor : below == kSolid ? law_.alpha_solid : law_.alpha_liquid;
  }

  void gather(const Cells<Format>& cells, std::size_t i, std::int64_t dither) {
    Flow out, in;
    Product content = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(law_.neighbours); ++d) {
      const Flow mine = given(cells, i, d);
      const std::size_t j = Cells<Format>::moved(i, way_[d]);
      const Flow theirs = given(cells, j, rule::kOpposite[d]);
      out = {out.amount + mine.amount, out.energy + mine.energy};
      in = {in.amount + theirs.amount, in.energy + theirs.energy};
      content += product(theirs.amount, cells.heat[j]);
    }
    if (out.amount == 0 && in.amount == 0) return;
    const Wide kept = cells.amount[i] - out.amount, held = kept + in.amount;
    const Wide gained = Format::part(in.energy, alpha_at(cells, i), dither);
    next_amount_[i] = static_cast<Value>(held);
    next_energy_[i] = static_cast<Value>(std::min(Wide{cells.energy[i]} - out.energy + gained, held));
    if (parameters_.heat.enabled && in.amount > 0)
      next_heat_[i] = static_cast<Value>(
          Format::mixed(content + product(kept, cells.heat[i]), static_cast<Value>(held), dither));
  }

  rule::Parameters parameters_;
  const rule::PaperLaw& law_;
  rule::RoundKeys keys_;
  Wide threshold_, margin_, slump_, minimum_, hang_, cap_, limit_;
  std::array<std::ptrdiff_t, 8> way_{};
  std::vector<std::uint8_t> pattern_;
  std::vector<Value> next_amount_, next_energy_, next_heat_;
};

}  // namespace voxmelt::accuracy::front
