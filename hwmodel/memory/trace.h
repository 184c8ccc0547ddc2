// The writer logs the requests that a memory took, in the text formats of two public simulators.
#pragma once

#include <cstdint>
#include <ostream>

#include "hwmodel/memory/dram.h"

namespace voxmelt::hwmodel::memory {

enum class TraceFormat : std::uint8_t {
  ramulator,  // "0x00001240 R": the memory trace of Ramulator; it has no times
  dramsys,    // "17: read 0x1240": DRAMSys's .stl, with the cycle of the memory's clock
};

class TraceWriter final : public RequestListener {
 public:
  TraceWriter(std::ostream& to, TraceFormat format) : to_(to), format_(format) {}
  void taken(std::int64_t memory_cycle, const Request& request) override;

 private:
  std::ostream& to_;
  TraceFormat format_;
};

}  // namespace voxmelt::hwmodel::memory
