#include "hwmodel/caster/model/ray_caster.h"

#include <cstddef>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/line_memory.h"
#include "hwmodel/caster/model/tile_order.h"
#include "hwmodel/fabric/process.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kHangAfter = 4000;  // cycles in which nothing moves
constexpr std::int64_t kPollEvery = 4096;

int tiles_along(int pixels) { return (pixels + kTileSide - 1) / kTileSide; }

// Deals tiles to the pipes, each to the next one that has room.
class Dealer {
 public:
  void begin(const FrameRegisters& frame, int bands, bool second) {
    frame_ = frame;
    turns_ = TileTurns(frame.tiles_x, frame.tiles_y, bands);
    second_ = second, next_ = 0, turn_ = 0;
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
  Machine(const Registers& r, Memory& m, const Configuration& c, const PipeMaker& make)
      : registers(r),
        memory(m),
        configuration(c),
        clock("clock", 1, sc_core::SC_NS),
        memory_block(make_line_memory(m, c)) {
    const auto count = static_cast<std::size_t>(c.pipes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string pipe = "pipe " + std::to_string(i) + ": ";
      const int channel = 100 * static_cast<int>(i) + 90;
      const auto link = [&]<class Word>(std::vector<std::unique_ptr<Link<Word>>>& links, const char* name,
                                        int number) {
        links.push_back(
            std::make_unique<Link<Word>>(pipe + name, channel + number, 1, c.fifo_depth, c.stall_seed));
      };
      link(jobs, "dealer -> tiles", 0);
      link(requests, "memory port -> memory", 1);
      link(replies, "memory -> memory port", 2);
      pipes.push_back(make(registers, frame, memory, configuration, static_cast<int>(i)));
      pipes.back()->connect(jobs.back()->fifo(), requests.back()->fifo(), replies.back()->fifo());
      dealer.connect(jobs.back()->fifo());
      memory_block->connect(requests.back()->fifo(), replies.back()->fifo());
    }
    make_blocks();
  }

  void make_blocks() {
    const auto add = [&](const std::string& name, std::function<void()> cycle) {
      blocks.push_back(std::make_unique<Block>(name.c_str(), clock, shared, std::move(cycle)));
    };
    add("dealer", [this] {
      shared.moves += dealer.cycle() ? 1 : 0;
      for (const auto& link : jobs) link->tick();
    });
    for (std::size_t i = 0; i < pipes.size(); ++i)
      add("pipe_" + std::to_string(i), [this, i] {
        try {
          shared.moves += pipes[i]->cycle();
        } catch (const WidthError& error) {
          throw StageError(error.what(), pipes[i]->running().name());
        }
        requests[i]->tick();
      });
    add("memory", [this] {
      shared.moves += memory_block->cycle(shared.cycle()) ? 1 : 0;
      for (const auto& link : replies) link->tick();
      watch_progress();
    });
  }

  void watch_progress() {
    idle = shared.moves == moves_before ? idle + 1 : 0;
    moves_before = shared.moves;
    shared.complete = memory_block->counts().written_bytes == bytes_at_end;
    shared.hangs = idle > kHangAfter;
    if (shared.complete || shared.hangs) shared.end();
    if (poll && shared.cycle() % kPollEvery == 0) poll();
  }

  std::int64_t bytes_dealt() const {
    std::int64_t tiles = 0;
    for (int y = 0; y < frame.tiles_y; ++y)
      for (int x = 0; x < frame.tiles_x; ++x)
        tiles += frame.window.meets(x * kTileSide, y * kTileSide, kTileSide) ? 1 : 0;
    return tiles * kTileBytes;
  }

  FrameEnd run_pass(bool second, int samples, int most) {
    const std::int64_t bytes = frame_bytes(registers.camera.width, registers.camera.height);
    frame = {second ? memory.frame : 0,
             second ? memory.frame + bytes : memory.frame,
             tiles_along(registers.camera.width),
             tiles_along(registers.camera.height),
             samples,
             most,
             window};
    dealer.begin(frame, configuration.bands, second);
    bytes_at_end = memory_block->counts().written_bytes + bytes_dealt();
    shared.complete = shared.hangs = false;
    shared.last_cycle = kNever;
    idle = 0;
    memory_block->begin();

    context.enter();
    shared.first_cycle = ran ? Shared::now() + 1 : 0;
    ran = true;
    sc_core::sc_start();
    context.leave();
    for (const auto& pipe : pipes) pipe->end_pass();
    if (shared.error) std::rethrow_exception(std::exchange(shared.error, nullptr));
    return {shared.last_cycle + 1, shared.complete, shared.hangs};
  }

  std::function<void()> poll;
  std::int64_t moves_before = 0, idle = 0, bytes_at_end = 0;
  bool ran = false;
  Context context;  // first: everything of SystemC lives in it
  Shared shared;
  const Registers& registers;
  Memory& memory;
  Configuration configuration;
  FrameRegisters frame;
  Window window;
  sc_core::sc_clock clock;
  Dealer dealer;
  std::unique_ptr<LineMemory> memory_block;
  Neighbour* neighbour = nullptr;
  std::vector<std::unique_ptr<Link<TileJob>>> jobs;
  std::vector<std::unique_ptr<Link<LineRequest>>> requests;
  std::vector<std::unique_ptr<Link<LineReply>>> replies;
  std::vector<std::unique_ptr<Pipe>> pipes;
  std::vector<std::unique_ptr<Block>> blocks;
};

RayCaster::RayCaster(const Registers& registers, Memory& memory, const Configuration& configuration,
                     const PipeMaker& make)
    : machine_(std::make_unique<Machine>(registers, memory, configuration, make)) {
  machine_->context.leave();
}
RayCaster::~RayCaster() { machine_->context.enter(); }

void RayCaster::watch(const Watchers& watchers) {
  for (const auto& pipe : machine_->pipes) pipe->watch(watchers);
  for (const auto& link : machine_->jobs) link->fifo().watch(watchers.jobs);
  for (const auto& link : machine_->requests) link->fifo().watch(watchers.requests);
  for (const auto& link : machine_->replies) link->fifo().watch(watchers.replies);
}
void RayCaster::stop() { machine_->shared.end(); }
void RayCaster::poll(std::function<void()> poll) { machine_->poll = std::move(poll); }

void RayCaster::share(Neighbour* neighbour) {
  machine_->neighbour = neighbour;
  machine_->memory_block->share(neighbour);
}
void RayCaster::wait_for_neighbour() {
  machine_->memory_block->begin();
  for (std::int64_t now = 0; !machine_->neighbour->done(); ++now) machine_->memory_block->cycle(now);
}

void RayCaster::draw_only(const Window& window) { machine_->window = window; }

FrameEnd RayCaster::draw_first() { return machine_->run_pass(false, 1, 0); }
FrameEnd RayCaster::draw_again(int samples, int most) { return machine_->run_pass(true, samples, most); }

void RayCaster::forget(std::size_t i, const std::vector<std::int64_t>& lines) {
  for (const auto& pipe : machine_->pipes) pipe->forget(i, lines);
}
void RayCaster::forget_all() {
  for (const auto& pipe : machine_->pipes) pipe->forget_all();
}

std::int64_t RayCaster::cycle() const { return machine_->shared.cycle(); }
int RayCaster::pipes() const { return machine_->configuration.pipes; }
const Pipe& RayCaster::pipe(int i) const { return *machine_->pipes[static_cast<std::size_t>(i)]; }
MemoryCounts RayCaster::memory_counts() const {
  MemoryCounts counts = machine_->memory_block->counts();
  counts.dram = machine_->memory_block->dram_counts();
  if (counts.dram) {  // in cycles of the machine, as of the other memory
    const memory::Parameters& p = *machine_->configuration.dram;
    counts.bus_cycles =
        counts.dram->busy * machine_->configuration.clock_mhz / (std::int64_t{p.mhz} * p.channels);
  }
  return counts;
}

}  // namespace voxmelt::hwmodel::raycast
