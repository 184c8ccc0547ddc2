#include "hwmodel/explore/device.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/error.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr std::int64_t kMost = 100'000'000;
constexpr int kWidest = 1 << 20;

std::string names_of(const std::vector<NamedText>& files) {
  std::string names;
  for (const NamedText& file : files) names += (names.empty() ? "" : ", ") + file.name;
  return names;
}

// Reads a file that came with the program, or one of the user's.
scene::Value document_of(const std::vector<NamedText>& files, const std::string& folder,
                         const std::string& name, const std::string& place, const std::string& what) {
  if (name.ends_with(".toml")) return scene::parse_file(name);
  const auto at =
      std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
  if (at == files.end())
    throw scene::InputError(place + ": error: no " + what + " \"" + name + "\"; there are " +
                            names_of(files) + ", or a file that ends in .toml");
  return scene::parse_text(at->text, std::make_shared<const scene::Origin>(scene::Origin{
                                         "hwmodel/explore/" + folder + "/" + name + ".toml", {}, false}));
}

int whole(scene::Reader& from, const char* key, int low, int high) { return from.integer(key, low, high); }

scene::Reader table_of(scene::Reader& from, const std::string& key) {
  std::optional<scene::Reader> table = from.table(key);
  if (!table) from.fail(key, ": the file has no such table");
  return *table;
}

std::vector<std::array<int, 2>> pairs(scene::Reader& from, const char* key) {
  std::vector<std::array<int, 2>> found;
  const std::vector<double> numbers = from.rows(key, 2, 0, 64, scene::at_least(1).at_most(kWidest));
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
    found.push_back({static_cast<int>(numbers[i]), static_cast<int>(numbers[i + 1])});
  return found;
}

LogicCost logic(scene::Reader& from) {
  from.knows(std::array{"lut", "ff", "source"});
  LogicCost cost;
  cost.lut = from.integer("lut", 0, kMost);
  cost.ff = from.integer("ff", 0, kMost);
  cost.source = from.text("source");
  for (const char* kind : {"synthesised", "counted", "assumed"})
    if (cost.source.starts_with(kind)) return cost;
  from.fail("source", ": it must begin with synthesised, counted or assumed");
}

LogicCost logic_of(scene::Reader& root, const char* key) {
  scene::Reader table = table_of(root, key);
  const LogicCost cost = logic(table);
  table.finish();
  return cost;
}

void read_memories(scene::Reader& from, Family& f) {
  from.knows(
      std::array{"bram_parts", "bram_shapes", "uram_shapes", "lutram_words", "lutram_bits", "lutram_luts"});
  f.bram_parts = whole(from, "bram_parts", 1, 16);
  for (const auto& [bits, words] : pairs(from, "bram_shapes")) f.bram.push_back({bits, words});
  for (const auto& [bits, words] : pairs(from, "uram_shapes")) f.uram.push_back({bits, words});
  f.lutram_words = whole(from, "lutram_words", 1, 4096);
  f.lutram_bits = whole(from, "lutram_bits", 1, 4096);
  f.lutram_luts = whole(from, "lutram_luts", 1, 4096);
  f.mux_ways = whole(from, "mux_ways", 2, 64);
  f.deepest_lutram = whole(from, "deepest_lutram", 1, kWidest);
  f.register_words = whole(from, "register_words", 1, 64);
  from.finish();
}

void read_stages(scene::Reader& root, Family& f) {
  scene::Reader stages = table_of(root, "stage");
  for (int i = 0; i <= static_cast<int>(StageKind::writer); ++i) {
    const auto kind = static_cast<StageKind>(i);
    if (!is_stage(kind)) continue;
    scene::Reader table = table_of(stages, std::string(name_of(kind)));
    StageCost& cost = f.stages[kind];
    cost.lane = logic(table);
    for (const auto& [wide, narrow] : pairs(table, "multipliers")) cost.multipliers.push_back({wide, narrow});
    table.finish();
  }
  stages.finish();
}

Family load_family(const std::string& name, const std::string& place) {
  const scene::Value document = document_of(family_files(), "families", name, place, "family");
  Family f;
  f.name = name;
  scene::Reader root(document, "");
  f.title = root.text("title", "");
  scene::Reader memory = table_of(root, "memory"), product = table_of(root, "product"),
                port = table_of(root, "port");
  read_memories(memory, f);
  f.product = {whole(product, "wide", 2, 256), whole(product, "narrow", 2, 256)};
  product.finish();
  f.divider = logic_of(root, "divider");
  f.random_block = logic_of(root, "random_block");
  f.channel = logic_of(root, "channel");
  f.base = logic_of(root, "base");
  f.coder = logic_of(root, "coder");
  f.port = logic(port);
  f.port_bits = whole(port, "buffer_bits", 1, kWidest);
  f.port_words = whole(port, "buffer_words", 1, kWidest);
  port.finish();
  read_stages(root, f);
  root.finish();
  return f;
}

}  // namespace

Amounts Device::usable() const {
  Amounts result = amounts;
  for (const Resource logic : {kLut, kFf})
    result[logic] = static_cast<std::int64_t>(std::floor(static_cast<double>(result[logic]) * fill + 1e-9));
  return result;
}

Device load_device(const std::string& name, const std::vector<std::string>& overrides) {
  scene::Value document = document_of(device_files(), "devices", name, "--device " + name, "device");
  for (const std::string& assignment : overrides) scene::apply_override(document, assignment);
  Device d;
  d.name = name;
  scene::Reader root(document, "");
  d.title = root.text("title", "");
  scene::Reader from = table_of(root, "device");
  from.knows(std::array{"family", "lut", "ff", "dsp", "bram", "uram", "lutram", "clock", "fill"});
  const std::string family = from.text("family");
  for (std::size_t r = 0; r < kResources; ++r) d.amounts[r] = from.integer(kResourceNames[r], 0, kMost);
  d.lutram = from.integer("lutram", 0, kMost);
  d.clock_mhz = whole(from, "clock", 1, 10000);
  d.fill = from.number("fill", scene::at_least(0.01).at_most(1));
  from.finish();
  root.finish();
  d.family = load_family(family, from.place("family").text());
  return d;
}

}  // namespace voxmelt::hwmodel::explore
