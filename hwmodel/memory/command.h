// What a controller tells a memory, and who hears it.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::memory {

struct Command {
  enum class Kind : std::uint8_t { activate, precharge, precharge_all, read, write, refresh };

  std::int64_t cycle = 0;  // of the memory's clock
  Kind kind = Kind::activate;
  int channel = 0, rank = 0, group = 0, bank = 0;  // bank of its group
  int row = 0, column = 0;                         // column of a read or a write
};

class CommandListener {
 public:
  virtual ~CommandListener() = default;
  virtual void issued(const Command& command) = 0;
};

}  // namespace voxmelt::hwmodel::memory
