// The reference's trace draws the same picture, and its numbers fit the widths of docs/picture/trace.md. It
// reads as often as docs/picture/definition.md, section 12, says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "render/density/density_field.h"
#include "render/packet/field_bricks.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/trace.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt {
namespace {

using picture::Stage;
using test::HostilePicture;

constexpr std::uint64_t kPictures = 60;
constexpr int kMostCells = 12000;

// Holds a picture's parts in integers.
struct World {
  explicit World(const HostilePicture& picture)
      : field(field_of(picture)),
        scene(field, picture.look, picture.light, picture.terrain),
        camera(render::camera_in_integers(picture.camera)) {}

  static render::DensityField field_of(const HostilePicture& picture) {
    render::DensityField field;
    field.update(picture.volume, picture.look, picture.terrain, 1);
    return field;
  }

  render::DensityField field;
  render::PictureScene scene;
  picture::Camera camera;
};

// Makes a hostile picture that is small, but as wide for its height as before.
HostilePicture hostile(std::uint64_t seed) {
  HostilePicture picture = test::hostile_picture(seed, kMostCells);
  while (picture.camera.width * picture.camera.height > 1000) {
    if (picture.camera.height == 1) {
      picture.camera.width = 1000;
    } else {
      picture.camera.width = std::max(1, picture.camera.width / 2);
      picture.camera.height = std::max(1, picture.camera.height / 2);
    }
  }
  return picture;
}

// Makes a grid that is as long as it may be along an axis, and full. Along y it has ground up to the top.
HostilePicture longest(int axis) {
  HostilePicture picture = test::hostile_picture(static_cast<std::uint64_t>(axis), kMostCells);
  const state::Grid grid{axis == 0 ? 1024 : 4, axis == 1 ? 1024 : 2, axis == 2 ? 1024 : 2};
  picture.volume = state::Volume(grid);
  worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
    picture.volume.solid.set(x, y, z, axis != 1);
    picture.volume.inert.set(x, y, z, axis == 1);
    picture.volume.amount[picture.volume.at(x, y, z)] = 4096;
  });
  picture.terrain = {};
  if (axis == 1) {
    picture.terrain.x = grid.x;
    picture.terrain.z = grid.z;
    picture.terrain.textured = true;
    picture.terrain.height = {1024, 1024, 1024, 0, 1024, 1024, 1024, 0};
    picture.look.smooth = 0;
  }
  picture.look.background = {1, 1, 1};
  picture.light.direction = {0.6, 1, 0.3};
  picture.camera.target = {1.0 * grid.x, 1.0 * grid.y, 1.0 * grid.z};  // the far end
  picture.camera.distance = 3;
  picture.camera.azimuth = 40;
  picture.camera.elevation = axis == 1 ? 60 : 25;
  picture.camera.field_of_view = 40;
  picture.camera.width = picture.camera.height = 24;
  return picture;
}

class Silence : public render::Listener {
 public:
  void told(Stage, std::string_view, std::span<const std::int64_t>) override { ++count; }
  std::size_t count = 0;
};

TEST(Trace, DrawsTheSamePicture) {
  for (std::uint64_t seed = 0; seed < kPictures; ++seed) {
    const HostilePicture picture = hostile(seed);
    const World world(picture);
    Silence silence;
    const render::Image expected = reference_picture(world.scene, world.camera, picture.setting);
    const render::Image got = reference_picture(world.scene, world.camera, picture.setting, silence);
    ASSERT_EQ(got.pixels, expected.pixels) << description(picture);
    ASSERT_GT(silence.count, 0U);
    for (int i = 0; i < 5; ++i) {
      const int x = i * 7 % picture.camera.width, y = i * 5 % picture.camera.height;
      ASSERT_EQ(reference_pixel(world.scene, world.camera, picture.setting, x, y, silence), expected.at(x, y))
          << description(picture) << ", pixel " << x << ' ' << y;
    }
  }
}

// Returns the cells of a table's row in Markdown, without blanks around them. Other lines have none.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  if (line.empty() || line[0] != '|') return cells;
  std::istringstream text(line.substr(1));
  for (std::string cell; std::getline(text, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? ""
                                               : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
  }
  return cells;
}

struct Width {
  std::size_t count = 0;
  bool with_sign = false;
  int bits = 0;
  bool seen = false, other_count = false;
  std::int64_t low = 0, high = 0;  // range of all numbers that were told
};

// Looks up every number that is told in the table of widths.
class Widths : public render::Listener {
 public:
  Widths() {
    std::ifstream page(VOXMELT_DOCS "/picture/trace.md");
    for (std::string line; std::getline(page, line);) {
      const std::vector<std::string> row = cells_of(line);
      if (row.size() != 4 || row[3].find_first_of("us") != 0 || row[3].size() > 3) continue;
      widths_[row[0]][row[1]] = {std::stoul(row[2]), row[3][0] == 's', std::stoi(row[3].substr(1))};
    }
  }

  void told(Stage stage, std::string_view name, std::span<const std::int64_t> numbers) override {
    if (name == "range" && numbers[0] > numbers[1]) return;  // an empty range
    if (name == "fetched") numbers = numbers.subspan(3);
    auto& names = widths_[std::string(render::name_of(stage))];
    const auto found = names.find(name);
    if (found == names.end()) {
      unknown_.insert(std::string(render::name_of(stage)) + " " + std::string(name));
      return;
    }
    Width& width = found->second;
    width.seen = true;
    width.other_count |= numbers.size() != width.count;
    for (const std::int64_t number : numbers) {
      width.low = std::min(width.low, number);
      width.high = std::max(width.high, number);
    }
  }

  // Returns the errors in words, or nothing if all is as the table says.
  std::string wrong() const {
    std::ostringstream text;
    for (const std::string& name : unknown_) text << name << " is not in the table\n";
    for (const auto& [stage, names] : widths_)
      for (const auto& [name, width] : names) {
        const std::int64_t end = std::int64_t{1} << (width.bits - (width.with_sign ? 1 : 0));
        const bool fits = width.high < end && width.low >= (width.with_sign ? -end : 0);
        if (!width.seen) text << stage << ' ' << name << " is never told\n";
        if (width.other_count) text << stage << ' ' << name << " has another count of numbers\n";
        if (!fits) text << stage << ' ' << name << " goes from " << width.low << " to " << width.high << '\n';
      }
    return text.str();
  }

 private:
  std::map<std::string, std::map<std::string, Width, std::less<>>> widths_;
  std::set<std::string> unknown_;
};

TEST(Trace, NumbersFitTheWidthsOfThePage) {
  Widths widths;
  for (std::uint64_t seed = 0; seed < kPictures + 3; ++seed) {
    const HostilePicture picture =
        seed < kPictures ? hostile(seed) : longest(static_cast<int>(seed - kPictures));
    const World world(picture);
    reference_picture(world.scene, world.camera, picture.setting, widths);
  }
  EXPECT_EQ(widths.wrong(), "");
}

// Returns the reads per piece of work by the table of docs/picture/definition.md, section 12: the first
// number of the second cell.
std::map<std::string, int> reads_of_the_page() {
  std::map<std::string, int> reads;
  std::ifstream page(VOXMELT_DOCS "/picture/definition.md");
  bool here = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) here = line == "## 12. What hardware reads";
    const std::vector<std::string> row = cells_of(line);
    if (here && row.size() == 3 && row[1].find_first_of("0123456789") == 0) reads[row[0]] = std::stoi(row[1]);
  }
  return reads;
}

// Counts the fetches for each piece of work, and checks that those of a piece lie in one brick.
class Reads : public render::Listener {
 public:
  void told(Stage stage, std::string_view name, std::span<const std::int64_t> numbers) override {
    if (name == "fetched") {
      ++fetched_[stage];
      const bool in_bricks = stage == Stage::sample || stage == Stage::normal || stage == Stage::matter;
      for (std::size_t axis = 0; in_bricks && axis < 3; ++axis) {
        const std::int64_t place = numbers[axis] + render::kLatticeBorder - (8 * brick_[axis] - 1);
        if (place < 0 || place >= render::kBrickPlaces) ++outside_bricks;
      }
    }
    if (stage == Stage::brick) std::copy(numbers.begin(), numbers.end(), brick_.begin());
    if (stage == Stage::sample && name == "level") {
      end("sample", stage);
      ++samples_;
    }
    if (stage == Stage::crossing && name == "samples") samples_ = 0;
    if (stage == Stage::crossing && name == "f") count("crossing", samples_);
    if (stage == Stage::normal && name == "slope") end("normal", stage);
    if (stage == Stage::matter && name == "obstacle") end("matter", stage);
    if (stage == Stage::light && name == "lamp") {
      end("light", stage);
      count("light's bytes", bytes_);
    }
    if (stage == Stage::light && name == "fetched") bytes_ = static_cast<int>(numbers.size()) - 3;
    if (stage == Stage::ground && name == "height") end("ground's height", stage);
    if (stage == Stage::paint && name == "fall") end("ground's normal", stage);
    if (stage == Stage::texture && name == "bump") end("ground's texture", stage);
    if (stage == Stage::unit && name == "R") count("length", static_cast<int>(numbers.size()));
  }

  std::map<std::string, std::set<int>> counts;  // the counts that occurred
  int outside_bricks = 0;

 private:
  void count(const std::string& what, int number) { counts[what].insert(number); }
  void end(const std::string& what, Stage stage) {
    count(what, fetched_[stage]);
    fetched_[stage] = 0;
  }

  std::map<Stage, int> fetched_;
  int samples_ = 0, bytes_ = 0;
  std::array<std::int64_t, 3> brick_{};
};

TEST(Trace, ReadsAsOftenAsThePageSays) {
  Reads reads;
  for (std::uint64_t seed = 0; seed < kPictures; ++seed) {
    const HostilePicture picture = hostile(seed);
    const World world(picture);
    reference_picture(world.scene, world.camera, picture.setting, reads);
  }
  EXPECT_EQ(reads.outside_bricks, 0);
  EXPECT_EQ(reads.counts["light's bytes"], std::set<int>{13});  // with glow; the page says 7 without
  reads.counts.erase("light's bytes");
  const std::map<std::string, int> page = reads_of_the_page();
  for (const auto& [what, counts] : reads.counts) {
    ASSERT_EQ(page.count(what), 1U) << what << " is not in the table";
    EXPECT_EQ(counts, std::set<int>{page.at(what)}) << what;
  }
  EXPECT_EQ(reads.counts.size(), 9U);
}

}  // namespace
}  // namespace voxmelt
