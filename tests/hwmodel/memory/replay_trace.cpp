// Replays a trace of requests on a DRAM, as fast as its controller takes them, and prints the cycles.
// It also writes the same requests for Ramulator. Their addresses lie in the same bank, row and column in
// Ramulator's order (row, bank, group, rank, column, channel). So its cycles can be compared
// (docs/hardware/memory.md).
//
//   replay_trace MEMORY IN.trace OUT.trace [READS]      lines: 0x00001240 R
//
// READS are the entries of the queue of reads, if not those of the controller.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hwmodel/memory/address_map.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/energy.h"
#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel::memory {
namespace {

std::vector<Request> requests_of(const std::string& file) {
  std::ifstream stream(file);
  std::vector<Request> requests;
  std::string address, kind;
  while (stream >> address >> kind) {
    if (kind != "R" && kind != "W")
      throw std::runtime_error(fmt::format("{}: neither R nor W: {}", file, kind));
    requests.push_back(
        {std::stoll(address, nullptr, 16), static_cast<std::uint32_t>(requests.size()), kind == "W"});
  }
  if (requests.empty()) throw std::runtime_error(file + ": no request");
  return requests;
}

std::int64_t for_ramulator(const Location& at, const Parameters& p) {
  std::int64_t burst = at.row;
  burst = burst * p.banks + at.bank;
  burst = burst * p.groups + at.group;
  burst = burst * p.ranks + at.rank;
  burst = burst * (p.row_bytes() / kBurst) + at.column / (kBurst / (p.width_bits / 8));
  return (burst * p.channels + at.channel) * kBurst;
}

// Sends the requests by one port, at the memory's own clock.
void run(const std::vector<Request>& requests, const Parameters& p, const Policy& policy) {
  Dram dram(p, p.mhz, policy);
  const int port = dram.open_port(nullptr);
  for (std::size_t next = 0; next < requests.size() || !dram.idle(); dram.cycle()) {
    while (dram.reply(port) != nullptr) dram.take(port);
    while (next < requests.size() && dram.ready(port)) dram.put(port, requests[next++]);
  }
  const Counts counts = dram.counts();
  fmt::print("{} requests, {} cycles, {} turns from reads to writes; {} rows opened, {:.3f} nJ\n",
             requests.size(), dram.memory_cycles(), counts.read_to_write, counts.activates,
             energy_of(counts, p).all());
}

void replay(const std::string& memory, const std::string& in, const std::string& out, const Policy& policy) {
  const Parameters p = load_memory(memory, "replay_trace");
  const std::vector<Request> requests = requests_of(in);
  std::ofstream stream(out);
  for (const Request& request : requests)
    stream << fmt::format("0x{:08x} {}\n", for_ramulator(locate(request.address, p), p),
                          request.write ? 'W' : 'R');
  stream.close();
  if (!stream) throw std::runtime_error(out + ": cannot be written");
  run(requests, p, policy);
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fputs("replay_trace MEMORY IN.trace OUT.trace [READS]\n", stderr);
    return 2;
  }
  try {
    voxmelt::hwmodel::memory::Policy policy;
    if (argc == 5) policy.reads = std::stoi(argv[4]);
    voxmelt::hwmodel::memory::replay(argv[1], argv[2], argv[3], policy);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "replay_trace: %s\n", error.what());
    return 2;
  }
  return 0;
}
