// The pipeline and the ray caster share one memory. Their bits, their bytes and the sums of cycles are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "hwmodel/machine/machine.h"
#include "hwmodel/machine/report_machine.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/sheet.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/packet/picture.h"

namespace voxmelt::hwmodel {
namespace {

// Loads a scene in which passes of the stream may have several steps.
scene::Scene load(const std::string& name) {
  scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
  scene.parameters.heat.visibility_every = 8;
  return scene;
}

struct Melt {
  explicit Melt(const std::string& name, std::uint32_t ahead)
      : scene(load(name)),
        before(scene.parameters, std::move(scene.initial), *run::implementations().find("reference")) {
    ahead -= scene.parameters.heat.visibility_age(ahead);
    while (before.step_number() < ahead) before.step();
    scene.camera.width = 40;
    scene.camera.height = 32;
  }
  MachineReport verify(const MachineOptions& options) const {
    return verify_machine({scene.parameters,
                           before.step_number(),
                           *run::implementations().find("reference"),
                           {},
                           {before.volume(), scene.look, scene.light, scene.terrain, scene.camera, setting}},
                          options);
  }

  scene::Scene scene;
  run::Simulation before;
  render::Setting setting = render::Setting::normal;
};

MachineOptions small_machine() {
  MachineOptions options;
  options.steps.steps = 6;
  options.steps.configuration.cascade = 2;
  options.picture.frames = 3;
  return options;
}

TEST(Machine, StatesAndPicturesAreThoseOfTheSoftware) {
  for (const char* name : {"bunny_small", "bunny_small_viscous", "lesson_piling"}) {
    const Melt melt(name, 24);
    MachineOptions options = small_machine();
    options.picture.configuration.pipes = 2;
    const MachineReport report = melt.verify(options);
    ASSERT_TRUE(report.good()) << name;
    ASSERT_EQ(report.periods.size(), 3U);

    run::Simulation software(melt.scene.parameters, melt.before.volume(), run::implementations().widest());
    software.begin_at(melt.before.step_number());
    for (int i = 0; i < 6; ++i) software.step();
    EXPECT_EQ(report.steps.digest, state::digest(software.volume())) << name;
    EXPECT_EQ(report.periods.back().step, software.step_number());
    render::Picture picture;
    picture.update(software.volume(), melt.scene.look, melt.scene.light, melt.scene.terrain, 1);
    const render::Image expected = picture.draw(melt.scene.camera, melt.setting, 1);
    int different = 0;
    for (int y = 0; y < expected.height; ++y)
      for (int x = 0; x < expected.width; ++x)
        different += expected.at(x, y) != report.pictures.image.at(x, y) ? 1 : 0;
    EXPECT_EQ(different, 0) << name;
  }
}

TEST(Machine, CyclesAndBytesSumUp) {
  const Melt melt("bunny_small", 200);
  MachineOptions options = small_machine();
  options.picture.configuration.bus_bytes = 96;
  const MachineReport report = melt.verify(options);
  ASSERT_TRUE(report.good());
  const state::Grid g = melt.before.volume().grid;
  const std::int64_t tokens = std::int64_t{(g.x + 3) / 4} * g.y * g.z;
  std::int64_t cycles = 0, frames = report.first_frame, read = 0;
  for (const Period& period : report.periods) {
    EXPECT_EQ(period.work.passes, 1);  // two steps at a cascade of 2
    EXPECT_EQ(period.work.tokens, tokens);
    EXPECT_EQ(period.work.read_bits, tokens * 4 * 50);
    EXPECT_EQ(period.work.written_bits, tokens * 4 * 50);
    EXPECT_GT(period.work.cycles, tokens);
    // The first words come after the latency. The last ones go when the last token has been written.
    EXPECT_GE(period.stream, period.work.cycles + options.picture.configuration.latency);
    EXPECT_LE(period.stream, period.work.cycles + 2 * options.picture.configuration.latency);
    EXPECT_GE(period.stream_beside, period.stream);
    EXPECT_EQ(period.together, std::max(period.stream_beside, period.frame_beside));
    EXPECT_LE(period.together, period.stream + period.frame + period.frame / 2);
    EXPECT_EQ(period.frame_written, 2 * 5 * 4 * 192);  // two passes, tiles of 192 bytes
    EXPECT_GT(period.upload.bursts, 0);
    EXPECT_LT(period.upload.bursts, report.first_upload.bursts);
    cycles += period.stream_beside;
    frames += period.frame_beside;
    read += period.frame_read;
  }
  EXPECT_EQ(cycles, report.steps.cycles);
  // The picture of the last state is drawn while the pipeline is idle, so it takes as long as alone.
  EXPECT_EQ(frames + report.periods.back().frame, report.pictures.all_cycles);
  EXPECT_LT(read, report.pictures.memory.read_bytes);  // the first frame reads, too
  EXPECT_EQ(report.state_bytes, (tokens * 4 * 50 + 7) / 8);

  const nlohmann::ordered_json json = json_of(report, options);
  const Period sum = report.sum();
  EXPECT_DOUBLE_EQ(json["a_second"]["overlapped"]["frames"].get<double>(),
                   3 * 2e8 / static_cast<double>(sum.overlapped()));
  EXPECT_DOUBLE_EQ(json["a_second"]["in_turn"]["steps"].get<double>(),
                   6 * 2e8 / static_cast<double>(sum.in_turn()));
  for (const Bound& bound : bounds_of(report, options)) {
    EXPECT_GE(bound.share, 0) << bound.name;
    EXPECT_LE(bound.share, 1) << bound.name;
  }
}

// The same picture is drawn alone and beside the pipeline. On a wide bus the neighbour costs next to nothing.
// On a narrow one both wait.
TEST(Machine, BothWaitForANarrowBus) {
  const Melt melt("bunny_small", 200);
  for (const bool narrow : {false, true}) {
    MachineOptions options = small_machine();
    options.picture.configuration.bus_bytes = narrow ? 60 : 4096;
    const MachineReport report = melt.verify(options);
    ASSERT_TRUE(report.good());
    for (std::size_t i = 1; i < 3; ++i) {
      const Period &before = report.periods[i - 1], &period = report.periods[i];
      EXPECT_EQ(period.together, std::max(period.stream_beside, period.frame_beside));
      if (narrow) {
        EXPECT_GT(period.frame_beside, before.frame + before.frame / 20);
        EXPECT_GT(period.stream_beside, period.work.cycles + 100);
      } else {
        EXPECT_LT(std::abs(period.frame_beside - before.frame), before.frame / 50);
        EXPECT_LE(period.stream_beside, period.stream + 2);
      }
    }
  }
}

TEST(Machine, BothAreClientsOfOneDram) {
  const Melt melt("bunny_small", 200);
  MachineOptions options = small_machine();
  options.picture.configuration.dram = load_memory("ddr4-2400", "");
  const MachineReport report = melt.verify(options);
  ASSERT_TRUE(report.good());
  for (std::size_t i = 1; i < 3; ++i) {
    const Period &before = report.periods[i - 1], &period = report.periods[i];
    EXPECT_GT(period.stream, period.work.cycles);
    EXPECT_GE(period.stream_beside, period.stream - period.stream / 50);
    EXPECT_GT(period.frame_beside, before.frame);
    EXPECT_EQ(period.together, std::max(period.stream_beside, period.frame_beside));
  }
}

// A wrong pixel, or a wrong cell, ends the run.
TEST(Machine, ADifferenceEndsTheRun) {
  const Melt melt("bunny_small", 200);
  MachineOptions options = small_machine();
  options.picture.fault = raycast::Fault::pixel_byte;
  const MachineReport report = melt.verify(options);
  EXPECT_FALSE(report.good());
  EXPECT_TRUE(report.periods.empty());
  EXPECT_EQ(report.steps.steps, 2U) << "the steps beside which the picture was drawn";
  options.picture.fault = raycast::Fault::none;
  options.steps.fault = Fault::conduction_sign;
  options.steps.fault_step = melt.before.step_number() + 2;
  const MachineReport wrong_step = melt.verify(options);
  EXPECT_FALSE(wrong_step.good());
  EXPECT_NE(wrong_step.steps.mismatch, nullptr);
  EXPECT_LT(wrong_step.periods.size(), 3U);
}

}  // namespace
}  // namespace voxmelt::hwmodel
