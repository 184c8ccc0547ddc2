// Relaxed heads, by hand and by the exact course of two columns.
#include "kernel/automaton/rule/relax.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::rule {
namespace {

TEST(Relaxation, ReachesAsFarAsItsStagesSay) {
  EXPECT_EQ(Relaxation{1}.reach(), 1);
  EXPECT_EQ(Relaxation{1}.bits(), 0);
  EXPECT_EQ(Relaxation{2}.reach(), 3);
  EXPECT_EQ(Relaxation{2}.bits(), 2);
  EXPECT_EQ(Relaxation{16}.reach(), 136);
  EXPECT_EQ(Relaxation{16}.bits(), 8);
  EXPECT_EQ(Relaxation{2}.scale(), 43690);   // 4 / 3 of 32768
  EXPECT_EQ(Relaxation{16}.scale(), 61680);  // 256 / 136
  for (int stages = 2; stages <= kMostStages; ++stages) {
    const Relaxation r{stages};
    EXPECT_LE(r.reach(), 1 << r.bits());
    EXPECT_GT(r.reach(), 1 << (r.bits() - 1));
    EXPECT_LT(r.scale(), 65536);
  }
}

TEST(Relaxation, TakesTheFewestStagesThatReach) {
  EXPECT_EQ(stages_for(1, 16), 1);
  EXPECT_EQ(stages_for(2, 16), 2);
  EXPECT_EQ(stages_for(3, 16), 2);
  EXPECT_EQ(stages_for(4, 16), 3);
  EXPECT_EQ(stages_for(136, 16), 16);
  EXPECT_EQ(stages_for(1000000, 16), 16);
  EXPECT_EQ(stages_for(1000000, 1), 1);
}

// At three times the reach of one sub-step, c = 2^26 / 3 has 2^26 / 3 >> 10 = 21845. On level ground that is
// 21845 / 4 = 5461, times 4 / 3 in halves 14562 / 65536 a cell.
TEST(Relaxation, LevelsWhatAPairConducts) {
  const Relaxation two{2};
  EXPECT_EQ(leveling((1 << 26) / 3, 16384, 1, false, two), 14562);
  EXPECT_EQ(leveling((1 << 26) / 3, 16384, 4, false, two), 58248);
  EXPECT_EQ(leveling((1 << 26) / 3, 16384, 5, false, two), 65535);  // cut
  EXPECT_EQ(leveling((1 << 26) / 3, 8192, 1, false, two), 7279);    // 21845 / 8 = 2730
  EXPECT_EQ(leveling((1 << 26) / 3, 16384, 1, true, two), 3640);    // a diagonal: a quarter
  EXPECT_EQ(leveling(1023, 16384, 1, false, two), 0);
}

TEST(Relaxation, CountsADifferenceOfOneCellAtMost) {
  const Relaxation two{2};
  EXPECT_EQ(two.time(1), 21845);
  EXPECT_EQ(two.time(2), 65536);
  EXPECT_EQ(leveled(1000, 32768, 1, two), 500);
  EXPECT_EQ(leveled(10922, 65535, 1, two), 10921);
  EXPECT_EQ(leveled(1 << 20, 65535, 1, two), 10921);  // a third of a cell is 10922
  EXPECT_EQ(leveled(0, 65535, 1, two), 0);
}

TEST(Relaxation, AStageAddsItsWeightedGain) {
  Relaxing cell;
  cell.add(1000, 0, 2);  // impetus 3000; 4097 / 2 = 2048
  EXPECT_EQ(cell.impetus, 3000);
  EXPECT_EQ(cell.change, 1500);
  cell.add(0, 100, 3);  // impetus 2500; 4097 / 3 = 1365
  EXPECT_EQ(cell.impetus, 2500);
  EXPECT_EQ(cell.change, 1500 + 833);
  cell.add(0, 400000, 4);  // all that is given counts as 65535
  EXPECT_EQ(cell.impetus, 2500 - 7 * 65535);
  Relaxing fast;
  fast.add(65535, 0, 16);
  EXPECT_EQ(fast.impetus, kMostImpetus);
}

// Two columns of one cell level out as exp(-2 rate t). The stages give the Legendre polynomial of
// 1 - 4 rate / (S^2 + S) in place of exp(-2 rate), as RKL1 does. So the mean of their drop is that much less.
TEST(Relaxation, TwoColumnsKeepTheMeanOfTheirDrop) {
  for (const int stages : {2, 3, 5, 9, 16}) {
    const Relaxation r{stages};
    for (const double part : {0.1, 0.5, 1.0}) {  // of the greatest that one neighbour may have
      const double rate = part * 0.2 * r.reach();
      const auto level = static_cast<std::int32_t>(std::lround(65536 * rate / r.reach()));
      const std::int32_t heads[2] = {1024 + 400, 1024};
      Relaxing cells[2];
      std::int32_t now[2];
      for (int j = 1; j <= stages; ++j) {
        for (int i = 0; i < 2; ++i) now[i] = integrated(heads[i], cells[i].change, j, r);
        if (j == stages) break;
        const std::int32_t moved = leveled(now[0] - now[1], level, j, r);
        cells[0].add(0, moved, j + 1);
        cells[1].add(moved, 0, j + 1);
      }
      const double left =
          std::legendre(static_cast<unsigned>(stages), 1 - 4 * rate / (stages * stages + stages));
      const double mean = (1 - left) / (2 * rate);
      const double found = (now[0] - now[1]) / (400.0 * 64);
      EXPECT_NEAR(found, mean, 0.005) << stages << " stages, rate " << rate;
      EXPECT_GT(found, 0);
    }
  }
}

// A row that relaxes keeps its sum, but for roundings, and makes no new highest or lowest.
TEST(Relaxation, ARowKeepsItsSumAndItsRange) {
  for (const int stages : {2, 4, 7, 11, 16}) {
    const Relaxation r{stages};
    std::vector<std::int32_t> heads;
    heads.reserve(40);
    std::uint32_t dice = 7;
    for (int i = 0; i < 40; ++i)
      heads.push_back(1024 + static_cast<int>((dice = dice * 1664525 + 1013904223) >> 23));
    std::vector<Relaxing> cells(heads.size());
    std::vector<std::int32_t> now(heads.size());
    for (int j = 1;; ++j) {
      for (std::size_t i = 0; i < heads.size(); ++i) now[i] = integrated(heads[i], cells[i].change, j, r);
      if (j == stages) break;
      std::vector<std::int32_t> taken(heads.size()), given(heads.size());
      for (std::size_t i = 0; i + 1 < heads.size(); ++i) {
        const std::size_t high = now[i] >= now[i + 1] ? i : i + 1, low = 2 * i + 1 - high;
        const std::int32_t moved = leveled(now[high] - now[low], 13107, j, r);
        given[high] += moved;
        taken[low] += moved;
      }
      for (std::size_t i = 0; i < heads.size(); ++i) cells[i].add(taken[i], given[i], j + 1);
    }
    std::int64_t before = 0, after = 0;
    for (std::size_t i = 0; i < heads.size(); ++i) {
      before += 64 * heads[i];
      after += now[i];
      EXPECT_GE(now[i], 64 * 1024 - stages);
      EXPECT_LE(now[i], 64 * (1024 + 511) + stages);
    }
    EXPECT_NEAR(static_cast<double>(after), static_cast<double>(before), 40.0 * stages) << stages;
  }
}

}  // namespace
}  // namespace voxmelt::rule
