// The requests that a memory took, and the commands that it got, are logged as text. Public simulators read
// the requests.
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <ostream>
#include <string>

#include "hwmodel/memory/dram.h"

namespace voxmelt::hwmodel::memory {

enum class TraceFormat : std::uint8_t {
  ramulator,  // "0x00001240 R": the memory trace of Ramulator; it has no times
  dramsys,    // "17: read 0x1240": DRAMSys's .stl, with the cycle of the memory's clock
  dramsim3,   // "0x1240 READ 17": the same for DRAMsim3
};

// Cycles count from `begin` on, the cycles of memories before this one.
class TraceWriter final : public RequestListener {
 public:
  TraceWriter(std::ostream& to, TraceFormat format, std::int64_t begin = 0)
      : to_(to), format_(format), begin_(begin) {}
  void taken(std::int64_t memory_cycle, const Request& request) override;

 private:
  std::ostream& to_;
  TraceFormat format_;
  std::int64_t begin_;
};

// Writes "17, ACT, 0, 0, 2, 1, 345, 0": the cycle of the memory's clock, the command, and the numbers of
// channel, rank, bank group, bank of the group, row and column. Those that a command does not name are 0.
class CommandWriter final : public CommandListener {
 public:
  explicit CommandWriter(std::ostream& to, std::int64_t begin = 0) : to_(to), begin_(begin) {}
  void issued(const Command& command) override;

 private:
  std::ostream& to_;
  std::int64_t begin_;
};

// Holds the files of both traces. They go on over several memories, one after the other.
class TraceFiles {
 public:
  // A path is empty for no trace. Requests are written for DRAMSys if their path ends in ".stl", for DRAMsim3
  // if it ends in ".trc", and else for Ramulator. Throws std::runtime_error if a file cannot be written.
  TraceFiles(const std::string& requests, const std::string& commands);

  // Logs what this memory does, and counts its cycles from `begin` on. Both must live as long as it works.
  void attach(Dram& dram, std::int64_t begin);

 private:
  TraceFormat format_;
  std::ofstream request_file_, command_file_;
  std::optional<TraceWriter> requests_;
  std::optional<CommandWriter> commands_;
};

}  // namespace voxmelt::hwmodel::memory
