// Checkpoints are tested byte by byte: what is written is read again, and nothing else is.
#include "kernel/run/checkpoint/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/checkpoint_files.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::checkpoint {
namespace {

namespace fs = std::filesystem;
using namespace worlds;

class CheckpointFile : public testing::Test {
 protected:
  CheckpointFile()
      : folder_(fs::temp_directory_path() / ("voxmelt_checkpoint_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~CheckpointFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void put_bytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  }
  fs::path folder_, file_ = folder_ / "step_00000007.vxc";
};

// The volume is more than a word wide, and odd.
Volume sample() {
  Volume v(Grid{70, 3, 5});
  put(v, 1, 0, 0, 0x1234, 0x0102, 0xFFFE);
  put(v, 69, 2, 4, 1, 1, 1);
  put_solid(v, 64, 1, 2, 4096, 7);
  put_inert(v, 63, 0, 3);
  return v;
}

Head sample_head() {
  Head head;
  head.version = "1.2.3";
  head.first_step = 5;
  head.scene.name = "melt \"it\"";
  head.scene.settings = "\"a\" = 1\n";
  head.scene.parameters = "{}";
  head.scene.warnings = {"odd"};
  head.scene.files = {{"/a/b.obj", 12, 0xFEDCBA9876543210u}};
  head.scene.initial_digest = 0x0123456789ABCDEFu;
  head.scene.terrain = std::vector<float>(70 * 5, 0.1f);
  head.scene.textured = true;
  head.run.steps_done = 7;
  head.run.irradiance_capped = 3;
  head.run.rays = 40;
  head.run.rays_cast = 4;
  // These sums exceed 64 bits, with either sign: 10^30 and -2^100.
  head.run.ledger.mass.start = state::Sum{1'000'000'000'000'000} * 1'000'000'000'000'000;
  head.run.ledger.heat.rounded = -(state::Sum{1} << 100);
  head.run.ledger.energy.capped = 5;
  head.run.ledger.limit.limited_mass = 9;
  head.run.seconds = {.source = 0.1, .excess = 1e-300, .visibility = 2.5};
  head.command = "{\"steps\":9}";
  return head;
}

TEST_F(CheckpointFile, GivesBackWhatWasWritten) {
  const Volume volume = sample();
  state::Field<std::uint16_t> light(volume.grid);
  light[light.layout().at(69, 0, 4)] = 4097;
  for (const int threads : {1, 3}) {
    write(file_, sample_head(), volume, &light, threads);
    const Checkpoint read_back = read(file_);
    EXPECT_TRUE(read_back.volume == volume);
    const Head expected = sample_head(), &head = read_back.head;
    EXPECT_EQ(head.version, expected.version);
    EXPECT_EQ(head.first_step, 5u);
    EXPECT_EQ(head.scene.name, expected.scene.name);
    EXPECT_EQ(head.scene.settings, expected.scene.settings);
    EXPECT_EQ(head.scene.files, expected.scene.files);
    EXPECT_EQ(head.scene.warnings, expected.scene.warnings);
    EXPECT_EQ(head.scene.initial_digest, expected.scene.initial_digest);
    EXPECT_EQ(head.scene.terrain, expected.scene.terrain);
    EXPECT_TRUE(head.scene.textured);
    EXPECT_EQ(head.run.steps_done, 7u);
    EXPECT_EQ(head.run.irradiance_capped, 3);
    EXPECT_EQ(head.run.rays, 40);
    EXPECT_TRUE(head.run.ledger == expected.run.ledger);
    EXPECT_EQ(head.run.seconds, expected.run.seconds);
    EXPECT_TRUE(head.run.irradiance == light);
    EXPECT_EQ(head.command, expected.command);
    EXPECT_EQ(read_head(file_).run.steps_done, 7u);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "nothing is left beside it";
}

// These slabs look empty at first sight: one has all in its last row, and one has rows of equal bytes.
TEST_F(CheckpointFile, AlmostEmptySlabsAreKept) {
  Volume last(Grid{64, 3, 5}), even(Grid{64, 3, 5});
  put_solid(last, 9, 2, 4, 4096, 7);
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 64; ++x) put_solid(even, x, y, z, 0x0101, 0x0202);
  Head head = sample_head();
  head.scene.terrain.clear();
  for (const Volume* volume : {&last, &even}) {
    write(file_, head, *volume, nullptr, 2);
    const Volume read = checkpoint::read(file_).volume;
    for (int z = 0; z < 5; ++z)
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 64; ++x) {
          ASSERT_EQ(read.solid.test(x, y, z), volume->solid.test(x, y, z)) << x << ' ' << y << ' ' << z;
          ASSERT_EQ(read.amount[read.at(x, y, z)], volume->amount[volume->at(x, y, z)]);
          ASSERT_EQ(read.heat[read.at(x, y, z)], volume->heat[volume->at(x, y, z)]);
        }
  }
}

TEST_F(CheckpointFile, NoFlippedBitIsRead) {
  write(file_, sample_head(), sample(), nullptr, 1);
  const std::string whole = bytes_of(file_);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string broken = whole;
    broken[at] = static_cast<char>(broken[at] ^ (1 << at % 8));
    put_bytes(file_, broken);
    EXPECT_THROW(read(file_), Error) << "byte " << at;
  }
}

TEST_F(CheckpointFile, NoShorterOrLongerFileIsRead) {
  write(file_, sample_head(), sample(), nullptr, 1);
  const std::string whole = bytes_of(file_);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    put_bytes(file_, whole.substr(0, length));
    EXPECT_THROW(read(file_), Error) << "the first " << length << " bytes";
  }
  put_bytes(file_, whole + '\0');
  EXPECT_THROW(read(file_), Error);
  put_bytes(file_, whole);
  EXPECT_NO_THROW(read(file_));
}

// The blocks are whole, but in another order or from another run.
TEST_F(CheckpointFile, BlocksKeepTheirPlaces) {
  {
    BlockWriter writer(file_);
    writer.put({"solid", 0, 5}, packed({}));
    writer.finish();
  }
  EXPECT_THROW(read(file_), Error);
  {
    BlockWriter writer(file_);
    const std::string head = "{\"grid\": [1e9, 1, 1]}";
    writer.put({"head", 0, 0}, packed(std::as_bytes(std::span(head))));
    writer.finish();
  }
  EXPECT_THROW(read(file_), Error);
}

TEST_F(CheckpointFile, TheLastTwoAreKept) {
  fs::create_directories(folder_ / "checkpoints");
  for (const std::uint32_t step : {0u, 9u, 10u, 100000000u})
    put_bytes(io::checkpoint_place(folder_, step), "x");
  put_bytes(folder_ / "checkpoints/step_00000010.vxc.partial-aBcDeF", "x");
  EXPECT_TRUE(io::holds_work(folder_));
  io::keep_two_checkpoints(folder_);
  const std::vector<io::CheckpointFile> left = io::checkpoints_in(folder_);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].step, 100000000u);
  EXPECT_EQ(left[1].step, 10u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "checkpoints"), {}), 2);
}

}  // namespace
}  // namespace voxmelt::checkpoint
