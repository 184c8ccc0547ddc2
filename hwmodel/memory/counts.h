// The counts tell what a memory did.
#pragma once

#include <algorithm>
#include <cstdint>

namespace voxmelt::hwmodel::memory {

struct Counts {
  std::int64_t reads = 0, writes = 0;  // requests of 64 bytes
  // Divide the requests: the row was open, no row was open, or another row was open.
  std::int64_t hits = 0, misses = 0, conflicts = 0;
  std::int64_t activates = 0, precharges = 0, refreshes = 0, columns = 0;  // commands
  std::int64_t bank_refreshes = 0;                                         // REF of some banks
  std::int64_t read_to_write = 0, write_to_read = 0;                       // turnarounds of a channel
  std::int64_t active = 0;  // cycles of every rank in which a row was open or a refresh ran
  std::int64_t held = 0;    // requests that waited for an older one to the same burst

  // Every cycle of every channel's data bus is one of these. In `idle` cycles no request waits, or the first
  // one is on its way. In `row` cycles a bank opens a row. `spacing` separates column commands in one bank
  // group.
  std::int64_t busy = 0, idle = 0, refresh = 0, turnaround = 0, row = 0, spacing = 0;

  // Latencies run from the port to the reply, in cycles of the memory.
  std::int64_t read_latency = 0, worst_read = 0;
  std::int64_t worst_write = 0;  // ends at its column command

  std::int64_t cycles() const { return busy + idle + refresh + turnaround + row + spacing; }

  Counts& operator+=(const Counts& o) {
    reads += o.reads;
    writes += o.writes;
    hits += o.hits;
    misses += o.misses;
    conflicts += o.conflicts;
    activates += o.activates;
    precharges += o.precharges;
    refreshes += o.refreshes;
    columns += o.columns;
    bank_refreshes += o.bank_refreshes;
    read_to_write += o.read_to_write;
    write_to_read += o.write_to_read;
    active += o.active;
    held += o.held;
    busy += o.busy;
    idle += o.idle;
    refresh += o.refresh;
    turnaround += o.turnaround;
    row += o.row;
    spacing += o.spacing;
    read_latency += o.read_latency;
    worst_read = std::max(worst_read, o.worst_read);
    worst_write = std::max(worst_write, o.worst_write);
    return *this;
  }
};

}  // namespace voxmelt::hwmodel::memory
