// A memory's file arrives with all that it says, and errors in it are refused at their place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "hwmodel/memory/sheet.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel {
namespace {

namespace fs = std::filesystem;

const std::string& text_of(const std::string& name) {
  for (const MemoryFile& file : memory_files())
    if (file.name == name) return file.text;
  throw std::logic_error("no file " + name);
}
// Returns the complaint of `load_memory` about the file with one text in place of another.
std::string complaint(const std::string& old, const std::string& now) {
  std::string text = text_of("ddr4-2400");
  const std::size_t at = text.find(old);
  if (at == std::string::npos) return "the file has no " + old;
  text.replace(at, old.size(), now);
  const fs::path file = fs::path(testing::TempDir()) / "voxmelt_memory.toml";
  std::ofstream(file) << text;
  std::string said;
  try {
    load_memory(file.string(), "test");
  } catch (const scene::InputError& error) {
    said = error.what();
    if (said.find(file.string() + ":") != 0) said = "without its place: " + said;
  }
  fs::remove(file);
  return said.substr(std::min(said.size(), said.find("error:")));
}

TEST(MemoryPreset, SaysWhatTheSheetSays) {
  const memory::Parameters ddr4 = load_memory("ddr4-2400", "test");
  EXPECT_EQ(ddr4.peak(), 19200);
  EXPECT_EQ(ddr4.bytes(), std::int64_t{8} << 30);
  EXPECT_EQ(ddr4.row_bytes(), 8192);
  EXPECT_EQ(ddr4.columns_of_request(), 1);
  EXPECT_EQ(ddr4.rc, ddr4.ras + ddr4.rp);
  const memory::Parameters hbm2 = load_memory("hbm2", "test");
  EXPECT_EQ(hbm2.peak(), 16000);
  EXPECT_EQ(hbm2.columns_of_request(), 2);
  EXPECT_TRUE(hbm2.two_buses);
  const memory::Parameters lpddr4 = load_memory("lpddr4-3200", "test");
  EXPECT_EQ(lpddr4.peak(), 25600);
  EXPECT_EQ(lpddr4.bytes(), std::int64_t{2} << 30);
  EXPECT_EQ(lpddr4.ppd, 4);
  EXPECT_EQ(ddr4.ppd, 0) << "the key may be missing";
  EXPECT_EQ(ddr4.ccd_l_write, ddr4.ccd_l) << "likewise";
  EXPECT_EQ(ddr4.beats(), 4);
}

// The peaks are those that the kinds are sold with: transfers on a pin, times pins.
TEST(MemoryPreset, PeaksAreThoseOfTheKind) {
  const std::map<std::string, std::int64_t> peaks{
      {"ddr4-2400", 19200},   {"ddr5-4800", 38400}, {"gddr6", 448000},      {"hbm2", 16000},
      {"hbm2-stack", 230400}, {"hbm3", 819200},     {"lpddr4-3200", 25600}, {"lpddr5-6400", 51200}};
  ASSERT_EQ(memory_files().size(), peaks.size());
  for (const MemoryFile& file : memory_files()) {
    const memory::Parameters p = load_memory(file.name, "test");
    EXPECT_EQ(p.peak(), peaks.at(file.name)) << file.name;
    EXPECT_EQ(p.rc, p.name == "hbm3" ? p.ras + p.rp + 1 : p.ras + p.rp) << file.name;
    EXPECT_EQ(p.beats(), p.ccd_s) << file.name << ": bursts of other groups follow without a gap";
    EXPECT_NE(p.title.find("GB/s"), std::string::npos);
  }
}

TEST(MemoryPreset, RefusesWhatCannotBe) {
  EXPECT_EQ(complaint("title", "title"), "");
  EXPECT_NE(complaint("groups = 4", "groups = 3").find("3 is not a power of 2"), std::string::npos);
  EXPECT_NE(complaint("ranks = 1", "ranks = 8").find("more than 64 banks"), std::string::npos);
  EXPECT_NE(complaint("transfers = 8", "transfers = 16").find("64 of them at most"), std::string::npos);
  EXPECT_NE(complaint("columns = 1024", "columns = 4").find("a row must have 64 bytes"), std::string::npos);
  EXPECT_NE(complaint("ccd_s = 4", "ccd_s = 3").find("ccd_s"), std::string::npos);
  EXPECT_NE(complaint("ccd_s = 4", "data_rate = 4\nccd_s = 1").find("ccd_s"), std::string::npos);
  EXPECT_EQ(complaint("ccd_s = 4", "data_rate = 4\nccd_s = 2"), "") << "8 transfers in two cycles";
  EXPECT_NE(complaint("mhz = 1200", "mhz = 1200\ndata_rate = 3").find("power of 2"), std::string::npos);
  EXPECT_NE(complaint("mhz = 1200", "mhz = 1200\ndata_rate = 16").find("whole cycles"), std::string::npos);
  EXPECT_NE(complaint("refi = 9360", "refi = 500").find("refi"), std::string::npos);
  EXPECT_NE(complaint("cl = 17", "latency = 17").find("cl"), std::string::npos);
  EXPECT_NE(complaint("rtp = 9", "rtp = 9\nrtq = 9").find("rtq"), std::string::npos);
  EXPECT_NE(complaint("rfc = 420 ", "refresh = \"bank\"\nrfc = 420 ").find("groups_at_once is missing"),
            std::string::npos);
  EXPECT_NE(complaint("rfc = 420 ", "rfc_bank = 9\nrfc = 420 ").find("groups_at_once is missing"),
            std::string::npos);
  EXPECT_NE(complaint("idd0 = 48", "idd0 = 40").find("idd0"), std::string::npos) << "below standby";
  EXPECT_NE(complaint("idd4r = 135", "idd4r = 42").find("idd4r"), std::string::npos);
  EXPECT_NE(complaint("idd5 = 250", "idd5b = 250").find("idd5"), std::string::npos);
  EXPECT_NE(complaint("parts = 8", "parts = 0").find("parts"), std::string::npos);
  EXPECT_NE(complaint("[[power.rail]]", "[power.rail]").find("rail"), std::string::npos);
  EXPECT_NE(complaint("[memory]", "[dram]").find("no such table"), std::string::npos);
  try {
    load_memory("ddr5", "--set hw.memory=ddr5");
    ADD_FAILURE();
  } catch (const scene::InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "--set hw.memory=ddr5: error: no memory \"ddr5\"; there are fixed, ddr4-2400, ddr5-4800, gddr6, "
        "hbm2-stack, hbm2, hbm3, lpddr4-3200, lpddr5-6400, or a file that ends in .toml, .json or .yaml");
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
