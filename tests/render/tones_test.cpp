// Tones of solids, by hand from docs/picture/light.md, section 1, and docs/picture/field.md, section 2.
#include "render/density/tones.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/density/density_field.h"

namespace voxmelt {
namespace {

using render::Tint;

constexpr scene::Vec3 kBlack{0, 0, 0}, kDim{0.25, 0.25, 0.25}, kGreen{0, 0.5, 0}, kRed{1, 0, 0},
    kWhite{1, 1, 1};

scene::Look look_of(const std::vector<scene::Vec3>& materials) {
  scene::Look look;
  look.materials = materials;
  return look;
}

TEST(Tones, OneColourHasNone) {
  EXPECT_FALSE(render::tones_of({}));
  EXPECT_FALSE(render::tones_of(look_of({kRed})));
  EXPECT_FALSE(render::tones_of(look_of({kRed, kRed, kRed})));
  // They differ by less than half of a 4096th.
  EXPECT_FALSE(render::tones_of(look_of({kRed, {1, 0, 0x1p-14}})));
  scene::Look glowing = look_of({kRed, kWhite});
  glowing.glow = true;
  EXPECT_FALSE(render::tones_of(glowing));
}

TEST(Tones, TwoColoursAreTheEnds) {
  const render::Tones tones = *render::tones_of(look_of({kWhite, kBlack, kWhite, kBlack}));
  EXPECT_EQ(tones[0], 0);
  EXPECT_EQ(tones[1], 255);
  EXPECT_EQ(tones[2], 0);
  EXPECT_EQ(tones[3], 255);
  EXPECT_EQ(render::tints_of(look_of({kWhite, kBlack})), (std::vector<Tint>{{4096, 4096, 4096}, {0, 0, 0}}));
}

// From black red is 2 x 4096 = 8192 away, dim 10 x 1024 = 10240, green 7 x 2048 = 14336 and white 40960.
// So they lie as white, dim, black, red, green. Five places are 0, 63, 127, 191 and 255.
TEST(Tones, TheFirstIsInTheMiddle) {
  const scene::Look look = look_of({kBlack, kWhite, kGreen, kDim, kRed});
  EXPECT_EQ(
      render::tints_of(look),
      (std::vector<Tint>{{4096, 4096, 4096}, {1024, 1024, 1024}, {0, 0, 0}, {4096, 0, 0}, {0, 2048, 0}}));
  const render::Tones tones = *render::tones_of(look);
  const std::vector<int> wanted{127, 0, 255, 63, 191};
  for (std::size_t m = 0; m < wanted.size(); ++m) EXPECT_EQ(tones[m], wanted[m]) << m;
}

// Blue and dark red are 2048 away from black. Blue has less red, so it comes first.
TEST(Tones, EqualDistancesGoByRed) {
  const std::vector<Tint> tints = render::tints_of(look_of({kBlack, {0.25, 0, 0}, {0, 0, 0.5}}));
  EXPECT_EQ(tints, (std::vector<Tint>{{1024, 0, 0}, {0, 0, 0}, {0, 0, 2048}}));
}

// Black 127, dim 0 and red 255: a full cell has 65280 / 256 = 255 times its tone. A cell of an amount of 1
// has 15, and (15 x 127 + 255) / 256 is 8. Liquid and walls have none.
TEST(Tones, TheFieldHasThem) {
  state::Volume volume(state::Grid{6, 1, 1});
  volume.material = state::Field<std::uint8_t>(volume.grid);
  const auto put = [&](int x, int amount, int material) {
    volume.solid.set(x, 0, 0, true);
    volume.amount[volume.at(x, 0, 0)] = static_cast<std::uint16_t>(amount);
    volume.material[volume.at(x, 0, 0)] = static_cast<std::uint8_t>(material);
  };
  put(0, 4096, 0);
  put(1, 4096, 1);
  put(2, 4096, 2);
  put(3, 1, 0);
  volume.liquid.set(4, 0, 0, true);
  volume.amount[volume.at(4, 0, 0)] = 4096;
  volume.inert.set(5, 0, 0, true);
  const scene::Look look = look_of({kBlack, kDim, kRed});
  render::DensityField field;
  field.update(volume, look);
  const std::vector<int> wanted{127 * 255, 0, 255 * 255, 8, 0, 0};
  for (std::size_t x = 0; x < wanted.size(); ++x) EXPECT_EQ(field.cells().heat[x], wanted[x]) << x;

  volume.material = {};  // all are of the first material
  render::DensityField another;
  another.update(volume, look);
  EXPECT_EQ(another.cells().heat[2], 127 * 255);
}

}  // namespace
}  // namespace voxmelt
