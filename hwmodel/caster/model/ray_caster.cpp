#include "hwmodel/caster/model/ray_caster.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/line_block.h"
#include "hwmodel/caster/model/tile_order.h"
#include "hwmodel/fabric/simulation.h"
#include "hwmodel/memory/chosen_memory.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kHangAfter = 4000;  // cycles in which nothing moves

int tiles_along(int pixels) { return (pixels + kTileSide - 1) / kTileSide; }

// Deals tiles to the pipes, each to the next one that has room.
class Dealer {
 public:
  void begin(const FrameRegisters& frame, int bands, bool second) {
    frame_ = frame;
    turns_ = TileTurns(frame.tiles_x, frame.tiles_y, bands);
    second_ = second;
    next_ = 0;
    turn_ = 0;
  }
  void connect(Fifo<TileJob>& out) { out_.push_back(&out); }
  bool cycle() {
    const auto drawn = [&](const TileTurns::Tile& tile) {
      return tile.any && frame_.window.meets(tile.x * kTileSide, tile.y * kTileSide, kTileSide);
    };
    while (next_ < turns_.count() && !drawn(turns_.at(next_))) ++next_;
    if (next_ == turns_.count()) return false;
    const TileTurns::Tile tile = turns_.at(next_);
    for (std::size_t i = 0; i < out_.size(); ++i) {
      Fifo<TileJob>& out = *out_[(turn_ + i) % out_.size()];
      if (!out.ready()) continue;
      *out.put() = {tile.x * kTileSide, tile.y * kTileSide, second_};
      ++next_;
      turn_ = (turn_ + i + 1) % out_.size();
      return true;
    }
    return false;
  }

 private:
  FrameRegisters frame_;
  TileTurns turns_;
  bool second_ = false;
  int next_ = 0;
  std::size_t turn_ = 0;
  std::vector<Fifo<TileJob>*> out_;
};

}  // namespace

std::int64_t frame_bytes(int width, int height) {
  return std::int64_t{tiles_along(width)} * tiles_along(height) * kTileBytes;
}

struct RayCaster::Machine {
  Machine(const Registers& r, Memory& m, const Configuration& c, const PipeMaker& make, Simulation& in,
          const std::optional<Shares>& shares)
      : simulation(in), part(in), registers(r), memory(m), configuration(c) {
    if (!shares) own_memory.emplace(c.memory());
    memory::Memory& served_by = shares ? shares->memory : own_memory->memory();
    const std::int64_t base = shares ? shares->base : 0;
    served_by.require(base + memory.frame + 2 * frame_bytes(r.camera.width, r.camera.height),
                      "the picture's volumes and the picture");
    lines.emplace(m, served_by, c.bus_bytes, base);
    part.hang_after = kHangAfter;
    part.waits = [&served_by] { return served_by.works(); };
    part.done = [this] { return lines->counts().written_bytes == bytes_at_end; };
    part.ended = [this] { end_pass(); };
    for (int i = 0; i < c.pipes; ++i) {
      const std::string pipe = "pipe " + std::to_string(i) + ": ";
      const int channel = 100 * i + 90;
      const auto link = [&]<class Word>(std::vector<std::unique_ptr<Link<Word>>>& links, const char* name,
                                        int number) {
        links.push_back(
            std::make_unique<Link<Word>>(pipe + name, channel + number, 1, c.fifo_depth, c.stall_seed));
      };
      link(jobs, "dealer -> tiles", 0);
      link(requests, "memory port -> memory", 1);
      link(replies, "memory -> memory port", 2);
      pipes.push_back(make(registers, frame, memory, configuration, i));
      pipes.back()->connect(jobs.back()->fifo(), requests.back()->fifo(), replies.back()->fifo());
      dealer.connect(jobs.back()->fifo());
      lines->connect(requests.back()->fifo(), replies.back()->fifo());
    }
    make_blocks();
  }

  void make_blocks() {
    const auto add = [&](const std::string& name, std::function<void()> cycle) {
      blocks.push_back(std::make_unique<Block>(name.c_str(), simulation, part, std::move(cycle)));
    };
    add("dealer", [this] {
      part.moves += dealer.cycle() ? 1 : 0;
      for (const auto& link : jobs) link->tick();
    });
    for (std::size_t i = 0; i < pipes.size(); ++i)
      add("pipe_" + std::to_string(i), [this, i] {
        try {
          part.moves += pipes[i]->cycle();
        } catch (const WidthError& error) {
          throw StageError(error.what(), pipes[i]->running().name());
        }
        requests[i]->tick();
      });
    add("memory", [this] {
      part.moves += lines->cycle() ? 1 : 0;
      if (own_memory) part.moves += own_memory->memory().cycle() ? 1 : 0;
      for (const auto& link : replies) link->tick();
    });
  }

  std::int64_t bytes_dealt() const {
    std::int64_t tiles = 0;
    for (int y = 0; y < frame.tiles_y; ++y)
      for (int x = 0; x < frame.tiles_x; ++x)
        tiles += frame.window.meets(x * kTileSide, y * kTileSide, kTileSide) ? 1 : 0;
    return tiles * kTileBytes;
  }

  void begin_pass(bool second, int samples, int most) {
    const std::int64_t bytes = frame_bytes(registers.camera.width, registers.camera.height);
    frame = {second ? memory.frame : 0,
             second ? memory.frame + bytes : memory.frame,
             tiles_along(registers.camera.width),
             tiles_along(registers.camera.height),
             samples,
             most,
             window};
    dealer.begin(frame, configuration.bands, second);
    bytes_at_end = lines->counts().written_bytes + bytes_dealt();
    if (own_memory) own_memory->begin_job();
    simulation.begin(part);
  }

  FrameEnd last() const { return {part.end().cycles, part.end().complete, part.end().hangs}; }
  void end_pass() {
    for (const auto& pipe : pipes) pipe->end_pass();
    if (when_ended) when_ended(last());
  }

  Simulation& simulation;
  Part part;
  std::function<void(const FrameEnd&)> when_ended;
  std::int64_t bytes_at_end = 0;
  const Registers& registers;
  Memory& memory;
  Configuration configuration;
  FrameRegisters frame;
  Window window;
  Dealer dealer;
  std::optional<memory::ChosenMemory> own_memory;  // none if it is somebody else's
  std::optional<LineBlock> lines;
  std::vector<std::unique_ptr<Link<TileJob>>> jobs;
  std::vector<std::unique_ptr<Link<LineRequest>>> requests;
  std::vector<std::unique_ptr<Link<LineReply>>> replies;
  std::vector<std::unique_ptr<Pipe>> pipes;
  std::vector<std::unique_ptr<Block>> blocks;
};

RayCaster::RayCaster(const Registers& registers, Memory& memory, const Configuration& configuration,
                     const PipeMaker& make, const std::optional<Shares>& shares)
    : own_(shares ? nullptr : std::make_unique<Simulation>()),
      simulation_(shares ? shares->simulation : *own_) {
  const Simulation::Scope scope(simulation_);
  machine_ = std::make_unique<Machine>(registers, memory, configuration, make, simulation_, shares);
}
RayCaster::~RayCaster() {
  const Simulation::Scope scope(simulation_);
  machine_.reset();
}

void RayCaster::watch(const Watchers& watchers) {
  for (const auto& pipe : machine_->pipes) pipe->watch(watchers);
  for (const auto& link : machine_->jobs) link->fifo().watch(watchers.jobs);
  for (const auto& link : machine_->requests) link->fifo().watch(watchers.requests);
  for (const auto& link : machine_->replies) link->fifo().watch(watchers.replies);
}
void RayCaster::probe(ChannelProbe* probe) {
  for (const auto& pipe : machine_->pipes) pipe->probe(probe);
}
void RayCaster::stop() { machine_->part.stop(); }
void RayCaster::poll(std::function<void()> poll) { machine_->part.poll = std::move(poll); }
void RayCaster::each_cycle(std::function<void()> call) { machine_->part.each_cycle = std::move(call); }

void RayCaster::draw_only(const Window& window) { machine_->window = window; }

void RayCaster::begin_first() { machine_->begin_pass(false, 1, 0); }
void RayCaster::begin_again(int samples, int most) { machine_->begin_pass(true, samples, most); }
void RayCaster::when_ended(std::function<void(const FrameEnd&)> call) {
  machine_->when_ended = std::move(call);
}
FrameEnd RayCaster::draw_first() {
  begin_first();
  run();
  return machine_->last();
}
FrameEnd RayCaster::draw_again(int samples, int most) {
  begin_again(samples, most);
  run();
  return machine_->last();
}
void RayCaster::run() {
  while (machine_->part.works()) simulation_.run(machine_->part);
  machine_->part.rethrow();
}

void RayCaster::forget(std::size_t i, const std::vector<std::int64_t>& lines) {
  for (const auto& pipe : machine_->pipes) pipe->forget(i, lines);
}
void RayCaster::forget_all() {
  for (const auto& pipe : machine_->pipes) pipe->forget_all();
}

std::int64_t RayCaster::cycle() const { return machine_->part.cycle(); }
int RayCaster::pipes() const { return machine_->configuration.pipes; }
const Pipe& RayCaster::pipe(int i) const { return *machine_->pipes[i]; }
MemoryCounts RayCaster::memory_counts() const {
  const LineCounts& lines = machine_->lines->counts();
  MemoryCounts counts{lines.reads, lines.read_bytes, lines.written_bytes, lines.bus_cycles, {}};
  if (!machine_->own_memory) return counts;  // its owner tells what else the memory does
  counts.dram = machine_->own_memory->dram_counts();
  if (counts.dram) counts.bus_cycles = machine_->own_memory->bus_cycles();
  return counts;
}

}  // namespace voxmelt::hwmodel::raycast
