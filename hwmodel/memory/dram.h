// The timing of a DRAM, for machines that run at a clock of their own. A machine opens ports, and asks for
// bursts of 64 bytes. Bytes stay with the machine: the model says when they move.
//
// One block of the machine owns a Dram: it takes requests from its channels, puts them, takes replies, and
// then calls cycle() once a cycle of the machine. What was put is seen by the memory from then on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "hwmodel/memory/command.h"
#include "hwmodel/memory/controller.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

struct Request {
  std::int64_t address = 0;  // a multiple of 64
  std::uint32_t id = 0;      // whatever the machine likes
  bool write = false;
};

// Told at the memory's column command. Requests of one burst come here in the order in which they were taken
// from their ports. So whoever moves the bytes here sees every write before it.
class PortClient {
 public:
  virtual ~PortClient() = default;
  virtual void performed(const Request& request) = 0;
};

// Told of every request when a controller takes it.
class RequestListener {
 public:
  virtual ~RequestListener() = default;
  virtual void taken(std::int64_t memory_cycle, const Request& request) = 0;
};

class Dram {
 public:
  Dram(const Parameters& parameters, int machine_mhz, const Policy& policy = {});

  // The client may be null.
  int open_port(PortClient* client);
  bool ready(int port) const;
  void put(int port, const Request& request);  // only where it is ready; more than one in a cycle, too
  // Of reads alone, in the order of a port's requests: the oldest one if its bytes have come, else null.
  const Request* reply(int port) const;
  void take(int port);

  bool cycle();       // ends a cycle of the machine; tells whether a request, a burst or a reply moved
  bool idle() const;  // every write is done, every reply is taken

  std::int64_t memory_cycles() const { return now_; }
  Counts counts() const;  // of all channels
  void listen(CommandListener* listener);
  void trace(RequestListener* listener) { trace_ = listener; }
  const Parameters& parameters() const { return parameters_; }

 private:
  struct UnderWay {
    Request request;
    std::int64_t done = 0;  // cycle of the memory; kNotDone
  };
  struct Waiting {
    Request request;
    std::int64_t put = 0;     // cycle of the memory
    std::int64_t number = 0;  // of a read at its port
    bool held = false;        // for an older request to the same burst
  };
  struct Port {
    PortClient* client = nullptr;
    std::deque<Waiting> inbox;
    std::deque<UnderWay> reads;
    std::int64_t first_read = 0;  // number of the oldest one
  };

  void run(std::int64_t end);
  bool take_request(std::size_t channel);
  void finish(const Controller::Done& done);

  Parameters parameters_;
  Policy policy_;
  int machine_mhz_;
  std::vector<Controller> channels_;
  std::vector<std::int64_t> wake_;
  std::vector<std::size_t> turn_;  // of each channel: the port that is asked first
  std::vector<Port> ports_;
  std::int64_t machine_cycle_ = 0, now_ = 0;
  std::int64_t moves_ = 0;
  Counts latencies_;
  RequestListener* trace_ = nullptr;
};

}  // namespace voxmelt::hwmodel::memory
