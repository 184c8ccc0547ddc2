// The pipeline's matrix has these columns. A pairwise covering array of them is built here, and a row is run.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "hwmodel/explore/size_fifos.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {

enum Column { kLanes, kCascade, kSized, kSeed, kTile, kMemory, kCoded, kOverlap, kColumns };
using MatrixRow = std::array<int, kColumns>;  // the index of a value in each column

inline constexpr MatrixRow kValues{3, 4, 2, 5, 4, 3, 2, 2};
inline constexpr std::array<int, 3> kLanesOf{1, 4, 16};
inline constexpr std::array<int, 4> kCascadeOf{1, 2, 4, 8};
inline constexpr std::array<const char*, 3> kMemoryOf{"", "ddr4-2400", "hbm2"};
inline constexpr int kMatrixClock = 200;  // MHz, beside a DRAM

using ValuePair = std::array<int, 4>;  // column, value, further column, its value

inline void each_pair(const MatrixRow& row, const auto& visit) {
  for (int a = 0; a < kColumns; ++a)
    for (int b = a + 1; b < kColumns; ++b)
      visit(ValuePair{a, row[static_cast<std::size_t>(a)], b, row[static_cast<std::size_t>(b)]});
}

inline std::set<ValuePair> all_pairs() {
  std::set<ValuePair> pairs;
  for (int a = 0; a < kColumns; ++a)
    for (int b = a + 1; b < kColumns; ++b)
      for (int i = 0; i < kValues[static_cast<std::size_t>(a)]; ++i)
        for (int j = 0; j < kValues[static_cast<std::size_t>(b)]; ++j) pairs.insert({a, i, b, j});
  return pairs;
}

// Returns 24 rows, in which every pair of values occurs. Each row is the best of some random rows that hold a
// missing pair: the one with the most missing pairs.
inline std::vector<MatrixRow> covering_rows() {
  worlds::Random random(18);
  std::set<ValuePair> missing = all_pairs();
  std::vector<MatrixRow> rows;
  while (!missing.empty() || rows.size() < 24) {
    MatrixRow best{};
    std::ptrdiff_t most = -1;
    for (int candidate = 0; candidate < 2000; ++candidate) {
      MatrixRow row{};
      for (std::size_t c = 0; c < kColumns; ++c) row[c] = random.below(kValues[c]);
      if (!missing.empty()) {
        const auto must = std::next(missing.begin(), random.below(static_cast<std::int32_t>(missing.size())));
        row[static_cast<std::size_t>((*must)[0])] = (*must)[1];
        row[static_cast<std::size_t>((*must)[2])] = (*must)[3];
      }
      std::ptrdiff_t found = 0;
      each_pair(row, [&](const ValuePair& pair) { found += missing.contains(pair) ? 1 : 0; });
      if (found > most) {
        most = found;
        best = row;
      }
    }
    each_pair(best, [&](const ValuePair& pair) { missing.erase(pair); });
    rows.push_back(best);
  }
  return rows;
}

// Returns the columns of a tile for the n-th of three widths, or 0 if the grid cannot be cut so. The widths
// give two tiles, three, and as many as there can be up to four.
inline int tile_width(const Start& start, const Configuration& c, int n) {
  if (n == 0) return 0;
  const Design uncut{start.parameters, {start.volume.grid, c.lanes}, c.substeps};
  const int blocks = uncut.shape.grid_blocks();
  const int halo = (c.cascade * reach_of_step(uncut) + c.lanes - 1) / c.lanes;
  const int tiles = n + 1;
  const int width = std::max((blocks + 2 * halo * (tiles - 1) + tiles - 1) / tiles, 2 * halo + 1);
  return width < blocks ? width * c.lanes : 0;
}

// Returns the smallest channels that lose no cycle, of a small grid with the same parameters and memory. They
// are sized without stalls, because a machine is built for no seed of stalls.
inline const std::vector<ChannelDepth>& sized_depths(const Start& start, const Configuration& c, int memory) {
  static std::map<std::tuple<std::string, int, int, int, bool>, std::vector<ChannelDepth>> known;
  auto& depths = known[{start.name, c.lanes, c.cascade, memory, c.overlap}];
  if (!depths.empty()) return depths;
  explore::TimedRun run;
  run.parameters = start.parameters;
  run.grid = {2 * std::max(c.lanes, 2), 5, 5};
  run.configuration = c;
  run.configuration.tile = 0;
  run.configuration.coded = false;
  run.configuration.stall_seed = 0;
  run.first_step = start.step;
  run.steps = c.cascade;
  std::optional<explore::SizingMemory> dram;
  if (memory > 0) dram = {load_memory(kMemoryOf[static_cast<std::size_t>(memory)], "test"), kMatrixClock};
  for (const explore::SizedChannel& channel : explore::size_fifos(run, dram).channels)
    depths.push_back({channel.name, channel.depth});
  return depths;
}

inline Configuration configuration_of(const Start& start, const MatrixRow& row) {
  Configuration c{kLanesOf[static_cast<std::size_t>(row[kLanes])],
                  kCascadeOf[static_cast<std::size_t>(row[kCascade])], 1,
                  static_cast<std::uint64_t>(row[kSeed])};
  c.overlap = row[kOverlap] == 1;
  c.coded = row[kCoded] == 1;
  if (row[kSized] == 1) {
    c.depths = sized_depths(start, c, row[kMemory]);
    c.fifo_depth = 4;
  }
  c.tile = tile_width(start, c, row[kTile]);
  return c;
}

inline std::string text_of(const MatrixRow& row, const Configuration& c) {
  return std::to_string(c.lanes) + " | " + std::to_string(c.cascade) + " | " +
         (row[kSized] == 1 ? "sized" : "1") + " | " + std::to_string(c.stall_seed) + " | " +
         std::to_string(c.tile) + " | " +
         (row[kMemory] == 0 ? "fixed" : kMemoryOf[static_cast<std::size_t>(row[kMemory])]) + " | " +
         (c.coded ? "coded" : "plain") + " | " + (c.overlap ? "yes" : "no");
}

// Runs a row in lock-step, with everything compared behind every stage.
inline VerifyReport run_row(const Start& start, const MatrixRow& row, const Configuration& c,
                            std::uint32_t steps) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = c;
  std::optional<MemoryStreams> streams;
  if (row[kMemory] > 0)
    streams.emplace(design_of(start.parameters, start.volume.grid, c), c.cascade,
                    load_memory(kMemoryOf[static_cast<std::size_t>(row[kMemory])], "test"), kMatrixClock);
  options.memory = streams ? &*streams : nullptr;
  VerifyReport report =
      verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  const std::string where = start.name + " | " + text_of(row, c);
  EXPECT_EQ(report.mismatch, nullptr) << where << ":\n" << (report.mismatch ? text_of(*report.mismatch) : "");
  if (report.mismatch) return report;
  std::int64_t stages = 0;  // the stages of one time step
  for (const StageReport& stage : report.stages) stages += is_stage(stage.kind) && stage.cascade == 0;
  EXPECT_GE(report.compared_cells, static_cast<std::int64_t>(start.volume.grid.cells()) * stages * steps)
      << where;
  const bool waits = c.stall_seed != 0 || row[kMemory] > 0;
  EXPECT_GE(report.cycles, report.predicted_cycles) << where;
  if (!waits) {
    EXPECT_EQ(report.cycles, report.predicted_cycles) << where;
  }
  return report;
}

}  // namespace voxmelt::hwmodel
