#include "hwmodel/pipeline/model/pipeline.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "hwmodel/fabric/simulation.h"
#include "hwmodel/pipeline/model/blocks.h"
#include "hwmodel/pipeline/model/feed.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::hwmodel {
namespace {

constexpr std::int64_t kHangAfter = 1000;  // cycles in which no stage moves

}  // namespace

struct Pipeline::Machine {
  Machine(const rule::Parameters& parameters, state::Grid grid, const Configuration& c,
          const StageMaker& make, Simulation& in)
      : simulation(in),
        part(in),
        configuration(c),
        design(design_of(parameters, grid, c)),
        memory(make_memory(design, c)),
        reader(design.shape, memory),
        writer(design.shape, memory) {
    const bool fed = design.hot() && parameters.heat.radiation;
    const auto depth_of = [this](const std::string& name) { return configuration.depth_of(name); };
    for (int t = 0; t < c.cascade; ++t) {
      const int channel = t == 0 ? 1 : steps.back()->out_channel() + 1;
      steps.push_back(std::make_unique<StepBlock>(design, make_step(design, make), channel, step_name(t),
                                                  depth_of, c.stall_seed));
    }
    const auto link = [&](int channel, const std::string& name) {
      links.push_back(std::make_unique<Link<Cell>>(name, channel, c.lanes, depth_of(name), c.stall_seed));
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
      const std::string name = step_name(t) + "feed -> exchange";
      feed_links.push_back(std::make_unique<Link<UInt<16>>>(name, kFirstFeedChannel + t, c.lanes,
                                                            depth_of(name), c.stall_seed));
      feeds.push_back(std::make_unique<IrradianceFeed>(design.shape, t, feed_links.back()->fifo()));
      step.feed(feed_links.back()->fifo());
    }
    if (parameters.pieces.fall) {  // a pass has one time step then
      const std::string name = step_name(0) + "feed -> fall";
      fall_link = std::make_unique<Link<UInt<1>>>(name, kFallChannel, c.lanes, depth_of(name), c.stall_seed);
      fall_feed.emplace(design.shape, c.cascade, fall_link->fifo());
      steps.front()->feed_falls(fall_link->fifo());
    }
    reader.connect(links.front()->fifo(), writer);
    writer.connect(links.back()->fifo());
    make_blocks();
  }

  static StateMemory make_memory(const Design& design, const Configuration& c) {
    const CodeLayout layout(design);
    const std::optional<state::Grid> set =
        design.keeps_set() ? std::optional(design.shape.grid) : std::nullopt;
    return StateMemory(design.shape.tiled(), c.coded ? &layout : nullptr, set);
  }

  void make_blocks() {
    part.hang_after = kHangAfter;
    part.waits = [this] { return dram != nullptr && dram->works(); };
    part.done = [this] { return writer.done() && (dram == nullptr || dram->settled()); };
    const auto add = [&](const std::string& name, std::function<void()> cycle) {
      blocks.push_back(std::make_unique<Block>(name.c_str(), simulation, part, std::move(cycle)));
    };
    add("reader", [this] {
      if (reader.cycle(part.cycle()) && next) follow(next());
      links.front()->tick();
    });
    for (int t = 0; t < std::ssize(steps); ++t)
      add("step_" + std::to_string(t), [this, t] {
        try {
          part.moves += steps[t]->cycle();
        } catch (const WidthError& error) {
          fail(error, StageError::Kind::width, t);
        } catch (const ModelError& error) {  // an address, or a token that is not there
          fail(error, StageError::Kind::address, t);
        }
        links[t + 1]->tick();
      });
    for (std::size_t t = 0; t < feeds.size(); ++t)
      add("feed_" + std::to_string(t), [this, t] {
        feeds[t]->cycle(part.cycle());
        feed_links[t]->tick();
      });
    if (fall_feed)
      add("feed_fall", [this] {
        fall_feed->cycle(part.cycle());
        fall_link->tick();
      });
    add("writer", [this] {
      writer.cycle(part.cycle());
      if (dram != nullptr) dram->cycle(part.cycle());
    });
  }

  [[noreturn]] void fail(const ModelError& error, StageError::Kind kind, int t) const {
    const Stage& failed = steps[t]->running();
    StageError wrong(error.what(), kind);
    wrong.stage = failed.kind();
    wrong.step = failed.working_step();
    wrong.spot = failed.spot();
    wrong.cascade = t;
    wrong.cycle = part.cycle();
    throw wrong;
  }

  void begin(const Pass& pass, bool first) {
    for (int t = 0; t < std::ssize(steps); ++t) steps[t]->begin_pass(pass, t, first);
    ++passes;
  }
  bool fed(const Pass& pass, int t) const { return t < pass.steps && pass.uses(StageKind::exchange, 0); }
  int fed_steps(const Pass& pass) const {
    int n = 0;
    for (int t = 0; t < std::ssize(feeds); ++t) n += fed(pass, t) ? 1 : 0;
    return n;
  }
  // Lets another pass follow without a gap. Its first token may be read in the next cycle.
  void follow(const std::optional<Pass>& pass) {
    if (!pass) return;
    begin(*pass, false);
    if (dram != nullptr) dram->add_pass(pass->tile, fed_steps(*pass));
    reader.add_pass(pass->tile);
    writer.add_pass(pass->tile);
    for (int t = 0; t < std::ssize(feeds); ++t)
      if (fed(*pass, t)) feeds[t]->add_pass(pass->tile);
    if (fall_feed && pass->uses(StageKind::fall, 0)) fall_feed->add_pass(pass->tile);
  }

  std::int64_t held_cycles() const {
    std::int64_t sum = 0;
    for (const auto& step : steps)
      for (const auto& stage : step->stages()) sum += stage->held_cycles();
    return sum;
  }

  using BuffersOf = std::vector<BufferCost> (*)(const CodeLayout&);
  std::vector<BufferCost> buffers(BuffersOf buffers_of) const {
    return memory.coded() ? buffers_of(memory.read_code().layout()) : std::vector<BufferCost>{};
  }
  std::int64_t bits_read() const {
    return memory.coded() ? reader.coded_bits() : reader.cycles().busy * token_bits();
  }
  std::int64_t bits_written() const {
    return memory.coded() ? writer.coded_bits() : writer.stored() * token_bits();
  }
  std::int64_t token_bits() const { return std::int64_t{design.shape.lanes} * design.cell_bits(); }

  static std::size_t at(int t) { return t; }
  static std::string step_name(int t) { return "step " + std::to_string(t) + ": "; }

  template <class Visit>  // visit(fifo, producer stage or null: the reader, cascade position)
  void for_each_channel(Visit&& visit) const {
    visit(links.front()->fifo(), static_cast<const Stage*>(nullptr), 0);
    for (int t = 0; t < std::ssize(steps); ++t)
      steps[t]->for_each_output([&](CellFifo& fifo, const Stage& producer) { visit(fifo, &producer, t); });
  }

  int passes = 0;  // passes of the present train
  Next next;
  StreamMemory* dram = nullptr;
  Simulation& simulation;
  Part part;
  Configuration configuration;
  Design design;
  StateMemory memory;
  Reader reader;
  Writer writer;
  std::vector<std::unique_ptr<StepBlock>> steps;
  std::vector<std::unique_ptr<Link<Cell>>> links;
  std::vector<std::unique_ptr<Link<UInt<16>>>> feed_links;
  std::vector<std::unique_ptr<IrradianceFeed>> feeds;
  std::unique_ptr<Link<UInt<1>>> fall_link;  // with pieces that fall
  std::optional<FallFeed> fall_feed;
  std::vector<std::unique_ptr<Block>> blocks;
};

Pipeline::Pipeline(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration,
                   const StageMaker& make, Simulation* simulation)
    : own_(simulation == nullptr ? std::make_unique<Simulation>() : nullptr),
      simulation_(simulation == nullptr ? *own_ : *simulation) {
  const Simulation::Scope scope(simulation_);
  machine_ = std::make_unique<Machine>(parameters, grid, configuration, make, simulation_);
}

Pipeline::~Pipeline() {
  const Simulation::Scope scope(simulation_);
  machine_.reset();
}

void Pipeline::watch(FifoWatcher<Cell>* watcher) {
  machine_->for_each_channel([&](CellFifo& fifo, const Stage*, int) { fifo.watch(watcher); });
}

void Pipeline::memory(StreamMemory* memory) {
  Machine& m = *machine_;
  m.dram = memory;
  m.reader.dram(memory);
  m.writer.dram(memory);
  for (const auto& feed : m.feeds) feed->dram(memory);
  if (m.fall_feed) m.fall_feed->dram(memory);
}

void Pipeline::poll(std::function<void()> poll) { machine_->part.poll = std::move(poll); }

void Pipeline::probe(ChannelProbe* probe) {
  machine_->for_each_channel([&](CellFifo& fifo, const Stage*, int) { fifo.probe(probe); });
}

void Pipeline::each_cycle(std::function<void()> watch) { machine_->part.each_cycle = std::move(watch); }

void Pipeline::stop() { machine_->part.stop(); }

void Pipeline::plant(PortFault* fault) {
  machine_->reader.plant(fault);
  machine_->writer.plant(fault);
}

void Pipeline::plant(FeedFault* fault) {
  for (const auto& feed : machine_->feeds) feed->plant(fault);
  if (machine_->fall_feed) machine_->fall_feed->plant(fault);
}

void Pipeline::watch_feeds(FifoWatcher<UInt<16>>* watcher) {
  for (const auto& link : machine_->feed_links) link->fifo().watch(watcher);
}

void Pipeline::watch_falls(FifoWatcher<UInt<1>>* watcher) {
  if (machine_->fall_link) machine_->fall_link->fifo().watch(watcher);
}

void Pipeline::plant(CodeFault* fault) {
  machine_->reader.plant(fault);
  machine_->writer.plant(fault);
}

void Pipeline::watch_columns(ColumnWatcher* watcher) { machine_->writer.watch(watcher); }

const Books& Pipeline::books() const { return machine_->writer.books(); }
const state::Volume& Pipeline::written() const { return machine_->writer.written(); }

std::vector<CellFifo*> Pipeline::channels_behind_stages(int cascade) {
  std::vector<CellFifo*> channels;
  machine_->steps.at(cascade)->for_each_output(
      [&](CellFifo& fifo, const Stage&) { channels.push_back(&fifo); });
  return channels;
}

PassEnd Pipeline::run_pass(const Pass& pass, const Irradiance* irradiance, state::Volume& volume) {
  if (irradiance == nullptr) return run_train(pass, {}, {}, volume);
  const IrradianceStream stream(*irradiance, design().shape);
  return run_train(pass, {}, &stream, volume);
}

PassEnd Pipeline::run_train(const Pass& pass, const Next& next, const Fed& fed, state::Volume& volume) {
  Machine& m = *machine_;
  m.passes = 0;
  m.next = next;
  m.for_each_channel([&](CellFifo& fifo, const Stage*, int) { fifo.begin_pass(pass.first); });
  for (const auto& link : m.feed_links) link->fifo().begin_pass(pass.first);
  if (m.fall_link) m.fall_link->fifo().begin_pass(pass.first);
  const FallStream* falls = pass.uses(StageKind::fall, 0) ? fed.falls : nullptr;
  m.memory.begin_train(volume);
  m.reader.begin_pass(pass.tile);
  m.writer.begin_pass(pass.tile);
  m.begin(pass, true);
  if (m.dram != nullptr)
    m.dram->begin_train(
        {pass.tile, m.fed_steps(pass), fed.irradiance, {m.memory.code(0), m.memory.code(1)}, falls});
  for (int t = 0; t < std::ssize(m.feeds); ++t)
    m.feeds[t]->begin_pass(m.fed(pass, t) ? fed.irradiance : nullptr, pass.tile);
  if (m.fall_feed) m.fall_feed->begin_pass(falls, pass.tile);

  const std::int64_t held = m.held_cycles();
  simulation_.begin(m.part);
  simulation_.run(m.part);
  m.memory.end_train();
  m.part.rethrow();
  const Part::End& end = m.part.end();
  return {end.cycles, m.passes, end.complete, end.hangs, m.held_cycles() - held};
}

std::int64_t Pipeline::cycle() const { return machine_->part.cycle(); }
const Design& Pipeline::design() const { return machine_->design; }
const Configuration& Pipeline::configuration() const { return machine_->configuration; }

std::vector<ChannelReport> Pipeline::channels() const {
  std::vector<ChannelReport> reports;
  const Machine& m = *machine_;
  m.for_each_channel([&](const CellFifo& fifo, const Stage* producer, int cascade) {
    const bool behind_stage = producer != nullptr;
    reports.push_back({fifo.name(), behind_stage ? producer->kind() : StageKind::reader, cascade,
                       fifo.depth(), behind_stage ? producer->output_bits() : m.design.cell_bits(),
                       fifo.highest(), fifo.count(), fifo.entered(), fifo.occupancy()});
  });
  for (int t = 0; t < std::ssize(m.feed_links); ++t) {
    const HeatFifo& fifo = m.feed_links[t]->fifo();
    reports.push_back({fifo.name(), StageKind::feed, t, fifo.depth(), 16, fifo.highest(), fifo.count(),
                       fifo.entered(), fifo.occupancy()});
  }
  if (m.fall_link) {
    const FallFifo& fifo = m.fall_link->fifo();
    reports.push_back({fifo.name(), StageKind::fall_feed, 0, fifo.depth(), 1, fifo.highest(), fifo.count(),
                       fifo.entered(), fifo.occupancy()});
  }
  return reports;
}

std::vector<const Stage*> Pipeline::working_stages() const {
  std::vector<const Stage*> stages;
  for (const auto& step : machine_->steps)
    for (const auto& stage : step->stages()) stages.push_back(stage.get());
  return stages;
}

std::vector<StageCycles> Pipeline::accounts() const {
  const Machine& m = *machine_;
  std::vector<StageCycles> accounts{m.reader.cycles()};
  for (const auto& step : m.steps)
    for (const auto& stage : step->stages()) accounts.push_back(stage->cycles());
  for (const auto& feed : m.feeds) accounts.push_back(feed->cycles());
  if (m.fall_feed) accounts.push_back(m.fall_feed->cycles());
  accounts.push_back(m.writer.cycles());
  return accounts;
}

std::vector<StageReport> Pipeline::stages() const {
  const Machine& m = *machine_;
  std::vector<StageReport> reports{
      {StageKind::reader, 0, 0, m.reader.cycles(), m.buffers(reader_buffers), {}, m.bits_read()}};
  for (int t = 0; t < std::ssize(m.steps); ++t)
    for (const auto& stage : m.steps[t]->stages())
      reports.push_back({stage->kind(), t, stage->lag() + stage->registers(), stage->cycles(),
                         stage->buffers(), stage->units()});
  for (int t = 0; t < std::ssize(m.feeds); ++t)
    reports.push_back({StageKind::feed, t, 0, m.feeds[t]->cycles(), {}, {}, m.feeds[t]->bits()});
  if (m.fall_feed)
    reports.push_back({StageKind::fall_feed, 0, 0, m.fall_feed->cycles(), {}, {}, m.fall_feed->bits()});
  reports.push_back({StageKind::writer,
                     m.configuration.cascade - 1,
                     0,
                     m.writer.cycles(),
                     m.buffers(writer_buffers),
                     {},
                     m.bits_written()});
  return reports;
}

}  // namespace voxmelt::hwmodel
