// What a machine sees of a memory: ports, at which it asks for bytes, and when they move. Bytes stay with the
// machine.
//
// In a cycle blocks put requests where a port is ready, and take replies. When all have, cycle() ends the
// cycle. What was put is seen by the memory from then on. So the order of the blocks cannot matter.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::memory {

inline constexpr int kBurst = 64;  // bytes: what a stream asks for at once, and the only request to a DRAM

struct Request {
  std::int64_t address = 0;  // of a burst a multiple of 64
  std::uint32_t id = 0;      // whatever the machine likes
  bool write = false;
  std::int32_t bytes = kBurst;
};

// Told when bytes move. Requests to the same place come here in the order in which they were taken from their
// ports. So whoever moves the bytes here sees every write before it.
class PortClient {
 public:
  virtual ~PortClient() = default;
  virtual void performed(const Request& request) = 0;
};

class Memory {
 public:
  virtual ~Memory() = default;

  // The client may be null. Ports of one client share its way back.
  virtual int open_port(PortClient* client) = 0;
  virtual bool ready(int port) const = 0;
  virtual void put(int port, const Request& request) = 0;  // only where it is ready
  // Of reads alone, in the order of a port's requests: the oldest one if its bytes have come, else null.
  virtual const Request* reply(int port) const = 0;
  virtual void take(int port) = 0;

  virtual bool cycle() = 0;       // ends a cycle of the machine; tells whether anything moved
  virtual bool idle() const = 0;  // every write is done, every reply is taken

  virtual int most_bytes() const = 0;          // of a request
  virtual std::int64_t alignment() const = 0;  // bytes: of what begins a region of its own
};

}  // namespace voxmelt::hwmodel::memory
