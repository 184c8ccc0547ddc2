#include "kernel/engine/gpu/open_cl.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <future>
#include <initializer_list>
#include <map>
#include <span>
#include <thread>
#include <utility>
#include <variant>

#include "kernel/engine/gpu/open_cl_library.h"
#include "kernel/engine/gpu/program_text.h"

namespace voxmelt::gpu {
namespace {

// Names what users may meet. A number is enough for the rest.
std::string name_of(cl_int code) {
  static const std::map<cl_int, const char*> names{
      {CL_DEVICE_NOT_AVAILABLE, "the device is not available"},
      {CL_MEM_OBJECT_ALLOCATION_FAILURE, "no memory on the device"},
      {CL_OUT_OF_RESOURCES, "out of resources"},
      {CL_OUT_OF_HOST_MEMORY, "no memory for the driver"},
      {CL_BUILD_PROGRAM_FAILURE, "the program does not build"},
      {CL_INVALID_BUFFER_SIZE, "more memory than the device gives at once"}};
  const auto found = names.find(code);
  return found != names.end() ? found->second : "error " + std::to_string(code);
}

void check(cl_int code, const char* what) {
  if (code != CL_SUCCESS) throw DeviceError(std::string("OpenCL, ") + what + ": " + name_of(code));
}

const OpenClLibrary& library() { return *open_cl_library(); }

// A device that does not answer may not answer to this either. Then nothing is given back.
bool lost = false;

// Something of OpenCL that is given back at the end.
template <class Thing, auto kRelease>
class Owned {
 public:
  Owned() = default;
  explicit Owned(Thing thing) : thing_(thing) {}
  Owned(Owned&& other) noexcept : thing_(std::exchange(other.thing_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(thing_, other.thing_);
    return *this;
  }
  ~Owned() {
    if (thing_ != nullptr && !lost) (library().*kRelease)(thing_);
  }
  Thing get() const { return thing_; }

 private:
  Thing thing_ = nullptr;
};
using Context = Owned<cl_context, &OpenClLibrary::clReleaseContext>;
using Queue = Owned<cl_command_queue, &OpenClLibrary::clReleaseCommandQueue>;
using Program = Owned<cl_program, &OpenClLibrary::clReleaseProgram>;
using KernelObject = Owned<cl_kernel, &OpenClLibrary::clReleaseKernel>;
using Event = Owned<cl_event, &OpenClLibrary::clReleaseEvent>;
using MemoryObject = Owned<cl_mem, &OpenClLibrary::clReleaseMemObject>;

class OpenClMemory final : public Memory {
 public:
  explicit OpenClMemory(cl_mem memory) : memory_(memory) {}
  cl_mem get() const { return memory_.get(); }

 private:
  MemoryObject memory_;
};

cl_mem of(const Memory& memory) { return static_cast<const OpenClMemory&>(memory).get(); }

// A program that is built, with its kernels by number.
struct OpenClKernels final : public OtherKernels {
  Program program;
  std::vector<KernelObject> kernels;
  std::span<const char* const> names;
};

class OpenClQueue final : public Device {
 public:
  OpenClQueue(const OpenClDevice& about, const Constants* constants, Patience patience)
      : about_(about), device_(static_cast<cl_device_id>(about.device)), patience_(patience) {
    cl_int code = CL_SUCCESS;
    context_ = Context(library().clCreateContext(nullptr, 1, &device_, nullptr, nullptr, &code));
    check(code, "open the device");
    queue_ = Queue(library().clCreateCommandQueue(context_.get(), device_, 0, &code));
    check(code, "open a queue");
    own_ = built(program_text(), kKernelNames,
                 constants == nullptr ? std::string() : specialised_options(*constants));
  }

  std::unique_ptr<Memory> allocate(std::size_t bytes) override {
    cl_int code = CL_SUCCESS;
    auto memory = std::make_unique<OpenClMemory>(
        library().clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, padded(bytes), nullptr, &code));
    check(code, ("take " + std::to_string(bytes) + " bytes").c_str());
    clear(*memory, padded(bytes));
    return memory;
  }

  void write(Memory& to, const void* from, std::size_t bytes) override {
    cl_event event = nullptr;
    check(library().clEnqueueWriteBuffer(queue_.get(), of(to), CL_FALSE, 0, bytes, from, 0, nullptr, &event),
          "write");
    wait(Event(event));
  }
  void read(const Memory& from, void* to, std::size_t bytes) override {
    cl_event event = nullptr;
    check(library().clEnqueueReadBuffer(queue_.get(), of(from), CL_FALSE, 0, bytes, to, 0, nullptr, &event),
          "read");
    wait(Event(event));
  }
  void clear(Memory& memory, std::size_t bytes) override {
    const cl_uint zero = 0;
    check(library().clEnqueueFillBuffer(queue_.get(), of(memory), &zero, sizeof zero, 0, padded(bytes), 0,
                                        nullptr, nullptr),
          "clear");
  }

  void run(Kernel kernel, int groups, std::initializer_list<Argument> arguments) override {
    start(*own_, static_cast<std::size_t>(kernel), groups, arguments);
  }
  std::unique_ptr<OtherKernels> build(const OtherProgram& program) override {
    return built(program.text, program.names, program.options);
  }
  void run(const OtherKernels& kernels, std::size_t kernel, int groups,
           std::initializer_list<Argument> arguments) override {
    start(static_cast<const OpenClKernels&>(kernels), kernel, groups, arguments);
  }

  void flush() override { flush_queue(); }

  // Every unit runs some groups at a time, and others wait so that none is idle.
  int most_groups() const override { return about_.units * (about_.is_processor ? 4 : 32); }
  std::uint64_t memory() const override { return about_.memory; }
  std::uint64_t largest_piece() const override { return about_.largest_piece; }

 private:
  static std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

  // Asks again and again, as a driver that waits by itself may never come back.
  void wait(const Event& event) const {
    const auto begin = std::chrono::steady_clock::now();
    flush_queue();
    while (true) {
      cl_int status = CL_QUEUED;
      check(library().clGetEventInfo(event.get(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status,
                                     nullptr),
            "ask how far it is");
      if (status == CL_COMPLETE) return;
      check(std::min(status, CL_SUCCESS), "go on");  // below 0 it is an error
      const auto waited = std::chrono::steady_clock::now() - begin;
      if (waited > std::chrono::seconds(patience_.answer)) give_up(patience_.answer, "");
      if (waited > std::chrono::milliseconds(2)) std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }
  [[noreturn]] void give_up(int seconds, const char* doing) const {
    lost = true;
    throw step::DeviceLost("OpenCL: " + about_.name + " does not answer for " + std::to_string(seconds) +
                           " s" + doing);
  }

  // A compiler cannot be asked how far it is, and may never come back. So it has a thread of its own, with
  // all that it needs. A driver that hangs keeps both.
  cl_int build_in_time(cl_program program, const std::string& options) const {
    std::packaged_task<cl_int()> task([program, options, device = device_] {
      return library().clBuildProgram(program, 1, &device, options.c_str(), nullptr, nullptr);
    });
    std::future<cl_int> answer = task.get_future();
    std::thread compiler(std::move(task));
    if (answer.wait_for(std::chrono::seconds(patience_.build)) != std::future_status::ready) {
      compiler.detach();
      give_up(patience_.build, " while it builds a program");
    }
    compiler.join();
    return answer.get();
  }

  void start(const OpenClKernels& program, std::size_t kernel, int groups,
             std::initializer_list<Argument> arguments) {
    cl_kernel object = program.kernels[kernel].get();
    cl_uint index = 0;
    for (const Argument& argument : arguments) set(object, index++, argument, program.names[kernel]);
    const std::array<std::size_t, 2> local{32, 4}, global{32 * static_cast<std::size_t>(groups), 4};
    check(library().clEnqueueNDRangeKernel(queue_.get(), object, 2, nullptr, global.data(), local.data(), 0,
                                           nullptr, nullptr),
          program.names[kernel]);
  }

  void flush_queue() const { check(library().clFlush(queue_.get()), "go on"); }

  void set(cl_kernel object, cl_uint index, const Argument& argument, const char* name) {
    cl_int code = CL_SUCCESS;
    if (const auto* memory = std::get_if<const Memory*>(&argument)) {
      const cl_mem object_of = *memory == nullptr ? nullptr : of(**memory);
      code = library().clSetKernelArg(object, index, sizeof(void*), &object_of);
    } else {
      code = library().clSetKernelArg(object, index, sizeof(std::int32_t), &std::get<std::int32_t>(argument));
    }
    check(code, name);
  }

  std::unique_ptr<OpenClKernels> built(const std::string& text, std::span<const char* const> names,
                                       const std::string& options) {
    auto all = std::make_unique<OpenClKernels>();
    all->names = names;
    compile(all->program, text, options);
    for (const char* name : names) {
      cl_int code = CL_SUCCESS;
      all->kernels.emplace_back(library().clCreateKernel(all->program.get(), name, &code));
      check(code, name);
    }
    return all;
  }

  void compile(Program& program, const std::string& text, const std::string& options) {
    const std::string whole = open_cl_dialect() + text;
    const char* begin = whole.data();
    const std::size_t size = whole.size();
    cl_int code = CL_SUCCESS;
    program = Program(library().clCreateProgramWithSource(context_.get(), 1, &begin, &size, &code));
    check(code, "take the program");
    code = build_in_time(program.get(), "-cl-std=CL1.2 -w" + options);
    if (code == CL_SUCCESS) return;
    std::string said(4096, '\0');
    std::size_t used = 0;
    library().clGetProgramBuildInfo(program.get(), device_, CL_PROGRAM_BUILD_LOG, said.size(), said.data(),
                                    &used);
    said.resize(std::min(said.size(), used));
    throw DeviceError("OpenCL: " + name_of(code) + ": " + said);
  }

  OpenClDevice about_;
  cl_device_id device_;
  Patience patience_;
  Context context_;
  Queue queue_;
  std::unique_ptr<OpenClKernels> own_;
};

template <class T>
T number_of(cl_device_id device, cl_device_info what) {
  T value{};
  library().clGetDeviceInfo(device, what, sizeof value, &value, nullptr);
  return value;
}
std::string text_of(cl_device_id device, cl_device_info what) {
  std::array<char, 256> text{};
  library().clGetDeviceInfo(device, what, text.size() - 1, text.data(), nullptr);
  return text.data();
}

std::vector<OpenClDevice> found() {
  std::vector<OpenClDevice> all;
  if (open_cl_library() == nullptr) return all;
  std::array<cl_platform_id, 16> platforms{};
  cl_uint count = 0;
  if (library().clGetPlatformIDs(platforms.size(), platforms.data(), &count) != CL_SUCCESS) return all;
  for (cl_uint p = 0; p < std::min<cl_uint>(count, platforms.size()); ++p) {
    std::array<cl_device_id, 64> devices{};
    cl_uint here = 0;
    if (library().clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, devices.size(), devices.data(), &here) !=
        CL_SUCCESS)
      continue;
    for (cl_uint d = 0; d < std::min<cl_uint>(here, devices.size()); ++d) {
      cl_device_id id = devices[d];
      all.push_back({text_of(id, CL_DEVICE_NAME),
                     text_of(id, CL_DEVICE_VERSION) + ", driver " + text_of(id, CL_DRIVER_VERSION),
                     number_of<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE),
                     number_of<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE),
                     (number_of<cl_device_type>(id, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) != 0,
                     (number_of<cl_device_type>(id, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_GPU) != 0,
                     static_cast<int>(number_of<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS)), id});
    }
  }
  // A device of its own comes before an ordinary processor.
  std::stable_sort(all.begin(), all.end(), [](const OpenClDevice& a, const OpenClDevice& b) {
    return !a.is_processor && b.is_processor;
  });
  return all;
}

}  // namespace

const std::vector<OpenClDevice>& open_cl_devices() {
  static const std::vector<OpenClDevice> devices = found();
  return devices;
}

std::unique_ptr<Device> open(const OpenClDevice& device, const Constants* constants, Patience patience) {
  return std::make_unique<OpenClQueue>(device, constants, patience);
}

}  // namespace voxmelt::gpu
