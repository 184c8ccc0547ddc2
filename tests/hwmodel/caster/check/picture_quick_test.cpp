// The covering array of the picture's matrix has every pair, and its runs pass on pictures of 24 x 24.
#include <array>
#include <cstddef>
#include <set>
#include <utility>

#include "tests/hwmodel/caster/check/picture_scenes.h"

namespace voxmelt::hwmodel::raycast {
namespace {

TEST(PictureMatrix, TheCoveringArrayHasEveryPair) {
  const auto values = [](const MatrixRun& run) {
    return std::array{run.pipes, run.view, run.seed, run.depth, run.size, run.ways};
  };
  constexpr std::array<std::size_t, 6> kMany{3, 3, 3, 2, 2, 2};
  for (const auto& runs : {covering_array(), full_product()})
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        std::set<std::pair<int, int>> seen;
        for (const MatrixRun& run : runs) seen.insert({values(run)[a], values(run)[b]});
        EXPECT_EQ(seen.size(), kMany[a] * kMany[b]) << a << " and " << b;
      }
  EXPECT_GE(covering_array().size(), 18U);
  std::set<std::array<int, 6>> all;
  for (const MatrixRun& run : full_product()) all.insert(values(run));
  EXPECT_EQ(all.size(), 3U * 3 * 3 * 2 * 2 * 2);
}

class QuickMatrix : public testing::TestWithParam<SceneStep> {};

TEST_P(QuickMatrix, CoveringArrayAt24) {
  const MidMelt melt(GetParam());
  for (const MatrixRun& run : covering_array()) {
    PictureOptions options;
    options.configuration = run.configuration();
    const PictureReport report = melt.draw(melt.camera(run.view, 24), options);
    ASSERT_TRUE(report.good()) << run.text() << ":\n" << text_of(report);
    ASSERT_GE(report.rays, 24 * 24);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, QuickMatrix,
                         testing::Values(SceneStep{"proving_ground", 40}, SceneStep{"bunny_small", 300},
                                         SceneStep{"lava", 60}),
                         [](const auto& chosen) { return chosen.param.first; });

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
