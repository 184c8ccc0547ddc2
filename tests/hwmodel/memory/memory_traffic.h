// Makes random requests for a DRAM: streams, lone bursts, rows of one bank, the same few bursts over and
// over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel::memory {

inline Parameters sheet(const std::string& name) { return load_memory(name, "test"); }
inline std::vector<Parameters> all_sheets() {
  std::vector<Parameters> all;
  for (const MemoryFile& file : memory_files()) all.push_back(sheet(file.name));
  return all;
}
// Refreshes banks one after the other, where the sheet has numbers for that.
inline Parameters by_bank(const std::string& name) {
  Parameters p = sheet(name);
  p.by_bank = true;
  return p;
}
inline std::vector<Parameters> all_by_bank() {
  std::vector<Parameters> all;
  for (const Parameters& p : all_sheets())
    if (p.groups_at_once > 0) all.push_back(by_bank(p.name));
  return all;
}
inline Parameters two_ranks() {
  Parameters p = sheet("ddr4-2400");
  p.ranks = 2;
  return p;
}

class Traffic {
 public:
  Traffic(Dram& dram, int ports, std::uint64_t seed, PortClient* client = nullptr)
      : dram_(dram), random_(seed), ports_(static_cast<std::size_t>(ports)) {
    for (Port& port : ports_) {
      port.number = dram.open_port(client);
      turn(port);
    }
  }

  void run(std::int64_t cycles) {
    for (std::int64_t i = 0; i < cycles; ++i) {
      for (Port& port : ports_) {
        while (dram_.reply(port.number) != nullptr) {
          dram_.take(port.number);
          ++replies_;
        }
        while (dram_.ready(port.number) && between(0, 99) < port.eager) put(port);
      }
      dram_.cycle();
    }
  }
  // Takes replies until nothing is left, and returns false if it takes far too long.
  bool drain() {
    for (int i = 0; i < 100000 && !dram_.idle(); ++i) {
      for (Port& port : ports_)
        while (dram_.reply(port.number) != nullptr) {
          dram_.take(port.number);
          ++replies_;
        }
      dram_.cycle();
    }
    return dram_.idle();
  }
  std::int64_t asked() const { return asked_; }      // reads
  std::int64_t written() const { return written_; }  // requests
  std::int64_t replies() const { return replies_; }

 private:
  struct Port {
    int number = 0, kind = 0, eager = 0, writes = 0, left = 0;
    std::int64_t at = 0, step = 0;
  };

  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  // Gives a port another habit.
  void turn(Port& port) {
    const Parameters& p = dram_.parameters();
    port.kind = static_cast<int>(between(0, 3));
    port.eager = static_cast<int>(between(0, 3) == 0 ? between(1, 20) : 95);
    port.writes = static_cast<int>(between(0, 4)) * 25;
    port.left = static_cast<int>(between(1, 400));
    port.at = between(0, p.bytes() / kBurst - 1) * kBurst;
    // This many bytes lead to the next row.
    const std::int64_t row = p.row_bytes() * p.banks_of_rank() * p.ranks * p.channels;
    port.step = port.kind == 0 ? kBurst : port.kind == 1 ? row * (std::int64_t{1} << between(0, 6)) : 0;
  }
  void put(Port& port) {
    if (--port.left <= 0) turn(port);
    const std::int64_t bursts = dram_.parameters().bytes() / kBurst;
    if (port.kind == 2)
      port.at = between(0, bursts - 1) * kBurst;
    else if (port.kind == 3)
      port.at = between(0, 5) * kBurst;
    else
      port.at = (port.at + port.step) % (bursts * kBurst);
    const bool write = between(0, 99) < port.writes;
    ++(write ? written_ : asked_);
    dram_.put(port.number, {port.at, ++id_, write});
  }

  Dram& dram_;
  std::mt19937_64 random_;
  std::vector<Port> ports_;
  std::int64_t asked_ = 0, written_ = 0, replies_ = 0;
  std::uint32_t id_ = 0;
};

}  // namespace voxmelt::hwmodel::memory
