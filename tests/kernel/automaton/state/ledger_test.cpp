// The books balance, and show a planted leak of one unit.
#include "kernel/automaton/state/ledger.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

using namespace worlds;

TEST(SumText, WritesAll128Bits) {
  EXPECT_EQ(to_string(Sum{0}), "0");
  EXPECT_EQ(to_string(Sum{-1}), "-1");
  EXPECT_EQ(to_string(Sum{1234567890}), "1234567890");
  const Sum power = Sum{1} << 64;
  EXPECT_EQ(to_string(power), "18446744073709551616");
  EXPECT_EQ(to_string(-power), "-18446744073709551616");
  const Sum largest = ~(Sum{1} << 127);
  EXPECT_EQ(to_string(largest), "170141183460469231731687303715884105727");
  EXPECT_EQ(to_string(-largest - 1), "-170141183460469231731687303715884105728");
}

TEST(Holdings, CountsMatterOnly) {
  Volume v(Grid{3, 2, 1});
  put(v, 0, 0, 0, 100, 40, 7);
  put_solid(v, 1, 0, 0, 50, 3);
  put_inert(v, 2, 0, 0, 1234);  // a bed offset is no mass
  const Holdings held = holdings(v);
  EXPECT_EQ(held.liquid, 100);
  EXPECT_EQ(held.solid, 50);
  EXPECT_EQ(held.energy, 40);
  EXPECT_EQ(held.heat, 700 + 150);
  EXPECT_TRUE(drift(Ledger::open(v), v).none());
}

TEST(Holdings, LargestCells) {
  Volume v(Grid{64, 64, 16});
  fill(v, whole(v.grid), 65535, 65535, 65535);
  const Holdings held = holdings(v);
  EXPECT_EQ(held.liquid, Sum{65536} * 65535);
  EXPECT_EQ(held.heat, Sum{65536} * 65535 * 65535);
}

// The signs are those of docs/automaton.md, section 12. Each term is another power of ten.
TEST(Ledger, ExpectsTheStartAndEveryTermWithItsSign) {
  Ledger l;
  l.mass.start = 5000;
  l.mass.added = 10;
  l.mass.removed = 1;
  EXPECT_EQ(l.mass.expected(), 5009);

  l.energy.start = 50000000;
  l.energy.melted = 1000000;
  l.energy.frozen = 20000000;
  l.energy.added = 100000;
  l.energy.removed = 10000;
  l.energy.reheated = 1000;
  l.energy.accelerated = 100;
  l.energy.dissipated = 10;
  l.energy.capped = 1;
  EXPECT_EQ(l.energy.expected(), 31091089);

  l.heat.start = 500000000;
  l.heat.conducted = 10000000;
  l.heat.walls = 3000000000;
  l.heat.convected = 1000000;
  l.heat.radiated = 100000;
  l.heat.warmed = 10000;
  l.heat.cooled = 1000;
  l.heat.melted = -20000000000;
  l.heat.added = 100;
  l.heat.removed = 10;
  l.heat.rounded = 1;
  EXPECT_EQ(l.heat.expected(), -16488890909);
}

// The values distinguish every term from the others, and fit 64 bits.
LedgerTerms<std::int64_t> some_books() {
  LedgerTerms<std::int64_t> books;
  books.mass = {1, -2};
  books.energy = {3, 19, 4, 5, 6, 7, 8, std::int64_t{1} << 62};
  books.heat = {-10, 18, 11, 12, 13, 14, -20, 15, 16, -17};
  return books;
}

TEST(Ledger, BooksEveryTermInItsPlace) {
  Ledger l;
  l.energy.start = 9;
  for (int i = 0; i < 3; ++i) l.book(some_books());
  EXPECT_EQ(l.mass.added, 3);
  EXPECT_EQ(l.mass.removed, -6);
  EXPECT_EQ(l.energy.start, 9);
  EXPECT_EQ(l.energy.melted, 9);
  EXPECT_EQ(l.energy.frozen, 57);
  EXPECT_EQ(l.energy.added, 12);
  EXPECT_EQ(l.energy.removed, 15);
  EXPECT_EQ(l.energy.reheated, 18);
  EXPECT_EQ(l.energy.accelerated, 21);
  EXPECT_EQ(l.energy.dissipated, 24);
  EXPECT_EQ(l.energy.capped, Sum{3} << 62) << "more than 64 bits";
  EXPECT_EQ(l.heat.conducted, -30);
  EXPECT_EQ(l.heat.walls, 54);
  EXPECT_EQ(l.heat.convected, 33);
  EXPECT_EQ(l.heat.radiated, 36);
  EXPECT_EQ(l.heat.warmed, 39);
  EXPECT_EQ(l.heat.cooled, 42);
  EXPECT_EQ(l.heat.melted, -60);
  EXPECT_EQ(l.heat.added, 45);
  EXPECT_EQ(l.heat.removed, 48);
  EXPECT_EQ(l.heat.rounded, -51);
}

TEST(Ledger, TermsOfManyWorkersAddUp) {
  LedgerTerms<std::int64_t> sum;
  LedgerTerms<std::int64_t> books = some_books();
  books.energy.capped = 9;
  for (int i = 0; i < 2; ++i) sum += books;
  EXPECT_EQ(sum.mass, (MassTerms<std::int64_t>{2, -4}));
  EXPECT_EQ(sum.energy, (EnergyTerms<std::int64_t>{6, 38, 8, 10, 12, 14, 16, 18}));
  EXPECT_EQ(sum.heat, (HeatTerms<std::int64_t>{-20, 36, 22, 24, 26, 28, -40, 30, 32, -34}));
}

// Makes a run that uses every term of the ledgers.
enum class Case { paper, paper_printed, viscous };
run::Simulation busy(Case which) {
  Parameters p = which == Case::viscous ? viscous(0.02, 0.002) : paper_showcase();
  if (which == Case::paper_printed) p.flow.paper.reading = rule::EnergyReading::printed;
  p.flow.paper.beta = 40000;
  p.flow.paper.reheat = 4000;
  p.material = {20000, 3000};
  p.heat.enabled = true;
  p.heat.neighbours = 26;
  p.heat.weight_face = 6000;
  p.heat.weight_edge = 3000;
  p.heat.weight_corner = 2000;
  p.heat.convection = 5000;
  p.heat.radiation = true;
  p.heat.sources = {{{{0, {200, 200, 100}, 1u << 30}}}};
  p.heat.air = true;
  p.heat.air_exchange = 9000;
  p.heat.air_temperature.assign(12, 30000);
  for (std::size_t y = 6; y < 12; ++y) p.heat.air_temperature[y] = 1000;
  p.materials = {{.melting_point = 20000, .latent_heat = 3000, .air_exchange = 9000},
                 {.melting_point = 20000, .latent_heat = 1000, .air_exchange = 9000}};
  for (rule::SolidMaterial& row : p.materials)
    for (std::size_t other = 0; other < 2; ++other) {
      row.weight_face[other] = 6000;
      row.weight_edge[other] = 3000;
      row.weight_corner[other] = 2000;
    }
  p.vents = {{{{16 * 3, 16 * 9, 16 * 3}, 24}, 700, 60000, 3000, 0, 0xFFFFFFFFu}};
  p.drains = {{{{16 * 9, 16 * 1, 16 * 6}, 40}, 500, 5, 0xFFFFFFFFu}};
  Volume v(Grid{12, 12, 9});
  for_each({2, 2, 2, 10, 8, 7}, [&](int x, int y, int z) { put_solid(v, x, y, z, 4000, 15000 + 100 * x); });
  v.material = decltype(v.material)(v.grid);
  for_each({2, 2, 2, 6, 8, 7}, [&](int x, int y, int z) { v.material[v.at(x, y, z)] = 1; });
  p.heat.walls = true;
  put_inert(v, 6, 1, 4);
  v.heat[v.at(6, 1, 4)] = 40000;
  return simulate(p, v);
}

class LedgerOfALaw : public testing::TestWithParam<Case> {};

TEST_P(LedgerOfALaw, BalancesAndEveryTermIsUsed) {
  run::Simulation s = busy(GetParam());
  for (int i = 0; i < 200; ++i) {
    s.step();
    ASSERT_TRUE(s.drift().none()) << "step " << i;
  }
  const HeatLedger& h = s.ledger().heat;
  for (const Sum term : {s.ledger().mass.added, s.ledger().mass.removed, h.conducted, h.walls, h.convected,
                         h.radiated, h.warmed, h.cooled, h.melted, h.added, h.removed, h.rounded})
    EXPECT_NE(term, 0);
  const EnergyLedger& e = s.ledger().energy;
  for (const Sum term : {e.melted, e.added, e.removed, e.reheated})
    EXPECT_EQ(term != 0, GetParam() != Case::viscous);
  for (const Sum term : {e.accelerated, e.dissipated}) EXPECT_EQ(term != 0, GetParam() == Case::paper);
  EXPECT_EQ(e.capped != 0, GetParam() == Case::paper_printed) << "by the text nothing needs to be cut";
  EXPECT_GE(e.dissipated, 0);
  EXPECT_GE(h.warmed, 0);
  EXPECT_GE(h.cooled, 0);
}

TEST_P(LedgerOfALaw, OneUnitPlantedInTheStateShows) {
  run::Simulation s = busy(GetParam());
  steps(s, 30);
  Volume& v = s.mutable_volume();
  int liquids = 0, solids = 0;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    const state::Slot i = v.at(x, y, z);
    if (!v.liquid.test(x, y, z) && !v.solid.test(x, y, z)) return;
    ++(v.liquid.test(x, y, z) ? liquids : solids);
    --v.amount[i];
    EXPECT_EQ(s.drift().mass, -1);
    EXPECT_EQ(s.drift().heat, -Sum{v.heat[i]});
    ++v.amount[i];
    ++v.energy[i];
    EXPECT_EQ(s.drift().energy, 1);
    --v.energy[i];
    ++v.heat[i];
    EXPECT_EQ(s.drift().heat, Sum{v.amount[i]});
    --v.heat[i];
  });
  EXPECT_GT(liquids, 0);
  EXPECT_GT(solids, 0);
  EXPECT_TRUE(s.drift().none());
}

TEST_P(LedgerOfALaw, OneUnitPlantedInAnyTermShows) {
  run::Simulation s = busy(GetParam());
  steps(s, 10);
  Ledger& l = s.mutable_ledger();
  const auto shows = [&](Sum& term) {
    ++term;
    const Drift d = s.drift();
    EXPECT_EQ(d.mass * d.mass + d.energy * d.energy + d.heat * d.heat, 1) << "one unit, in one ledger";
    EXPECT_FALSE(d.none());
    --term;
  };
  const auto every_term_shows = [&](auto& ledger) {
    shows(ledger.start);
    for (const auto& term : ledger.table()) shows(ledger.*term.value);
  };
  every_term_shows(l.mass);
  every_term_shows(l.energy);
  every_term_shows(l.heat);
  EXPECT_TRUE(s.drift().none());
}

INSTANTIATE_TEST_SUITE_P(Cases, LedgerOfALaw,
                         testing::Values(Case::paper, Case::paper_printed, Case::viscous));

}  // namespace
}  // namespace voxmelt::state
