// The stage gravity in SystemVerilog, as Verilator compiles it, gives the reference's cells. Columns come as
// the pipeline's stream has them, with and without stalls.
#include <gtest/gtest.h>
#include <verilated.h>

#include <cstddef>
#include <cstdint>
#include <ios>
#include <memory>
#include <string>
#include <vector>

#include "gravity_p1.h"
#include "gravity_p16.h"
#include "gravity_p4.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/engine/scalar/reference.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt {
namespace {

using hwmodel::Place;
using hwmodel::Shape;

enum : unsigned { kAir, kLiquid, kSolid, kInert };  // voxmelt_pkg
constexpr int kBitsIn = 35, kBitsOut = 34;
constexpr std::uint64_t kBorder = kInert | std::uint64_t{2048} << 2;

std::uint64_t word_of(const state::Volume& volume, int x, int y, int z) {
  const state::Slot at = volume.at(x, y, z);
  const unsigned state = volume.inert.test(x, y, z)    ? kInert
                         : volume.solid.test(x, y, z)  ? kSolid
                         : volume.liquid.test(x, y, z) ? kLiquid
                                                       : kAir;
  return state | std::uint64_t{volume.amount[at]} << 2 | std::uint64_t{volume.energy[at]} << 18;
}

bool beside_wall(const state::Volume& volume, int x, int y, int z) {
  const auto blocked = [&](int dx, int dz) {
    return !volume.grid.contains(x + dx, y, z + dz) || volume.solid.test(x + dx, y, z + dz) ||
           volume.inert.test(x + dx, y, z + dz);
  };
  return blocked(1, 0) || blocked(-1, 0) || blocked(0, 1) || blocked(0, -1);
}

// Returns the words of a volume in the order of the stream, lane after lane. Lanes beyond the grid are
// border.
std::vector<std::uint64_t> stream_of(const state::Volume& volume, int lanes, bool with_walls) {
  const Shape shape{volume.grid, lanes};
  std::vector<std::uint64_t> words;
  Place place = begin_of(shape, 0);
  for (std::int64_t i = 0; i < shape.tokens(); ++i, place.next(shape))
    for (int x = place.x; x < place.x + lanes; ++x) {
      const bool inside = x < volume.grid.x;
      const std::uint64_t wall = with_walls && inside && beside_wall(volume, x, place.y, place.z) ? 1 : 0;
      words.push_back(inside ? word_of(volume, x, place.y, place.z) | wall << 34 : kBorder);
    }
  return words;
}

// A world without heat, under the paper's law, in the reading `text`. Nothing hangs or sets.
struct World {
  explicit World(std::uint64_t seed) : random(seed * 7919 + 1) {
    grid = {random.between(1, 18), random.between(1, 14), random.between(1, 4)};
    parameters = worlds::hostile_parameters(random, rule::Law::paper, grid);
    parameters.heat = {};
    parameters.flow.fall.hang = 0;
    parameters.flow.paper.reading = rule::EnergyReading::text;
    before = worlds::hostile_volume(random, parameters, grid);
    after = before;
    scalar::Reference reference(parameters, grid);
    state::Ledger ledger;
    reference.run(step::Phase::gravity, step::Moment(3), nullptr, after, ledger);
  }

  worlds::Random random;
  state::Grid grid;
  rule::Parameters parameters;
  state::Volume before, after;
};

// A port that is wider than 64 bits is an array of words of 32 bits.
template <class Port>
void put(Port& port, int at, int bits, std::uint64_t value) {
  auto* words = reinterpret_cast<std::uint32_t*>(&port);
  for (int i = 0; i < bits; ++i) {
    std::uint32_t& word = words[(at + i) / 32];
    const std::uint32_t bit = std::uint32_t{1} << ((at + i) % 32);
    word = (value >> i & 1) != 0 ? word | bit : word & ~bit;
  }
}
template <class Port>
std::uint64_t get(const Port& port, int at, int bits) {
  const auto* words = reinterpret_cast<const std::uint32_t*>(&port);
  std::uint64_t value = 0;
  for (int i = 0; i < bits; ++i) value |= std::uint64_t{words[(at + i) / 32] >> ((at + i) % 32) & 1} << i;
  return value;
}

// A register without a reset may hold anything at first. A model takes these bits when it is made.
std::unique_ptr<VerilatedContext> random_context(int seed) {
  auto context = std::make_unique<VerilatedContext>();
  context->randReset(2);
  context->randSeed(seed);
  return context;
}

template <class Model>
class Bench {
 public:
  Bench(const World& world, int lanes)
      : lanes_(lanes),
        context_(random_context(static_cast<int>(world.grid.cells()) + 1)),
        model_(&*context_) {
    model_.top = static_cast<std::uint16_t>(world.grid.y - 1);
    model_.factor = world.parameters.flow.fall.factor;
    model_.wall_factor = world.parameters.flow.fall.wall_factor;
    model_.minimum = static_cast<std::uint16_t>(world.parameters.flow.fall.minimum);
    model_.beta = world.parameters.flow.paper.beta;
    model_.rst = 1;
    model_.in_valid = model_.out_ready = 0;
    for (int i = 0; i < 3; ++i) clock();
    model_.rst = 0;
  }

  // Streams all tokens through, and returns what came out. `stalls` is how many cycles of 8 wait at each end.
  std::vector<std::uint64_t> run(const std::vector<std::uint64_t>& words, int stalls,
                                 worlds::Random& random) {
    const std::size_t tokens = words.size() / lanes_;
    std::vector<std::uint64_t> out;
    std::size_t sent = 0;
    cycles_ = 0;
    while (out.size() < words.size() && cycles_ < static_cast<std::int64_t>(40 * tokens + 400)) {
      model_.in_valid = sent < tokens && random.below(8) >= stalls;
      model_.out_ready = random.below(8) >= stalls;
      for (std::size_t lane = 0; lane < lanes_ && model_.in_valid; ++lane)
        put(model_.in_cells, static_cast<int>(lane) * kBitsIn, kBitsIn, words[sent * lanes_ + lane]);
      model_.eval();
      const bool taken = model_.in_valid && model_.in_ready;
      if (model_.out_valid && model_.out_ready)
        for (std::size_t lane = 0; lane < lanes_; ++lane)
          out.push_back(get(model_.out_cells, static_cast<int>(lane) * kBitsOut, kBitsOut));
      sent += taken ? 1 : 0;
      clock();
      ++cycles_;
    }
    return out;
  }

  std::int64_t cycles() const { return cycles_; }
  bool offers_nothing() {
    for (int i = 0; i < 40; ++i) {
      model_.in_valid = 0;
      model_.out_ready = 1;
      model_.eval();
      if (model_.out_valid) return false;
      clock();
    }
    return true;
  }

 private:
  void clock() {
    model_.clk = 1;
    model_.eval();
    model_.clk = 0;
    model_.eval();
  }

  std::size_t lanes_;
  std::int64_t cycles_ = 0;
  std::unique_ptr<VerilatedContext> context_;
  Model model_;
};

void expect_same(const std::vector<std::uint64_t>& is, const std::vector<std::uint64_t>& wanted, int lanes,
                 int height) {
  ASSERT_EQ(is.size(), wanted.size()) << "tokens are missing";
  for (std::size_t i = 0; i < is.size(); ++i)
    ASSERT_EQ(is[i], wanted[i]) << "token " << i / lanes << " (y = " << i / lanes % height << "), lane "
                                << i % lanes << std::hex << ": " << is[i] << " for " << wanted[i];
}

template <class Model>
void agrees(int lanes, int worlds) {
  int moved = 0;
  for (int seed = 0; seed < worlds; ++seed) {
    SCOPED_TRACE("world " + std::to_string(seed) + ", P = " + std::to_string(lanes));
    World world(static_cast<std::uint64_t>(seed));
    Bench<Model> bench(world, lanes);
    const auto in = stream_of(world.before, lanes, true), out = stream_of(world.after, lanes, false);
    for (const int stalls : {0, 2, 6}) {  // pass after pass, without a reset
      expect_same(bench.run(in, stalls, world.random), out, lanes, world.grid.y);
      if (testing::Test::HasFatalFailure()) return;
      if (stalls == 0) {
        EXPECT_EQ(bench.cycles(), static_cast<std::int64_t>(in.size()) / lanes + 11);
      }
    }
    EXPECT_TRUE(bench.offers_nothing()) << "more tokens than came";
    moved += world.before == world.after ? 0 : 1;
  }
  EXPECT_GT(moved, worlds / 2);
}

TEST(GravityInRtl, OneLane) { agrees<gravity_p1>(1, 150); }
TEST(GravityInRtl, FourLanes) { agrees<gravity_p4>(4, 150); }
TEST(GravityInRtl, SixteenLanes) { agrees<gravity_p16>(16, 60); }

}  // namespace
}  // namespace voxmelt
