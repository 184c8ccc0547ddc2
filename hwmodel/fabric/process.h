// What a machine needs of SystemC: a simulation context of its own, channels that commit in the update phase,
// blocks with one process each. Only the file that assembles a machine includes this one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <systemc>
#include <utility>

#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
inline constexpr std::uint64_t kPeriod = 1000;  // of the clock, in the kernel's units of time (1 ps)

// A simulation context of its own, so that a program can run many simulations, one after the other.
class Context {
 public:
  Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();
  void enter();
  void leave();

 private:
  sc_core::sc_simcontext* outer_ = sc_core::sc_curr_simcontext;
  sc_core::sc_simcontext* outer_default_ = sc_core::sc_default_global_context;
  sc_core::sc_simcontext* own_;
};

// What all blocks share.
struct Shared {
  std::int64_t moves = 0;  // of stages
  std::int64_t first_cycle = 0;
  std::int64_t last_cycle = kNever;  // after which no block does anything: whatever ended the pass, the
                                     // cycle in which it happened is finished by all
  bool complete = false, hangs = false;
  std::exception_ptr error;

  static std::int64_t now() { return static_cast<std::int64_t>(sc_core::sc_time_stamp().value() / kPeriod); }
  std::int64_t cycle() const { return now() - first_cycle; }
  void end() { last_cycle = std::min(last_cycle, cycle()); }
  bool ended() const { return cycle() > last_cycle; }
};

// A channel between blocks: it commits in the update phase, after every process of the cycle has run.
template <class Word>
class Link final : public sc_core::sc_prim_channel {
 public:
  Link(std::string name, int channel, int lanes, int depth, std::uint64_t stall_seed)
      : fifo_(std::move(name), channel, lanes, depth, stall_seed) {}
  Fifo<Word>& fifo() { return fifo_; }
  void tick() { request_update(); }

 private:
  void update() override { fifo_.commit(); }

  Fifo<Word> fifo_;
};

// Calls `watch` in the update phase, when every block has run its cycle.
class AfterCycle final : public sc_core::sc_prim_channel {
 public:
  std::function<void()> watch;
  void tick() { request_update(); }

 private:
  void update() override { watch(); }
};

// A block: one process, one cycle of its plain C++ content at every rising edge.
class Block final : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Block);
  Block(sc_core::sc_module_name name, sc_core::sc_clock& clock, Shared& shared, std::function<void()> cycle)
      : sc_module(name), shared_(shared), cycle_(std::move(cycle)) {
    SC_METHOD(run);
    sensitive << clock.posedge_event();
    dont_initialize();
  }

 private:
  void run() {
    if (shared_.ended()) return sc_core::sc_pause();
    try {
      cycle_();
    } catch (...) {  // SystemC would keep only its text
      shared_.error = std::current_exception();
      shared_.end();
    }
  }

  Shared& shared_;
  std::function<void()> cycle_;
};

}  // namespace voxmelt::hwmodel
