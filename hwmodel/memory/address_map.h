// An address map tells where a burst lies. From the lowest bits of its number on, it takes the channel, bank
// group, columns of a row, bank, rank and row. So a stream goes from group to group, and meets another bank
// at the end of a row.
#pragma once

#include <cstdint>

#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::memory {

struct Location {
  int channel = 0, rank = 0, group = 0, bank = 0, row = 0, column = 0;
};

// Streams whose distance is a power of 2 would meet in one bank. So bits of the row are added to bank and
// group.
inline Location locate(std::int64_t address, const Parameters& p) {
  std::int64_t left = address / kBurst;
  const auto cut = [&](std::int64_t count) {
    const auto part = static_cast<int>(left % count);
    left /= count;
    return part;
  };
  Location at;
  at.channel = cut(p.channels);
  at.group = cut(p.groups);
  at.column = cut(p.row_bytes() / kBurst) * (kBurst / (p.width_bits / 8));
  at.bank = cut(p.banks);
  at.rank = cut(p.ranks);
  at.row = cut(p.rows);
  at.bank ^= at.row & (p.banks - 1);
  at.group ^= at.row / p.banks & (p.groups - 1);
  return at;
}

}  // namespace voxmelt::hwmodel::memory
