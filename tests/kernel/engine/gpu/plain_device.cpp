#include "tests/kernel/engine/gpu/plain_device.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/kernel/engine/gpu/plain_call.h"

namespace voxmelt::gpu {
namespace {

#include "tests/kernel/engine/gpu/plain_dialect.h"

#include "kernel/engine/gpu/program/all.cl"

// All kernels in the order of kKernelNames.
#define ALL_KERNELS(DO)                                                                               \
  DO(list_bricks), DO(list_awake), DO(list_givers), DO(list_columns), DO(list_pairs), DO(list_falls), \
      DO(find_matter), DO(vent), DO(drain), DO(border), DO(conduct), DO(exchange), DO(copy_heat),     \
      DO(find_cold), DO(melt), DO(gravity), DO(find_patterns), DO(apply_patterns), DO(take_over),     \
      DO(settle), DO(count_substeps), DO(spread_runs), DO(begin_relaxing), DO(relax), DO(put_light),  \
      DO(find_cubes), DO(find_blocks), DO(add_light), DO(share_light), DO(copy_words)
#define CALL(name) (&Unpacked<&(name)>::call)
constexpr Call kCalls[] = {ALL_KERNELS(CALL)};
#define TAKE(name) (&Bound<&(name)>::take)
constexpr Take kTakes[] = {ALL_KERNELS(TAKE)};
static_assert(std::size(kCalls) == std::size(kKernelNames));

class PlainDevice final : public Device {
 public:
  PlainDevice(int threads, std::span<const Call> others) : threads_(threads), others_(others) {}

  std::unique_ptr<Memory> allocate(std::size_t bytes) override {
    return std::make_unique<PlainMemory>(bytes);
  }
  void write(Memory& to, const void* from, std::size_t bytes) override {
    std::memcpy(data(to, bytes), from, bytes);
  }
  void read(const Memory& from, void* to, std::size_t bytes) override {
    std::memcpy(to, data(from, bytes), bytes);
  }
  void clear(Memory& memory, std::size_t bytes) override { std::memset(data(memory, bytes), 0, bytes); }

  void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) override {
    start(kCalls[static_cast<std::size_t>(kernel)], groups, arguments);
  }
  std::unique_ptr<OtherKernels> build(const OtherProgram& program) override {
    if (program.names.size() != others_.size()) throw std::logic_error("the program has other kernels");
    return std::make_unique<OtherKernels>();
  }
  void run(const OtherKernels& /*kernels*/, std::size_t kernel, int groups,
           std::initializer_list<Argument> arguments) override {
    start(others_[kernel], groups, arguments);
  }
  void flush() override {}
  int most_groups() const override { return 7; }
  std::uint64_t memory() const override { return std::uint64_t{1} << 40; }
  std::uint64_t largest_piece() const override { return memory(); }

 private:
  static unsigned char* data(const Memory& memory, std::size_t bytes) {
    const auto& plain = static_cast<const PlainMemory&>(memory);
    if (bytes > plain.size()) throw std::logic_error("more than the memory has");
    return plain.data();
  }
  void start(Call call, int groups, std::initializer_list<Argument> arguments) const {
    const std::span all(arguments.begin(), arguments.size());
    const auto work = [&](int first) {
      for (int group = first; group < groups; group += threads_) {
        place = {group, groups};
        call(all);
      }
    };
    std::vector<std::jthread> helpers;
    for (int t = 1; t < threads_; ++t) helpers.emplace_back(work, t);
    work(0);
  }

  int threads_;
  std::span<const Call> others_;
};

}  // namespace

std::unique_ptr<Device> plain_device(int threads, std::span<const Call> others) {
  return std::make_unique<PlainDevice>(threads, others);
}

Take plain_kernel(std::string_view name) {
  const auto found = std::ranges::find(kKernelNames, name);
  return found == std::end(kKernelNames) ? nullptr : kTakes[found - std::begin(kKernelNames)];
}

}  // namespace voxmelt::gpu
