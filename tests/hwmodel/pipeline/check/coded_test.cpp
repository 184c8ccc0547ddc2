// The sparse stream of irradiance and the occupancy code of the state (hw.coded) are tested by words by hand
// and by round trips. They also run in lock-step with tiles, stalls and a DRAM, with bits counted beforehand.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "hwmodel/explore/content.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/model/feed.h"
#include "hwmodel/pipeline/model/volume_port.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

Irradiance field_of(state::Grid grid) { return Irradiance(grid); }
std::uint16_t& at(Irradiance& field, int x, int y, int z) { return field[field.layout().at(x, y, z)]; }

TEST(IrradianceStream, HasTheWordsOfLitTokens) {
  Irradiance field = field_of({7, 2, 2});  // two blocks of four lanes: tokens (x 0, y 0), (0, 1), (4, 0) ..
  at(field, 2, 1, 0) = 20;
  at(field, 3, 1, 0) = 30;
  at(field, 4, 0, 0) = 40;
  at(field, 6, 0, 1) = 60;
  const IrradianceStream stream(field, {{7, 2, 2}, 4});
  EXPECT_EQ(stream.words(0), (IrradianceWords{1, 0b1100, 20, 30, 0, 0b0001, 40, 3, 0b0100, 60}));
  EXPECT_EQ(stream.bits(), 10 * 16);
  EXPECT_EQ(stream.counts().lit_cells, 4);
  EXPECT_EQ(stream.counts().lit_tokens, 3);
}

TEST(IrradianceStream, AMaskOf32LanesHasTwoWords) {
  Irradiance field = field_of({32, 1, 1});
  at(field, 1, 0, 0) = 5;
  at(field, 31, 0, 0) = 6;
  EXPECT_EQ(IrradianceStream(field, {{32, 1, 1}, 32}).words(0), (IrradianceWords{0, 2, 0x8000, 5, 6}));
}

TEST(IrradianceStream, ADarkStretchNeedsAnEmptyMask) {
  Irradiance field = field_of({1, 300, 300});
  at(field, 0, 299, 299) = 9;
  EXPECT_EQ(IrradianceStream(field, {{1, 300, 300}, 1}).words(0),
            (IrradianceWords{65535, 0, 90000 - 1 - 65536, 1, 9}));
  EXPECT_TRUE(IrradianceStream(field_of({1, 300, 300}), {{1, 300, 300}, 1}).bits() == 32)
      << "one count that does not fit";
}

// The reader gets each word no sooner than it says that it needs it, and still restores the field.
TEST(IrradianceStream, IsReadBack) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    worlds::Random random(seed + 3);
    const state::Grid grid{random.between(1, 40), random.between(1, 6), random.between(1, 5)};
    Shape shape{grid, random.any({1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 16, 24, 31, 32})};
    if (shape.grid_blocks() > 3) {
      shape.tile = shape.grid_blocks() - 1;
      shape.halo = 1;
    }
    Irradiance field = field_of(grid);
    const int one_in = random.any({1, 2, 30, 1000});
    worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
      if (random.one_in(one_in)) at(field, x, y, z) = static_cast<std::uint16_t>(random.between(1, 65535));
    });
    const IrradianceStream stream(field, shape);
    for (int tile = 0; tile < shape.tiles(); ++tile) {
      IrradianceReader reader(shape.lanes);
      reader.begin(stream.words(tile));
      std::array<UInt<16>, 32> lanes;
      for (Place place = begin_of(shape, tile); place.ordinal < shape.tokens(); place.next(shape)) {
        const std::int64_t needs = reader.needs();
        reader.next(lanes.data(), place, nullptr, 0, 0);
        ASSERT_EQ(reader.used(), needs) << seed;
        for (int lane = 0; lane < shape.lanes; ++lane) {
          const int x = place.x + lane;
          ASSERT_EQ(lanes[static_cast<std::size_t>(lane)], x < grid.x ? at(field, x, place.y, place.z) : 0);
        }
      }
      EXPECT_EQ(reader.used(), static_cast<std::int64_t>(stream.words(tile).size())) << "all was taken";
    }
  }
}

// The column has three heights, and the middle one is solid. It takes 3 bits, then one token of 34 bits.
TEST(Code, AColumnByHand) {
  Design design{{}, {{1, 3, 1}, 1}, 1};
  design.parameters.flow.law = rule::Law::paper;
  ASSERT_EQ(design.cell_bits(), 34);
  state::Volume volume({1, 3, 1});
  worlds::put_solid(volume, 0, 1, 0, 5);
  CodedState code{CodeLayout(design)};
  code.store(volume);
  EXPECT_EQ(code.slot(0)[0], 0b010u | std::uint64_t{2 | 5 << 2} << 3);
  EXPECT_EQ(code.bits_of(0), 3 + 34);
  EXPECT_EQ(code.moved_bits(), 512);
  EXPECT_EQ(code.layout().slot_bits(), 512);
}

TEST(Code, AVolumeIsReadBack) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    worlds::Random random(seed + 11);
    const state::Grid grid{random.between(1, 20), random.between(1, 70), random.between(1, 5)};
    const Start start = hostile_start(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    const Design design{start.parameters, {grid, random.any({1, 2, 3, 8, 13, 32})}, 1};
    CodedState code{CodeLayout(design)};
    code.store(start.volume);
    state::Volume back(grid);
    if (design.of_materials()) back.material = decltype(back.material)(grid);
    for (int z = 0; z < grid.z; ++z)
      for (int x = 0; x < grid.x; x += design.shape.lanes) code.load(design.shape, {x, 0, z, 0, 0}, back);
    ASSERT_EQ(worlds::difference(start.volume, back), "") << seed;
  }
}

void hostile_worlds(int begin, int end) {
  int cut = 0, overlapped = 0;
  for (int i = begin; i < end; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    worlds::Random random(seed + 97);
    const state::Grid grid{random.between(8, 60), random.between(1, 9), random.between(2, 24)};
    const Start start =
        hostile_start(seed + 5000, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    Configuration c{random.any({1, 2, 3, 4, 5, 8, 12, 16}), random.between(1, 3), random.any({1, 2, 5}),
                    random.one_in(2) ? 0 : seed + 1};
    c.coded = true;
    if (random.one_in(3)) c.substeps = 2;
    if (!random.one_in(3)) c.tile = narrow(start, c, random.between(0, 4));
    ASSERT_TRUE(agrees(start, c, 9)) << "seed " << seed;
    const VerifyReport report = lockstep(start, c, 9);
    cut += design_of(start.parameters, grid, c).shape.tiles() > 1;
    overlapped += std::any_of(report.trains.begin(), report.trains.end(), [&](const TrainReport& train) {
      return train.passes > design_of(start.parameters, grid, c).shape.tiles();
    });
  }
  std::printf("             %d of %d worlds were cut, in %d passes overlapped\n", cut, end - begin,
              overlapped);
  EXPECT_GT(cut, 2);
  EXPECT_GT(overlapped, 2);
}
TEST(Code, HostileWorldsWithTilesAndStalls) { hostile_worlds(0, 16); }
TEST(CodeLong, HostileWorldsWithTilesAndStalls) { hostile_worlds(16, 50); }

// The last block of each column has a token of air alone, and any number of lanes beyond the grid.
TEST(Code, EveryRestOfTheWidthByTheLanes) {
  for (const int lanes : {2, 3, 4, 5, 8, 12, 16})
    for (int rest = 0; rest < lanes; ++rest) {
      const state::Grid grid{lanes + (rest == 0 ? lanes : rest), 4, 3};
      const rule::Law law = rest % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
      Start start = hostile_start(static_cast<std::uint64_t>(100 * lanes + rest), law, grid);
      worlds::for_each({lanes, 2, 0, grid.x, 4, grid.z}, [&](int x, int y, int z) {
        for (state::BitPlane* mask : {&start.volume.solid, &start.volume.liquid, &start.volume.inert})
          mask->set(x, y, z, false);
        if (!start.volume.material.empty()) start.volume.material[start.volume.at(x, y, z)] = 0;
        worlds::put(start.volume, x, y, z, 0);
      });
      Configuration c{lanes, 1, 2, 0};
      c.coded = true;
      ASSERT_TRUE(agrees(start, c, 2)) << grid.x << " cells, " << lanes << " lanes";
    }
}

// The crop runs with several lanes and cascades, with and without the code, and in tiles if it is wide
// enough.
void crop_of_scene(const std::string& name, std::uint32_t step) {
  const std::array<int, 3> lanes{1, 4, 16};
  const std::array<int, 4> cascade{1, 2, 4, 8};
  int cut = 0;
  const Start start = crop(start_of(name, step), 32);
  for (std::size_t i = 0; i < lanes.size(); ++i)
    for (std::size_t j = 0; j < cascade.size(); ++j) {
      Configuration c{lanes[i], cascade[j], (i + j) % 2 == 0 ? 2 : 4, j % 3 == 1 ? i + 1 : 0};
      c.coded = (i + j) % 2 == 0;
      if (i < 2 && j < 2) c.tile = narrow(start, c, 1);
      cut += design_of(start.parameters, start.volume.grid, c).shape.tiles() > 1;
      ASSERT_TRUE(agrees(start, c, std::min(8u, 2u * static_cast<std::uint32_t>(c.cascade)))) << name;
    }
  EXPECT_GE(cut, 3);
}
TEST(Code, CropsOfScenes) { crop_of_scene("cello", 1048); }
TEST(CodeLong, CropsOfScenes) { crop_of_scene("bunny_viscous", 896); }

// On a DRAM the bits are the same. It reads the bursts that hold something, and no others.
TEST(Code, ADramGivesTheBurstsThatAreCounted) {
  const memory::Parameters sheet = load_memory("ddr4-2400", "test");
  int fed = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    worlds::Random random(seed + 55);
    const state::Grid grid{random.between(1, 40), random.any({1, 3, 40}), random.between(3, 30)};
    const Start start =
        hostile_start(seed + 300, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    Configuration c{random.any({1, 3, 4, 7, 16}), random.between(1, 3), 4, 0};
    c.coded = seed % 3 != 0;
    const Design design = design_of(start.parameters, grid, c);
    MemoryStreams streams(design, c.cascade, sheet, 200);
    VerifyOptions options;
    options.steps = static_cast<std::uint32_t>(c.cascade);  // one pass, unless sub-steps take more
    options.configuration = c;
    options.memory = &streams;
    const VerifyReport report =
        verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
    ASSERT_EQ(report.mismatch, nullptr) << seed << ": " << text_of(*report.mismatch);
    ASSERT_EQ(report.digest, lockstep(start, c, options.steps).digest);
    if (report.trains.size() != 1 || report.passes != 1) continue;
    std::int64_t bursts = 0;
    for (const StageReport& stage : report.stages) {
      if (stage.kind == StageKind::reader) {
        bursts += (stage.moved_bits + 511) / 512;
        const explore::Content content = explore::content_of(design, nullptr, &start.volume);
        if (c.coded) {
          EXPECT_EQ(stage.moved_bits, content.coded_bits) << seed;
        }
      }
      if (stage.kind == StageKind::feed) {
        bursts += (stage.moved_bits + 511) / 512;
        fed += stage.moved_bits > 0;
        EXPECT_EQ(stage.moved_bits, stage.cycles.busy > 0 ? report.irradiance->bits : 0) << seed;
      }
    }
    EXPECT_EQ(streams.counts().reads, bursts) << seed;
  }
  EXPECT_GT(fed, 1);
}

// The grids are cut into tiles. Each tile reads whole columns of its window, and writes those that it owns.
TEST(Columns, ADramGivesThoseOfEachTile) {
  const memory::Parameters sheet = load_memory("ddr4-2400", "test");
  int cut = 0, coded = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    worlds::Random random(seed + 7);
    const state::Grid grid{random.between(20, 60), random.any({1, 3, 20}), random.between(3, 20)};
    Start start = hostile_start(seed + 900, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous, grid);
    if (seed % 3 != 0) start.parameters.heat.radiation = false;  // its words begin with a burst in each tile
    Configuration c{random.any({1, 2, 3, 4, 6}), random.between(1, 2), random.any({1, 4}), seed % 3};
    c.coded = seed % 4 < 2;
    c.tile = narrow(start, c, random.between(0, 4));
    const Design design = design_of(start.parameters, grid, c);
    MemoryStreams streams(design, c.cascade, sheet, random.any({100, 400}));
    VerifyOptions options;
    options.steps = static_cast<std::uint32_t>(c.cascade) * 2;
    options.configuration = c;
    options.memory = &streams;
    const VerifyReport report =
        verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
    ASSERT_EQ(report.mismatch, nullptr) << seed << ": " << text_of(*report.mismatch);
    ASSERT_EQ(report.digest, lockstep(start, c, options.steps).digest);
    if (!design.shape.tiled()) continue;
    ++cut;
    // The pass runs once more. Its tiles follow one another.
    options.steps = 1;
    const VerifyReport one =
        verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
    if (one.trains.size() != 1 || one.passes != 1) continue;
    const explore::Content content = explore::content_of(design, nullptr, &start.volume);
    const ColumnSlots slots(design, c.coded);
    std::int64_t reads = 0;
    for (int k = 0; k < design.shape.tiles(); ++k) {
      const int first = design.shape.first_block(k), end = first + design.shape.blocks();
      reads += c.coded ? explore::Content::between(content.coded_before, first, end) / 512
                       : std::int64_t{end - first} * grid.z * slots.slot_bursts;
    }
    if (start.parameters.heat.radiation) continue;
    EXPECT_EQ(streams.counts().reads, reads) << seed;
    if (!c.coded) {
      const std::int64_t writes = slots.columns * slots.slot_bursts;
      EXPECT_LE(streams.counts().writes, writes) << seed;
      EXPECT_GE(streams.counts().writes, writes - 64) << seed << ": more than its queue holds";
    }
    coded += c.coded;
  }
  EXPECT_GE(cut, 10);
  EXPECT_GE(coded, 2);
}

// Two passes run over 3 x 2 columns of one burst. The second pass asks for a column once it has been written,
// in the order of the columns.
TEST(Columns, AreAskedForWhenTheyHaveBeenWritten) {
  Design design{{}, {{3, 5, 2}, 1}, 1};
  const ColumnSlots slots(design, false);
  ASSERT_EQ(slots.columns, 6);
  ASSERT_EQ(slots.slot_bursts, 1);
  memory::Dram dram(load_memory("ddr4-2400", "test"), 200);
  ColumnOutput out;
  ColumnInput in;
  out.begin(slots, dram, dram.open_port(nullptr));
  in.begin(slots, {}, dram, dram.open_port(nullptr));
  for (int pass = 0; pass < 2; ++pass) {
    in.add(0);
    out.add(0);
  }
  std::int64_t now = 0;
  const auto cycles = [&](int n) {
    for (int i = 0; i < n; ++i) {
      out.cycle(now);
      in.cycle(out, now);
      dram.cycle();
      ++now;
    }
  };
  cycles(500);
  EXPECT_EQ(dram.counts().reads, 6);
  out.written(100, false, now);
  cycles(500);
  EXPECT_EQ(dram.counts().reads, 6) << "half a column";
  out.written(5 * 34, true, now);
  cycles(500);
  EXPECT_EQ(dram.counts().reads, 7);
  EXPECT_EQ(out.passes(0), 1);
  for (int column = 1; column < 6; ++column) {
    out.written(5 * 34, true, now);
    cycles(1);
  }
  cycles(500);
  EXPECT_EQ(dram.counts().reads, 12);
  EXPECT_EQ(dram.counts().writes, 6);
}

// The blocks run alone. The reader waits until the whole column has been written.
TEST(Code, AColumnIsReadOnlyWhenItHasBeenWritten) {
  Design design{{}, {{1, 3, 1}, 1}, 1};
  const CodeLayout layout(design);
  state::Volume volume({1, 3, 1});
  StateMemory memory(false, &layout);
  Writer writer(design.shape, memory);
  Reader reader(design.shape, memory);
  CellFifo out("out", 0, 1, 8, 0), in("in", 1, 1, 8, 0);
  reader.connect(out, writer);
  writer.connect(in);
  memory.begin_train(volume);
  reader.begin_pass(0);
  writer.begin_pass(0);
  std::int64_t now = 0;
  const auto cycle = [&](bool comes) {
    reader.cycle(now);
    writer.cycle(now);
    if (comes) in.put()[0] = {};
    in.commit();
    out.commit();
    ++now;
  };
  for (int i = 0; i < 3; ++i) cycle(false);
  reader.add_pass(0);
  writer.add_pass(0);
  for (int i = 0; i < 3; ++i) cycle(true);
  EXPECT_EQ(reader.cycles().starved, 3) << "two of three have been written";
  cycle(false);
  EXPECT_EQ(reader.cycles().starved, 4) << "the third one is written in this cycle";
  cycle(false);
  EXPECT_EQ(reader.cycles().busy, 4);
}

// In these grids the column makes the reader wait, and single tokens would not. So passes do not overlap.
TEST(Code, PassesOverlapIfNobodyWaitsForAColumn) {
  int apart = 0, overlapped = 0;
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (int planes = 2; planes < 30; ++planes) {
      const Start start = hostile_start(static_cast<std::uint64_t>(planes) + 70, law, {2, 9, planes});
      Configuration c{2, 2, 2, 0};
      const Design design = design_of(start.parameters, start.volume.grid, c);
      const Pass pass{.first = 0, .steps = 2};
      const bool plain = passes_overlap(design, c, pass);
      c.coded = true;
      const bool coded = passes_overlap(design, c, pass);
      ASSERT_TRUE(agrees(start, c, 6)) << planes;
      apart += plain && !coded;
      overlapped += coded;
    }
  EXPECT_GE(apart, 1);
  EXPECT_GE(overlapped, 3);
}

// With 8 lanes and 8 steps, at most a quarter of the 1024 bits of irradiance that used to be sent remains.
// The same holds for the cello's state.
void traffic_of(const std::string& name, std::uint32_t step) {
  const Start start = start_of(name, step);
  run::Simulation simulation(start.parameters, start.volume, run::implementations().widest());
  simulation.begin_at(start.step);
  simulation.begin_step();
  const Design design{start.parameters, {start.volume.grid, 8}, 1};
  const explore::Content content = explore::content_of(design, simulation.irradiance(), &start.volume);
  const auto tokens = static_cast<double>(design.shape.tokens());
  const double irradiance = 8 * static_cast<double>(content.irradiance_bits) / tokens;
  const double coded = static_cast<double>(content.coded_bits) / tokens / (8 * design.cell_bits());
  std::printf("%-16s %.1f bits of irradiance per cycle; coded %.1f %% of the state\n", name.c_str(),
              irradiance, 100 * coded);
  EXPECT_LE(irradiance, 256);
  if (name == "cello" || name == "cello_viscous") {
    EXPECT_LE(coded, 0.25);
  }
}
TEST(Code, TrafficOfTheShowcase) { traffic_of(showcase()[0].first, showcase()[0].second); }
TEST(CodeLong, TrafficOfTheShowcase) {
  for (std::size_t i = 1; i < showcase().size(); ++i) traffic_of(showcase()[i].first, showcase()[i].second);
}

}  // namespace
}  // namespace voxmelt::hwmodel
