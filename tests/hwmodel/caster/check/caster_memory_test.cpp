// The ray caster on a DRAM gives the same bytes whatever the memory, and the counts match what it moved.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/caster/model/line_block.h"
#include "hwmodel/caster/model/upload_stage.h"
#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/memory/sheet.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast {
namespace {

TEST(CasterMemory, HostilePicturesOnADram) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    test::HostilePicture picture = test::hostile_picture(seed + 500, 2000);
    picture.look.clear = {};
    picture.camera.width = 1 + static_cast<int>(seed * 7 % 30);
    picture.camera.height = 1 + static_cast<int>(seed * 5 % 23);
    picture.setting = seed % 3 == 0 ? render::Setting::normal : render::Setting::fast;
    worlds::Random random(seed + 77);
    PictureOptions options;
    Configuration& c = options.configuration;
    c.dram = load_memory(random.any({"ddr4-2400", "hbm2", "lpddr4-3200"}), "test");
    c.clock_mhz = random.any({90, 200, 1700});
    c.pipes = random.any({1, 2, 4});
    c.fifo_depth = random.any({1, 4});
    c.stall_seed = seed % 2 == 0 ? 0 : seed;
    c.apron = random.one_in(4);
    c.level_bits = random.between(1, 3);
    c.levels = {random.any({1, 16}), random.any({1, 4}), 8, random.any({4, 64})};
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, picture.setting},
        options);
    ASSERT_TRUE(report.good()) << seed << " " << c.dram->name << " " << report.hang;
    // Every line that was asked for moved, burst by burst.
    ASSERT_TRUE(report.memory.dram);
    const memory::Counts& dram = *report.memory.dram;
    EXPECT_EQ(dram.reads * memory::kBurst, report.memory.read_bytes);
    EXPECT_EQ(dram.writes * memory::kBurst, report.memory.written_bytes);
    EXPECT_GE(dram.cycles(), report.all_cycles * c.dram->mhz / c.clock_mhz * c.dram->channels);
    const nlohmann::ordered_json json = memory_json(dram, *c.dram);
    std::int64_t sum = 0;
    for (const char* cause : {"busy", "idle", "refresh", "turnaround", "row", "spacing"})
      sum += json["data_bus_cycles"][cause].get<std::int64_t>();
    EXPECT_EQ(json["data_bus_cycles"]["all"], sum);
    EXPECT_NE(memory_text(dram, *c.dram).find(std::to_string(dram.refreshes) + " refreshes"),
              std::string::npos);
  }
}

TEST(CasterMemory, AnUploadArrivesOnADram) {
  Upload upload;
  upload.words = 5;
  std::vector<std::uint8_t> line(kBurst);
  for (int i = 0; i < 5000; ++i) {
    for (std::size_t b = 0; b < line.size(); ++b)
      line[b] = static_cast<std::uint8_t>(7 * i + static_cast<int>(b));
    upload.add(64 * std::int64_t{i}, line.data(), kBurst);
  }
  Configuration c;
  c.dram = load_memory("ddr4-2400", "test");
  Memory memory;
  memory.bytes.resize(5000 * 64);
  const UploadEnd end = run_upload(upload, memory, c);
  for (int i = 0; i < 5000; ++i)
    ASSERT_EQ(memory.bytes[static_cast<std::size_t>(64 * i + 9)], static_cast<std::uint8_t>(7 * i + 9));
  // A burst a cycle is two thirds of the peak: the DRAM keeps pace, but for refreshes and the last batch.
  EXPECT_GE(end.cycles, 5005);
  EXPECT_LT(end.cycles, 5500);
  // At 100 MHz the memory has three times what it needs; at 400 MHz the peak is three bursts in four cycles.
  c.clock_mhz = 400;
  const UploadEnd fast = run_upload(upload, memory, c);
  EXPECT_GE(fast.cycles, 5000 * 4 / 3);
  EXPECT_LT(fast.cycles, 5000 * 4 / 3 * 110 / 100);
}

// Two machines share a DRAM, each with its own bytes: neither ever sees what the other one writes.
TEST(CasterMemory, TwoShareADram) {
  memory::Dram dram(load_memory("ddr4-2400", "test"), 200);
  std::vector<Memory> memories(2);
  struct Side {
    Side(Memory& memory, memory::Dram& dram_of_both, std::int64_t base)
        : lines(memory, dram_of_both, 64, base),
          requests("requests", 0, 1, 4, 0),
          replies("replies", 1, 1, 4, 0) {
      lines.connect(requests, replies);
    }
    LineBlock lines;
    Fifo<LineRequest> requests;
    Fifo<LineReply> replies;
    int asked = 0, replied = 0;
  };
  for (Memory& memory : memories) memory.bytes.resize(100 * 128);
  Side first(memories[0], dram, 0), second(memories[1], dram, 100 * 128);
  for (int cycle = 0; cycle < 3000; ++cycle) {
    std::uint8_t mark = 1;
    for (Side* side : {&first, &second}) {
      if (side->asked < 300 && side->requests.ready()) {  // writes both bursts of a line, then reads it
        const int line = side->asked / 3, what = side->asked % 3;
        LineRequest& request = *side->requests.put();
        request = {0, line, line * 128 + (what == 1 ? 64 : 0), what == 2 ? 128 : kBurst, what != 2, {}};
        request.data.fill(mark);
        ++side->asked;
      }
      if (side->replies.valid()) {
        EXPECT_EQ(side->replies.get()->slot, side->replied++);
      }
      side->lines.cycle();
      ++mark;
    }
    dram.cycle();
    for (Side* side : {&first, &second}) {
      side->requests.commit();
      side->replies.commit();
    }
  }
  EXPECT_EQ(first.replied, 100);
  EXPECT_EQ(second.replied, 100);
  EXPECT_EQ(memories[0].bytes, std::vector<std::uint8_t>(100 * 128, 1));
  EXPECT_EQ(memories[1].bytes, std::vector<std::uint8_t>(100 * 128, 2));
  EXPECT_EQ(dram.counts().writes, 400);
}

TEST(CasterMemory, TheTraceHasEveryRequest) {
  test::HostilePicture picture = test::hostile_picture(510, 2000);
  picture.look.clear = {};
  picture.camera.width = picture.camera.height = 20;
  PictureOptions options;
  Configuration& c = options.configuration;
  c.dram = load_memory("ddr4-2400", "test");
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "voxmelt_memory.trace";
  c.memory_trace = file.string();
  const PictureReport report = verify_picture(
      {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, render::Setting::fast},
      options);
  ASSERT_TRUE(report.good());
  std::ifstream in(file);
  std::int64_t reads = 0, writes = 0;
  for (std::string address, kind; in >> address >> kind;) {
    EXPECT_EQ(std::stoll(address, nullptr, 16) % 64, 0);
    ++(kind == "R" ? reads : writes);
  }
  EXPECT_EQ(reads, report.memory.dram->reads);
  EXPECT_EQ(writes, report.memory.dram->writes);
  EXPECT_GT(reads, 0);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
