#include "hwmodel/explore/part_list.h"

#include <algorithm>
#include <cstddef>

#include "hwmodel/explore/operation_energy.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Every piece of a number but the first loses a bit to the sign.
std::int64_t pieces(int width, int number) {
  return width <= number ? 1 : 1 + (width - number + number - 2) / (number - 1);
}

void add_stage(PartList& list, const StagePart& part, const Family& family) {
  const StageCost& cost = family.stages.at(part.kind);
  for (int i = 0; i < part.units.multipliers && !cost.multipliers.empty(); ++i) {
    const auto at = std::min<std::size_t>(i, cost.multipliers.size() - 1);
    list.dsp += list.design.shape.lanes * dsps_of(cost.multipliers[at], family.product);
  }
  for (const BufferCost& buffer : part.buffers)
    if (buffer.words <= family.register_words)
      list.register_bits += buffer.total();
    else
      list.memories = sums_of(list.memories, ways_to_hold(buffer.words, buffer.lanes * buffer.bits, family));
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
    const LogicCost& lane = family.stages.at(part.kind).lane;
    const std::int64_t dividers = part.units.dividers * lanes,
                       blocks = part.units.random_blocks * blocks_of_token(parts.design.shape.lanes);
    all.lut +=
        lanes * lane.lut.value + dividers * family.divider.lut.value + blocks * family.random_block.lut.value;
    all.ff +=
        lanes * lane.ff.value + dividers * family.divider.ff.value + blocks * family.random_block.ff.value;
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
    list.stages.push_back(
        {stage->kind(), stage->lag(), stage->output_bits(), stage->buffers(), stage->units()});
    StagePart& part = list.stages.back();
    part.token_energy =
        energy_of_token(part.kind, part.units, part.buffers, design.shape.lanes, family).all();
    add_stage(list, part, family);
  }
  return list;
}

}  // namespace voxmelt::hwmodel::explore
