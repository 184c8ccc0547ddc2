#include "hwmodel/memory/trace.h"

#include <ios>

namespace voxmelt::hwmodel::memory {

void TraceWriter::taken(std::int64_t memory_cycle, const Request& request) {
  if (format_ == TraceFormat::ramulator)
    to_ << "0x" << std::hex << request.address << std::dec << (request.write ? " W\n" : " R\n");
  else
    to_ << memory_cycle << ": " << (request.write ? "write" : "read") << " 0x" << std::hex << request.address
        << std::dec << '\n';
}

}  // namespace voxmelt::hwmodel::memory
