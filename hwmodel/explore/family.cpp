#include "hwmodel/explore/family.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hwmodel/explore/read_file.h"
#include "hwmodel/explore/read_number.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr int kWidest = 1 << 20;

int whole(scene::Reader& from, const char* key, int low, int high) { return from.integer(key, low, high); }

template <std::size_t Width>
std::vector<std::array<int, Width>> rows(scene::Reader& from, const char* key, std::size_t fewest = 0) {
  const std::vector<double> numbers = from.rows(key, Width, fewest, 64, scene::at_least(1).at_most(kWidest));
  std::vector<std::array<int, Width>> found(numbers.size() / Width);
  for (std::size_t i = 0; i < numbers.size(); ++i) found[i / Width][i % Width] = static_cast<int>(numbers[i]);
  return found;
}

// Where flip-flops have a source of their own, the other one is that of the LUTs.
LogicCost logic(scene::Reader& from, const Given& given) {
  from.knows(std::array{"lut", "ff", "source", "ff_source", "lut_range", "ff_range"});
  const std::string source = read_source(from, "source");
  return {read_logic(from, "lut", source, given), read_logic(from, "ff", source, given)};
}

LogicCost logic_of(scene::Reader& root, const char* key, const Given& given) {
  scene::Reader table = table_of(root, key);
  const LogicCost cost = logic(table, given);
  table.finish();
  return cost;
}

void read_memories(scene::Reader& from, Family& f) {
  from.knows(
      std::array{"bram_parts", "byte_bits", "part_mux_bits", "bram_shapes", "uram_shapes", "lutram_shapes"});
  f.bram_parts = whole(from, "bram_parts", 1, 16);
  f.byte_bits = whole(from, "byte_bits", 1, 72);
  f.part_mux_bits = whole(from, "part_mux_bits", 1, kWidest);
  for (const auto& [bits, words] : rows<2>(from, "bram_shapes")) f.bram.push_back({bits, words});
  for (const auto& [bits, words] : rows<2>(from, "uram_shapes")) f.uram.push_back({bits, words});
  for (const auto& [bits, words, luts] : rows<3>(from, "lutram_shapes", 1))
    f.lutram.push_back({bits, words, luts});
  f.mux_ways = whole(from, "mux_ways", 2, 64);
  f.deepest_lutram = whole(from, "deepest_lutram", 1, kWidest);
  f.register_words = whole(from, "register_words", 1, 64);
  from.finish();
}

void read_stages(scene::Reader& root, Family& f, const Given& given) {
  scene::Reader stages = table_of(root, "stage");
  for (int i = 0; i <= static_cast<int>(StageKind::writer); ++i) {
    const auto kind = static_cast<StageKind>(i);
    if (!is_stage(kind)) continue;
    scene::Reader table = table_of(stages, std::string(name_of(kind)));
    StageCost& cost = f.stages[kind];
    cost.lane = logic(table, given);
    for (const auto& [wide, narrow] : rows<2>(table, "multipliers"))
      cost.multipliers.push_back({wide, narrow});
    if (table.has("dsp")) {
      const std::array<double, 2> synthesised = table.vector<2>("dsp", scene::at_least(1).at_most(kWidest));
      cost.products = static_cast<int>(synthesised[0]);
      cost.dsps = static_cast<int>(synthesised[1]);
    }
    table.finish();
  }
  stages.finish();
}

}  // namespace

Family load_family(const std::string& name, const std::string& place,
                   const std::vector<std::string>& overrides) {
  scene::Value document = read_file(family_files(), "families", name, place, "family");
  const Given given = override_file(document, overrides);
  Family f;
  f.name = name;
  scene::Reader root(document, "");
  f.title = root.text("title", "");
  scene::Reader memory = table_of(root, "memory"), product = table_of(root, "product"),
                port = table_of(root, "port");
  read_memories(memory, f);
  f.product = {whole(product, "wide", 2, 256), whole(product, "narrow", 2, 256)};
  product.finish();
  f.control = logic_of(root, "control", given);
  f.divider = logic_of(root, "divider", given);
  f.random_block = logic_of(root, "random_block", given);
  f.channel = logic_of(root, "channel", given);
  f.base = logic_of(root, "base", given);
  f.coder = logic_of(root, "coder", given);
  f.port = logic(port, given);
  f.port_bits = whole(port, "buffer_bits", 1, kWidest);
  f.port_words = whole(port, "buffer_words", 1, kWidest);
  port.finish();
  read_stages(root, f, given);
  root.finish();
  return f;
}

}  // namespace voxmelt::hwmodel::explore
