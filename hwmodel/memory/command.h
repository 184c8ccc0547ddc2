// A controller sends commands to a memory, and a listener hears them.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel::memory {

struct Command {
  // `refresh` is of all banks of a rank, and `refresh_bank` of one bank in one group or in several.
  enum class Kind : std::uint8_t { activate, precharge, precharge_all, read, write, refresh, refresh_bank };

  std::int64_t cycle = 0;  // cycle of the memory's clock
  Kind kind = Kind::activate;
  int channel = 0, rank = 0, group = 0, bank = 0;  // the bank counts in its group
  int row = 0, column = 0;                         // the column is that of a read or a write
};

class CommandListener {
 public:
  virtual ~CommandListener() = default;
  virtual void issued(const Command& command) = 0;
};

}  // namespace voxmelt::hwmodel::memory
