// Exported fields are compared byte by byte, and output folders are never half-written.
#include "kernel/run/io/export.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <tuple>

#include "kernel/run/io/output_folder.h"
#include "kernel/run/io/vti.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;
using namespace worlds;

class Export : public testing::Test {
 protected:
  Export()
      : folder_(fs::temp_directory_path() / ("voxmelt_io_test_" + std::to_string(::getpid()) + "_" +
                                             testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Export() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string read(const fs::path& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  fs::path folder_;
};

Volume sample() {
  Volume v(Grid{3, 2, 2});
  put(v, 1, 0, 0, 0x1234, 0x0102, 0xFFFE);
  put_solid(v, 2, 1, 0, 4096, 7);
  put_inert(v, 0, 0, 1);
  return v;
}

TEST_F(Export, NpyIsCOrderZYXLittleEndian) {
  export_npy(sample(), folder_);
  for (const auto& [name, type, size] : {std::tuple{"solid", "'|u1'", 1u},
                                         {"liquid", "'|u1'", 1u},
                                         {"inert", "'|u1'", 1u},
                                         {"amount", "'<u2'", 2u},
                                         {"energy", "'<u2'", 2u},
                                         {"heat", "'<u2'", 2u}}) {
    const std::string bytes = read(std::string(name) + ".npy");
    ASSERT_GE(bytes.size(), 10u);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t header =
        10 + static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ(header % 64, 0u);
    EXPECT_EQ(bytes[header - 1], '\n');
    EXPECT_NE(bytes.find(type), std::string::npos) << name;
    EXPECT_NE(bytes.find("(2, 2, 3)"), std::string::npos);
    EXPECT_NE(bytes.find("'fortran_order': False"), std::string::npos);
    EXPECT_EQ(bytes.size(), header + 12u * size) << name;
  }
  const std::string amount = read("amount.npy");
  EXPECT_EQ(amount.substr(amount.size() - 24 + 2, 2), "\x34\x12");
  EXPECT_EQ(amount.substr(amount.size() - 24 + 10, 2), std::string("\x00\x10", 2));
  const std::string solid = read("solid.npy"), liquid = read("liquid.npy"), inert = read("inert.npy");
  EXPECT_EQ(solid[solid.size() - 12 + 5], 1);
  EXPECT_EQ(liquid[liquid.size() - 12 + 1], 1);
  EXPECT_EQ(inert[inert.size() - 12 + 6], 1);
}

// The arrays themselves are read by tests/app/write_test.py, with zlib and with VTK.
TEST_F(Export, VtiSaysTheSizesOfItsBlocks) {
  const Volume volume = sample();
  Moment moment(volume);
  moment.step = 31;
  find_format("vti")->write(moment, folder_, {});
  const std::string vti = read("volume.vti");
  EXPECT_NE(vti.find("WholeExtent=\"0 3 0 2 0 2\""), std::string::npos);
  EXPECT_NE(vti.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">31<"), std::string::npos);
  std::size_t at = vti.find("encoding=\"raw\">\n_") + 17;
  for (const std::uint64_t bytes : {12u, 12u, 12u, 24u, 24u, 24u}) {  // three masks, three numbers
    std::uint64_t header[4];  // blocks, their size, that of the last one, and when packed
    ASSERT_LE(at + sizeof header, vti.size());
    std::memcpy(header, vti.data() + at, sizeof header);
    EXPECT_EQ(header[0], 1u);
    EXPECT_EQ(header[1], 1u << 20);
    EXPECT_EQ(header[2], bytes);
    EXPECT_EQ(vti[at + sizeof header], '\x78') << "a zlib stream";
    at += sizeof header + header[3];
  }
  EXPECT_EQ(vti.substr(at), "\n  </AppendedData>\n</VTKFile>\n");
}

// VTK itself reads all of them in tests/app/write_test.py.
TEST_F(Export, VtiHasTheParameters) {
  const Volume volume = sample();
  rule::Parameters parameters;
  parameters.vents.resize(2);
  parameters.vents[0].region.at = {1, 2, 3};
  parameters.vents[1].region.at = {4, 5, 6};
  parameters.open_border = true;
  Moment moment(volume);
  moment.parameters = &parameters;
  moment.version = "9.8.7";
  moment.scene = "hi";
  find_format("vti")->write(moment, folder_, {});
  const std::string vti = read("volume.vti");
  for (const char* const line :
       {"<Array type=\"String\" Name=\"version\" NumberOfTuples=\"1\" format=\"ascii\">57 46 56 46 55 "
        "0</Array>",
        "<Array type=\"String\" Name=\"scene\" NumberOfTuples=\"1\" format=\"ascii\">104 105 0</Array>",
        "<Array type=\"String\" Name=\"border\" NumberOfTuples=\"1\" format=\"ascii\">111 112 101 110 "
        "0</Array>",
        "<DataArray type=\"Int64\" Name=\"vents.at\" NumberOfComponents=\"3\" NumberOfTuples=\"2\" "
        "format=\"ascii\">1 2 3 4 5 6</DataArray>",
        "<DataArray type=\"Int64\" Name=\"seed\" NumberOfTuples=\"1\" format=\"ascii\">1</DataArray>"})
    EXPECT_NE(vti.find(line), std::string::npos) << line;
  EXPECT_EQ(vti.find("Name=\"grid\""), std::string::npos);
}

// A state whose packed blocks are not kept is packed twice, for the same file.
TEST_F(Export, VtiIsTheSameHoweverMuchIsKept) {
  Volume volume(Grid{200, 100, 110});
  for (int z = 0; z < 110; ++z)
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 200; ++x)
        if ((x * y + z) % 7 == 0) put(volume, x, y, z, (x * 31 + y * 17 + z * 5) % 4096, 0, x);
  write_vti(volume, folder_, {}, std::size_t{64} << 20);
  const std::string kept = read("volume.vti");
  EXPECT_LT(kept.size(), 6'000'000u);
  for (const std::size_t most : {0, 300'000}) {
    write_vti(volume, folder_, {}, most);
    EXPECT_TRUE(read("volume.vti") == kept) << most;
  }
}

// Each format writes into a folder that holds nothing else, so that no two formats can be one.
TEST_F(Export, NrrdHoldsTheSameBytes) {
  find_format("nrrd")->write(sample(), folder_, {});
  const std::string amount = read("amount.nrrd"), solid = read("solid.nrrd");
  EXPECT_EQ(amount.substr(0, amount.size() - 24),
            "NRRD0004\ncontent: amount\ntype: uint16\ndimension: 3\nsizes: 3 2 2\nspacings: 1 1 1\n"
            "labels: \"x\" \"y\" \"z\"\nendian: little\nencoding: raw\n\n");
  EXPECT_EQ(amount.substr(amount.size() - 24 + 2, 2), "\x34\x12");
  EXPECT_NE(solid.find("\ntype: uint8\n"), std::string::npos);
  EXPECT_EQ(solid.substr(solid.size() - 12), std::string("\0\0\0\0\0\1\0\0\0\0\0\0", 12));
}

// A member that is not packed is there as it is, after a header that ends in its name.
TEST_F(Export, NpzHoldsTheNpyFiles) {
  fs::create_directories(folder_ / "npz");
  find_format("npz")->write(sample(), folder_ / "npz", {});
  export_npy(sample(), folder_);
  const std::string npz = read("npz/fields.npz");
  EXPECT_EQ(npz.substr(0, 4), "PK\x03\x04");
  for (const char* name : {"solid.npy", "liquid.npy", "inert.npy", "amount.npy", "energy.npy", "heat.npy"})
    EXPECT_NE(npz.find(name + read(name)), std::string::npos) << name;
  EXPECT_EQ(npz.substr(npz.size() - 22, 4), "PK\x05\x06");
  EXPECT_EQ(npz.substr(npz.size() - 12, 2), std::string("\6\0", 2)) << "members";
}

// Summed by hand: 4660 + 4096, and 4660 * 65534 + 4096 * 7.
TEST_F(Export, CsvHasTheBooks) {
  const Volume volume = sample();
  Moment moment(volume);
  moment.step = 12;
  moment.seconds_per_step = 1.0 / 64;
  find_format("csv")->write(moment, folder_, {});
  const std::string csv = read("steps.csv");
  const std::size_t end = csv.find('\n') + 1;
  EXPECT_EQ(csv.substr(0, end),
            "step,seconds_per_step,solid_cells,liquid_cells,solid_mass,liquid_mass,mass,mass_start,"
            "mass_added,mass_removed,energy,energy_start,energy_melted,energy_frozen,energy_added,"
            "energy_removed,energy_reheated,energy_accelerated,energy_dissipated,energy_capped,heat,"
            "heat_start,heat_conducted,heat_walls,heat_convected,heat_radiated,heat_warmed,heat_cooled,"
            "heat_melted,heat_added,heat_removed,heat_rounded\n");
  EXPECT_EQ(csv.substr(end),
            "12,0.015625,1,1,4096,4660,8756,8756,0,0,258,258,0,0,0,0,0,0,0,0,305417112,305417112,"
            "0,0,0,0,0,0,0,0,0,0\n");
}

TEST_F(Export, EveryFormatHasANameOfItsOwnAndWrites) {
  std::set<std::string> all;
  for (const Format& format : formats()) {
    EXPECT_TRUE(all.emplace(format.name).second) << format.name << " is there twice";
    EXPECT_EQ(find_format(format.name), &format);
    EXPECT_FALSE(format.description.empty()) << format.name;
    if (format.missing != nullptr && !format.missing().empty()) continue;  // of another program
    const fs::path folder = folder_ / std::string(format.name);
    fs::create_directories(folder);
    format.write(sample(), folder, {});
    EXPECT_FALSE(fs::is_empty(folder)) << format.name;
  }
  EXPECT_EQ(formats().front().name, "npy");
  EXPECT_EQ(find_format("tiff"), nullptr);
  EXPECT_EQ(find_format(""), nullptr);
}

bool names(const std::string& json, const std::string& key) {
  for (std::size_t at = json.find(key + "\":"); at != std::string::npos; at = json.find(key + "\":", at + 1))
    if (json[at - 1] == '"') return true;
  return false;
}

TEST(ParametersJson, NamesEverythingOfSection14) {
  Parameters p = paper_showcase();
  p.seed = ~std::uint64_t{0};
  using enum rule::SourceKind;
  p.heat.sources = {{{{3, {1, -2, 3}, (std::uint64_t{1} << 50) - 1}}},
                    {{{.step = 4, .at = {7, 8, 9}, .power = 10, .radius = 987}}, sphere},
                    {{{.step = 5, .power = 11, .direction = {-654, 321, 0}}}, directional},
                    {{{.step = 6, .power = 12}}, sky}};
  p.vents = {{}};
  p.drains = {{}};
  p.open_border = true;
  p.pieces = {true, 321, 43210};
  p.material.freezing_point = 12345;
  p.heat.air_glow = 4321;
  p.heat.air_sky = 23456;
  const std::string json = parameters_json(p, {3, 4, 5}, 17);
  for (const char* key : {"grid",
                          "border",
                          "step",
                          "seed",
                          "material",
                          "melting_point",
                          "latent_heat",
                          "freezing_point",
                          "pieces",
                          "in_liquid",
                          "density",
                          "heat",
                          "enabled",
                          "neighbours",
                          "weight_face",
                          "weight_edge",
                          "weight_corner",
                          "convection",
                          "walls",
                          "radiation",
                          "visibility_every",
                          "rays_per_face",
                          "sources",
                          "keys",
                          "at",
                          "power",
                          "radius",
                          "direction",
                          "kind",
                          "air",
                          "air_exchange",
                          "air_temperature",
                          "air_glow",
                          "air_sky",
                          "vents",
                          "radius",
                          "rate",
                          "temperature",
                          "energy",
                          "from",
                          "until",
                          "drains",
                          "flow",
                          "law",
                          "fall",
                          "factor",
                          "wall_factor",
                          "minimum",
                          "hang",
                          "paper",
                          "threshold",
                          "use_table",
                          "table",
                          "share",
                          "downhill",
                          "margin",
                          "support",
                          "slump",
                          "beta",
                          "alpha_liquid",
                          "alpha_solid",
                          "alpha_floor",
                          "reheat",
                          "viscous",
                          "mobility",
                          "yield",
                          "stiffness",
                          "substeps",
                          "substeps_max",
                          "stages_max",
                          "thermal_viscosity",
                          "mobility_table",
                          "mobility_reference",
                          "mobility_rate"})
    EXPECT_TRUE(names(json, key)) << key;
  std::string dense;
  for (const char c : json)
    if (c != ' ' && c != '\n') dense += c;
  EXPECT_NE(
      dense.find("[{\"keys\":[{\"step\":3,\"at\":[1,-2,3],\"power\":1125899906842623}]},"
                 "{\"kind\":\"sphere\",\"keys\":[{\"step\":4,\"at\":[7,8,9],\"radius\":987,\"power\":10}]},"
                 "{\"kind\":\"directional\",\"keys\":[{\"step\":5,\"direction\":[-654,321,0],\"power\":11}]},"
                 "{\"kind\":\"sky\",\"keys\":[{\"step\":6,\"power\":12}]}]"),
      std::string::npos)
      << dense;
  for (const char* value :
       {"\"seed\": 18446744073709551615", "\"step\": 17", "\"power\": 1125899906842623", "\"law\": \"paper\"",
        "\"border\": \"open\"", "\"freezing_point\": 12345", "\"air_glow\": 4321", "\"air_sky\": 23456",
        "\"in_liquid\": 321", "\"density\": 43210"})
    EXPECT_NE(json.find(value), std::string::npos) << value;
}

TEST_F(Export, AnOutputFolderAppearsWholeOrNotAtAll) {
  const fs::path place = folder_ / "out";
  {
    OutputFolder out(place);
    write_file(out.partial() / "a", "1");
    EXPECT_FALSE(fs::exists(place));
  }
  EXPECT_TRUE(fs::is_empty(folder_)) << "not committed: nothing is left";
  {
    OutputFolder out(place);
    write_file(out.partial() / "a", "1");
    out.commit();
  }
  EXPECT_EQ(read("out/a"), "1");
  {
    OutputFolder out(place);  // our own output is replaced whole
    write_file(out.partial() / "b", "2");
    out.commit();
  }
  EXPECT_FALSE(fs::exists(place / "a"));
  EXPECT_EQ(read("out/b"), "2");
}

TEST_F(Export, ForeignFilesAreNotTouched) {
  fs::create_directories(folder_ / "mine");
  std::ofstream(folder_ / "mine" / "letter") << "dear";
  EXPECT_THROW(OutputFolder(folder_ / "mine"), OutputError);
  EXPECT_THROW(OutputFolder(folder_ / "mine" / "letter"), OutputError);
  EXPECT_EQ(read("mine/letter"), "dear");
}

TEST(WriteFile, SaysWhyItCannot) {
  try {
    write_file("/nonexistent folder/x", "1");
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_FALSE(error.out_of_space());
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos);
  }
}

}  // namespace
}  // namespace voxmelt::io
