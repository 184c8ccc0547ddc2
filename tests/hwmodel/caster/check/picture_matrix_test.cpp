// The picture's matrix (slow) draws whole scenes in the middle of their melt: the covering array at 256 x
// 256, and the full product at 48 x 48. It prints a line per run, or per scene.
#include <cstdint>
#include <cstdio>

#include "tests/hwmodel/caster/check/picture_scenes.h"

namespace voxmelt::hwmodel::raycast {
namespace {

class PictureMatrix : public testing::TestWithParam<SceneStep> {};

PictureReport draw(const MidMelt& melt, const MatrixRun& run, int pixels) {
  PictureOptions options;
  options.configuration = run.configuration();
  return melt.draw(melt.camera(run.view, pixels), options);
}

TEST_P(PictureMatrix, CoveringArrayAt256) {
  const MidMelt melt(GetParam());
  ASSERT_GT(melt.volume().liquid.count(), 50);
  int runs = 0;
  for (const MatrixRun& run : covering_array()) {
    const PictureReport report = draw(melt, run, 256);
    ASSERT_TRUE(report.good()) << GetParam().first << ", " << run.text() << ":\n" << text_of(report);
    ASSERT_GT(report.rays, 256 * 256);
    std::printf("| %s | %s | %lld | %lld | 0 |\n", GetParam().first.c_str(), run.text().c_str(),
                static_cast<long long>(report.compared), static_cast<long long>(report.end.cycles));
    std::fflush(stdout);
    ++runs;
  }
  EXPECT_GE(runs, 18);
}

TEST_P(PictureMatrix, FullProductAt48) {
  const MidMelt melt(GetParam());
  std::int64_t compared = 0;
  int runs = 0;
  for (const MatrixRun& run : full_product()) {
    const PictureReport report = draw(melt, run, 48);
    ASSERT_TRUE(report.good()) << GetParam().first << ", " << run.text() << ":\n" << text_of(report);
    compared += report.compared;
    ++runs;
  }
  EXPECT_EQ(runs, 216);
  std::printf("| %s | %d runs at 48 x 48 | %lld | 0 |\n", GetParam().first.c_str(), runs,
              static_cast<long long>(compared));
  std::fflush(stdout);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PictureMatrix, testing::ValuesIn(drawn_scenes()),
                         [](const auto& chosen) { return chosen.param.first; });

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
