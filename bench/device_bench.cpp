// Times whole steps on a device, and each kernel by itself: device_bench [--steps N] [--alone] WORKLOAD...
//
// A workload is the name of a scene, in the middle of its melt, or dense:N or dense_viscous:N, N-cubed of
// liquid with heat. Beside each stands AVX2, or else the widest implementation here, with two threads. Times
// are those of the fastest of five rounds from the same state, without visibility. Kernels are waited for one
// by one, so their times hold a launch each. With --alone the processor has nothing to do.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/open_cl.h"
#include "kernel/engine/gpu/stepper.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt {
namespace {

constexpr int kRounds = 5, kDenseLead = 0;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Passes everything on to a device, and times kernels if it is told to.
class Watched final : public gpu::Device {
 public:
  explicit Watched(std::unique_ptr<gpu::Device> device)
      : device_(std::move(device)), number_(device_->allocate(sizeof(int))) {}

  void watch() { watching_ = true; }
  void wait() {
    int nothing = 0;
    device_->read(*number_, &nothing, sizeof nothing);
  }
  // Returns how long it takes to wait for nothing.
  double waiting() {
    double least = 1;
    for (int k = 0; k < 50; ++k) {
      const double begin = now();
      wait();
      least = std::min(least, now() - begin);
    }
    return least;
  }
  struct Times {
    double seconds = 0;
    int calls = 0;
  };
  const std::map<std::string, Times>& times() const { return times_; }

  std::unique_ptr<gpu::Memory> allocate(std::size_t bytes) override { return device_->allocate(bytes); }
  void write(gpu::Memory& to, const void* from, std::size_t bytes) override {
    timed("(write)", [&] { device_->write(to, from, bytes); });
  }
  void read(const gpu::Memory& from, void* to, std::size_t bytes) override {
    timed("(read)", [&] { device_->read(from, to, bytes); });
  }
  void clear(gpu::Memory& memory, std::size_t bytes) override {
    timed("(clear)", [&] { device_->clear(memory, bytes); });
  }
  void run(gpu::Kernel kernel, int groups, std::initializer_list<gpu::Argument> arguments) override {
    timed(gpu::kKernelNames[static_cast<std::size_t>(kernel)],
          [&] { device_->run(kernel, groups, arguments); });
  }
  void flush() override { device_->flush(); }
  int most_groups() const override { return device_->most_groups(); }
  std::uint64_t memory() const override { return device_->memory(); }
  std::uint64_t largest_piece() const override { return device_->largest_piece(); }

 private:
  template <class Work>
  void timed(const char* name, const Work& work) {
    if (!watching_) return work();
    const double begin = now();
    work();
    wait();
    Times& times = times_[name];
    times.seconds += now() - begin;
    ++times.calls;
  }

  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::Memory> number_;
  bool watching_ = false;
  std::map<std::string, Times> times_;
};

rule::Parameters dense_parameters(rule::Law law) {
  rule::Parameters p;
  p.flow.law = law;
  p.flow.paper.margin = 64;
  p.flow.paper.alpha_liquid = 62915;
  p.flow.paper.alpha_solid = p.flow.paper.alpha_floor = 60293;
  p.flow.viscous.mobility = (std::uint64_t{1} << 32) / 50;
  p.heat.enabled = true;
  p.heat.weight_face = 2086;
  p.material.melting_point = 60000;
  return p;
}

// Makes liquid of any height and temperature everywhere.
state::Volume dense_volume(int side, bool energy) {
  state::Volume volume(state::Grid{side, side, side});
  std::uint64_t number = 0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const std::uint64_t bits = state::mixed_bits(++number);
        const state::Slot i = volume.at(x, y, z);
        volume.amount[i] = static_cast<std::uint16_t>(rule::kOne / 2 + bits % rule::kOne);
        if (energy) volume.energy[i] = static_cast<std::uint16_t>(1 + (bits >> 16) % (rule::kOne / 2));
        volume.heat[i] = static_cast<std::uint16_t>((bits >> 32) % 50000);
        volume.liquid.set(x, y, z, true);
      }
  return volume;
}

int number_of(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 1)
    throw std::invalid_argument(text + " is no whole number from 1 on");
  return value;
}

struct Workload {
  rule::Parameters parameters;
  state::Volume start;
  int lead = kDenseLead;  // steps before those that are timed
};
Workload workload_of(const std::string& name) {
  for (const auto& [prefix, law] : {std::pair<std::string, rule::Law>("dense:", rule::Law::paper),
                                    {"dense_viscous:", rule::Law::viscous}}) {
    if (!name.starts_with(prefix)) continue;
    const int side = number_of(name.substr(prefix.size()));
    return {dense_parameters(law), dense_volume(side, law == rule::Law::paper)};
  }
  scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
  scene.parameters.pieces.fall = false;  // that is the host's work
  return {std::move(scene.parameters), std::move(scene.initial), static_cast<int>(scene.steps / 2)};
}

// Returns the milliseconds of a step in the fastest of some rounds, each of which begins with the same state.
template <class Begin, class Steps>
double fastest(int steps, const Begin& begin_anew, const Steps& make_steps) {
  double least = 1e9;
  for (int k = 0; k < kRounds; ++k) {
    begin_anew();
    const double begin = now();
    make_steps();
    least = std::min(least, (now() - begin) / steps);
  }
  return 1e3 * least;
}

// Returns the same of a processor, less what visibility takes.
double on_processor(const Workload& workload, const state::Volume& start,
                    const step::Implementation& processor, int steps) {
  std::unique_ptr<run::Simulation> host;
  const auto begin = [&] {
    host =
        std::make_unique<run::Simulation>(workload.parameters, start, processor, step::Tuning{.threads = 2});
    host->begin_at(static_cast<std::uint32_t>(workload.lead));
    host->step();
  };
  const auto make_steps = [&] {
    for (int i = 0; i < steps; ++i) host->step();
  };
  const double all = fastest(steps, begin, make_steps);
  return all * (1 - host->seconds().visibility / host->seconds().total());
}

void time_workload(const gpu::OpenClDevice& found, const std::string& name, int steps, bool alone) {
  const Workload workload = workload_of(name);
  const step::Implementation* const avx2 = run::implementations().find("avx2");
  const step::Implementation& processor =
      avx2 != nullptr && avx2->supported ? *avx2 : run::implementations().widest();
  run::Simulation lead(workload.parameters, workload.start, processor, {.threads = 2});
  for (int i = 0; i < workload.lead; ++i) lead.step();
  const auto first = static_cast<std::uint32_t>(workload.lead);

  const gpu::Constants constants = gpu::constants_of(workload.parameters, gpu::Shape(workload.start.grid));
  const auto device = std::make_shared<Watched>(gpu::open(found, &constants));
  gpu::Stepper stepper(device, workload.parameters, workload.start.grid);
  std::uint32_t number = 0;
  const auto upload = [&] {
    stepper.upload(lead.volume(), lead.ledger());
    number = first;
    stepper.run_step(number++, lead.irradiance());
    device->wait();
  };
  const auto on_device = [&] {
    for (int i = 0; i < steps; ++i) {
      stepper.tell_irradiance({});  // visibility is not counted, nor what it sends
      stepper.run_step(number++, lead.irradiance());
    }
    device->wait();
  };
  const double here = fastest(steps, upload, on_device);
  upload();
  device->watch();
  on_device();

  const state::Grid grid = workload.start.grid;
  std::printf("%s, %d x %d x %d: %.4f ms a step", name.c_str(), grid.x, grid.y, grid.z, here);
  if (!alone) {
    const double there = on_processor(workload, lead.volume(), processor, steps);
    std::printf("; %s with 2 threads %.3f ms (%.1f times)", processor.name.c_str(), there, there / here);
  }
  std::printf("\n");
  const double waiting = device->waiting();
  for (const auto& [kernel, times] : device->times())
    std::printf("  %-16s %8.4f ms a step in %d calls\n", kernel.c_str(),
                1e3 * std::max(0.0, times.seconds - times.calls * waiting) / steps, times.calls / steps);
  std::fflush(stdout);
}

}  // namespace
}  // namespace voxmelt

int main(int count, char** words) {
  using namespace voxmelt;
  try {
    int steps = 16;
    bool alone = false;
    std::vector<std::string> workloads;
    for (int i = 1; i < count; ++i) {
      const std::string word = words[i];
      if (word == "--steps" && i + 1 < count)
        steps = number_of(words[++i]);
      else if (word == "--alone")
        alone = true;
      else
        workloads.push_back(word);
    }
    const std::vector<gpu::OpenClDevice>& all = gpu::open_cl_devices();
    if (all.empty()) throw std::invalid_argument("this machine has no device of OpenCL");
    if (workloads.empty()) workloads = {"dense:128", "goblet", "cello", "lava"};
    std::printf("%s, %s\n", all.front().name.c_str(), all.front().driver.c_str());
    for (const std::string& name : workloads) time_workload(all.front(), name, steps, alone);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "device_bench: error: %s\n", error.what());
    return 2;
  }
}
