// The timing of a DRAM is modelled for machines that run at a clock of their own. A machine opens ports, and
// asks for bursts of 64 bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>
#include <vector>

#include "hwmodel/fabric/memory_port.h"
#include "hwmodel/memory/command.h"
#include "hwmodel/memory/controller.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

// Is told of every request when a controller takes it.
class RequestListener {
 public:
  virtual ~RequestListener() = default;
  virtual void taken(std::int64_t memory_cycle, const Request& request) = 0;
};

class Dram final : public Memory {
 public:
  Dram(const Parameters& parameters, int machine_mhz, const Policy& policy = {});

  // The client is told at the memory's column command.
  int open_port(PortClient* client) override;
  bool ready(int port) const override;
  void put(int port, const Request& request) override;
  const Request* reply(int port) const override;
  void take(int port) override;

  bool cycle() override;
  bool idle() const override;
  bool works() const override;
  void require(std::int64_t bytes, std::string_view what) const override;  // throws scene::InputError

  int most_bytes() const override { return kBurst; }
  std::int64_t alignment() const override {  // one row of every bank
    return parameters_.row_bytes() * parameters_.banks_of_rank() * parameters_.ranks * parameters_.channels;
  }

  std::int64_t memory_cycles() const { return now_; }
  Counts counts() const;  // sum over all channels
  void listen(CommandListener* listener);
  void trace(RequestListener* listener) { trace_ = listener; }
  const Parameters& parameters() const { return parameters_; }

 private:
  struct UnderWay {
    Request request;
    std::int64_t done = 0;  // cycle of the memory, or kNotDone
  };
  struct Waiting {
    Request request;
    std::int64_t put = 0;     // cycle of the memory
    std::int64_t number = 0;  // number of a read at its port
    bool held = false;        // it waits for an older request to the same burst
  };
  struct Port {
    PortClient* client = nullptr;
    std::deque<Waiting> inbox;
    std::deque<UnderWay> reads;
    std::int64_t first_read = 0;  // number of the oldest read
  };

  void run(std::int64_t end);
  bool take_request(int channel);
  void finish(const Controller::Done& done);

  Parameters parameters_;
  Policy policy_;
  int machine_mhz_;
  std::vector<Controller> channels_;
  std::vector<std::int64_t> wake_;
  std::vector<std::size_t> turn_;  // for each channel, the port that is asked first
  std::vector<Port> ports_;
  std::int64_t machine_cycle_ = 0, now_ = 0;
  std::int64_t moves_ = 0;
  Counts latencies_;
  RequestListener* trace_ = nullptr;
};

}  // namespace voxmelt::hwmodel::memory
