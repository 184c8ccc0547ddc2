#include "hwmodel/explore/part_list.h"

#include <algorithm>
#include <cstddef>
#include <map>

#include "hwmodel/explore/operation_energy.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Every piece of a number but the first loses a bit to the sign.
std::int64_t pieces(int width, int number) {
  return width <= number ? 1 : 1 + (width - number + number - 2) / (number - 1);
}

// Buffers of a few words are flip-flops.
bool is_registers(const BufferCost& buffer, const Family& family) {
  return buffer.words <= family.register_words;
}

// A lane was synthesised with so many products. With others it takes in proportion: a share for each, and one
// more.
std::int64_t of_lanes(std::int64_t lane, std::int64_t lanes, const Units& units, const StageCost& cost) {
  if (cost.products == 0) return lanes * lane;
  return lanes * lane * (1 + units.multipliers) / (1 + cost.products);
}

void add_stage(PartList& list, const StagePart& part, const Family& family) {
  const StageCost& cost = family.stages.at(part.kind);
  const std::int64_t products = std::int64_t{list.design.shape.lanes} * part.units.multipliers;
  if (cost.products > 0) list.dsp += (products * cost.dsps + cost.products - 1) / cost.products;
  for (int i = 0; i < part.units.multipliers && cost.products == 0 && !cost.multipliers.empty(); ++i) {
    const auto at = std::min<std::size_t>(i, cost.multipliers.size() - 1);
    list.dsp += list.design.shape.lanes * dsps_of(cost.multipliers[at], family.product);
  }
  for (const BufferCost& buffer : part.buffers)
    if (is_registers(buffer, family)) list.register_bits += buffer.total();
}

// Adds the memories of a stage, of which there are so many copies.
void add_memories(PartList& list, const StagePart& part, std::int64_t copies, const Family& family) {
  for (const BufferCost& buffer : part.buffers) {
    if (is_registers(buffer, family)) continue;
    std::vector<MemoryUse> ways = ways_to_hold(buffer.words, buffer.lanes * buffer.bits, family);
    for (MemoryUse& way : ways) way = copies * way;
    list.memories = sums_of(list.memories, ways);
  }
}

// Adds all memories. Copies of a stage are alike.
void add_memories(PartList& list, const Family& family) {
  std::map<StageKind, std::int64_t> copies;
  for (const StagePart& part : list.stages) ++copies[part.kind];
  for (const StagePart& part : list.stages)
    if (const auto of_kind = copies.extract(part.kind)) add_memories(list, part, of_kind.mapped(), family);
}

}  // namespace

std::int64_t dsps_of(const Widths& product, const Widths& dsp) {
  return std::min(pieces(product.wide, dsp.wide) * pieces(product.narrow, dsp.narrow),
                  pieces(product.wide, dsp.narrow) * pieces(product.narrow, dsp.wide));
}

Logic logic_of(const PartList& parts, const Family& family) {
  const std::int64_t lanes = parts.design.shape.lanes;
  Logic all{0, parts.register_bits};
  for (const StagePart& part : parts.stages) {
    const StageCost& cost = family.stages.at(part.kind);
    const std::int64_t dividers = part.units.dividers * lanes,
                       blocks = part.units.random_blocks * blocks_of_token(parts.design.shape.lanes);
    all.lut += family.control.lut.value + of_lanes(cost.lane.lut.value, lanes, part.units, cost) +
               dividers * family.divider.lut.value + blocks * family.random_block.lut.value;
    all.ff += family.control.ff.value + of_lanes(cost.lane.ff.value, lanes, part.units, cost) +
              dividers * family.divider.ff.value + blocks * family.random_block.ff.value;
  }
  return all;
}

PartList part_list(const Design& design, const Family& family) {
  PartList list;
  list.design = design;
  list.fed = design.hot() && design.parameters.heat.radiation;
  list.falls = design.parameters.pieces.fall;
  list.memories = {{}};
  const CodeLayout layout(design);
  list.coder_energy =
      energy_of_token(StageKind::reader, {}, reader_buffers(layout), design.shape.lanes, family).all() +
      energy_of_token(StageKind::writer, {}, writer_buffers(layout), design.shape.lanes, family).all();
  for (const auto& stage : make_step(list.design)) {
    list.stages.push_back({stage->kind(), stage->lag(), stage->output_bits(), stage->circuit_buffers(),
                           stage->buffers(), stage->units()});
    StagePart& part = list.stages.back();
    part.token_energy =
        energy_of_token(part.kind, part.units, part.model_buffers, design.shape.lanes, family).all();
    add_stage(list, part, family);
  }
  add_memories(list, family);
  return list;
}

}  // namespace voxmelt::hwmodel::explore
