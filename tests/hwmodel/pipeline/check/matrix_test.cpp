// This is the matrix of docs/verification.md. The quick part runs every row of the covering array on a crop
// of a showcase scene. The slow part runs all rows on whole scenes in the middle of their melt, and the full
// product on crops.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/hwmodel/pipeline/check/matrix_rows.h"

namespace voxmelt::hwmodel {
namespace {

const std::vector<MatrixRow>& rows() {
  static const std::vector<MatrixRow> all = covering_rows();
  return all;
}

void print(const Start& start, const MatrixRow& row, const Configuration& c, const VerifyReport& report) {
  std::printf("| %s | %s | %lld | %lld | %.2f |\n", start.name.c_str(), text_of(row, c).c_str(),
              static_cast<long long>(report.compared_cells), static_cast<long long>(report.cycles),
              1e-6 * static_cast<double>(report.cell_steps) / report.model_seconds);
  std::fflush(stdout);
}

// The runs take ten steps. A scene that counts its sub-steps from the state has passes of one step only. So
// it gets one sub-step a step here, and `counted` adds two steps with all of them.
Start with_long_passes(Start start) {
  if (start.parameters.flow.law == rule::Law::viscous) start.parameters.flow.viscous.substeps = 1;
  return start;
}

void check_row(const Start& start, std::size_t i, bool counted) {
  const MatrixRow& row = rows()[i];
  const Start longer = with_long_passes(start);
  Configuration c = configuration_of(longer, row);
  const VerifyReport report = run_row(longer, row, c, 10);
  if (testing::Test::HasFailure()) return;
  print(start, row, c, report);
  if (!counted || start.parameters.flow.law == rule::Law::paper) return;
  c.substeps = 1 + static_cast<int>(i % 3);
  c.tile = tile_width(start, c, row[kTile]);
  run_row(start, row, c, 2);
}

TEST(Matrix, TheRowsHoldEveryPair) {
  std::set<ValuePair> pairs;
  for (const MatrixRow& row : rows()) each_pair(row, [&](const ValuePair& pair) { pairs.insert(pair); });
  std::size_t expected = 0;
  for (std::size_t a = 0; a < kColumns; ++a)
    for (std::size_t b = a + 1; b < kColumns; ++b)
      expected += static_cast<std::size_t>(kValues[a]) * static_cast<std::size_t>(kValues[b]);
  EXPECT_EQ(pairs.size(), expected);
  EXPECT_GE(rows().size(), 24U);
}

class Crops : public testing::TestWithParam<std::size_t> {};

// Each row runs on one scene, so each scene has an eighth of them. The cubes end within a block of 16 lanes.
// Most scenes are early in their melt, because getting there takes most of the time.
TEST_P(Crops, OfAShowcaseScene) {
  const auto& [name, ahead] = showcase()[GetParam()];
  const Start start = crop(start_of(name, name.starts_with("goblet") ? ahead : 240), 20);
  ASSERT_GT(start.volume.liquid.count(), 100) << name;
  for (std::size_t i = GetParam(); i < rows().size(); i += showcase().size()) check_row(start, i, true);
}

INSTANTIATE_TEST_SUITE_P(Matrix, Crops, testing::Range(std::size_t{0}, showcase().size()),
                         [](const auto& chosen) { return showcase()[chosen.param].first; });

// The runs of a scene are split into this many parts, so that a session can be cut short.
constexpr int kParts = 8;

class Whole : public testing::TestWithParam<std::pair<std::size_t, int> > {
 protected:
  Start start_of_scene() const {
    const auto& [name, ahead] = showcase()[GetParam().first];
    return start_of(name, ahead);
  }
  int part() const { return GetParam().second; }
};

TEST_P(Whole, CoveringArray) {
  const Start start = start_of_scene();
  ASSERT_GT(start.volume.liquid.count(), 1000);
  for (auto i = static_cast<std::size_t>(part()); i < rows().size() && !HasFailure(); i += kParts)
    check_row(start, i, i == GetParam().first);
}

// Returns the part of a row. Runs that share sized channels come together, and each part has every number of
// lanes.
int part_of(const MatrixRow& row) { return (row[kLanes] + 3 * row[kCascade] + 4 * row[kOverlap]) % kParts; }

// Rows that a crop cannot tell from others are left out: their tile is as wide as the grid.
TEST_P(Whole, FullProductOnACrop) {
  const Start start = with_long_passes(crop(start_of_scene(), 32));
  std::int64_t compared = 0, cut = 0, runs = 0;
  MatrixRow row{};
  const auto next = [&row] {
    std::size_t column = 0;
    while (column < kColumns && ++row[column] == kValues[column]) row[column++] = 0;
    return column < kColumns;
  };
  do {
    if (part_of(row) != part()) continue;
    Configuration c{kLanesOf[static_cast<std::size_t>(row[kLanes])],
                    kCascadeOf[static_cast<std::size_t>(row[kCascade])]};
    if (row[kTile] > 0 && tile_width(start, c, row[kTile]) == 0) continue;
    c = configuration_of(start, row);
    compared += run_row(start, row, c, 10).compared_cells;
    if (HasFailure()) return;
    ++runs;
    cut += c.tile > 0 ? 1 : 0;
  } while (next());
  std::printf("| %s | part %d of %d | %lld runs | %lld in tiles | %lld | 0 |\n", start.name.c_str(),
              part() + 1, kParts, static_cast<long long>(runs), static_cast<long long>(cut),
              static_cast<long long>(compared));
  std::fflush(stdout);
}

std::vector<std::pair<std::size_t, int> > parts() {
  std::vector<std::pair<std::size_t, int> > all;
  for (int part = 0; part < kParts; ++part)
    for (std::size_t scene = 0; scene < showcase().size(); ++scene) all.emplace_back(scene, part);
  return all;
}
INSTANTIATE_TEST_SUITE_P(Long, Whole, testing::ValuesIn(parts()), [](const auto& chosen) {
  return showcase()[chosen.param.first].first + "_" + std::to_string(chosen.param.second);
});

}  // namespace
}  // namespace voxmelt::hwmodel
