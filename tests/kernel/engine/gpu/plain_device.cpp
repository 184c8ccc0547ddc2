#include "tests/kernel/engine/gpu/plain_device.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <span>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"

namespace voxmelt::gpu {
namespace {

using uchar = unsigned char;
using ushort = unsigned short;
using uint = unsigned int;
using ulong = unsigned long;

struct Place {
  int group = 0, groups = 1;
};
thread_local Place place;

int next(int& counter) { return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); }
void raise_to(int& number, int least) {
  std::atomic_ref<int> shared(number);
  int seen = shared.load();
  while (seen < least && !shared.compare_exchange_weak(seen, least)) {
  }
}

__extension__ using Wide = unsigned __int128;
ulong mul_high(ulong a, ulong b) { return static_cast<ulong>(Wide{a} * b >> 64); }

#define KERNEL(name) void name
#define GLOBAL
#define LOCAL
#define PRIVATE
#define FN inline
#define TABLE constexpr
#define LANES_X 1
#define LANES_Y 1
#define LANES 1
#define LANE_X 0
#define LANE_Y 0
#define LANE 0
#define GROUP place.group
#define GROUPS place.groups
#define BARRIER
#define SCRATCH long scratch[1];
#define NEXT(counter) next(*(counter))
#define RAISE_TO(number, least) raise_to(*(number), least)
#define LOOK(flag) std::atomic_ref(const_cast<uchar&>(flag)).load(std::memory_order_relaxed)
#define RAISE(flag) std::atomic_ref(flag).store(1, std::memory_order_relaxed)
#define MUL_HIGH(a, b) mul_high(a, b)

#include "kernel/engine/gpu/program/all.cl"

class PlainMemory final : public Memory {
 public:
  explicit PlainMemory(std::size_t bytes) : words_((bytes + 7) / 8), bytes_(bytes) {}
  unsigned char* data() const { return reinterpret_cast<unsigned char*>(words_.data()); }
  std::size_t size() const { return bytes_; }

 private:
  mutable std::vector<std::uint64_t> words_;
  std::size_t bytes_;
};

template <class T>
T as(const Argument& argument) {
  if constexpr (requires(T what) { *what; }) {
    const Memory* memory = std::get<const Memory*>(argument);
    return memory == nullptr ? nullptr : reinterpret_cast<T>(static_cast<const PlainMemory*>(memory)->data());
  } else {
    return static_cast<T>(std::get<std::int32_t>(argument));
  }
}

using Call = void (*)(std::span<const Argument>);
template <auto kFunction>
struct Unpacked;
template <class... T, void (*kFunction)(T...)>
struct Unpacked<kFunction> {
  static void call(std::span<const Argument> arguments) {
    if (arguments.size() != sizeof...(T)) throw std::logic_error("a kernel has other arguments");
    [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) { kFunction(as<T>(arguments[kIndex])...); }
    (std::index_sequence_for<T...>());
  }
};
#define CALL(name) (&Unpacked<&(name)>::call)
constexpr Call kCalls[] = {CALL(list_bricks),    CALL(find_matter), CALL(vent),           CALL(drain),
                           CALL(border),         CALL(conduct),     CALL(exchange),       CALL(copy_heat),
                           CALL(find_cold),      CALL(melt),        CALL(gravity),        CALL(find_patterns),
                           CALL(apply_patterns), CALL(settle),      CALL(count_substeps), CALL(spread_runs),
                           CALL(begin_relaxing), CALL(relax),       CALL(put_light),      CALL(find_cubes),
                           CALL(find_blocks),    CALL(add_light),   CALL(share_light),    CALL(copy_words)};
static_assert(std::size(kCalls) == std::size(kKernelNames));

class PlainDevice final : public Device {
 public:
  explicit PlainDevice(int threads) : threads_(threads) {}

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
    const std::span all(arguments.begin(), arguments.size());
    const auto work = [&](int first) {
      for (int group = first; group < groups; group += threads_) {
        place = {group, groups};
        kCalls[static_cast<std::size_t>(kernel)](all);
      }
    };
    std::vector<std::jthread> others;
    for (int t = 1; t < threads_; ++t) others.emplace_back(work, t);
    work(0);
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
  int threads_;
};

}  // namespace

std::unique_ptr<Device> plain_device(int threads) { return std::make_unique<PlainDevice>(threads); }

}  // namespace voxmelt::gpu
