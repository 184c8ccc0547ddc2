#include "kernel/engine/gpu/cuda.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <span>
#include <thread>
#include <utility>
#include <variant>

#include "kernel/engine/gpu/cuda_compiler.h"
#include "kernel/engine/gpu/program_text.h"

namespace voxmelt::gpu {
namespace {

// The state goes to and fro in pieces of this size, through memory of the host that the driver knows. A
// driver that copies from any other memory may wait by itself.
constexpr std::size_t kStaging = std::size_t{8} << 20;

void check(const CudaLibrary& driver, CudaResult code, const std::string& what) {
  if (code == kCudaSuccess) return;
  const char* said = nullptr;
  driver.cuGetErrorString(code, &said);
  throw DeviceError("CUDA, " + what + ": " + (said != nullptr ? said : "error " + std::to_string(code)));
}

// A device's context is that of the thread which asks. All of a program share one for each device.
class Context {
 public:
  Context(const CudaLibrary& driver, CudaDeviceNumber device) : driver_(driver), device_(device) {
    check(driver_, driver_.cuDevicePrimaryCtxRetain(&context_, device_), "open the device");
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    if (!lost) driver_.cuDevicePrimaryCtxRelease(device_);
  }
  const CudaLibrary& entered() const {
    check(driver_, driver_.cuCtxSetCurrent(context_), "enter the device");
    return driver_;
  }
  // Gives something back, unless the device is lost: it may not answer to this either.
  template <class Thing>
  void give_back(CudaResult (*CudaLibrary::*release)(Thing), Thing thing) const {
    if (thing == Thing{} || lost || driver_.cuCtxSetCurrent(context_) != kCudaSuccess) return;
    (driver_.*release)(thing);
  }

  bool lost = false;

 private:
  const CudaLibrary& driver_;
  CudaDeviceNumber device_;
  CudaContext context_ = nullptr;
};

// Something of the driver that is given back at the end.
template <class Thing, auto kRelease>
class Owned {
 public:
  explicit Owned(std::shared_ptr<Context> context) : context_(std::move(context)) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { context_->give_back(kRelease, thing); }

  Thing thing{};

 private:
  std::shared_ptr<Context> context_;
};

class CudaMemory final : public Memory {
 public:
  explicit CudaMemory(std::shared_ptr<Context> context) : owned(std::move(context)) {}
  Owned<CudaAddress, &CudaLibrary::cuMemFree> owned;
};

CudaAddress of(const Memory& memory) { return static_cast<const CudaMemory&>(memory).owned.thing; }

// A program in machine code, with its kernels by number.
struct CudaKernels final : public OtherKernels {
  explicit CudaKernels(std::shared_ptr<Context> context) : module(std::move(context)) {}
  Owned<CudaModule, &CudaLibrary::cuModuleUnload> module;
  std::vector<CudaFunction> kernels;
  std::span<const char* const> names;
};

class CudaQueue final : public Device {
 public:
  CudaQueue(const Cuda& cuda, const CudaDevice& about, const Constants* constants, Patience patience)
      : cuda_(cuda),
        about_(about),
        patience_(patience),
        context_(std::make_shared<Context>(*cuda.driver, about.number)),
        stream_(context_),
        staging_(context_) {
    const CudaLibrary& driver = context_->entered();
    check(driver, driver.cuStreamCreate(&stream_.thing, kCudaNonBlocking), "open a queue");
    check(driver, driver.cuMemHostAlloc(&staging_.thing, kStaging, 0), "take memory of the host");
    own_ = built(program_text(), kKernelNames,
                 constants == nullptr ? std::string() : specialised_options(*constants));
  }

  std::unique_ptr<Memory> allocate(std::size_t bytes) override {
    const CudaLibrary& driver = context_->entered();
    auto memory = std::make_unique<CudaMemory>(context_);
    check(driver, driver.cuMemAlloc(&memory->owned.thing, std::max<std::size_t>(padded(bytes), 4)),
          "take " + std::to_string(bytes) + " bytes");
    clear(*memory, bytes);
    return memory;
  }

  void write(Memory& to, const void* from, std::size_t bytes) override {
    const CudaLibrary& driver = context_->entered();
    in_pieces(bytes, [&](std::size_t first, std::size_t count) {
      std::memcpy(staging_.thing, static_cast<const char*>(from) + first, count);
      check(driver, driver.cuMemcpyHtoDAsync(of(to) + first, staging_.thing, count, stream_.thing), "write");
      wait(driver);
    });
  }
  void read(const Memory& from, void* to, std::size_t bytes) override {
    const CudaLibrary& driver = context_->entered();
    in_pieces(bytes, [&](std::size_t first, std::size_t count) {
      check(driver, driver.cuMemcpyDtoHAsync(staging_.thing, of(from) + first, count, stream_.thing), "read");
      wait(driver);
      std::memcpy(static_cast<char*>(to) + first, staging_.thing, count);
    });
  }
  void clear(Memory& memory, std::size_t bytes) override {
    const CudaLibrary& driver = context_->entered();
    check(driver, driver.cuMemsetD32Async(of(memory), 0, padded(bytes) / 4, stream_.thing), "clear");
  }

  void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) override {
    start(*own_, static_cast<std::size_t>(kernel), groups, arguments);
  }
  std::unique_ptr<OtherKernels> build(const OtherProgram& program) override {
    return built(program.text, program.names, program.options);
  }
  void run(const OtherKernels& kernels, std::size_t kernel, int groups,
           std::initializer_list<Argument> arguments) override {
    start(static_cast<const CudaKernels&>(kernels), kernel, groups, arguments);
  }

  void flush() override {}  // a stream begins at once

  // Every unit runs some groups at a time, and others wait so that none is idle.
  int most_groups() const override { return about_.units * 32; }
  std::uint64_t memory() const override { return about_.memory; }
  std::uint64_t largest_piece() const override { return about_.memory; }

 private:
  static std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

  template <class Copy>
  static void in_pieces(std::size_t bytes, Copy&& copy) {
    for (std::size_t first = 0; first < bytes; first += kStaging)
      copy(first, std::min(kStaging, bytes - first));
  }

  // Asks again and again, as a driver that waits by itself may never come back.
  void wait(const CudaLibrary& driver) const {
    const auto begin = std::chrono::steady_clock::now();
    while (true) {
      const CudaResult state = driver.cuStreamQuery(stream_.thing);
      if (state == kCudaSuccess) return;
      if (state != kCudaNotReady) check(driver, state, "go on");
      const auto waited = std::chrono::steady_clock::now() - begin;
      if (waited > std::chrono::seconds(patience_.answer)) {
        context_->lost = true;
        throw step::DeviceLost("CUDA: " + about_.name + " does not answer for " +
                               std::to_string(patience_.answer) + " s");
      }
      if (waited > std::chrono::milliseconds(2)) std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  void start(const CudaKernels& program, std::size_t kernel, int groups,
             std::initializer_list<Argument> arguments) {
    const CudaLibrary& driver = context_->entered();
    union Value {
      CudaAddress address;
      std::int32_t number;
    };
    std::array<Value, 32> values;
    std::array<void*, 32> places;
    if (arguments.size() > values.size()) throw DeviceError("CUDA: too many arguments");
    std::size_t count = 0;
    for (const Argument& argument : arguments) {
      if (const auto* memory = std::get_if<const Memory*>(&argument))
        values[count].address = *memory == nullptr ? 0 : of(**memory);
      else
        values[count].number = std::get<std::int32_t>(argument);
      places[count] = &values[count];
      ++count;
    }
    check(driver,
          driver.cuLaunchKernel(program.kernels[kernel], static_cast<unsigned>(groups), 1, 1, 32, 4, 1, 0,
                                stream_.thing, places.data(), nullptr),
          program.names[kernel]);
  }

  std::unique_ptr<CudaKernels> built(const std::string& text, std::span<const char* const> names,
                                     const std::string& options) {
    const std::string code = compiled_for_cuda(*cuda_.compiler, text, options, about_.architecture);
    const CudaLibrary& driver = context_->entered();
    auto all = std::make_unique<CudaKernels>(context_);
    all->names = names;
    check(driver, driver.cuModuleLoadData(&all->module.thing, code.data()), "take the program");
    for (const char* name : names)
      check(driver, driver.cuModuleGetFunction(&all->kernels.emplace_back(), all->module.thing, name), name);
    return all;
  }

  Cuda cuda_;
  CudaDevice about_;
  Patience patience_;
  std::shared_ptr<Context> context_;
  Owned<CudaStream, &CudaLibrary::cuStreamDestroy> stream_;
  Owned<void*, &CudaLibrary::cuMemFreeHost> staging_;
  std::unique_ptr<CudaKernels> own_;
};

std::string version(int number) {
  return std::to_string(number / 1000) + "." + std::to_string(number % 1000 / 10);
}

}  // namespace

std::vector<CudaDevice> devices_of(const Cuda& cuda) {
  std::vector<CudaDevice> all;
  if (cuda.driver == nullptr || cuda.compiler == nullptr) return all;
  const CudaLibrary& driver = *cuda.driver;
  int count = 0, number = 0, major = 0, minor = 0;
  if (driver.cuInit(0) != kCudaSuccess || driver.cuDeviceGetCount(&count) != kCudaSuccess) return all;
  driver.cuDriverGetVersion(&number);
  cuda.compiler->nvrtcVersion(&major, &minor);
  const std::string versions =
      "CUDA " + version(number) + ", compiler " + std::to_string(major) + "." + std::to_string(minor);
  for (int n = 0; n < count; ++n) {
    CudaDeviceNumber device = 0;
    std::array<char, 256> name{};
    std::size_t memory = 0;
    int units = 1;
    if (driver.cuDeviceGet(&device, n) != kCudaSuccess) continue;
    driver.cuDeviceGetName(name.data(), static_cast<int>(name.size()) - 1, device);
    driver.cuDeviceTotalMem(&memory, device);
    driver.cuDeviceGetAttribute(&units, kCudaMultiprocessors, device);
    driver.cuDeviceGetAttribute(&major, kCudaMajor, device);
    driver.cuDeviceGetAttribute(&minor, kCudaMinor, device);
    all.push_back({name.data(), versions, memory, units, major * 10 + minor, device});
  }
  return all;
}

const std::vector<CudaDevice>& cuda_devices() {
  static const std::vector<CudaDevice> devices = [] {
    const CudaLibrary* driver = cuda_library();  // without a driver, no compiler is looked for
    return driver == nullptr ? std::vector<CudaDevice>() : devices_of({driver, nvrtc_library()});
  }();
  return devices;
}

std::unique_ptr<Device> open(const Cuda& cuda, const CudaDevice& device, const Constants* constants,
                             Patience patience) {
  return std::make_unique<CudaQueue>(cuda, device, constants, patience);
}

std::unique_ptr<Device> open(const CudaDevice& device, const Constants* constants, Patience patience) {
  return open({cuda_library(), nvrtc_library()}, device, constants, patience);
}

}  // namespace voxmelt::gpu
