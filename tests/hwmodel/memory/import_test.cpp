// Files of other simulators are read as sheets. The numbers here were copied by hand from public files:
// DRAMSys's MICRON_4Gb_DDR4-2400_8bit_A.json and JEDEC_8Gb_LPDDR4-3200_16bit.json, and the example of
// Ramulator 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "hwmodel/memory/sheet.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel {
namespace {

namespace fs = std::filesystem;
using memory::Parameters;

constexpr const char* kDdr4 = R"({"memspec": {
  "memarchitecturespec": {"burstLength": 8, "dataRate": 2, "nbrOfBankGroups": 4, "nbrOfBanks": 16,
    "nbrOfColumns": 1024, "nbrOfRanks": 1, "nbrOfRows": 32768, "width": 8, "nbrOfDevices": 8, "nbrOfChannels": 1,
    "RefMode": 1, "maxBurstLength": 8},
  "memoryId": "MICRON_4Gb_DDR4-2400_8bit_A", "memoryType": "DDR4",
  "mempowerspec": {"vdd": 1.2, "idd0": 60.75e-3, "idd2n": 38.25e-3, "idd3n": 44.0e-3, "idd4r": 184.5e-3,
    "idd4w": 168.75e-3, "idd5B": 118.0e-3, "vpp": 2.5, "ipp0": 4.05e-3, "ipp2n": 0, "ipp3n": 0, "ipp4r": 0,
    "ipp4w": 0, "ipp5B": 0.0},
  "memtimingspec": {"AL": 0, "CCD_L": 6, "CCD_S": 4, "CKE": 6, "CL": 16, "DQSCK": 2, "FAW": 26, "RAS": 39,
    "RC": 55, "RCD": 16, "REFI": 4680, "RFC1": 313, "RL": 16, "RPRE": 1, "RP": 16, "RRD_L": 6, "RRD_S": 4,
    "RTP": 12, "WL": 16, "WPRE": 1, "WR": 18, "WTR_L": 9, "WTR_S": 3, "RTRS": 1, "tCK": 833e-12}}})";

constexpr const char* kLpddr4 = R"({"memspec": {
  "memarchitecturespec": {"burstLength": 16, "dataRate": 2, "nbrOfBanks": 8, "nbrOfColumns": 1024, "nbrOfRanks": 1,
    "nbrOfRows": 65536, "width": 16, "nbrOfDevices": 1, "nbrOfChannels": 1, "nbrOfBankGroups": 1},
  "memoryId": "JEDEC_8Gb_LPDDR4-3200_16bit", "memoryType": "LPDDR4",
  "mempowerspec": {"idd01": 3.5e-3, "idd02": 45.0e-3, "idd2n1": 2.0e-3, "idd2n2": 27.0e-3, "idd3n1": 2.25e-3,
    "idd3n2": 30.0e-3, "idd4r1": 2.25e-3, "idd4r2": 275.0e-3, "idd4w1": 2.25e-3, "idd4w2": 210.0e-3,
    "idd51": 10.0e-3, "idd52": 90.0e-3, "vdd1": 1.8, "vdd2": 1.1, "vddq": 1.1},
  "memtimingspec": {"CCD": 8, "DQSCK": 6, "DQSS": 1, "FAW": 64, "PPD": 4, "RCD": 29, "REFI": 6246, "REFIpb": 780,
    "RFCab": 448, "RFCpb": 224, "RL": 28, "RAS": 68, "RPab": 34, "RPpb": 29, "RCab": 102, "RCpb": 97, "RRD": 16,
    "RTP": 12, "WL": 14, "WPRE": 2, "WR": 29, "WTR": 16, "RTRS": 1, "tCK": 625e-12}}})";

constexpr const char* kRamulator = R"(Frontend:
  impl: SimpleO3   # any
  traces:
    - example_inst.trace
  Translation:
    impl: RandomTranslation

MemorySystem:
  impl: GenericDRAM
  clock_ratio: 3
  DRAM:
    impl: DDR4
    org:
      preset: DDR4_8Gb_x8
      channel: 1
      rank: 1
    timing:
      preset: "DDR4_2400U"
  Controller:
    plugins:
  AddrMapper:
    impl: RoBaRaCoCh
)";

// Loads a text as a file with this name.
Parameters loaded(const std::string& text, const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / "voxmelt_import";
  fs::create_directories(folder);
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  std::ofstream(name) << text;
  try {
    Parameters p = load_memory(name, "test");
    fs::current_path(before);
    return p;
  } catch (...) {
    fs::current_path(before);
    throw;
  }
}
std::string replaced(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(std::min(at, text.size()), old.size(), now);
}
std::string complaint(const std::string& text, const std::string& name) {
  try {
    loaded(text, name);
  } catch (const scene::InputError& error) {
    return error.what();
  }
  return "";
}

std::map<std::string, int> numbers_of(const Parameters& p) {
  return {{"mhz", p.mhz},
          {"data_rate", p.data_rate},
          {"channels", p.channels},
          {"ranks", p.ranks},
          {"groups", p.groups},
          {"banks", p.banks},
          {"rows", p.rows},
          {"columns", p.columns},
          {"width_bits", p.width_bits},
          {"transfers", p.transfers},
          {"cl", p.cl},
          {"cwl", p.cwl},
          {"read_more", p.read_more},
          {"write_more", p.write_more},
          {"rcd", p.rcd},
          {"rp", p.rp},
          {"rp_all", p.rp_all},
          {"ras", p.ras},
          {"rc", p.rc},
          {"ccd_s", p.ccd_s},
          {"ccd_l", p.ccd_l},
          {"ccd_l_write", p.ccd_l_write},
          {"rrd_s", p.rrd_s},
          {"rrd_l", p.rrd_l},
          {"faw", p.faw},
          {"wr", p.wr},
          {"wtr_s", p.wtr_s},
          {"wtr_l", p.wtr_l},
          {"rtp", p.rtp},
          {"ppd", p.ppd},
          {"read_to_write", p.read_to_write},
          {"rank_switch", p.rank_switch},
          {"rfc", p.rfc},
          {"refi", p.refi},
          {"act_slots", p.act_slots},
          {"column_slots", p.column_slots},
          {"pre_slots", p.pre_slots},
          {"ref_slots", p.ref_slots},
          {"interface_cycles", p.interface_cycles}};
}
// Returns the numbers of `other` that differ from those of a sheet.
std::map<std::string, int> beside(const std::string& sheet, const Parameters& other) {
  std::map<std::string, int> different;
  const std::map<std::string, int> own = numbers_of(load_memory(sheet, "test"));
  for (const auto& [key, value] : numbers_of(other))
    if (own.at(key) != value) different[key] = value;
  return different;
}
using Different = std::map<std::string, int>;

// The file has parts of 4 Gb and the grade 16-16-16. Its WL, RTP and REFI are its own. Its rank switch is
// RTRS.
TEST(Import, DramsysDiffersFromTheSheetWhereTheGradeDoes) {
  const Parameters p = loaded(kDdr4, "ddr4.json");
  EXPECT_EQ(beside("ddr4-2400", p), (Different{{"rows", 32768},
                                               {"cl", 16},
                                               {"rcd", 16},
                                               {"rp", 16},
                                               {"rp_all", 16},
                                               {"rc", 55},
                                               {"cwl", 16},
                                               {"rtp", 12},
                                               {"rfc", 313},
                                               {"refi", 4680},
                                               {"rank_switch", 1}}));
  EXPECT_EQ(p.title, "MICRON_4Gb_DDR4-2400_8bit_A");
  EXPECT_EQ(p.parts, 8);
  ASSERT_EQ(p.rails.size(), 2u);
  EXPECT_EQ(p.rails[0].name, "VDD");
  EXPECT_DOUBLE_EQ(p.rails[0].idd0, 60.75);
  EXPECT_DOUBLE_EQ(p.rails[0].idd5, 118);
  EXPECT_DOUBLE_EQ(p.rails[1].volts, 2.5);
  EXPECT_DOUBLE_EQ(p.rails[1].idd0, 4.05);
}

// The file has one channel with 8 Gb, where the sheet has four with 4 Gb.
TEST(Import, DramsysOfLpddr4IsTheSheetButForItsSize) {
  const Parameters p = loaded(kLpddr4, "lpddr4.json");
  EXPECT_EQ(beside("lpddr4-3200", p),
            (Different{{"channels", 1}, {"rows", 65536}, {"rfc", 448}, {"rank_switch", 1}}));
  ASSERT_EQ(p.rails.size(), 2u);
  EXPECT_DOUBLE_EQ(p.rails[1].idd4r, 275);
}

// With the grade and the size of the sheet written into the file, nothing differs.
TEST(Import, TheSheetItselfComesBack) {
  std::string text = kDdr4;
  for (const auto& [old, now] :
       std::map<std::string, std::string>{{"\"nbrOfRows\": 32768", "\"nbrOfRows\": 65536"},
                                          {"\"RL\": 16", "\"RL\": 17"},
                                          {"\"WL\": 16", "\"WL\": 12"},
                                          {"\"RCD\": 16", "\"RCD\": 17"},
                                          {"\"RP\": 16", "\"RP\": 17"},
                                          {"\"RC\": 55", "\"RC\": 56"},
                                          {"\"RTP\": 12", "\"RTP\": 9"},
                                          {"\"RFC1\": 313", "\"RFC1\": 420"},
                                          {"\"REFI\": 4680", "\"REFI\": 9360"},
                                          {"\"RTRS\": 1", "\"RTRS\": 2"}})
    text = replaced(text, old, now);
  EXPECT_EQ(beside("ddr4-2400", loaded(text, "same.json")), Different{});
}

// Ramulator calls the grade 17-17-17 DDR4_2400U. It counts tREFI in cycles of 833 ps, and its tRFC is 360 ns.
TEST(Import, RamulatorDiffersFromTheSheetWhereItRounds) {
  EXPECT_EQ(beside("ddr4-2400", loaded(kRamulator, "ddr4.yaml")), (Different{{"rfc", 433}, {"refi", 9364}}));
  const std::string own =
      replaced(kRamulator, "preset: \"DDR4_2400U\"",
               "preset: DDR4_2400R\n      nRFC: 420\n      tREFI: 7796.88\n      tRP: 13.32\n      nRCD: 20");
  EXPECT_EQ(beside("ddr4-2400", loaded(own, "own.yaml")),
            (Different{{"cl", 16}, {"rcd", 20}, {"rp", 16}, {"rp_all", 16}, {"rc", 55}}));
}

// Parts of 16 bits have two groups, and their own tRRD and tFAW (JESD79-4B, DDR4-3200: 5.3 ns, 6.4 ns, 30
// ns).
TEST(Import, RamulatorsPresetsFollowTheParts) {
  const std::string wide =
      replaced(replaced(kRamulator, "DDR4_8Gb_x8", "DDR4_4Gb_x16"), "\"DDR4_2400U\"", "DDR4_3200AA");
  const Parameters p = loaded(wide, "wide.yaml");
  EXPECT_EQ(p.mhz, 1600);
  EXPECT_EQ(p.groups, 2);
  EXPECT_EQ(p.rows, 32768);
  EXPECT_EQ(p.cl, 22);
  EXPECT_EQ(p.rrd_s, 9);
  EXPECT_EQ(p.rrd_l, 11);
  EXPECT_EQ(p.faw, 48);
  EXPECT_EQ(p.rc, 74);
}

// Every number that a sheet needs is missed by its own name. Other numbers may be missing.
TEST(Import, WhatIsMissingIsNamed) {
  for (const std::string key : {"CCD_L", "FAW", "RAS", "RC", "RCD", "REFI", "RFC1", "RL", "RP", "RRD_S",
                                "RTP", "WL", "WR", "WTR_L", "RTRS", "tCK"}) {
    const std::string name = key == "RFC1" || key == "RP" || key == "RC" ? "" : key;
    const std::string said = complaint(replaced(kDdr4, "\"" + key + "\":", "\"gone\":"), "gone.json");
    EXPECT_NE(said.find("gone.json: error: memtimingspec." + name), std::string::npos) << key << ": " << said;
    EXPECT_NE(said.find("is missing"), std::string::npos) << said;
  }
  for (const std::string key : {"nbrOfBanks", "nbrOfRows", "width", "burstLength", "dataRate"})
    EXPECT_NE(
        complaint(replaced(kDdr4, "\"" + key + "\":", "\"gone\":"), "gone.json").find(key + " is missing"),
        std::string::npos);
  EXPECT_NE(complaint(replaced(kDdr4, "\"idd4r\":", "\"gone\":"), "gone.json")
                .find("mempowerspec.idd4r is missing"),
            std::string::npos);
  EXPECT_EQ(complaint(replaced(kDdr4, "\"CKE\":", "\"gone\":"), "gone.json"), "");
}

// A number that cannot be is complained of under its name in the file.
TEST(Import, WhatCannotBeIsNamed) {
  const auto said = [](const std::string& old, const std::string& now) {
    return complaint(replaced(kDdr4, old, now), "bad.json");
  };
  EXPECT_EQ(said("\"RC\": 55", "\"RC\": 30"),
            "bad.json: memtimingspec.RC: error: memory.rc = 30 is outside 39..10000");
  EXPECT_EQ(said("\"nbrOfRows\": 32768", "\"nbrOfRows\": 49152"),
            "bad.json: memarchitecturespec.nbrOfRows: error: memory.rows = 49152 is not a power of 2");
  EXPECT_EQ(said("\"idd4r\": 184.5e-3", "\"idd4r\": 40e-3"),
            "bad.json: mempowerspec.idd4r: error: power.rail.0.idd4r = 40 is below 44");
  EXPECT_NE(said("\"tCK\": 833e-12", "\"tCK\": 625").find("memtimingspec.tCK: error: memory.mhz = 0"),
            std::string::npos);
  EXPECT_NE(said("\"RAS\": 39", "\"RAS\": 38.5").find("memtimingspec.RAS = 38.5 is not a whole number"),
            std::string::npos);
  EXPECT_NE(said("\"RAS\": 39", "\"RAS\": \"39\"").find("memtimingspec.RAS is not a number"),
            std::string::npos);
  EXPECT_NE(said("\"DDR4\"", "\"STT-MRAM\"").find("\"STT-MRAM\" is not read; there are DDR3, DDR4, LPDDR4"),
            std::string::npos);
  EXPECT_NE(said("\"RefMode\": 1", "\"RefMode\": 2").find("RefMode"), std::string::npos);
  EXPECT_NE(said("\"memspec\"", "\"simulation\"").find("memspec is missing"), std::string::npos);
  EXPECT_NE(said("\"memspec\": {", "\"memspec\": [").find("no JSON"), std::string::npos);
  EXPECT_NE(complaint("[]", "bad.json").find("memspec is missing"), std::string::npos);
}

TEST(Import, YamlIsRefusedByItsLine) {
  const auto said = [](const std::string& old, const std::string& now) {
    return complaint(replaced(kRamulator, old, now), "bad.yaml");
  };
  EXPECT_EQ(said("impl: DDR4", "impl: HBM2"),
            "bad.yaml:12:5: error: MemorySystem.DRAM.impl = \"HBM2\" is not read; only DDR4 is");
  EXPECT_NE(said("DDR4_8Gb_x8", "DDR4_3Gb_x8").find("bad.yaml:14:"), std::string::npos);
  EXPECT_NE(said("DDR4_2400U", "DDR4_2400Z").find("timing.preset = \"DDR4_2400Z\" is not known"),
            std::string::npos);
  EXPECT_NE(said("preset: \"DDR4_2400U\"", "rate: 2400").find("MemorySystem.DRAM.timing.nCL is missing"),
            std::string::npos);
  EXPECT_NE(said("rank: 1", "rank: 1\n      ranks: 2").find("unknown key MemorySystem.DRAM.org.ranks"),
            std::string::npos);
  EXPECT_NE(said("rank: 1", "rank: {a: 1}").find("bad.yaml:16:"), std::string::npos);
  EXPECT_NE(said("rank: 1", "rank: &one 1").find("a form that this reader does not know"), std::string::npos);
  EXPECT_NE(said("rank: 1", "rank: 1\n      rank: 2").find("stands there twice"), std::string::npos);
  EXPECT_NE(said("      rank: 1", "       rank: 1").find("indented below a value"), std::string::npos);
  EXPECT_NE(said("      rank: 1", "\t rank: 1").find("a tab indents it"), std::string::npos);
  EXPECT_NE(said("\"DDR4_2400U\"", "\"DDR4_2400U").find("a quote does not end"), std::string::npos);
  EXPECT_NE(said("- example_inst.trace", "- a: b").find("a list has plain values here"), std::string::npos);
  EXPECT_NE(said("rank: 1", "rank: 3").find("memory.ranks = 3 is not a power of 2"), std::string::npos);
  EXPECT_NE(said("MemorySystem:", "Memory:").find("MemorySystem is missing"), std::string::npos);
  EXPECT_NE(complaint("", "bad.yaml").find("MemorySystem is missing"), std::string::npos);
}

}  // namespace
}  // namespace voxmelt::hwmodel
