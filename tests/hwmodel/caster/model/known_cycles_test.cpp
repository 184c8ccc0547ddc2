// The exact parts of the ray caster's closed form hold over many machines and pictures.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/caster/model/upload_stage.h"
#include "render/packet/picture.h"
#include "tests/hwmodel/caster/model/known_cycles.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Counts the pixels of the first pass that differ by more than `most` from a neighbour.
std::int64_t differing(const render::Image& image, int most) {
  const auto far = [&](int x, int y, int nx, int ny) {
    if (nx < 0 || ny < 0 || nx >= image.width || ny >= image.height) return false;
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(image.at(x, y)[c] - image.at(nx, ny)[c]) > most) return true;
    return false;
  };
  std::int64_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      count +=
          far(x, y, x - 1, y) || far(x, y, x + 1, y) || far(x, y, x, y - 1) || far(x, y, x, y + 1) ? 1 : 0;
  return count;
}

Account account_of(const PictureReport& report, const std::string& stage) {
  for (const StageAccount& account : report.stages)
    if (account.name == stage) return account.account;
  ADD_FAILURE() << "no stage " << stage;
  return {};
}

TEST(KnownCycles, WorkFillAndWriteBackAreExact) {
  int fills = 0, seconds = 0, stalls = 0;
  for (std::uint64_t seed = 0; seed < 96; ++seed) {
    test::HostilePicture picture = test::hostile_picture(seed + 300, 3000);
    picture.look.clear = {};
    picture.camera.width = 1 + static_cast<int>(seed * 7 % 30);
    picture.camera.height = 1 + static_cast<int>(seed * 5 % 23);
    picture.setting = seed % 3 == 0 ? render::Setting::normal : render::Setting::fast;
    worlds::Random random(seed + 5000);
    PictureOptions options;
    options.compare = false;
    Configuration& c = options.configuration;
    c.pipes = random.any({1, 2, 3, 4});
    c.rays = random.any({3, 64});
    c.walkers = random.between(1, 3);
    c.searchers = random.between(1, 4);
    c.bands = random.any({1, 2, 4});
    c.fifo_depth = random.any({1, 2, 4});
    c.stall_seed = seed % 4 == 1 ? seed : 0;
    c.tiles = random.any({1, 4});
    c.latency = random.any({1, 40});
    c.bus_bytes = random.any({16, 64, 128});
    c.level_bits = random.between(1, 3);
    c.levels = {random.any({1, 16}), random.any({1, 4}), 8, random.any({4, 64})};
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, picture.setting},
        options);
    ASSERT_TRUE(report.end.complete) << seed;
    ASSERT_EQ(report.different_bytes, 0) << seed;

    const int width = static_cast<int>(picture.camera.width),
              height = static_cast<int>(picture.camera.height);
    const KnownPass first = known_first(width, height, c);
    KnownPass second;
    if (picture.setting == render::Setting::normal) {
      render::Picture software;
      software.update(picture.volume, picture.look, picture.light, picture.terrain, 1);
      const std::int64_t pixels = differing(software.draw(picture.camera, render::Setting::fast, 1), 16);
      second = known_second(width, height, pixels, 8, c);
      seconds += pixels > 0 ? 1 : 0;
    } else if (first.set_up_fill >= 0) {
      EXPECT_EQ(account_of(report, "set-up").fill, first.set_up_fill) << seed;
      ++fills;
    }
    for (const char* stage : {"set-up", "met", "arriving", "mirror", "colour", "press", "pixel"})
      EXPECT_EQ(account_of(report, stage).busy, first.rays + second.rays) << seed << " " << stage;
    EXPECT_EQ(account_of(report, "tiles").busy, first.tiles_busy + second.tiles_busy) << seed;
    EXPECT_EQ(report.memory.written_bytes, first.written_bytes + second.written_bytes) << seed;
    // Reads are tiles and counted misses.
    std::int64_t reads = second.tiles_read, beats = first.bus_cycles + second.bus_cycles;
    for (const CacheAccount& cache : report.caches) {
      reads += cache.counts.misses;
      beats += cache.counts.misses * ((cache.line_bytes + c.bus_bytes - 1) / c.bus_bytes);
    }
    EXPECT_EQ(report.memory.reads, reads) << seed;
    EXPECT_EQ(report.memory.bus_cycles, beats) << seed;
    EXPECT_GE(report.end.cycles, first.least_cycles + second.least_cycles) << seed;
    stalls += c.stall_seed != 0 ? 1 : 0;
  }
  EXPECT_GE(fills, 15);
  EXPECT_GE(seconds, 15);
  EXPECT_GE(stalls, 15);
}

TEST(KnownCycles, AnUploadsCyclesAreExact) {
  int configurations = 0;
  for (const int depth : {1, 2, 3, 8})
    for (const int bus : {4, 16, 32, 64, 256})
      for (const int words : {0, 1, 77})
        for (const int bursts : {0, 1, 2, 90}) {
          Configuration c;
          c.fifo_depth = depth;
          c.bus_bytes = bus;
          Upload upload;
          upload.words = words;
          std::vector<std::uint8_t> line(kBurst);
          for (int i = 0; i < bursts; ++i) {
            for (std::size_t b = 0; b < line.size(); ++b)
              line[b] = static_cast<std::uint8_t>(7 * i + static_cast<int>(b));
            upload.add(64 * std::int64_t{(i * 37) % 90}, line.data(), kBurst);
          }
          Memory memory;
          memory.bytes.resize(90 * 64);
          const UploadEnd end = run_upload(upload, memory, c);
          EXPECT_EQ(end.cycles, known_upload(words, bursts, c))
              << depth << " " << bus << " " << words << " " << bursts;
          EXPECT_EQ(end.account.total(), end.cycles);
          EXPECT_EQ(end.account.busy, words + bursts);
          for (int i = 0; i < bursts; ++i)
            EXPECT_EQ(memory.bytes[static_cast<std::size_t>(64 * ((i * 37) % 90) + 5)],
                      static_cast<std::uint8_t>(7 * i + 5));
          c.stall_seed = 3;
          EXPECT_GE(run_upload(upload, memory, c).cycles, end.cycles);
          ++configurations;
        }
  EXPECT_GE(configurations, 60);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
