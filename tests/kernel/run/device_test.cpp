// With a device stepper the run loop's state is in the stepper's own memory. The device here is the reference
// behind a wall: it hides its state, and counts the requests.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "kernel/automaton/state/difference.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/fields.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/engine/scalar/substeps.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/parallel/equal.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::run {
namespace {

using namespace worlds;

struct Traffic {
  int uploads = 0, steps = 0, mask_downloads = 0, downloads = 0;
};

class HiddenReference : public step::DeviceStepper {
 public:
  HiddenReference(const Parameters& parameters, Grid grid)
      : parameters_(parameters), reference_(parameters, grid) {
    traffic = {};
  }

  void change_sources(const Parameters& parameters) override { reference_.change_sources(parameters); }
  void upload(const Volume& volume, const state::Ledger& ledger) override {
    ++traffic.uploads;
    volume_ = volume;
    ledger_ = ledger;
  }
  void run_step(std::uint32_t step, const step::Irradiance* irradiance) override {
    ++traffic.steps;
    const rule::Law law = parameters_.flow.law;
    const step::Cadence cadence =
        law == rule::Law::viscous ? scalar::count_substeps(parameters_, volume_) : step::Cadence{};
    step::Moment moment(step, 0, cadence);
    for (const step::Phase phase : step::phase_order(law, cadence.substeps)) {
      reference_.run(phase, moment, irradiance, volume_, ledger_);
      if (phase == step::Phase::spread) ++moment.substep;
    }
  }
  void download_masks(Volume& volume) override {
    ++traffic.mask_downloads;
    volume.solid = volume_.solid;
    volume.inert = volume_.inert;
  }
  void download(Volume& volume, state::Ledger& ledger) override {
    ++traffic.downloads;
    state::copy_fields(volume_, volume);
    ledger = ledger_;
  }

  static inline Traffic traffic;

 protected:
  Volume volume_;

 private:
  Parameters parameters_;
  scalar::Reference reference_;
  state::Ledger ledger_;
};

// This device knows the rows of bricks that it has changed since it was last asked.
class TellingReference final : public HiddenReference {
 public:
  using HiddenReference::HiddenReference;
  void upload(const Volume& volume, const state::Ledger& ledger) override {
    HiddenReference::upload(volume, ledger);
    told_ = volume_;
  }
  void tell_changes(state::ChangedBricks& changed) override {
    for_each(whole(volume_.grid), [&](int x, int y, int z) {
      if (state::same_cell(told_, volume_, x, y, z)) return;
      changed.mark(state::ChangedBricks::kMatter, std::uint64_t{1} << (x / 64), y / 8, z / 8);
    });
    told_ = volume_;
  }

 private:
  Volume told_;
};

const step::Implementation kHidden{
    "hidden", "",
    [](const Parameters& parameters, Grid grid, const step::Tuning&) -> std::unique_ptr<step::Stepper> {
      return std::make_unique<HiddenReference>(parameters, grid);
    }};

const step::Implementation kTelling{
    "telling", "",
    [](const Parameters& parameters, Grid grid, const step::Tuning&) -> std::unique_ptr<step::Stepper> {
      return std::make_unique<TellingReference>(parameters, grid);
    }};

// The approved digests have lines such as "step 10 digest 38ec6dd4b2ee9cb7 mass ...". The oracle agrees with
// them.
std::uint64_t approved_digest(const std::string& scene) {
  std::ifstream file(VOXMELT_APPROVED_DIGESTS);
  const std::string line = nlohmann::json::parse(file).at(scene).at("10");
  return std::stoull(line.substr(line.find("digest ") + 7, 16), nullptr, 16);
}

// A box falls for six steps and lands. The state comes back only while it is loose.
TEST(Device, PiecesFallInTheHostsMemory) {
  Parameters p = viscous(0.02);
  p.pieces.fall = true;
  Volume v(Grid{12, 12, 12});
  fill(v, {0, 0, 0, 12, 1, 12}, kOne / 4);
  for_each({3, 6, 3, 7, 9, 6}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  Simulation expected = simulate(p, v);
  steps(expected, 10);
  Simulation device(p, v, kHidden);
  steps(device, 10);
  EXPECT_EQ(HiddenReference::traffic.uploads, 1 + 6);
  EXPECT_EQ(HiddenReference::traffic.downloads, 5) << "the first step had the state";
  EXPECT_EQ(device.volume(), expected.volume());
}

TEST(Device, EveryCommittedSceneHasItsDigestAndTheStateIsFetchedOnce) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(VOXMELT_SCENES_FOLDER)) {
    if (entry.path().extension() != ".toml") continue;
    scene::Scene scene = scene::load(entry.path(), {});
    const rule::Heat heat = scene.parameters.heat;
    Simulation simulation(scene.parameters, std::move(scene.initial), kHidden);
    steps(simulation, 10);
    EXPECT_EQ(HiddenReference::traffic.downloads, 0) << scene.name;
    EXPECT_EQ(state::digest(simulation.volume()), approved_digest(scene.name)) << scene.name;
    EXPECT_TRUE(simulation.drift().none()) << scene.name;

    const auto visible = heat.enabled && heat.radiation ? 9 / static_cast<int>(heat.visibility_every) : 0;
    EXPECT_EQ(HiddenReference::traffic.uploads, 1) << scene.name;
    EXPECT_EQ(HiddenReference::traffic.steps, 10) << scene.name;
    const int asked = scene.parameters.pieces.fall ? 9 : visible;  // pieces may fall in every step
    EXPECT_EQ(HiddenReference::traffic.mask_downloads, asked) << scene.name << ": step 0 needs none";
    EXPECT_EQ(HiddenReference::traffic.downloads, 1) << scene.name;
    ++scenes;
  }
  EXPECT_GT(scenes, 20);
}

Volume melting_block() {
  Volume v(Grid{16, 12, 16});
  for_each({5, 2, 5, 11, 10, 11}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 25000); });
  return v;
}
Parameters melting_parameters() {
  Parameters p = paper_showcase();
  p.heat.enabled = true;
  p.heat.weight_face = 8000;
  p.heat.radiation = true;
  p.heat.sources = {{{{0, {16 * 20, 16 * 12, 16 * 8}, std::uint64_t{1} << 31}}}};
  return p;
}

TEST(Device, HasTheStateAndTheBooksOfTheReferenceWheneverTheyAreRead) {
  Simulation hidden(melting_parameters(), melting_block(), kHidden);
  Simulation reference = simulate(melting_parameters(), melting_block());
  for (int step = 0; step < 60; ++step) {
    hidden.step();
    reference.step();
    if (step % 7 != 3) continue;
    ASSERT_TRUE(hidden.ledger() == reference.ledger()) << "step " << step;
    ASSERT_TRUE(hidden.volume() == reference.volume()) << "step " << step;
  }
  EXPECT_GT(hidden.volume().liquid.count(), 20) << "it did melt: visibility saw the masks of its step";
  EXPECT_EQ(HiddenReference::traffic.uploads, 1);
  EXPECT_EQ(HiddenReference::traffic.downloads, 9) << "steps 3, 10, .. 52, and the last";
}

TEST(Device, GoesOnFromWhatTheHostHasChanged) {
  Simulation hidden(melting_parameters(), melting_block(), kHidden);
  Simulation reference = simulate(melting_parameters(), melting_block());
  for (Simulation* one : {&hidden, &reference}) {
    steps(*one, 20);
    Volume& v = one->mutable_volume();
    v.amount[v.at(6, 9, 6)] = 1234;
    one->mutable_ledger().mass.added += 5;
    steps(*one, 5);
  }
  EXPECT_TRUE(hidden.volume() == reference.volume());
  EXPECT_TRUE(hidden.ledger() == reference.ledger());
  EXPECT_EQ(HiddenReference::traffic.uploads, 2);
}

// The block melts in the bricks z < 16. If the device tells its changes, a follower of its volume need not
// look beyond.
TEST(Device, TellsItsChangesThroughTheOneInterface) {
  Volume start(Grid{16, 12, 64});
  for_each({5, 2, 5, 11, 10, 11}, [&](int x, int y, int z) { put_solid(start, x, y, z, kOne, 25000); });
  const std::size_t far = state::brick_grid(start.grid).index(0, 0, 6);
  for (const auto& [device, tells] : {std::pair(&kHidden, false), {&kTelling, true}}) {
    Simulation simulation(melting_parameters(), start, *device);
    Volume before = simulation.volume();
    state::ChangedBricks::Seen seen = simulation.volume().changed.now();
    int changed = 0;
    for (int step = 0; step < 30; ++step) {
      simulation.step();
      if (step % 3 == 1) continue;  // changes of several steps add up
      const Volume& after = simulation.volume();
      ASSERT_FALSE(after.changed.all_since(seen)) << "a download does not begin the account anew";
      ASSERT_EQ(untold(before, seen, after), "") << "step " << step;
      EXPECT_EQ(after.changed.since(state::ChangedBricks::kMatter, seen, far), !tells) << "step " << step;
      changed += !(before == after);
      before = after;
      seen = after.changed.now();
      EXPECT_TRUE(simulation.volume().changed.none_since(seen)) << "nothing was done in between";
    }
    EXPECT_GT(changed, 15);

    Volume& edited = simulation.mutable_volume();
    edited.amount[edited.at(8, 1, 60)] = 0;
    simulation.step();
    EXPECT_TRUE(simulation.volume().changed.all_since(seen)) << "nobody tells of an edit by hand";
  }
}

TEST(Device, HasNoPhases) {
  Simulation hidden(melting_parameters(), melting_block(), kHidden);
  hidden.begin_step();
  EXPECT_THROW(hidden.run_phase(step::Phase::heat), std::logic_error);
}

}  // namespace
}  // namespace voxmelt::run
