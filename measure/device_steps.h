// Whole steps on a device with memory of its own (docs/gpu.md): how long they take, what takes most of it,
// how near that is to what the device's memory can give, and what goes to the host and back.
//
// Times are minima, as in measure.h, and every workload is run once for its bits first.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/step/stepper.h"
#include "kernel/scene/scene.h"
#include "measure/device_picture.h"
#include "measure/measure.h"
#include "measure/rounds.h"
#include "measure/workloads.h"

namespace voxmelt::gpu {
struct OpenClDevice;
}

namespace voxmelt::measure {

class WatchedDevice;

// These rates bound what a device does.
struct DeviceMachine {
  std::string implementation, name, driver;  // "gpu:0", and what its driver says
  std::uint64_t memory = 0;                  // bytes
  double copy = 0;    // bytes per second, read and written both, where a kernel copies a large piece
  double launch = 0;  // seconds of a kernel that does nothing, among others
};

struct KernelTime {
  std::string name;
  double seconds = 0;  // in a step
  double calls = 0;    // in a step
};

struct Transfer {
  double seconds = 0;
  std::uint64_t bytes = 0;
};

struct DeviceCase {
  std::string workload, judge;
  state::Grid grid;
  std::int64_t cells = 0, active = 0;  // all cells, and those that concern a step
  int rounds = 0;
  double seconds = 0;               // a step that stays on the device
  std::vector<KernelTime> kernels;  // longest first
  double launches = 0;              // in a step
  double bytes_per_cell = 0;        // needed by the definition, for an active cell
  double copied_per_second = 0;     // what the device can copy: DeviceMachine::copy
  double launch = 0;                // DeviceMachine::launch
  double as_run = 0;                // a step of a run: with visibility, and what the host asks for
  double visibility = 0;            // what a step of visibility takes beside that, if the scene has radiation
  std::int64_t rays = 0;            // that it casts
  Transfer upload, masks, download;
  // The same step on a processor, without visibility.
  Candidate processor;
  double processor_seconds = 0;
  std::optional<DevicePictureTime> picture;  // of a scene, if the device draws it

  double bytes_per_second() const { return bytes_per_cell * static_cast<double>(active) / seconds; }
  double percent_of_copy() const { return 100 * bytes_per_second() / copied_per_second; }
  double percent_of_launches() const { return 100 * launches * launch / seconds; }
  double times_processor() const { return processor_seconds / seconds; }
};

class DeviceBench {
 public:
  // `implementation` is a device's: "gpu:1". The processor beside it runs `beside`.
  DeviceBench(const step::Implementation& implementation, Candidate beside, Rounds rounds);

  // Throws Mismatch if the bits or the books are wrong, and DeviceError. The scene is that of the workload,
  // if it is of one.
  DeviceCase run(const Workload& workload, const scene::Scene* scene = nullptr);

  // Returns volumes in which every cell works.
  std::vector<Workload> dense(bool quick) const;

  const DeviceMachine& machine() const { return machine_; }  // its rates are known after the first run

 private:
  void measure_machine(WatchedDevice& device);

  const step::Implementation& implementation_;
  const gpu::OpenClDevice& found_;
  Candidate beside_;
  Rounds rounds_;
  DeviceMachine machine_;
};

}  // namespace voxmelt::measure
