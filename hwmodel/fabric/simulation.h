// A simulation holds what machines need of SystemC. It has one clock, and one machine runs in it, or several
// beside each other. Channels commit in the update phase, and each block has one process. Only the file that
// assembles a machine includes this one.
//
//   Simulation simulation;
//   Part part(simulation);                  // a machine
//   part.done = [&] { return writer.done(); };
//   Block block("writer", simulation, part, [&] { writer.cycle(part.cycle()); });
//   simulation.begin(part);                 // a job: one train of passes, one pass of a picture
//   simulation.run(part);                   // until its job has ended; other machines with jobs go on
//   part.rethrow();                         // what a block has thrown
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <systemc>
#include <utility>
#include <vector>

#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel {

class Simulation;

// A machine works through jobs, one after another. Its cycles count from 0 in each of them. When a job ends
// for any reason, all of its blocks finish the present cycle.
class Part {
 public:
  explicit Part(Simulation& simulation);
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;
  ~Part();

  // These are set once. All are called between two cycles, when every block has run and every channel has
  // committed. All but `done` may be empty.
  std::function<bool()> done;        // is the job done?
  std::function<void()> each_cycle;  // after each cycle of a job
  std::function<void()> poll;        // now and then; what it throws ends the job
  std::function<void()> ended;       // after a job; it may begin another one, from the next cycle on
  std::function<bool()> waits;  // does something else, as a memory, still work for it? Then it does not hang
  std::int64_t hang_after = 1000;  // cycles in which nothing moves

  std::int64_t moves = 0;  // moves of stages, and of whatever else shows that the machine does not hang

  bool works() const { return works_; }
  std::int64_t cycle() const;            // cycle of the present job
  void stop() { stops_ = true; }         // ends the job after the present cycle
  void fail(std::exception_ptr error) {  // ends it likewise, with an error
    if (!error_) error_ = std::move(error);
  }

  // Tells how the last job ended.
  struct End {
    std::int64_t cycles = 0;
    bool complete = false, hangs = false;
  };
  const End& end() const { return end_; }
  // Throws what a block, or `poll`, has thrown in the last job.
  void rethrow();

 private:
  friend class Simulation;
  bool ends();  // called between two cycles of a job

  Simulation& simulation_;
  bool works_ = false, stops_ = false;
  bool is_waited_for();

  std::int64_t first_cycle_ = 0, moves_before_ = 0, idle_ = 0, waited_ = 0;
  End end_;
  std::exception_ptr error_;
};

// Holds one SystemC context and one clock. A program can run many simulations, one after another, or in turn.
class Simulation {
 public:
  Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  // All SystemC objects are made, and destroyed, within a scope.
  class Scope {
   public:
    explicit Scope(Simulation& simulation) : of_(simulation) { of_.enter(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() { of_.leave(); }

   private:
    Simulation& of_;
  };

  // Adds something that no machine owns and all may use. It runs its cycle when all blocks have run theirs.
  void after_blocks(std::function<void()> cycle) { after_blocks_.push_back(std::move(cycle)); }

  void begin(Part& part);
  void run(Part& part);  // until the part's job has ended
  void run();            // until no machine has a job

  std::int64_t cycle() const;  // cycles since the begin

 private:
  friend class Part;
  friend class Block;
  struct Clock;

  void enter();
  void leave();
  void start();
  void between_cycles();

  sc_core::sc_simcontext* outer_ = nullptr;
  sc_core::sc_simcontext* outer_default_ = nullptr;
  sc_core::sc_simcontext* own_;
  int depth_ = 0;  // number of open scopes
  std::unique_ptr<Clock> clock_;
  std::vector<Part*> parts_;
  std::vector<std::function<void()>> after_blocks_;
  const Part* awaited_ = nullptr;  // null: all parts
  bool ran_ = false;
};

// A channel between blocks commits in the update phase, after every process of the cycle has run.
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

// A block has one process. It runs one cycle of its plain C++ content at every rising edge while its machine
// works.
class Block final : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Block);
  Block(sc_core::sc_module_name name, Simulation& simulation, Part& part, std::function<void()> cycle);

 private:
  void run();

  Part& part_;
  std::function<void()> cycle_;
};

}  // namespace voxmelt::hwmodel
