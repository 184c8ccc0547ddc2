// How a kernel that is compiled as C++ is called with a device's arguments.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "kernel/engine/gpu/device.h"

namespace voxmelt::gpu {

// The group that a thread works on.
struct Place {
  int group = 0, groups = 1;
};
inline thread_local Place place;

// Groups share what these change.
inline int next(int& counter) { return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); }
inline void raise_to(int& number, int least) {
  std::atomic_ref<int> shared(number);
  int seen = shared.load();
  while (seen < least && !shared.compare_exchange_weak(seen, least)) {
  }
}
inline int leading_zeros(std::uint64_t number) { return std::countl_zero(number); }
inline int look(const int& moment) {
  return std::atomic_ref(const_cast<int&>(moment)).load(std::memory_order_relaxed);
}
inline void stamp(int& moment, int now) { std::atomic_ref(moment).store(now, std::memory_order_relaxed); }
inline int claim(int& moment, int now) {
  return std::atomic_ref(moment).exchange(now, std::memory_order_relaxed);
}

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

// The same for a driver that has a place for each argument, as CUDA's. It takes them at once, and calls
// later.
template <auto kFunction>
struct Bound;
template <class... T, void (*kFunction)(T...)>
struct Bound<kFunction> {
  static std::function<void()> take(void** places) {
    return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
      return
          [values = std::tuple<T...>(*static_cast<T*>(places[kIndex])...)] { std::apply(kFunction, values); };
    }
    (std::index_sequence_for<T...>());
  }
};
using Take = std::function<void()> (*)(void** places);

}  // namespace voxmelt::gpu
