// A device has memory of its own and runs kernels (program/) in the order in which they are asked for. It is
// one of OpenCL (open_cl.h) or of CUDA (cuda.h), or in the tests the same kernels as C++.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <variant>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::gpu {

using step::DeviceError;

class Memory {
 public:
  virtual ~Memory() = default;
};

// All kernels of program/, in any order.
enum class Kernel {
  list_bricks,
  list_awake,
  list_givers,
  list_columns,
  list_pairs,
  list_falls,
  find_matter,
  vent,
  drain,
  border,
  conduct,
  exchange,
  copy_heat,
  find_cold,
  melt,
  gravity,
  find_patterns,
  apply_patterns,
  take_over,
  settle,
  count_substeps,
  spread_runs,
  begin_relaxing,
  relax,
  put_light,
  find_cubes,
  find_blocks,
  add_light,
  share_light,
  copy_words  // for measurements
};
inline constexpr const char* kKernelNames[] = {
    "list_bricks", "list_awake", "list_givers",    "list_columns", "list_pairs",     "list_falls",
    "find_matter", "vent",       "drain",          "border",       "conduct",        "exchange",
    "copy_heat",   "find_cold",  "melt",           "gravity",      "find_patterns",  "apply_patterns",
    "take_over",   "settle",     "count_substeps", "spread_runs",  "begin_relaxing", "relax",
    "put_light",   "find_cubes", "find_blocks",    "add_light",    "share_light",    "copy_words"};

using Argument = std::variant<const Memory*, std::int32_t>;  // null: memory that the scene does not have

// A program of others, whose kernels work on the same memory: the picture's (render/device).
struct OtherProgram {
  std::string text;                    // in the dialect of program/
  std::span<const char* const> names;  // of its kernels
  std::string options;                 // for the compiler: " -D NAME=value"
};
// It is built for a device, and lives no longer than that.
class OtherKernels {
 public:
  virtual ~OtherKernels() = default;
};

// The seconds that a device may need to build a program, and to answer. After them it counts as lost.
struct Patience {
  int build = 120, answer = 120;
};

// Every function may throw DeviceError.
class Device {
 public:
  virtual ~Device() = default;

  // Returns memory of zeros.
  virtual std::unique_ptr<Memory> allocate(std::size_t bytes) = 0;
  virtual void write(Memory& to, const void* from, std::size_t bytes) = 0;
  // Waits until all that was asked for has been done.
  virtual void read(const Memory& from, void* to, std::size_t bytes) = 0;
  virtual void clear(Memory& memory, std::size_t bytes) = 0;  // the first ones become 0

  // Begins to run so many groups of items, after all that was asked for before.
  virtual void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) = 0;
  // The same for a program of others. `kernel` is the number of its name. A device need not take any.
  virtual std::unique_ptr<OtherKernels> build(const OtherProgram& /*program*/) {
    throw DeviceError("the device takes no other programs");
  }
  virtual void run(const OtherKernels& /*kernels*/, std::size_t /*kernel*/, int /*groups*/,
                   std::initializer_list<Argument> /*arguments*/) {
    throw DeviceError("the device takes no other programs");
  }
  // Hands over all that was asked for, without waiting.
  virtual void flush() = 0;

  virtual int most_groups() const = 0;              // as many as keep it busy
  virtual std::uint64_t memory() const = 0;         // bytes
  virtual std::uint64_t largest_piece() const = 0;  // bytes that one allocation may have
};

}  // namespace voxmelt::gpu
