// After each step only changes are sent to the ray caster's memory. Its contents are then compared, place by
// place, with the field of a fresh picture, which knows nothing of changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hwmodel/caster/check/picture_run.h"
#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "tests/hwmodel/caster/model/known_cycles.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::uint32_t kSmall = 200;  // the step at which bunny_small melts everywhere

// Steps a scene and draws pictures of it, which are told of its changes.
class Melt {
 public:
  Melt(const std::string& name, std::uint32_t ahead, const std::vector<std::string>& overrides = {})
      : scene_(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), overrides)) {
    scene_.camera.width = 24;
    scene_.camera.height = 16;
    simulation_ = std::make_unique<run::Simulation>(scene_.parameters, std::move(scene_.initial),
                                                    run::implementations().widest());
    while (simulation_->step_number() < ahead) simulation_->step();
    take_over();
  }
  void step() {
    simulation_->step();
    take_over();
  }
  std::int64_t number() const { return simulation_->step_number(); }
  const std::vector<std::uint32_t>* changed() const { return changed_; }
  render::PictureData data() const { return picture_.data(camera(), render::Setting::fast); }
  UploadReport send(Uploader& uploader) const { return uploader.update(data(), changed_); }
  render::Image image() const { return picture_.draw(scene_.camera, render::Setting::fast, 1); }

  UploadComparison compare_fresh(Uploader& uploader) const {
    render::Picture fresh;
    fresh.update(simulation_->volume(), scene_.look, scene_.light, scene_.terrain, 1);
    return compare_upload(uploader.registers(), uploader.memory(),
                          fresh.data(camera(), render::Setting::fast));
  }
  void draw(PictureRun& run) const {
    const render::PictureScene reference(field_, scene_.look, scene_.light, scene_.terrain);
    run.draw(reference, camera(), render::Setting::fast, image());
  }
  UploadComparison compare(Uploader& uploader) const {
    return compare_upload(uploader.registers(), uploader.memory(), data());
  }

 private:
  picture::Camera camera() const { return render::camera_in_integers(scene_.camera); }
  void take_over() {
    field_.update(simulation_->volume(), scene_.look, scene_.terrain, 1);
    changed_ = first_ ? nullptr : &field_.refreshed();
    first_ = false;
    picture_.update(field_, scene_.look, scene_.light, scene_.terrain, changed_, 1);
  }

  scene::Scene scene_;
  std::unique_ptr<run::Simulation> simulation_;
  render::DensityField field_;
  render::Picture picture_;
  bool first_ = true;
  const std::vector<std::uint32_t>* changed_ = nullptr;
};

std::string text(const UploadComparison& comparison, std::int64_t step) {
  return comparison.first ? text_of(*comparison.first, step) : "";
}

using Bytes = std::array<std::int64_t, kSentVolumes>;
std::int64_t sum_of(const Bytes& bytes) {
  return std::accumulate(bytes.begin(), bytes.end(), std::int64_t{0});
}

class UploadOf : public testing::TestWithParam<std::pair<const char*, std::uint32_t>> {};

TEST_P(UploadOf, FiftyStepsOfChangedBricksMakeTheFieldByteForByte) {
  const auto& [name, ahead] = GetParam();  // docs/hardware/ray-caster.md has them without falls
  Melt melt(name, ahead, {"pieces.fall=false"});
  Uploader uploader{Configuration{}};
  const UploadReport whole = melt.send(uploader);
  ASSERT_TRUE(whole.whole);
  Bytes bytes{};
  std::int64_t cycles = 0;
  for (int step = 1; step <= 50; ++step) {
    melt.step();
    const UploadReport report = melt.send(uploader);
    ASSERT_FALSE(report.whole);
    ASSERT_EQ(sum_of(report.bytes), report.bursts * kBurst);
    ASSERT_EQ(report.account.total(), report.cycles);
    ASSERT_EQ(report.cycles, known_upload(report.words, report.bursts, Configuration{}));
    for (std::size_t i = 0; i < kSentVolumes; ++i) bytes[i] += report.bytes[i];
    cycles += report.cycles;
    if (step % 25 != 0) continue;
    const UploadComparison comparison = melt.compare_fresh(uploader);
    ASSERT_GT(comparison.compared, 100000);
    ASSERT_FALSE(comparison.first) << text(comparison, melt.number());
  }
  EXPECT_GT(bytes[0], 0);
  EXPECT_GT(bytes[1], 0);
  EXPECT_GT(bytes[2], 0);
  EXPECT_LT(sum_of(bytes), 50 * sum_of(whole.bytes));
  // These numbers show with --gtest_output, and docs/hardware/pipeline.md quotes them.
  RecordProperty("whole_bytes", std::to_string(sum_of(whole.bytes)));
  RecordProperty("whole_cycles", std::to_string(whole.cycles));
  RecordProperty("level_bytes", std::to_string(bytes[0] / 50));
  RecordProperty("matter_bytes", std::to_string(bytes[1] / 50));
  RecordProperty("light_bytes", std::to_string(bytes[2] / 50));
  RecordProperty("cycles", std::to_string(cycles / 50));
}

INSTANTIATE_TEST_SUITE_P(PaperScenes, UploadOf,
                         testing::Values(std::pair{"cello", 1048U}, std::pair{"goblet", 1100U},
                                         std::pair{"lava", 1200U}, std::pair{"bunny", 896U}),
                         [](const auto& one) { return std::string(one.param.first); });

// Every brick of a step with other bytes is forgotten once, in the middle of six steps. The comparison names
// it in that step, and not before.
TEST(Upload, AForgottenBrickIsFoundWithItsStep) {
  for (const bool apron : {false, true}) {
    Configuration configuration;
    configuration.apron = apron;
    std::vector<SentBrick> others;
    std::int64_t at = 0;
    {
      Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
      Uploader uploader{configuration};
      melt.send(uploader);
      for (int step = 1; step <= 3; ++step) {
        melt.step();
        const UploadReport report = melt.send(uploader);
        if (step != 3) continue;
        at = melt.number();
        for (const SentBrick& brick : report.bricks)
          if (brick.other) others.push_back(brick);
      }
    }
    ASSERT_GT(others.size(), 8U);
    const auto of_levels = [](const SentBrick& b) { return b.volume == Sent::levels; };
    ASSERT_TRUE(std::any_of(others.begin(), others.end(), of_levels));
    ASSERT_FALSE(std::all_of(others.begin(), others.end(), of_levels));
    const std::size_t every = std::max<std::size_t>(others.size() / 12, 1);
    for (std::size_t i = 0; i < others.size(); i += every) {
      Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
      Uploader uploader{configuration};
      uploader.plant({UploadFault::Kind::forgotten, 3, others[i]});
      melt.send(uploader);
      for (int step = 1; step <= 2; ++step) {
        melt.step();
        melt.send(uploader);
        const UploadComparison comparison = melt.compare(uploader);
        ASSERT_FALSE(comparison.first) << text(comparison, melt.number());
      }
      melt.step();
      melt.send(uploader);
      ASSERT_EQ(melt.number(), at);
      const UploadComparison comparison = melt.compare(uploader);
      ASSERT_TRUE(comparison.first);
      EXPECT_EQ(comparison.first->volume, of_levels(others[i]) ? "levels" : "matter");
      EXPECT_EQ(comparison.first->brick, others[i].brick);
      EXPECT_NE(text(comparison, melt.number()).find("step " + std::to_string(at)), std::string::npos);
    }
  }
}

// Returns the bricks with other bytes that a correct uploader sends in step `at`.
std::vector<SentBrick> bricks_sent(const Configuration& configuration, int at) {
  Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
  Uploader uploader{configuration};
  melt.send(uploader);
  std::vector<SentBrick> sent;
  for (int step = 1; step <= at; ++step) {
    melt.step();
    const UploadReport report = melt.send(uploader);
    if (step != at) continue;
    for (const SentBrick& brick : report.bricks)
      if (brick.other) sent.push_back(brick);
  }
  return sent;
}

// A brick that is put in the place of the next one is found with its step: its own place is old, or the next
// one is wrong.
TEST(Upload, AMisplacedBrickIsFoundWithItsStep) {
  for (const bool apron : {false, true}) {
    Configuration configuration;
    configuration.apron = apron;
    const std::vector<SentBrick> sent = bricks_sent(configuration, 2);
    ASSERT_GT(sent.size(), 8U);
    const std::size_t every = std::max<std::size_t>(sent.size() / 10, 1);
    for (std::size_t i = 0; i < sent.size(); i += every) {
      Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
      Uploader uploader{configuration};
      uploader.plant({UploadFault::Kind::misplaced, 2, sent[i]});
      melt.send(uploader);
      melt.step();
      melt.send(uploader);
      ASSERT_FALSE(melt.compare(uploader).first);
      melt.step();
      melt.send(uploader);
      const UploadComparison comparison = melt.compare(uploader);
      ASSERT_TRUE(comparison.first);
      EXPECT_EQ(comparison.first->volume, sent[i].volume == Sent::levels ? "levels" : "matter");
      const Layout& layout = uploader.memory().levels;
      const auto slot = [&](const state::Grid& b) { return layout.brick_at(b.x, b.y, b.z); };
      const std::int64_t ahead = slot(comparison.first->brick) - slot(sent[i].brick);
      EXPECT_TRUE(ahead == 0 || ahead == 1) << ahead;
    }
  }
}

// The caches hold all, and are not told of one brick that was sent. Lock-step finds an old word in it, or the
// picture does not need it. If the caches are told of a brick whose words the picture needs, it is never
// found.
TEST(Upload, ABrickOfWhichTheCachesAreNotToldIsFoundInTheNextPicture) {
  PictureOptions options;
  options.configuration.levels = options.configuration.matter = {1024, 4, 8, 64};
  const std::vector<SentBrick> sent = bricks_sent(options.configuration, 1);
  int found = 0, levels = 0;
  for (const SentBrick& brick : sent) {
    for (const bool told : {true, false}) {
      if (told && found >= 3) continue;
      Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
      Uploader uploader{options.configuration};
      if (!told) uploader.plant({UploadFault::Kind::untold, 1, brick});
      melt.send(uploader);
      PictureRun run(uploader.registers(), uploader.memory(), options);
      melt.draw(run);
      ASSERT_TRUE(run.good());
      melt.step();
      run.forget(melt.send(uploader));
      ASSERT_FALSE(melt.compare(uploader).first);  // memory itself is right
      melt.draw(run);
      if (run.good()) continue;
      ASSERT_FALSE(told) << text_of(*run.report().difference);
      ++found;
      const PictureReport report = run.report();
      ASSERT_TRUE(report.difference);
      EXPECT_EQ(report.difference->stage, brick.volume == Sent::levels ? "levels" : "matter");
      levels += brick.volume == Sent::levels ? 1 : 0;
      ASSERT_TRUE(report.difference->has_position);
      const Vec at = to_lattice(report.difference->position) >> (kCellBits + kBrickBits);
      EXPECT_LE(std::abs(at.x - brick.brick.x), 1);
      EXPECT_LE(std::abs(at.y - brick.brick.y), 1);
      EXPECT_LE(std::abs(at.z - brick.brick.z), 1);
    }
  }
  EXPECT_GE(found, 4);
  EXPECT_GE(levels, 2);
  EXPECT_LT(levels, found);
}

// Memory holds the field, too, when bricks hold their aprons, lines are as large as bricks, or stalls delay
// the bursts.
TEST(Upload, EveryLayoutHoldsTheFieldAfterEveryStep) {
  for (const int bits : {1, 2, 3})
    for (const bool apron : {false, true}) {
      Configuration configuration;
      configuration.level_bits = bits;
      configuration.apron = apron;
      configuration.stall_seed = apron ? 7 : 0;
      Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
      Uploader uploader{configuration};
      melt.send(uploader);
      for (int step = 0; step < 10; ++step) {
        const UploadComparison comparison = melt.compare_fresh(uploader);
        ASSERT_GT(comparison.compared, 10000);
        ASSERT_FALSE(comparison.first) << text(comparison, melt.number());
        melt.step();
        melt.send(uploader);
      }
    }
}

// Turns air into solid or liquid, or back. The bytes of matter are 0 in the one case, and not in the other.
void toggle_cell(state::Volume& volume, int x, int y, int z) {
  std::uint16_t& amount = volume.amount[volume.at(x, y, z)];
  const bool fill = amount == 0, liquid = fill && (x + y + z) % 2 == 0;
  volume.solid.set(x, y, z, fill && !liquid);
  volume.liquid.set(x, y, z, liquid);
  amount = fill ? 4096 : 0;
}

// Single cells make bricks, in changing order: in the second update a brick is stored before the others,
// whose places in memory change. An old table of matter's bricks is found at once.
TEST(Upload, AnOldTableOfBricksIsFoundWithItsStep) {
  scene::Look look;
  look.smooth = look.smooth_solid = 0;
  const picture::Camera camera = render::camera_in_integers({});
  for (const bool planted : {false, true}) {
    Uploader uploader{Configuration{}};
    if (planted) uploader.plant({UploadFault::Kind::old_table, 2, {}});
    state::Volume volume({40, 40, 40});
    toggle_cell(volume, 20, 20, 20);
    toggle_cell(volume, 36, 36, 36);
    render::DensityField field;
    render::Picture picture;
    for (int update = 0; update < 3; ++update) {
      if (update > 0) toggle_cell(volume, 4, 4, 16 * update - 12);
      field.update(volume, look, {}, 1);
      const std::vector<std::uint32_t>* changed = update == 0 ? nullptr : &field.refreshed();
      picture.update(field, look, {}, {}, changed, 1);
      const render::PictureData data = picture.data(camera, render::Setting::fast);
      uploader.update(data, changed);
      const UploadComparison comparison = compare_upload(uploader.registers(), uploader.memory(), data);
      ASSERT_EQ(comparison.first.has_value(), planted && update == 2)
          << update << ' ' << text(comparison, update);
      if (comparison.first) {
        EXPECT_EQ(comparison.first->volume, "matter");
      }
    }
  }
}

// The bounds of the ground are compared with the demand of each column: the three of each block, and those of
// the blocks of 16 x 16 cells.
TEST(Upload, AWrongBoundOfTheGroundIsFound) {
  const Melt melt("lava", 0);
  Uploader uploader{Configuration{}};
  melt.send(uploader);
  ASSERT_FALSE(melt.compare(uploader).first) << text(melt.compare(uploader), 0);
  const Registers right = uploader.registers();
  const auto found = [&](const Registers& wrong) {
    const UploadComparison comparison = compare_upload(wrong, uploader.memory(), melt.data());
    return comparison.first ? comparison.first->volume : "";
  };
  const std::size_t fine = right.ground.blocks.fine.size();
  ASSERT_GT(fine, 50U);
  for (const std::size_t i : {std::size_t{0}, fine / 2, fine - 1})
    for (const int by : {-1, 1}) {
      Registers wrong = right;
      wrong.ground.blocks.fine[i].highest += by;
      EXPECT_EQ(found(wrong), "bound of heights");
      wrong = right;
      wrong.ground.blocks.fine[i].slope_x += by;
      EXPECT_EQ(found(wrong), "bound of slopes along x");
      wrong = right;
      wrong.ground.blocks.fine[i].slope_z += by;
      EXPECT_EQ(found(wrong), "bound of slopes along z");
    }
  Registers wrong = right;
  wrong.ground.blocks.coarse.back() -= 1;
  EXPECT_EQ(found(wrong), "bound of heights, 16 x 16 cells");
}

// Lone cells at the sides of bricks come and go, without any filter. Bricks are then stored in the old rooms
// of others, and an apron holds cells that no other listed brick has.
TEST(Upload, LoneCellsThatComeAndGoAreWhereTheyShouldBe) {
  scene::Look look;
  look.smooth = look.smooth_solid = 0;
  scene::Camera picture_camera;
  picture_camera.width = 16;
  picture_camera.height = 16;
  const picture::Camera camera = render::camera_in_integers(picture_camera);
  std::mt19937 random(61);
  for (const bool apron : {false, true}) {
    Configuration configuration;
    configuration.apron = apron;
    Uploader uploader{configuration};
    state::Volume volume({40, 40, 40});
    render::DensityField field;
    render::Picture now;
    const auto toggle = [&] {
      const auto coordinate = [&] {
        return static_cast<int>(8 * (random() % 5) + (random() % 4 < 3 ? 0 : random() % 8));
      };
      toggle_cell(volume, coordinate(), coordinate(), coordinate());
    };
    for (int i = 0; i < 20; ++i) toggle();
    for (int step = 0; step < 60; ++step) {
      field.update(volume, look, {}, 1);
      const std::vector<std::uint32_t>* changed = step == 0 ? nullptr : &field.refreshed();
      now.update(field, look, {}, {}, changed, 1);
      uploader.update(now.data(camera, render::Setting::fast), changed);
      render::Picture fresh;
      fresh.update(volume, look, {}, {}, 1);
      const UploadComparison comparison =
          compare_upload(uploader.registers(), uploader.memory(), fresh.data(camera, render::Setting::fast));
      ASSERT_FALSE(comparison.first) << text(comparison, step) << "apron " << apron;
      toggle();
      if (step % 3 == 0) toggle();
    }
  }
}

// A vent fills an empty grid. More and more bricks are stored, until there is no room for them.
TEST(Upload, WhereThereIsNoRoomForMoreBricksAllIsSentAnew) {
  Melt melt("lesson_piling", 0);
  Uploader uploader{Configuration{}};
  melt.send(uploader);
  int whole = 0;
  for (int step = 0; step < 60; ++step) {
    melt.step();
    whole += melt.send(uploader).whole ? 1 : 0;
    const UploadComparison comparison = melt.compare(uploader);
    ASSERT_FALSE(comparison.first) << text(comparison, melt.number());
  }
  EXPECT_GE(whole, 1);
  EXPECT_LE(whole, 6);
}

// A ray caster with warm caches draws each step, once its caches have forgotten the lines that were sent.
// Caches that forget nothing draw an old picture.
TEST(Upload, WarmCachesDrawEachStepIfTheyForgetWhatWasSent) {
  for (const bool forgets : {true, false}) {
    Melt melt("bunny_small", kSmall, {"heat.visibility_every=8"});
    Uploader uploader{Configuration{}};
    melt.send(uploader);
    RayCaster caster(uploader.registers(), uploader.memory(), Configuration{});
    int different = 0;
    for (int step = 0; step < 6; ++step) {
      ASSERT_TRUE(caster.draw_first().complete);
      const render::Image expected = melt.image();
      for (int y = 0; y < expected.height; ++y)
        for (int x = 0; x < expected.width; ++x) {
          const std::int64_t tile = (y / 8) * 3 + x / 8;
          const std::uint8_t* bytes = uploader.memory().bytes.data() + uploader.memory().frame + 192 * tile +
                                      3 * (8 * (y % 8) + x % 8);
          const auto& e = expected.at(x, y);
          different += e != std::decay_t<decltype(e)>{bytes[0], bytes[1], bytes[2]} ? 1 : 0;
        }
      for (int ahead = 0; ahead < 4; ++ahead) {
        melt.step();
        const UploadReport report = melt.send(uploader);
        ASSERT_FALSE(report.whole);
        for (std::size_t i = 0; forgets && i < kSentVolumes; ++i) caster.forget(i, report.lines[i]);
      }
    }
    if (forgets)
      EXPECT_EQ(different, 0);
    else
      EXPECT_GT(different, 0);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
