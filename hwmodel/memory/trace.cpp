#include "hwmodel/memory/trace.h"

#include <array>
#include <cstddef>
#include <ios>
#include <stdexcept>

namespace voxmelt::hwmodel::memory {
namespace {

void open(std::ofstream& file, const std::string& path) {
  if (path.empty()) return;
  file.open(path);
  if (!file) throw std::runtime_error(path + ": error: cannot be written");
}

}  // namespace

void TraceWriter::taken(std::int64_t memory_cycle, const Request& request) {
  if (format_ == TraceFormat::ramulator)
    to_ << "0x" << std::hex << request.address << std::dec << (request.write ? " W\n" : " R\n");
  else if (format_ == TraceFormat::dramsim3)
    to_ << "0x" << std::hex << request.address << std::dec << (request.write ? " WRITE " : " READ ")
        << begin_ + memory_cycle << '\n';
  else
    to_ << begin_ + memory_cycle << ": " << (request.write ? "write" : "read") << " 0x" << std::hex
        << request.address << std::dec << '\n';
}

void CommandWriter::issued(const Command& c) {
  constexpr std::array kNames{"ACT", "PRE", "PREA", "RD", "WR", "REF", "REFB"};
  to_ << begin_ + c.cycle << ", " << kNames[static_cast<std::size_t>(c.kind)] << ", " << c.channel << ", "
      << c.rank << ", " << c.group << ", " << c.bank << ", " << c.row << ", " << c.column << '\n';
}

TraceFiles::TraceFiles(const std::string& requests, const std::string& commands)
    : format_(requests.ends_with(".stl")   ? TraceFormat::dramsys
              : requests.ends_with(".trc") ? TraceFormat::dramsim3
                                           : TraceFormat::ramulator) {
  open(request_file_, requests);
  open(command_file_, commands);
}

void TraceFiles::attach(Dram& dram, std::int64_t begin) {
  if (request_file_.is_open()) dram.trace(&requests_.emplace(request_file_, format_, begin));
  if (command_file_.is_open()) dram.listen(&commands_.emplace(command_file_, begin));
}

}  // namespace voxmelt::hwmodel::memory
