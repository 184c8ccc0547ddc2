#include "measure/device_steps.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <functional>
#include <memory>

#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/open_cl.h"
#include "kernel/engine/gpu/stepper.h"
#include "kernel/run/simulation.h"
#include "measure/clocks.h"
#include "measure/machine.h"
#include "measure/roof.h"
#include "measure/watched_device.h"

namespace voxmelt::measure {
namespace {

// Bytes of each half, on a card, and on a processor, which takes seconds where its items share badly.
constexpr std::size_t kCopied = std::size_t{256} << 20, kCopiedByProcessor = std::size_t{32} << 20;
constexpr int kCopies = 4, kLaunches = 200, kTrials = 2;
constexpr int kItems = 128;  // of a group
constexpr int kFullSide = 64;
constexpr std::uint64_t kLargeDevice = std::uint64_t{32} << 30;  // bytes
constexpr std::size_t kLargeHost = std::size_t{64} << 30;        // of five states

const gpu::OpenClDevice& device_of(const step::Implementation& implementation) {
  const std::string digits = implementation.name.substr(implementation.name.find(':') + 1);
  std::size_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return gpu::open_cl_devices().at(number);
}

// A state in the middle of a workload, and the light in it.
class Lead {
 public:
  // It stops a step before those that are timed, which a device needs to find what sleeps.
  Lead(const Workload& workload, const Candidate& by)
      : simulation_(workload.parameters, workload.start, *by.implementation,
                    step::Tuning{.threads = by.threads}) {
    while (simulation_.steps_done() + 1 < static_cast<std::uint32_t>(workload.lead_steps)) simulation_.step();
  }
  const state::Volume& volume() const { return simulation_.volume(); }
  const run::Simulation& simulation() const { return simulation_; }
  std::uint32_t step() const { return simulation_.steps_done(); }

 private:
  run::Simulation simulation_;
};

double bytes_of(const rule::Parameters& parameters) {
  const double flow = work_of(Subject::flow, parameters).bytes;
  return parameters.heat.enabled ? flow + work_of(Subject::heat, parameters).bytes : flow;
}

// The least of some rounds, each of which is timed alone.
template <class Round>
double least_of(int rounds, const Round& round) {
  Least least;
  for (int k = 0; k < rounds; ++k) least.add(round());
  return least.value();
}

// A workload on a device, from the state to which `Lead` came.
class OnDevice {
 public:
  OnDevice(const gpu::OpenClDevice& found, const Workload& workload, const Candidate& beside)
      : workload_(workload),
        lead_(workload, beside),
        device_(opened(found, workload)),
        stepper_(device_, workload.parameters, workload.start.grid),
        volume_(workload.start.grid) {}

  WatchedDevice& device() { return *device_; }

  // Each of these waits until the device has done it.
  void upload() {
    stepper_.upload(lead_.volume(), lead_.simulation().ledger());
    device_->wait();
  }
  void first_step() {
    stepper_.run_step(lead_.step(), lead_.simulation().irradiance());
    device_->wait();
  }
  bool radiates() const { return workload_.parameters.heat.radiates(); }
  void find_irradiance() {
    stepper_.find_irradiance(lead_.step());
    device_->wait();
  }
  std::int64_t rays() { return stepper_.count_rays().rays; }
  void timed_steps() {
    for (int i = 1; i <= workload_.steps; ++i) {
      stepper_.tell_irradiance({});  // visibility is timed by itself, so the light stays as it was
      stepper_.run_step(lead_.step() + static_cast<std::uint32_t>(i), lead_.simulation().irradiance());
    }
    device_->wait();
  }
  void download_masks() { stepper_.download_masks(volume_); }
  void download() { stepper_.download(volume_, ledger_); }
  // The state after the first step.
  DrawnState drawn() {
    const auto again = [this] {
      upload();
      first_step();
      return stepper_.where();
    };
    again();
    download();
    return {device_, again, volume_};
  }

 private:
  static std::shared_ptr<WatchedDevice> opened(const gpu::OpenClDevice& found, const Workload& workload) {
    const gpu::Constants constants = gpu::constants_of(workload.parameters, gpu::Shape(workload.start.grid));
    return std::make_shared<WatchedDevice>(gpu::open(found, &constants));
  }

  const Workload& workload_;
  Lead lead_;
  std::shared_ptr<WatchedDevice> device_;
  gpu::Stepper stepper_;
  state::Volume volume_;
  state::Ledger ledger_;
};

// Seconds of a step as a run has it, with visibility, and with what comes and goes for it. It also sees that
// the bits and the books are right.
double step_of_a_run(const Workload& workload, const Candidate& candidate, std::uint64_t expected) {
  run::Simulation simulation(workload.parameters, workload.start, *candidate.implementation,
                             step::Tuning{.threads = candidate.threads});
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  simulation.ledger();  // waits for the device
  const double seconds = seconds_for(Clock::wall, [&] {
    for (int i = 0; i < workload.steps; ++i) simulation.step();
    simulation.ledger();
  });
  check_result(simulation, workload, candidate, expected);
  return seconds / workload.steps;
}

void time_rounds(OnDevice& run, const Workload& workload, std::uint64_t expected, const Rounds& rounds,
                 DeviceCase& one) {
  const auto wall = [](const auto& work) { return seconds_for(Clock::wall, work); };
  Least step, beside, there, light, masks, back;
  for (const RoundClock clock(rounds); clock.more(one.rounds); ++one.rounds) {
    there.add(wall([&] { run.upload(); }));
    if (run.radiates()) light.add(wall([&] { run.find_irradiance(); }));
    run.first_step();
    step.add(wall([&] { run.timed_steps(); }) / workload.steps);
    masks.add(wall([&] { run.download_masks(); }));
    back.add(wall([&] { run.download(); }));
    beside.add(mean(timed_run(workload, one.processor, expected)).total());
  }
  one.seconds = step.value();
  one.processor_seconds = beside.value();
  if (run.radiates()) one.visibility = light.value();
  one.upload.seconds = there.value();
  one.masks.seconds = masks.value();
  one.download.seconds = back.value();
}

void count_bytes(OnDevice& run, DeviceCase& one) {
  const auto bytes = [&](std::uint64_t (WatchedDevice::*count)() const, const auto& work) {
    run.device().forget();
    work();
    return (run.device().*count)();
  };
  one.upload.bytes = bytes(&WatchedDevice::sent, [&] { run.upload(); });
  if (run.radiates()) {
    const std::int64_t before = run.rays();
    run.find_irradiance();
    one.rays = run.rays() - before;
  }
  run.first_step();
  one.masks.bytes = bytes(&WatchedDevice::fetched, [&] { run.download_masks(); });
  one.download.bytes = bytes(&WatchedDevice::fetched, [&] { run.download(); });
}

void time_kernels(OnDevice& run, const Workload& workload, DeviceCase& one) {
  const double waiting = run.device().waiting();
  run.upload();
  run.first_step();
  run.device().forget();
  run.device().watch();
  run.timed_steps();
  for (const auto& [name, calls] : run.device().calls()) {
    const double seconds = std::max(0.0, calls.seconds - calls.calls * waiting);
    one.kernels.push_back(
        {name, seconds / workload.steps, static_cast<double>(calls.calls) / workload.steps});
    one.launches += one.kernels.back().calls;
  }
  std::ranges::stable_sort(one.kernels, std::greater(), &KernelTime::seconds);
}

}  // namespace

DeviceBench::DeviceBench(const step::Implementation& implementation, Candidate beside, Rounds rounds)
    : implementation_(implementation),
      found_(device_of(implementation)),
      beside_(beside),
      rounds_(rounds),
      machine_{implementation.name, found_.name, found_.driver, found_.memory, 0, 0} {}

void DeviceBench::measure_machine(WatchedDevice& device) {
  const std::size_t bytes = std::min({found_.is_processor ? kCopiedByProcessor : kCopied,
                                      static_cast<std::size_t>(device.largest_piece()),
                                      static_cast<std::size_t>(device.memory() / 8)});
  const auto words = static_cast<std::int32_t>(bytes / sizeof(std::uint32_t));
  const auto from = device.allocate(bytes), to = device.allocate(bytes);
  const auto seconds = [&](int calls, int groups, std::int32_t count) {
    device.wait();
    return seconds_for(Clock::wall, [&] {
      for (int k = 0; k < calls; ++k)
        device.run(gpu::Kernel::copy_words, groups, {from.get(), to.get(), count});
      device.wait();
    });
  };
  const double waiting = device.waiting();
  Least copies;  // over how many groups share it, because each device likes another number
  for (int groups = device.most_groups(); groups <= words / kItems; groups *= 8)
    copies.add(least_of(kTrials, [&] { return seconds(kCopies, groups, words); }));
  const double launches = least_of(kTrials, [&] { return seconds(kLaunches, device.most_groups(), 0); });
  machine_.copy = 2.0 * static_cast<double>(bytes) * kCopies / std::max(copies.value() - waiting, 1e-9);
  machine_.launch = std::max(0.0, launches - waiting) / kLaunches;
}

DeviceCase DeviceBench::run(const Workload& given, const scene::Scene* scene) {
  Workload workload = given;
  workload.parameters.pieces.fall = false;  // the host's work
  const std::uint64_t expected = expected_digest(workload);
  DeviceCase one;
  one.workload = workload.name;
  one.judge = workload.judge;
  one.grid = workload.start.grid;
  one.cells = one.grid.cells();
  one.active = active_cells(workload, workload.parameters.heat.enabled);
  one.bytes_per_cell = bytes_of(workload.parameters);
  one.processor = beside_;
  OnDevice on_device(found_, workload, beside_);
  if (machine_.copy == 0) measure_machine(on_device.device());
  one.copied_per_second = machine_.copy;
  one.launch = machine_.launch;
  // Each of these opens the device anew, which takes longer than its steps.
  one.as_run = least_of(kTrials, [&] {
    return step_of_a_run(workload, {&implementation_, beside_.threads}, expected);
  });
  time_rounds(on_device, workload, expected, rounds_, one);
  count_bytes(on_device, one);
  time_kernels(on_device, workload, one);
  if (scene != nullptr) one.picture = time_picture(on_device.drawn(), *scene, beside_.threads, kTrials);
  return one;
}

std::vector<Workload> DeviceBench::dense(bool quick) const {
  const int n = quick ? kFullSide : 256;
  std::vector<Workload> all{dense_paper(n, true), dense_viscous(n, true)};
  if (quick) return all;
  all.push_back(dense_heat(n, 6));
  // The reference is too slow for what only a large card holds.
  if (found_.is_processor || found_.memory < kLargeDevice || describe_machine().memory_bytes < kLargeHost)
    return all;
  all.push_back(dense_paper(1024, true));
  all.back().judge = beside_.implementation->name;
  return all;
}

}  // namespace voxmelt::measure
