// A device that tells what goes to and fro, and how long each kernel takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "kernel/engine/gpu/device.h"
#include "measure/clocks.h"

namespace voxmelt::measure {

class WatchedDevice final : public gpu::Device {
 public:
  explicit WatchedDevice(std::unique_ptr<gpu::Device> device)
      : device_(std::move(device)), number_(device_->allocate(sizeof(int))) {}

  struct Calls {
    double seconds = 0;
    int calls = 0;
  };

  void wait() {
    int nothing = 0;
    device_->read(*number_, &nothing, sizeof nothing);
  }
  // Returns how long it takes to wait for nothing.
  double waiting() {
    Least least;
    for (int k = 0; k < 50; ++k) least.add(seconds_for(Clock::wall, [&] { wait(); }));
    return least.value();
  }

  // Kernels are waited for one by one from now on, so each takes a launch longer than it does in a row.
  void watch() { watching_ = true; }
  // Forgets what was counted, and waits for no kernel any more.
  void forget() {
    watching_ = false;
    calls_.clear();
    sent_ = fetched_ = 0;
    launches_ = 0;
  }
  const std::map<std::string, Calls>& calls() const { return calls_; }
  int launches() const { return launches_; }          // of others' kernels
  std::uint64_t sent() const { return sent_; }        // bytes to the device
  std::uint64_t fetched() const { return fetched_; }  // bytes from it

  std::unique_ptr<gpu::Memory> allocate(std::size_t bytes) override { return device_->allocate(bytes); }
  void write(gpu::Memory& to, const void* from, std::size_t bytes) override {
    sent_ += bytes;
    timed("(write)", [&] { device_->write(to, from, bytes); });
  }
  void read(const gpu::Memory& from, void* to, std::size_t bytes) override {
    fetched_ += bytes;
    timed("(read)", [&] { device_->read(from, to, bytes); });
  }
  void clear(gpu::Memory& memory, std::size_t bytes) override {
    timed("(clear)", [&] { device_->clear(memory, bytes); });
  }
  void run(gpu::Kernel kernel, int groups, std::initializer_list<gpu::Argument> arguments) override {
    timed(gpu::kKernelNames[static_cast<std::size_t>(kernel)],
          [&] { device_->run(kernel, groups, arguments); });
  }
  std::unique_ptr<gpu::OtherKernels> build(const gpu::OtherProgram& program) override {
    return device_->build(program);
  }
  void run(const gpu::OtherKernels& kernels, std::size_t kernel, int groups,
           std::initializer_list<gpu::Argument> arguments) override {
    ++launches_;
    device_->run(kernels, kernel, groups, arguments);
  }
  void flush() override { device_->flush(); }
  int most_groups() const override { return device_->most_groups(); }
  std::uint64_t memory() const override { return device_->memory(); }
  std::uint64_t largest_piece() const override { return device_->largest_piece(); }

 private:
  template <class Work>
  void timed(const char* name, const Work& work) {
    if (!watching_) return work();
    Calls& calls = calls_[name];
    ++calls.calls;
    calls.seconds += seconds_for(Clock::wall, [&] {
      work();
      wait();
    });
  }

  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::Memory> number_;
  bool watching_ = false;
  std::map<std::string, Calls> calls_;
  std::uint64_t sent_ = 0, fetched_ = 0;
  int launches_ = 0;
};

}  // namespace voxmelt::measure
