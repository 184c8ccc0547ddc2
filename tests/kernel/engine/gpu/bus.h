// The bus between the host and a device, which counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <utility>

#include "kernel/engine/gpu/device.h"

namespace voxmelt::gpu {

// Counts the bytes that go to a device and come from it.
class Bus final : public Device {
 public:
  explicit Bus(std::unique_ptr<Device> device) : device_(std::move(device)) {}
  std::unique_ptr<Memory> allocate(std::size_t bytes) override { return device_->allocate(bytes); }
  void write(Memory& to, const void* from, std::size_t bytes) override {
    bytes_ += bytes;
    device_->write(to, from, bytes);
  }
  void read(const Memory& from, void* to, std::size_t bytes) override {
    bytes_ += bytes;
    device_->read(from, to, bytes);
  }
  void clear(Memory& memory, std::size_t bytes) override { device_->clear(memory, bytes); }
  void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) override {
    device_->run(kernel, groups, arguments);
  }
  std::unique_ptr<OtherKernels> build(const OtherProgram& program) override {
    return device_->build(program);
  }
  void run(const OtherKernels& kernels, std::size_t kernel, int groups,
           std::initializer_list<Argument> arguments) override {
    device_->run(kernels, kernel, groups, arguments);
  }
  void flush() override { device_->flush(); }
  int most_groups() const override { return device_->most_groups(); }
  std::uint64_t memory() const override { return device_->memory(); }
  std::uint64_t largest_piece() const override { return device_->largest_piece(); }
  std::size_t bytes() const { return bytes_; }

 private:
  std::unique_ptr<Device> device_;
  std::size_t bytes_ = 0;
};

}  // namespace voxmelt::gpu
