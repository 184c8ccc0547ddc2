// The host of CUDA, on a driver whose card is this machine's processor; the kernels, by NVIDIA's compiler
// where that is installed; and both on a real card, where there is one.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/engine/gpu/cuda_compiler.h"
#include "kernel/engine/gpu/program_text.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/engine/gpu/fake_cuda.h"
#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/kernel/engine/gpu/same_light.h"
#include "tests/kernel/engine/scene_names.h"
#include "tests/rounds.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

CudaDevice fake_device() { return devices_of(fake_cuda()).front(); }

std::unique_ptr<Device> fake(const Constants* constants = nullptr, Patience patience = {}) {
  return open(fake_cuda(), fake_device(), constants, patience);
}
std::shared_ptr<Device> fake_for(const Parameters& parameters, Grid grid) {
  const Constants constants = constants_of(parameters, Shape(grid));
  return fake(&constants);
}

TEST(CudaDevices, AreNamedAsTheirDriverSays) {
  const std::vector<CudaDevice> all = devices_of(fake_cuda());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "Fake card");
  EXPECT_EQ(all[0].driver, "CUDA 13.2, compiler 13.1");
  EXPECT_EQ(all[0].memory, std::uint64_t{6} << 30);
  EXPECT_EQ(all[0].units, 3);
  EXPECT_EQ(all[0].architecture, 125);
  EXPECT_EQ(all[1].architecture, 75);
  EXPECT_EQ(all[1].number, 8) << "the driver's own number";
  EXPECT_TRUE(devices_of({fake_cuda().driver, nullptr}).empty());
  EXPECT_TRUE(devices_of({nullptr, fake_cuda().compiler}).empty());
}

TEST(CudaHost, HostileWorldsHaveTheBitsAndTheBooks) {
  const FakeCard& card = new_fake_card();
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (int seed = 0; seed < rounds(60); ++seed) {
      const HostileWorld world = seed % 2 == 0 ? hostile_world(seed, law) : sparse_world(seed, law);
      ASSERT_TRUE(same_steps_on_device(world.parameters, world.start, fake_for, 3)) << "seed " << seed;
    }
  EXPECT_EQ(card.broken_rules, std::vector<std::string>());
  EXPECT_EQ(card.alive, 0) << "something was not given back";
}

// More than goes at once.
TEST(CudaHost, LargeMemoryComesBackAsItWent) {
  const FakeCard& card = new_fake_card();
  const auto device = fake();
  std::vector<std::uint32_t> sent(5'000'003), back(sent.size(), 0x01010101);
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<std::uint32_t>(7 + 3 * i);
  const std::size_t bytes = 4 * sent.size() - 3;
  const auto memory = device->allocate(bytes);
  device->read(*memory, back.data(), bytes);
  EXPECT_EQ(std::ranges::count(back, 0u), static_cast<std::ptrdiff_t>(back.size() - 1))
      << "memory is zeros at first";
  device->write(*memory, sent.data(), bytes);
  device->read(*memory, back.data(), bytes);
  sent.back() = 0x01010100 | (sent.back() & 255);  // its other bytes did not go
  EXPECT_EQ(back, sent);
  device->clear(*memory, 4000);
  device->read(*memory, back.data(), bytes);
  EXPECT_EQ(std::ranges::count(back, 0u), 1000);
  EXPECT_EQ(card.broken_rules, std::vector<std::string>());
}

TEST(CudaHost, AnyThreadMayAsk) {
  const FakeCard& card = new_fake_card();
  std::unique_ptr<Device> device = fake();
  std::unique_ptr<Memory> memory;
  std::jthread([&] { memory = device->allocate(40); }).join();
  std::jthread([&] {
    const int sent = 5;
    device->write(*memory, &sent, sizeof sent);
  }).join();
  std::jthread([&] {
    int back = 0;
    device->read(*memory, &back, sizeof back);
    EXPECT_EQ(back, 5);
    memory.reset();
    device.reset();
  }).join();
  EXPECT_EQ(card.broken_rules, std::vector<std::string>());
  EXPECT_EQ(card.alive, 0);
}

TEST(CudaHost, TheCompilerGetsTheNumbersOfTheScene) {
  const FakeCard& card = new_fake_card();
  Parameters parameters = paper_showcase();
  fake_for(parameters, {70, 9, 11});
  const auto has = [&](const char* option) { return std::ranges::count(card.options, option) == 1; };
  EXPECT_TRUE(has("--gpu-architecture=sm_125"));
  EXPECT_TRUE(has("--define-macro=SPECIALISED"));
  EXPECT_TRUE(has("--define-macro=NX=70"));
  EXPECT_TRUE(has("--define-macro=NY=9"));
  EXPECT_TRUE(has("--define-macro=NZ=11"));
  EXPECT_TRUE(card.text.starts_with("// CUDA C++.")) << card.text.substr(0, 80);
  EXPECT_EQ(card.text.find("__kernel"), std::string::npos);
  fake();
  EXPECT_FALSE(has("--define-macro=SPECIALISED"));
}

std::string message_of(const std::function<void()>& does) {
  try {
    does();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(CudaHost, WhatFailsIsSaid) {
  FakeCard& card = new_fake_card();
  card.memory_left = 1;
  {
    const auto device = fake();
    const auto memory = device->allocate(8);
    EXPECT_EQ(message_of([&] { device->allocate(1000); }), "CUDA, take 1000 bytes: out of memory");
  }
  card.compiler_refuses = true;
  EXPECT_EQ(message_of([] { fake(); }), "CUDA: it does not compile: line 3: what");
  EXPECT_EQ(card.alive, 0);
}

TEST(CudaHost, ACardThatHangsIsLost) {
  FakeCard& card = new_fake_card();
  const int alive = card.alive;
  {
    const auto device = fake(nullptr, {120, 1});
    const auto memory = device->allocate(8);
    card.hangs = true;
    int back = 0;
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THROW(device->read(*memory, &back, sizeof back), step::DeviceLost);
    const auto waited = std::chrono::steady_clock::now() - begin;
    EXPECT_GE(waited, std::chrono::seconds(1));
    EXPECT_LT(waited, std::chrono::seconds(30));
  }
  EXPECT_EQ(card.alive, alive + 5) << "nothing is given back to what does not answer";
  new_fake_card();
}

std::set<std::string> words_of(const std::string& dialect) {
  std::set<std::string> words;
  std::istringstream text(dialect);
  for (std::string line; std::getline(text, line);)
    if (const std::string define = "#define "; line.starts_with(define))
      words.insert(line.substr(define.size(), line.find_first_of(" (", define.size()) - define.size()));
  return words;
}

TEST(Dialects, HaveTheSameWords) {
  EXPECT_EQ(words_of(cuda_dialect()), words_of(open_cl_dialect()));
  EXPECT_EQ(words_of(cuda_dialect()).count("CLAIM"), 1u);
}

// NVIDIA's compiler needs no card.
TEST(CudaCompiler, TakesTheKernelsOfScenes) {
  if (nvrtc_library() == nullptr) GTEST_SKIP() << "no compiler of CUDA here (libnvrtc.so, of its toolkit)";
  const auto check = [](const std::string& name, const std::string& options, int architecture) {
    std::string said;
    const std::string code =
        compiled_for_cuda(*nvrtc_library(), program_text(), options, architecture, &said);
    EXPECT_TRUE(
        code.starts_with("\x7f"
                         "ELF"))
        << name;
    for (const char* kernel : kKernelNames)
      EXPECT_NE(said.find("Compiling entry function '" + std::string(kernel) + "'"), std::string::npos)
          << name;
  };
  check("any scene", "", 90);
  if (!all_rounds()) return;
  for (const std::string& name : scene_names(VOXMELT_SCENES_FOLDER)) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
    check(name, specialised_options(constants_of(scene.parameters, Shape(scene.initial.grid))), 75);
  }
}

TEST(CudaCard, ScenesHaveTheDigestsAndTheBooks) {
  if (cuda_devices().empty()) GTEST_SKIP() << "no card of CUDA here, or no compiler of it";
  for (const std::string& name : some_of(scene_names(VOXMELT_SCENES_FOLDER))) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
    run::Simulation expected(scene.parameters, scene.initial, run::implementations().widest(),
                             {.threads = 2});
    const auto card = [](const Parameters& parameters, Grid grid) -> std::shared_ptr<Device> {
      const Constants constants = constants_of(parameters, Shape(grid));
      return open(cuda_devices().front(), &constants);
    };
    run::Simulation actual(scene.parameters, scene.initial, on_device(card));
    steps(expected, 60);
    steps(actual, 60);
    ASSERT_EQ(state::digest(actual.volume()), state::digest(expected.volume())) << name;
    ASSERT_TRUE(actual.ledger() == expected.ledger()) << name << ": the books differ";
  }
}

}  // namespace
}  // namespace voxmelt::gpu
