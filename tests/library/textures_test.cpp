// Textures are held against a scene whose numbers are worked by hand, and what a program keeps of them
// against a fresh simulation.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

// Nothing is filtered, and there is no ground. The box has the cells 10..19, 3..12 and 8..11, and water
// fills 25..30, 4..11 and 7..12. A pillar that never melts hangs at 34..37, 6..17 and 8..11.
const char* const kBoxes = R"(
[grid]
size = [40, 20, 24]
[look]
smooth = 0
smooth_solid = 0
[[solid]]
shape = "box"
size = [10, 10, 4]
at = [15, 8, 10]
[[liquid]]
shape = "box"
size = [6, 8, 6]
at = [28, 8, 10]
[[inert]]
shape = "box"
size = [4, 12, 4]
at = [36, 12, 10]
)";

// Holds what a program has uploaded.
class Uploaded {
 public:
  void take(const Textures& textures) {
    if (textures.everything) bricks_.clear();
    list_ = textures.textures;
    version = textures.version;
    for (const TextureBrick& brick : textures.bricks)
      bricks_[{brick.texture, brick.at}].assign(brick.bytes.begin(), brick.bytes.end());
  }

  // Returns the bytes of a texel.
  std::vector<std::uint8_t> texel(const std::string& name, std::array<int, 3> at) const {
    std::size_t number = 0;
    while (list_.at(number).name != name) ++number;
    const std::array<int, 3>& side = list_[number].brick;
    std::array<int, 3> first{};
    for (std::size_t i = 0; i < 3; ++i) first[i] = at[i] / side[i] * side[i];
    const auto size = name == "levels" ? 2 : name == "light" ? 16 : 4;
    const auto found = bricks_.find({number, first});
    if (found == bricks_.end()) return std::vector<std::uint8_t>(static_cast<std::size_t>(size), 0);
    const int place = ((at[2] - first[2]) * side[1] + at[1] - first[1]) * side[0] + at[0] - first[0];
    const auto begin = found->second.begin() + std::ptrdiff_t{place} * size;
    return {begin, begin + size};
  }
  // Returns the level of a cell, as it is in the lattice.
  int level(int x, int y, int z) const {
    const std::vector<std::uint8_t> bytes = texel("levels", {x + 2, y + 2, z + 2});
    return bytes[0] + 256 * bytes[1] - 32640;
  }
  std::vector<std::uint8_t> matter(int x, int y, int z) const {
    return texel("matter", {x + 2, y + 2, z + 2});
  }

  // Two are equal if all texels are, however they came.
  friend bool operator==(const Uploaded& a, const Uploaded& b) {
    return a.list_ == b.list_ && a.not_zeros() == b.not_zeros();
  }

  std::uint64_t version = 0;

 private:
  using Place = std::pair<std::size_t, std::array<int, 3>>;
  std::map<Place, std::vector<std::uint8_t>> not_zeros() const {
    auto found = bricks_;
    std::erase_if(found, [](const auto& brick) {
      return std::all_of(brick.second.begin(), brick.second.end(),
                         [](std::uint8_t byte) { return byte == 0; });
    });
    return found;
  }
  std::vector<Texture> list_;
  std::map<Place, std::vector<std::uint8_t>> bricks_;
};

using Textured = SceneFile;

TEST_F(Textured, HoldLevelsAndMatterByPlacesOfTheLattice) {
  Simulation boxes(write("boxes.toml", kBoxes));
  Uploaded uploaded;
  const Textures textures = boxes.textures();
  EXPECT_TRUE(textures.everything);
  uploaded.take(textures);
  // The pre-filter takes 43, 170 and 43 of 256 along each axis. Within the box all is full, and on a face 213
  // of 256 are. Beside a face 43 are. An edge has 213 of 256 of 213.
  EXPECT_EQ(uploaded.level(15, 8, 9), 65280 - 32640);
  EXPECT_EQ(uploaded.level(10, 8, 9), 54315 - 32640);
  EXPECT_EQ(uploaded.level(9, 8, 9), 10965 - 32640);
  EXPECT_EQ(uploaded.level(15, 13, 9), 10965 - 32640);
  EXPECT_EQ(uploaded.level(15, 8, 12), 10965 - 32640);
  EXPECT_EQ(uploaded.level(10, 3, 9), (213 * 54315 + 128) / 256 - 32640);
  EXPECT_EQ(uploaded.level(8, 8, 9), -32640);
  EXPECT_EQ(uploaded.level(-1, 0, 0), -32640);
  // The bytes of matter are liquid, heat or tone, obstacle and 0.
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(uploaded.matter(15, 8, 9), (Bytes{0, 0, 0, 0}));
  EXPECT_EQ(uploaded.matter(28, 8, 9), (Bytes{255, 0, 0, 0}));
  EXPECT_EQ(uploaded.matter(36, 12, 9), (Bytes{0, 0, 255, 0}));
}

TEST_F(Textured, KeepUpWithARunWhateverVersionIsAskedFor) {
  Simulation run(file);
  std::vector<Uploaded> all(3);
  for (Uploaded& one : all) one.take(run.textures());
  std::size_t sent = 0;
  for (std::uint32_t step = 1; step <= 24; ++step) {
    run.step();
    Simulation fresh(file);
    fresh.step(step);
    Uploaded wanted;
    wanted.take(fresh.textures());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (step % (i + 1) != 0) continue;  // it skips versions
      const Textures textures = run.textures(all[i].version);
      EXPECT_FALSE(textures.everything);
      sent += textures.bricks.size();
      all[i].take(textures);
      EXPECT_EQ(all[i], wanted) << "step " << step << ", every " << i + 1;
    }
  }
  EXPECT_GT(sent, 0u);
}

TEST_F(Textured, ListNothingWhereNothingChanged) {
  Simulation boxes(write("boxes.toml", kBoxes));
  const std::uint64_t version = boxes.textures().version;
  const Textures again = boxes.textures(version);
  EXPECT_FALSE(again.everything);
  EXPECT_EQ(again.bricks.size(), 0u);
  EXPECT_EQ(again.version, version);
}

TEST_F(Textured, AVersionOfAnotherSimulationIsUnknown) {
  Simulation one(file), other(file);
  const std::uint64_t first = one.textures().version, second = other.textures().version;
  EXPECT_NE(first, second);
  EXPECT_TRUE(other.textures(first).everything);
  EXPECT_TRUE(one.textures(second).everything);
  EXPECT_TRUE(one.textures(first + 1000).everything);
  EXPECT_FALSE(one.textures(first).everything);
}

TEST_F(Textured, GoBackWithARestart) {
  Simulation run(file);
  Uploaded kept, first;
  first.take(run.textures());
  run.step(30);
  kept.take(run.textures());
  EXPECT_FALSE(kept == first);
  run.restart();
  kept.take(run.textures(kept.version));
  EXPECT_EQ(kept, first);
}

TEST_F(Textured, RefuseAGridBeyondThirtyTwoBits) {
  std::string wide = kSmallScene;
  wide.replace(wide.find("[70,"), 4, "[1025,");
  Simulation run(write("wide.toml", wide));
  try {
    run.textures();
    ADD_FAILURE() << "it was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "textures: error: a grid of 1025 x 12 x 20 cells exceeds 1024 along a side, or 2^25 in all");
  }
}

}  // namespace
}  // namespace voxmelt
