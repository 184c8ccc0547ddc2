#include "hwmodel/stream/pipeline.h"

#include <exception>
#include <functional>
#include <limits>
#include <systemc>
#include <utility>

#include "hwmodel/stream/blocks.h"

// libsystemc's own main asks for this; ours never calls it.
int sc_main(int, char**) { return 1; }

namespace voxmelt::hwmodel {
namespace {

constexpr std::int64_t kHangAfter =
    1000;  // cycles in which no token moves anywhere, and no stage can be draining
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr std::uint64_t kPeriod = 1000;  // of the clock, in the kernel's units of time (1 ps)

// A simulation context of its own, so that a program can run many simulations, one after the other.
class Context {
 public:
  Context() : own_(new sc_core::sc_simcontext) { enter(); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() {
    delete own_;
    leave();
  }
  void enter() { sc_core::sc_curr_simcontext = sc_core::sc_default_global_context = own_; }
  void leave() {
    sc_core::sc_curr_simcontext = outer_;
    sc_core::sc_default_global_context = outer_default_;
  }

 private:
  sc_core::sc_simcontext* outer_ = sc_core::sc_curr_simcontext;
  sc_core::sc_simcontext* outer_default_ = sc_core::sc_default_global_context;
  sc_core::sc_simcontext* own_;
};

// What all blocks share.
struct Shared {
  std::int64_t moves = 0;  // of tokens, anywhere
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
  Link(Shared& shared, std::string name, int channel, const Configuration& c)
      : shared_(shared), fifo_(std::move(name), channel, c.lanes, c.fifo_depth, c.stall_seed) {}
  Fifo<Word>& fifo() { return fifo_; }
  void tick() { request_update(); }

 private:
  void update() override { shared_.moves += fifo_.commit() ? 1 : 0; }

  Shared& shared_;
  Fifo<Word> fifo_;
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
    } catch (...) {  // SystemC would only keep its text
      shared_.error = std::current_exception();
      shared_.end();
    }
  }

  Shared& shared_;
  std::function<void()> cycle_;
};

}  // namespace

struct Pipeline::Machine {
  Machine(const rule::Parameters& parameters, state::Grid grid, const Configuration& c)
      : configuration(c),
        design{parameters, {grid, c.lanes}},
        clock("clock", 1, sc_core::SC_NS),
        reader(design.shape),
        writer(design.shape) {
    const bool fed = design.hot() && parameters.heat.radiation;
    for (int t = 0; t < c.cascade; ++t) {
      const int channel = t == 0 ? 1 : steps.back()->out_channel() + 1;
      steps.push_back(std::make_unique<StepBlock>(design, channel, step_name(t), c.fifo_depth, c.stall_seed));
    }
    const auto link = [&](int channel, const std::string& name) {
      links.push_back(std::make_unique<Link<Cell>>(shared, name, channel, c));
    };
    link(0, step_name(0) + "reader -> " + steps.front()->stages().front()->name());
    for (int t = 0; t < c.cascade; ++t) {
      const StepBlock& step = *steps[at(t)];
      link(step.out_channel(),
           step_name(t) + step.stages().back()->name() + " -> " +
               (t + 1 == c.cascade ? "writer" : steps[at(t + 1)]->stages().front()->name()));
    }
    for (int t = 0; t < c.cascade; ++t) {
      StepBlock& step = *steps[at(t)];
      step.connect(links[at(t)]->fifo(), links[at(t + 1)]->fifo());
      if (!fed) continue;
      feed_links.push_back(
          std::make_unique<Link<UInt<16>>>(shared, step_name(t) + "feed -> exchange", 1000 + t, c));
      feeds.push_back(std::make_unique<Feed>(design.shape, feed_links.back()->fifo()));
      step.feed(feed_links.back()->fifo());
    }
    reader.connect(links.front()->fifo());
    writer.connect(links.back()->fifo());
    // On a grid thinner than its stencil a stage has taken all before it gives anything: its lag passes in
    // silence.
    for (const auto& stage : steps.front()->stages())
      hang_after = std::max(hang_after, kHangAfter + stage->lag());
    make_blocks();
  }

  void make_blocks() {
    const auto add = [&](const std::string& name, std::function<void()> cycle) {
      blocks.push_back(std::make_unique<Block>(name.c_str(), clock, shared, std::move(cycle)));
    };
    add("reader", [this] {
      reader.cycle();
      links.front()->tick();
    });
    for (std::size_t t = 0; t < steps.size(); ++t)
      add("step_" + std::to_string(t), [this, t] {
        try {
          shared.moves += steps[t]->cycle();
        } catch (const WidthError& error) {
          const Stage& failed = steps[t]->running();
          throw StageError(error.what(), failed.name(), failed.phase(), static_cast<int>(t));
        }
        links[t + 1]->tick();
      });
    for (std::size_t t = 0; t < feeds.size(); ++t)
      add("feed_" + std::to_string(t), [this, t] {
        feeds[t]->cycle();
        feed_links[t]->tick();
      });
    add("writer", [this] {
      writer.cycle();
      watch_progress();
    });
  }

  // Runs once a cycle.
  void watch_progress() {
    idle = shared.moves == moves_before ? idle + 1 : 0;
    moves_before = shared.moves;
    shared.hangs = idle > hang_after;
    shared.complete = writer.done();
    if (shared.complete || shared.hangs) shared.end();
  }

  static std::size_t at(int t) { return static_cast<std::size_t>(t); }
  static std::string step_name(int t) { return "step " + std::to_string(t) + ": "; }

  // A fault of a channel is planted behind the stage in the middle of the first time step.
  CellFifo* plant_in_channel(std::uint32_t first) {
    if (plan == nullptr || plan->struck() || first < plan->first_step()) return nullptr;
    FifoFault fault = FifoFault::none;
    if (plan->fault() == Fault::fifo_overwrite) fault = FifoFault::overwrite;
    if (plan->fault() == Fault::fifo_stale) fault = FifoFault::stale;
    if (plan->fault() == Fault::fifo_swap_lanes) fault = FifoFault::swap_lanes;
    if (plan->fault() == Fault::fifo_never_ready) fault = FifoFault::never_ready;
    if (fault == FifoFault::none) return nullptr;
    std::vector<CellFifo*> outputs;
    steps.front()->for_each_output([&](CellFifo& fifo, const Stage&) { outputs.push_back(&fifo); });
    CellFifo* faulty = outputs[outputs.size() / 2];
    faulty->plant(fault);
    return faulty;
  }
  void note_strike(const CellFifo& faulty, std::uint32_t step) {
    if (!faulty.struck()) return;
    const Place place = place_of(design.shape, faulty.struck()->ordinal);
    plan->strike({faulty.name(), step, place.x + faulty.struck()->lane, place.y, place.z});
  }

  template <class Visit>  // visit(fifo, producer stage or null, cascade position)
  void for_each_channel(Visit&& visit) const {
    visit(links.front()->fifo(), static_cast<const Stage*>(nullptr), 0);
    for (std::size_t t = 0; t < steps.size(); ++t)
      steps[t]->for_each_output(
          [&](CellFifo& fifo, const Stage& producer) { visit(fifo, &producer, static_cast<int>(t)); });
  }

  std::int64_t moves_before = 0, idle = 0, hang_after = kHangAfter;
  FaultPlan* plan = nullptr;
  bool ran = false;
  Context context;  // first: everything of SystemC lives in it
  Shared shared;
  Configuration configuration;
  Design design;
  sc_core::sc_clock clock;
  Reader reader;
  Writer writer;
  std::vector<std::unique_ptr<StepBlock>> steps;
  std::vector<std::unique_ptr<Link<Cell>>> links;
  std::vector<std::unique_ptr<Link<UInt<16>>>> feed_links;
  std::vector<std::unique_ptr<Feed>> feeds;
  std::vector<std::unique_ptr<Block>> blocks;
};

Pipeline::Pipeline(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration)
    : machine_(std::make_unique<Machine>(parameters, grid, configuration)) {
  machine_->context.leave();
}

Pipeline::~Pipeline() { machine_->context.enter(); }

void Pipeline::watch(FifoWatcher<Cell>* watcher) {
  machine_->for_each_channel([&](CellFifo& fifo, const Stage*, int) { fifo.watch(watcher); });
}

void Pipeline::stop() { machine_->shared.end(); }

void Pipeline::plant(FaultPlan* plan) {
  machine_->plan = plan;
  for (const auto& step : machine_->steps)
    for (const auto& stage : step->stages()) stage->plant(plan);
}

PassEnd Pipeline::run_pass(std::uint32_t first, int steps, const state::Field<std::uint16_t>* irradiance,
                           state::Volume& volume) {
  Machine& m = *machine_;
  Shared& shared = m.shared;
  shared.complete = shared.hangs = false;
  shared.last_cycle = kNever;
  m.idle = 0;
  m.for_each_channel([](CellFifo& fifo, const Stage*, int) { fifo.begin_pass(); });
  m.reader.begin_pass(volume);
  m.writer.begin_pass(volume);
  for (std::size_t t = 0; t < m.steps.size(); ++t) {
    const bool bypass = static_cast<int>(t) >= steps;
    m.steps[t]->begin_pass(first + static_cast<std::uint32_t>(t), bypass);
    if (t < m.feeds.size()) m.feeds[t]->begin_pass(bypass ? nullptr : irradiance);
  }
  CellFifo* faulty = m.plant_in_channel(first);

  m.context.enter();
  shared.first_cycle = m.ran ? Shared::now() + 1 : 0;
  m.ran = true;
  sc_core::sc_start();
  m.context.leave();

  if (faulty != nullptr) m.note_strike(*faulty, first);
  if (shared.error) std::rethrow_exception(std::exchange(shared.error, nullptr));
  return {shared.last_cycle + 1, shared.complete, shared.hangs};
}

// Asked from within a pass only, where the context is entered.
std::int64_t Pipeline::cycle() const { return machine_->shared.cycle(); }
const Design& Pipeline::design() const { return machine_->design; }
const Configuration& Pipeline::configuration() const { return machine_->configuration; }

std::vector<ChannelReport> Pipeline::channels() const {
  std::vector<ChannelReport> reports;
  const Machine& m = *machine_;
  m.for_each_channel([&](const CellFifo& fifo, const Stage* producer, int cascade) {
    const bool behind_stage = producer != nullptr;
    reports.push_back({fifo.name(), behind_stage ? producer->name() : "reader",
                       behind_stage ? producer->phase() : "", cascade, fifo.depth(),
                       behind_stage ? producer->output_bits() : m.design.cell_bits(), fifo.highest(),
                       fifo.count(), fifo.entered(), fifo.occupancy()});
  });
  return reports;
}

std::vector<StageReport> Pipeline::stages() const {
  const Machine& m = *machine_;
  std::vector<StageReport> reports{{"reader", "", 0, 0, m.reader.cycles(), {}, {}}};
  for (std::size_t t = 0; t < m.steps.size(); ++t)
    for (const auto& stage : m.steps[t]->stages())
      reports.push_back({stage->name(), stage->phase(), static_cast<int>(t), stage->lag(), stage->cycles(),
                         stage->buffers(), stage->units()});
  for (std::size_t t = 0; t < m.feeds.size(); ++t)
    reports.push_back({"feed", "", static_cast<int>(t), 0, m.feeds[t]->cycles(), {}, {}});
  reports.push_back({"writer", "", m.configuration.cascade - 1, 0, m.writer.cycles(), {}, {}});
  return reports;
}

}  // namespace voxmelt::hwmodel
