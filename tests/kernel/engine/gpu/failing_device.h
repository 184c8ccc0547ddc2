// A device that fails at any of the things that it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>

#include "kernel/engine/gpu/device.h"
#include "tests/kernel/engine/gpu/plain_device.h"

namespace voxmelt::gpu {

enum class Failure { refuses, is_lost };

// Does what it is asked for so many times.
class FailingDevice final : public Device {
 public:
  FailingDevice(std::unique_ptr<Device> device, int times, Failure how)
      : device_(std::move(device)), left_(times), how_(how) {}
  std::unique_ptr<Memory> allocate(std::size_t bytes) override { return count(), device_->allocate(bytes); }
  void write(Memory& to, const void* from, std::size_t bytes) override {
    count();
    device_->write(to, from, bytes);
  }
  void read(const Memory& from, void* to, std::size_t bytes) override {
    count();
    device_->read(from, to, bytes);
  }
  void clear(Memory& memory, std::size_t bytes) override {
    count();
    device_->clear(memory, bytes);
  }
  void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) override {
    count();
    device_->run(kernel, groups, arguments);
  }
  std::unique_ptr<OtherKernels> build(const OtherProgram& program) override {
    return count(), device_->build(program);
  }
  void run(const OtherKernels& kernels, std::size_t kernel, int groups,
           std::initializer_list<Argument> arguments) override {
    count();
    device_->run(kernels, kernel, groups, arguments);
  }
  void flush() override {}
  int most_groups() const override { return 7; }
  std::uint64_t memory() const override { return device_->memory(); }
  std::uint64_t largest_piece() const override { return device_->largest_piece(); }

 private:
  void count() {
    if (left_-- > 0) return;
    if (how_ == Failure::is_lost) throw step::DeviceLost("it does not answer");
    throw DeviceError("it refuses");
  }
  std::unique_ptr<Device> device_;
  int left_;
  Failure how_;
};

}  // namespace voxmelt::gpu
