// A machine sees ports of a memory. There it asks for bytes, and learns when they move. The bytes themselves
// stay with the machine.
//
// In a cycle, blocks put requests where a port is ready, and take replies. When all have done so, cycle()
// ends the cycle. The memory sees what was put from then on. So the order of the blocks cannot matter.
#pragma once

#include <cstdint>
#include <string_view>

namespace voxmelt::hwmodel::memory {

inline constexpr int kBurst = 64;  // bytes that a stream asks for at once; a DRAM takes no other request

struct Request {
  std::int64_t address = 0;  // a multiple of 64 for a burst
  std::uint32_t id = 0;      // free for the machine's use
  bool write = false;
  std::int32_t bytes = kBurst;
};

// Is told when bytes move. Requests to the same place come here in the order in which they were taken from
// their ports. So a client that moves the bytes here sees every earlier write.
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
  virtual void put(int port, const Request& request) = 0;  // only while the port is ready
  // Returns the oldest read of a port if its bytes have come, else null. Reads are answered in the order of
  // the port's requests. Writes have no reply.
  virtual const Request* reply(int port) const = 0;
  virtual void take(int port) = 0;

  virtual bool cycle() = 0;       // ends a cycle of the machine; returns true if anything moved
  virtual bool idle() const = 0;  // every write is done, every reply is taken
  // Returns true while a request is under way that will be done without anybody's help.
  virtual bool works() const = 0;
  // Throws if the memory has no `bytes`. `what` is to lie there.
  virtual void require(std::int64_t bytes, std::string_view what) const = 0;

  virtual int most_bytes() const = 0;          // largest request
  virtual std::int64_t alignment() const = 0;  // bytes; a region of its own begins at a multiple
};

}  // namespace voxmelt::hwmodel::memory
