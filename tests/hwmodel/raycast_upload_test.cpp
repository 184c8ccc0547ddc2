// After each step only what changed is sent to the ray caster's memory. What it holds then is compared, place
// by place, with the field of a fresh picture, which knows nothing of changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/picture/uploader.h"
#include "hwmodel/raycast/ray_caster.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// A scene that steps, and the pictures of it, told of changes.
class Melt {
 public:
  Melt(const std::string& name, std::uint32_t ahead, const std::vector<std::string>& overrides = {})
      : scene_(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), overrides)) {
    scene_.camera.width = 24, scene_.camera.height = 16;
    simulation_ = std::make_unique<run::Simulation>(scene_.parameters, std::move(scene_.initial),
                                                    *run::implementations().find("auto"));
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
    return compare_upload(uploader.registers(), uploader.memory(), fresh.data(camera(), render::Setting::fast));
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

std::string text(const UploadComparison& of, std::int64_t step) {
  return of.first ? text_of(*of.first, step) : "";
}

struct Totals {
  std::int64_t bricks = 0, other = 0, bytes = 0, cycles = 0, words = 0;
  void add(const UploadReport& report) {
    bricks += static_cast<std::int64_t>(report.bricks.size());
    other += std::count_if(report.bricks.begin(), report.bricks.end(), [](const SentBrick& b) { return b.other; });
    bytes += report.bursts * kBurst;
    cycles += report.cycles;
    words += report.slots + report.skip_words;
  }
};

class UploadOf : public testing::TestWithParam<std::pair<const char*, std::uint32_t>> {};

TEST_P(UploadOf, FiftyStepsOfChangedBricksMakeTheFieldByteForByte) {
  const auto& [name, ahead] = GetParam();
  Melt melt(name, ahead);
  Uploader uploader{Configuration{}};
  const UploadReport whole = melt.send(uploader);
  EXPECT_TRUE(whole.whole);
  Totals totals;
  for (int step = 1; step <= 50; ++step) {
    melt.step();
    const UploadReport report = melt.send(uploader);
    EXPECT_FALSE(report.whole);
    EXPECT_EQ(report.account.total(), report.cycles);
    totals.add(report);
    if (step % 10 != 0) continue;
    const UploadComparison of = melt.compare_fresh(uploader);
    ASSERT_GT(of.compared, 100000);
    ASSERT_FALSE(of.first) << text(of, melt.number());
  }
  EXPECT_GT(totals.other, 0);
  EXPECT_LT(totals.bytes, 50 * whole.bursts * kBurst);
  RecordProperty("whole_bytes", std::to_string(whole.bursts * kBurst));
  RecordProperty("bytes_per_step", std::to_string(totals.bytes / 50));
  std::printf("%s: whole %lld bytes, %lld cycles; a step %.0f bytes, %.0f cycles, %.1f bricks of which %.1f are others, %.1f words\n",
              name, static_cast<long long>(whole.bursts * kBurst), static_cast<long long>(whole.cycles),
              static_cast<double>(totals.bytes) / 50, static_cast<double>(totals.cycles) / 50, static_cast<double>(totals.bricks) / 50,
              static_cast<double>(totals.other) / 50, static_cast<double>(totals.words) / 50);
}

INSTANTIATE_TEST_SUITE_P(PaperScenes, UploadOf,
                         testing::Values(std::pair{"cello", 1048U}, std::pair{"goblet", 1100U},
                                         std::pair{"lava", 1200U}, std::pair{"bunny", 896U}),
                         [](const auto& of) { return std::string(of.param.first); });

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
