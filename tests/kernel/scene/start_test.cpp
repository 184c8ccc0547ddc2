// A scene may start from exported fields, and bad ones are refused.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/kernel/scene/scene_text.h"

namespace voxmelt::scene {
namespace {

class Fields {
 public:
  explicit Fields(const SceneFolder& folder) : folder_(folder) {
    for (const char* mask : {"solid", "liquid", "inert"}) write(mask, "|u1", std::string(8, '\0'));
    for (const char* field : {"amount", "energy", "heat"}) write(field, "<u2", std::string(16, '\0'));
  }

  void write(const std::string& field, const std::string& type, const std::string& data,
             const std::string& shape = "(2, 2, 2)") const {
    std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header += std::string(118 - header.size() - 1, ' ') + "\n";
    folder_.write("fields/" + field + ".npy", std::string("\x93NUMPY\x01\x00", 8) +
                                                  static_cast<char>(header.size()) + '\0' + header + data);
  }
  // Writes another header: its version, and the whole dictionary.
  void write_headed(const std::string& field, char version, std::string header,
                    const std::string& data) const {
    header += std::string(119 - header.size(), ' ') + "\n";
    std::string length{static_cast<char>(header.size()), '\0'};
    if (version > 1) length += std::string(2, '\0');
    folder_.write("fields/" + field + ".npy",
                  "\x93NUMPY" + std::string{version, '\0'} + length + header + data);
  }
  void remove(const std::string& field) const {
    std::filesystem::remove(folder_.path() / "fields" / (field + ".npy"));
  }

 private:
  const SceneFolder& folder_;
};

const std::string kStartScene = "[grid]\nsize = [2, 2, 2]\n[start]\nfields = \"fields\"\n";

TEST(Start, FieldsReplaceTheShapes) {
  const SceneFolder folder;
  const Fields fields(folder);
  fields.write("solid", "|u1", std::string("\1\0\0\0\0\0\0\0", 8));
  fields.write("liquid", "|u1", std::string("\0\0\0\0\0\0\0\1", 8));
  fields.write("amount", "<u2",
               std::string("\0\x10", 2) + std::string(12, '\0') + std::string("\x34\x12", 2));
  const state::Volume volume = folder.load_text(kStartScene).initial;
  EXPECT_TRUE(volume.solid.test(0, 0, 0));
  EXPECT_TRUE(volume.liquid.test(1, 1, 1));
  EXPECT_EQ(volume.amount[volume.at(0, 0, 0)], 4096);
  EXPECT_EQ(volume.amount[volume.at(1, 1, 1)], 0x1234);
}

TEST(Start, EveryFieldOfEveryCellIsRead) {
  const SceneFolder folder;
  const Fields fields(folder);
  const auto numbers = [](int first) {  // little endian, one more in every cell
    std::string data;
    for (int i = first; i < first + 8; ++i) data += {static_cast<char>(i & 0xFF), static_cast<char>(i >> 8)};
    return data;
  };
  fields.write("liquid", "|u1", std::string(8, '\1'));
  fields.write("amount", "<u2", numbers(4000));
  fields.write("energy", "<u2", numbers(2000));
  fields.write("heat", "<u2", numbers(50000));
  const state::Volume volume = folder.load_text(kStartScene + "[heat]\ngamma = 0.1\n").initial;
  for (int i = 0; i < 8; ++i) {
    const state::Slot cell = volume.at(i & 1, i >> 1 & 1, i >> 2);  // x fastest, z outermost
    EXPECT_EQ(volume.amount[cell], 4000 + i);
    EXPECT_EQ(volume.energy[cell], 2000 + i);
    EXPECT_EQ(volume.heat[cell], 50000 + i);
  }
}

TEST(Start, AFolderOfVersion01CallsHeatTemperature) {
  const SceneFolder folder;
  const Fields fields(folder);
  fields.write("liquid", "|u1", std::string(8, '\1'));
  fields.write("amount", "<u2", std::string(16, '\1'));
  fields.write("temperature", "<u2", std::string(16, '\2'));
  const std::string scene = kStartScene + "[heat]\ngamma = 0.1\n";
  EXPECT_EQ(folder.load_text(scene).initial.heat[state::Slot{}], 0) << "heat.npy is there, and wins";
  fields.remove("heat");
  EXPECT_EQ(folder.load_text(scene).initial.heat[state::Slot{}], 0x0202);
}

TEST(Start, WhatIsDroppedIsSaid) {
  const SceneFolder folder;
  const Fields fields(folder);
  fields.write("liquid", "|u1", std::string(8, '\1'));
  fields.write("amount", "<u2", std::string(16, '\1'));
  fields.write("energy", "<u2", std::string(6, '\1') + std::string(10, '\0'));
  fields.write("heat", "<u2", std::string(2, '\1') + std::string(14, '\0'));
  const std::string no_heat = "start.fields: heat of 1 cell dropped: the scene has no [heat]";
  using Lines = std::vector<std::string>;
  EXPECT_EQ(folder.load_text(kStartScene).warnings, Lines{no_heat});
  const scene::Scene viscous =
      folder.load_text(kStartScene + "[flow]\nlaw = \"viscous\"\nviscous = {kappa = 0.1}\n");
  EXPECT_EQ(viscous.warnings,
            (Lines{"start.fields: energy of 3 cells dropped: the viscous law has no energy", no_heat}));
  EXPECT_EQ(viscous.initial.energy[state::Slot{}], 0);
  EXPECT_EQ(folder.load_text(kStartScene + "[heat]\ngamma = 0.1\n").warnings, Lines{});
}

// The cell (x, y, z) = (1, 0, 0) alone is liquid and full: 4096 is 0x1000. NumPy's description of its format
// has versions, types and orders.
TEST(Start, ArraysAreReadAsNumpyWritesThem) {
  const SceneFolder folder;
  const Fields fields(folder);
  const auto digest_of = [&](const std::string& liquid, const std::string& amount, char version = 1,
                             const char* order = "False", char quote = '\'') {
    const auto dictionary = [&](const char* type) {
      std::string text = std::string("{\"descr\": \"") + type + "\", \"fortran_order\": " + order +
                         ", \"shape\": (2, 2, 2), }";
      std::ranges::replace(text, '"', quote);
      return text;
    };
    const std::size_t split = liquid.find(':'), other = amount.find(':');
    fields.write_headed("liquid", version, dictionary(liquid.substr(0, split).c_str()),
                        liquid.substr(split + 1));
    fields.write_headed("amount", version, dictionary(amount.substr(0, other).c_str()),
                        amount.substr(other + 1));
    const scene::Scene scene = folder.load_text(kStartScene);
    EXPECT_TRUE(scene.initial.liquid.test(1, 0, 0));
    EXPECT_EQ(scene.initial.liquid.count(), 1);
    EXPECT_EQ(scene.initial.amount[scene.initial.at(1, 0, 0)], 4096);
  };
  // The element at `at` of eight, each of `bytes`, is `value`.
  const auto data = [](std::size_t at, const std::string& value) {
    std::string all(8 * value.size(), '\0');
    return all.replace(at * value.size(), value.size(), value);
  };
  const std::string one(1, '\1'), little("\0\x10", 2), big("\x10\0", 2), wide("\0\x10\0\0\0\0\0\0", 8),
      wide_big("\0\0\0\0\0\0\x10\0", 8);
  digest_of("|u1:" + data(1, one), "<u2:" + data(1, little));
  digest_of("|b1:" + data(1, one), ">u2:" + data(1, big));
  digest_of("|i1:" + data(1, one), "<i8:" + data(1, wide));
  digest_of("|b1:" + data(1, one), ">i8:" + data(1, wide_big));
  digest_of("|b1:" + data(1, one), "<u2:" + data(1, little), 2);
  digest_of("|b1:" + data(1, one), "<u2:" + data(1, little), 3, "False", '"');
  digest_of("|b1:" + data(4, one), "<u2:" + data(4, little), 1, "True");  // z runs fastest
}

TEST(Start, NumbersThatNoFieldHoldsAreRefused) {
  const SceneFolder folder;
  const Fields fields(folder);
  const std::string place = "scene.toml:4:10: error: fields/amount.npy: ";
  const auto error = [&](const char* type, const std::string& data, char version = 1) {
    fields.write_headed(
        "amount", version,
        std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': (2, 2, 2), }", data);
    return folder.error_of(kStartScene);
  };
  EXPECT_EQ(error("<i2", std::string(10, '\0') + "\xff\xff" + std::string(4, '\0')),
            place + "[1][0][1] = -1 is outside 0..65535");
  EXPECT_EQ(error("<u4", std::string(2, '\0') + '\1' + std::string(29, '\0')),
            place + "[0][0][0] = 65536 is outside 0..65535");
  EXPECT_EQ(error("<u8", std::string(64, '\xff')),
            place + "[0][0][0] = 9223372036854775807 is outside 0..65535");
  EXPECT_EQ(error("<u2", std::string(16, '\0'), 4), place + "npy format 4.0 is not known");
}

TEST(Start, BadFieldsAreRefused) {
  const SceneFolder folder;
  const Fields good(folder);
  EXPECT_EQ(folder.error_of(kStartScene), "");
  const std::string place = "scene.toml:4:10: error: fields";
  const auto error = [&](const char* field, const char* type, const std::string& data,
                         const char* shape = "(2, 2, 2)") {
    const Fields fields(folder);
    fields.write(field, type, data, shape);
    return folder.error_of(kStartScene);
  };
  EXPECT_EQ(error("solid", "|u1", std::string(8, '\2')),
            place + "/solid.npy: cell (0, 0, 0) is 2, not 0 or 1");
  EXPECT_EQ(error("solid", "<f8", std::string(64, '\0')),
            place + "/solid.npy: type <f8: the numbers must be whole, as in array.astype(numpy.uint8)");
  EXPECT_EQ(error("amount", "<u2", std::string(16, '\0'), "(2, 4, 1)"),
            place + "/amount.npy: shape (2,4,1) instead of (2,2,2) (z, y, x of grid.size)");
  EXPECT_EQ(error("amount", "<u2", std::string(15, '\0')),
            place + "/amount.npy: 15 bytes of data instead of 16");
  EXPECT_EQ(
      error("amount", "<u2", std::string(16, '\1')),
      place +
          ": cell (0, 0, 0) breaks a rule: liquid exactly where there is an amount, neither solid nor inert");
  EXPECT_EQ(error("energy", "<u2", std::string(16, '\1')),
            place + ": cell (0, 0, 0) breaks a rule: energy not more than the amount");
  EXPECT_EQ(error("heat", "<u2", std::string(16, '\1')),
            place + ": cell (0, 0, 0) breaks a rule: no heat without an amount");
  folder.write("fields/inert.npy", "junk");
  EXPECT_EQ(folder.error_of(kStartScene), place + "/inert.npy: not an npy file");
}

}  // namespace
}  // namespace voxmelt::scene
