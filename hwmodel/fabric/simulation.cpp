#include "hwmodel/fabric/simulation.h"

#include <algorithm>
#include <utility>

// The main function of libsystemc needs this symbol. Ours never calls it.
int sc_main(int, char**) { return 1; }

// SystemC never frees its pools, which is no leak of ours. (Only the address sanitizer calls this.)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libsystemc"; }

namespace voxmelt::hwmodel {
namespace {

constexpr std::uint64_t kPeriod = 1000;    // period of the clock, in the kernel's units of time (1 ps)
constexpr std::int64_t kPollEvery = 4096;  // cycles
constexpr std::int64_t kLongestWait = 1'000'000'000;

}  // namespace

Part::Part(Simulation& simulation) : simulation_(simulation) { simulation.parts_.push_back(this); }
Part::~Part() { std::erase(simulation_.parts_, this); }

std::int64_t Part::cycle() const { return simulation_.cycle() - first_cycle_; }

void Part::rethrow() {
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

// A memory that works for ever and gives nothing lets the machine hang, too.
bool Part::is_waited_for() {
  if (!waits || waited_ > kLongestWait || !waits()) return false;
  waited_ += idle_;
  idle_ = 0;
  return true;
}

bool Part::ends() {
  if (moves != moves_before_)
    idle_ = waited_ = 0;
  else
    ++idle_;
  if (idle_ > hang_after) is_waited_for();
  moves_before_ = moves;
  end_ = {cycle() + 1, !error_ && done(), idle_ > hang_after};
  try {
    if (each_cycle) each_cycle();
    if (poll && cycle() % kPollEvery == 0) poll();
  } catch (...) {
    fail(std::current_exception());
  }
  return end_.complete || end_.hangs || stops_ || error_;
}

// The falling edge comes when all blocks have run their cycle, and all channels have committed.
struct Simulation::Clock final : sc_core::sc_module {
  SC_HAS_PROCESS(Clock);
  Clock(sc_core::sc_module_name name, Simulation& simulation)
      : sc_module(name), signal("clock", 1, sc_core::SC_NS), owner(simulation) {
    SC_METHOD(between_cycles);
    sensitive << signal.negedge_event();
    dont_initialize();
  }
  void between_cycles() { owner.between_cycles(); }

  sc_core::sc_clock signal;
  Simulation& owner;
};

Simulation::Simulation() : own_(new sc_core::sc_simcontext) {
  const Scope scope(*this);
  clock_ = std::make_unique<Clock>("beat", *this);
}

Simulation::~Simulation() {
  enter();
  clock_.reset();
  delete own_;
  leave();
}

void Simulation::enter() {
  if (depth_++ > 0) return;
  outer_ = std::exchange(sc_core::sc_curr_simcontext, own_);
  outer_default_ = std::exchange(sc_core::sc_default_global_context, own_);
}
void Simulation::leave() {
  if (--depth_ > 0) return;
  sc_core::sc_curr_simcontext = outer_;
  sc_core::sc_default_global_context = outer_default_;
}

std::int64_t Simulation::cycle() const { return own_->time_stamp().value() / kPeriod; }

void Simulation::begin(Part& part) {
  part.works_ = true;
  part.stops_ = false;
  part.idle_ = part.waited_ = 0;
  part.moves_before_ = part.moves;
  part.end_ = {};
  part.first_cycle_ = ran_ ? cycle() + 1 : 0;
}

void Simulation::run(Part& part) {
  awaited_ = &part;
  if (part.works_) start();
}

void Simulation::run() {
  awaited_ = nullptr;
  if (std::any_of(parts_.begin(), parts_.end(), [](const Part* part) { return part->works_; })) start();
}

void Simulation::start() {
  const Scope scope(*this);
  ran_ = true;
  sc_core::sc_start();
}

void Simulation::between_cycles() {
  for (const std::function<void()>& cycle : after_blocks_) cycle();
  for (Part* part : parts_) {
    if (!part->works_ || !part->ends()) continue;
    part->works_ = false;
    try {
      if (part->ended) part->ended();
    } catch (...) {
      part->fail(std::current_exception());
      part->works_ = false;
    }
  }
  const bool goes_on = awaited_ != nullptr ? awaited_->works_
                                           : std::any_of(parts_.begin(), parts_.end(),
                                                         [](const Part* part) { return part->works_; });
  if (!goes_on) sc_core::sc_pause();
}

Block::Block(sc_core::sc_module_name name, Simulation& simulation, Part& part, std::function<void()> cycle)
    : sc_module(name), part_(part), cycle_(std::move(cycle)) {
  SC_METHOD(run);
  sensitive << simulation.clock_->signal.posedge_event();
  dont_initialize();
}

void Block::run() {
  if (!part_.works()) return;
  try {
    cycle_();
  } catch (...) {  // SystemC would keep only its text
    part_.fail(std::current_exception());
  }
}

}  // namespace voxmelt::hwmodel
