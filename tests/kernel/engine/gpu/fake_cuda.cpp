#include "tests/kernel/engine/gpu/fake_cuda.h"

#include <bit>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tests/kernel/engine/gpu/plain_device.h"

namespace voxmelt::gpu {
namespace {

constexpr CudaResult kInvalid = 1;

FakeCard card;
std::deque<std::function<void()>> queue;    // what was asked for and has not been done
std::map<CudaAddress, std::size_t> memory;  // of the card, by its first byte
std::set<void*> staging;                    // of the host
thread_local bool entered = false;          // by this thread
const CudaContext kContext = reinterpret_cast<CudaContext>(16);
const CudaStream kStream = reinterpret_cast<CudaStream>(32);
const CudaModule kModule = reinterpret_cast<CudaModule>(48);
const char kMachineCode[] = "machine code";

CudaResult broken(const std::string& rule) {
  card.broken_rules.push_back(rule);
  return kInvalid;
}
// Every function but a few is for a thread that has entered the device.
bool outside(const char* function) {
  if (entered) return false;
  broken(std::string(function) + " by a thread that is not in the device");
  return true;
}
bool is_on_card(CudaAddress first, std::size_t bytes) {
  const auto after = memory.upper_bound(first);
  if (after == memory.begin()) return false;
  const auto& [begin, size] = *std::prev(after);
  return first + bytes <= begin + size;
}
char* bytes_at(CudaAddress address) { return std::bit_cast<char*>(address); }

template <class Task>
CudaResult later(const char* what, CudaStream stream, Task&& task) {
  if (outside(what)) return kInvalid;
  if (stream != kStream) return broken(std::string(what) + ": another queue");
  queue.emplace_back(std::forward<Task>(task));
  return kCudaSuccess;
}

void do_next() {
  queue.front()();
  queue.pop_front();
}

CudaResult take_memory(CudaAddress* address, std::size_t bytes) {
  if (outside("cuMemAlloc")) return kInvalid;
  if (bytes == 0) return broken("memory of no bytes");
  if (card.memory_left-- <= 0) return kCudaOutOfMemory;
  *address = reinterpret_cast<CudaAddress>(std::malloc(bytes));
  std::memset(bytes_at(*address), 0xA5, bytes);  // whoever held it before
  memory[*address] = bytes;
  ++card.alive;
  return kCudaSuccess;
}
CudaResult free_memory(CudaAddress address) {
  if (outside("cuMemFree")) return kInvalid;
  if (memory.erase(address) == 0) return broken("memory is given back twice");
  while (!queue.empty()) do_next();  // as the driver does
  std::free(bytes_at(address));
  --card.alive;
  return kCudaSuccess;
}
CudaResult clear_words(CudaAddress to, unsigned value, std::size_t words, CudaStream stream) {
  if (!is_on_card(to, 4 * words)) return broken("clears what it does not have");
  return later("cuMemsetD32Async", stream, [=] {
    for (std::size_t i = 0; i < words; ++i) std::memcpy(bytes_at(to) + 4 * i, &value, 4);
  });
}
CudaResult send(CudaAddress to, const void* from, std::size_t bytes, CudaStream stream) {
  if (!is_on_card(to, bytes)) return broken("writes where it has nothing");
  return later("cuMemcpyHtoDAsync", stream, [=] { std::memcpy(bytes_at(to), from, bytes); });
}
CudaResult fetch(void* to, CudaAddress from, std::size_t bytes, CudaStream stream) {
  if (!is_on_card(from, bytes)) return broken("reads what it does not have");
  return later("cuMemcpyDtoHAsync", stream, [=] { std::memcpy(to, bytes_at(from), bytes); });
}

// Does one thing each time that it is asked, as a card is seldom ready at once.
CudaResult query(CudaStream stream) {
  if (outside("cuStreamQuery")) return kInvalid;
  if (stream != kStream) return broken("another queue is asked for");
  if (card.hangs) return kCudaNotReady;
  if (queue.empty()) return kCudaSuccess;
  do_next();
  return queue.empty() ? kCudaSuccess : kCudaNotReady;
}

CudaResult launch(CudaFunction function, unsigned groups, unsigned y, unsigned z, unsigned lanes_x,
                  unsigned lanes_y, unsigned lanes_z, unsigned shared, CudaStream stream, void** places,
                  void** others) {
  if (groups == 0 || y != 1 || z != 1 || lanes_x != 32 || lanes_y != 4 || lanes_z != 1 || shared != 0 ||
      others != nullptr)
    return broken("a launch of another shape");
  const auto take = reinterpret_cast<Take>(function);
  return later("cuLaunchKernel", stream, [call = take(places), groups] {
    for (unsigned group = 0; group < groups; ++group) {
      place = {static_cast<int>(group), static_cast<int>(groups)};
      call();
    }
  });
}

CudaLibrary driver() {
  CudaLibrary all;
  all.cuInit = [](unsigned) { return kCudaSuccess; };
  all.cuDriverGetVersion = [](int* version) { return *version = 13020, kCudaSuccess; };
  all.cuGetErrorString = [](CudaResult code, const char** text) {
    *text = code == kCudaOutOfMemory ? "out of memory" : code == kInvalid ? "invalid argument" : nullptr;
    return *text != nullptr ? kCudaSuccess : kInvalid;
  };
  all.cuDeviceGetCount = [](int* count) { return *count = 2, kCudaSuccess; };
  all.cuDeviceGet = [](CudaDeviceNumber* device, int number) { return *device = 7 + number, kCudaSuccess; };
  all.cuDeviceGetName = [](char* name, int size, CudaDeviceNumber device) {
    const std::string found = device == 7 ? "Fake card" : "Older card";
    found.copy(name, static_cast<std::size_t>(size));
    return kCudaSuccess;
  };
  all.cuDeviceGetAttribute = [](int* value, int what, CudaDeviceNumber device) {
    *value = what == kCudaMultiprocessors ? 3
             : what == kCudaMajor         ? (device == 7 ? 12 : 7)
             : what == kCudaMinor         ? 5
                                          : -1;
    return kCudaSuccess;
  };
  all.cuDeviceTotalMem = [](std::size_t* bytes, CudaDeviceNumber) {
    return *bytes = std::size_t{6} << 30, kCudaSuccess;
  };
  all.cuDevicePrimaryCtxRetain = [](CudaContext* context, CudaDeviceNumber) {
    return *context = kContext, ++card.alive, kCudaSuccess;
  };
  all.cuDevicePrimaryCtxRelease = [](CudaDeviceNumber) {
    return entered = false, --card.alive, kCudaSuccess;
  };
  all.cuCtxSetCurrent = [](CudaContext context) { return entered = context == kContext, kCudaSuccess; };
  all.cuStreamCreate = [](CudaStream* stream, unsigned flags) {
    if (outside("cuStreamCreate") || flags != kCudaNonBlocking) return kInvalid;
    return *stream = kStream, ++card.alive, kCudaSuccess;
  };
  all.cuStreamQuery = query;
  all.cuStreamDestroy = [](CudaStream) { return --card.alive, kCudaSuccess; };
  all.cuMemAlloc = take_memory;
  all.cuMemFree = free_memory;
  all.cuMemHostAlloc = [](void** to, std::size_t bytes, unsigned) {
    if (outside("cuMemHostAlloc")) return kInvalid;
    *to = std::malloc(bytes);
    staging.insert(*to);
    return ++card.alive, kCudaSuccess;
  };
  all.cuMemFreeHost = [](void* at) {
    if (staging.erase(at) == 0) return broken("memory of the host is given back twice");
    std::free(at);
    return --card.alive, kCudaSuccess;
  };
  all.cuMemsetD32Async = clear_words;
  all.cuMemcpyHtoDAsync = send;
  all.cuMemcpyDtoHAsync = fetch;
  all.cuModuleLoadData = [](CudaModule* module, const void* code) {
    if (outside("cuModuleLoadData")) return kInvalid;
    if (std::strcmp(static_cast<const char*>(code), kMachineCode) != 0) return broken("other machine code");
    return *module = kModule, ++card.alive, kCudaSuccess;
  };
  all.cuModuleUnload = [](CudaModule) { return --card.alive, kCudaSuccess; };
  all.cuModuleGetFunction = [](CudaFunction* function, CudaModule, const char* name) {
    const Take found = plain_kernel(name);
    *function = reinterpret_cast<CudaFunction>(found);
    return found != nullptr ? kCudaSuccess : broken(std::string("no kernel ") + name);
  };
  all.cuLaunchKernel = launch;
  return all;
}

NvrtcLibrary compiler() {
  NvrtcLibrary all;
  all.nvrtcVersion = [](int* major, int* minor) { return *major = 13, *minor = 1, 0; };
  all.nvrtcGetErrorString = [](NvrtcResult) { return "it does not compile"; };
  all.nvrtcCreateProgram = [](NvrtcProgram* program, const char* text, const char*, int, const char* const*,
                              const char* const*) {
    card.text = text;
    ++card.alive;
    return *program = reinterpret_cast<NvrtcProgram>(64), 0;
  };
  all.nvrtcDestroyProgram = [](NvrtcProgram*) { return --card.alive, 0; };
  all.nvrtcCompileProgram = [](NvrtcProgram, int count, const char* const* options) {
    card.options.assign(options, options + count);
    return card.compiler_refuses ? 6 : 0;
  };
  all.nvrtcGetProgramLogSize = [](NvrtcProgram, std::size_t* size) { return *size = 12, 0; };
  all.nvrtcGetProgramLog = [](NvrtcProgram, char* log) { return std::memcpy(log, "line 3: what", 12), 0; };
  all.nvrtcGetCUBINSize = [](NvrtcProgram, std::size_t* size) { return *size = sizeof kMachineCode, 0; };
  all.nvrtcGetCUBIN = [](NvrtcProgram, char* code) {
    return std::memcpy(code, kMachineCode, sizeof kMachineCode), 0;
  };
  return all;
}

}  // namespace

FakeCard& new_fake_card() {
  queue.clear();
  for (const auto& [address, bytes] : memory) std::free(bytes_at(address));
  for (void* piece : staging) std::free(piece);
  memory.clear();
  staging.clear();
  return card = {};
}

Cuda fake_cuda() {
  static const CudaLibrary own_driver = driver();
  static const NvrtcLibrary own_compiler = compiler();
  return {&own_driver, &own_compiler};
}

}  // namespace voxmelt::gpu
