#include "hwmodel/rtl/host/rtl_ports.h"

#include <algorithm>
#include <array>

#include "hwmodel/pipeline/model/lag.h"
#include "hwmodel/pipeline/model/paper_flow.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "hwmodel/rtl/host/material_tables.h"
#include "hwmodel/rtl/host/port_bits.h"

namespace voxmelt::hwmodel {
namespace {

// Moves between a cell and its neighbours, and what the shortest memory holds.
struct Line {
  std::int64_t column, plane;
  bool single;  // no cell has a neighbour in another block
};

std::uint64_t packed(std::int64_t first, std::int64_t second, std::int64_t third, int bits) {
  return static_cast<std::uint64_t>(first | second << bits | third << (2 * bits));
}

class Ports {
 public:
  Ports(StageKind kind, const Design& design, const RtlSizes& sizes)
      : design_(design),
        sizes_(sizes),
        p_(design.parameters),
        line_{design.shape.column(), design.shape.plane(), design.shape.blocks() == 1} {
    if (design.shape.tiled()) ports_.refusal = "a grid is one tile";
    const Shape& shape = design.shape;
    add("last", packed(shape.grid.y - 1, shape.blocks() - 1, shape.grid.z - 1, 12));
    fill(kind);
  }
  RtlPorts ports() && { return std::move(ports_); }

 private:
  void add(std::string_view name, std::int64_t value) {
    ports_.values.push_back({name, port_bits(name), static_cast<std::uint64_t>(value)});
  }
  // Adds the length of a memory. None is shorter than two moves.
  std::int64_t add_memory(std::string_view name, std::int64_t delay) {
    if (delay < 2 && ports_.refusal.empty())
      ports_.refusal = "a column of " + std::to_string(line_.column) + " cells and a plane of " +
                       std::to_string(line_.plane) + " tokens are too short for its registers";
    if (delay > (name == "north" ? sizes_.north : sizes_.column) && ports_.refusal.empty())
      ports_.refusal = "a plane of " + std::to_string(line_.plane) + " tokens does not fit its memories";
    add(name, delay);
    return delay;
  }
  // Adds two memories that hold `both` moves together, of which the first is `first` where that matters.
  void add_memories(std::string_view one, std::string_view other, std::int64_t first, std::int64_t both) {
    const std::int64_t length = line_.single ? both - 2 : first;
    add_memory(one, length);
    add_memory(other, both - length);
  }

  void fill(StageKind kind) {
    using enum StageKind;
    if (kind == fall) add("lag", 2);
    if (kind == source) add_source();
    if (kind == walls) add_walls();
    if (kind == conduction) add_conduction();
    if (kind == edges) add_distant(kind, p_.heat.weight_edge, &rule::SolidMaterial::weight_edge);
    if (kind == corners) add_distant(kind, p_.heat.weight_corner, &rule::SolidMaterial::weight_corner);
    if (kind == convection) add_convection();
    if (kind == exchange) add_exchange();
    if (kind == melt) add_melt();
    if (kind == gravity) add_gravity();
    if (kind == pattern) add_pattern();
    if (kind == apply) add_apply();
    if (kind == settle) add_settle();
    if (kind == viscous_spread) add_spread();
  }

  void add_curve() {
    add("melting_point", p_.material.melting_point);
    add("latent_heat", p_.material.latent_heat);
    add("top", Curves(p_).top());
  }
  void add_curves() {
    add("several", design_.of_materials() ? 1 : 0);
    ports_.wide.emplace_back("curves", curve_rows(design_, sizes_.material_bits));
    add("top", Curves(p_).top());
  }
  void add_weights(std::uint16_t only, PairWeights::Row row) {
    ports_.wide.emplace_back("weights", pair_rows(design_, only, row, sizes_.material_bits));
  }
  std::int64_t registers(StageKind kind) const { return circuit_registers(kind, design_); }

  void add_walls() {
    add("lag", line_.plane + 1);
    add_memories("east", "north", line_.column, line_.plane);
  }

  // An opening that is not there never opens.
  void add_source() {
    constexpr std::size_t kBits = 199;
    add("lag", 8 + kOpeningRegisters * static_cast<std::int64_t>(sizes_.vents + sizes_.drains));
    add("last_x", design_.shape.grid.x - 1);
    add("open_border", p_.open_border ? 1 : 0);
    add("hot", design_.hot() ? 1 : 0);
    if (p_.vents.size() > sizes_.vents || p_.drains.size() > sizes_.drains)
      ports_.refusal = "it has at most " + std::to_string(sizes_.vents) + " vents and " +
                       std::to_string(sizes_.drains) + " drains";
    std::vector<std::uint32_t> words((std::max<std::size_t>(sizes_.vents + sizes_.drains, 1) * kBits + 31) /
                                     32);
    for (std::size_t i = 0; i < std::min(sizes_.vents, p_.vents.size()); ++i) {
      const rule::Vent& vent = p_.vents[i];
      put_opening(words, kBits * i, vent.region,
                  {vent.rate, vent.temperature, design_.paper() ? vent.energy : 0}, vent.from, vent.until);
    }
    for (std::size_t i = 0; i < std::min(sizes_.drains, p_.drains.size()); ++i) {
      const rule::Drain& drain = p_.drains[i];
      put_opening(words, kBits * (sizes_.vents + i), drain.region, {drain.rate, 0, 0}, drain.from,
                  drain.until);
    }
    ports_.wide.emplace_back("openings", words);
  }

  void put_opening(std::vector<std::uint32_t>& words, std::size_t at, const rule::Region& ball,
                   std::array<std::int64_t, 3> liquid, std::uint32_t from, std::uint32_t until) {
    const state::Grid& grid = design_.shape.grid;
    const auto put = [&](std::int64_t value, int bits) {
      for (int bit = 0; bit < bits; ++bit, ++at)
        words[at / 32] |= static_cast<std::uint32_t>(value >> bit & 1) << (at % 32);
    };
    constexpr std::int64_t kFar = std::int64_t{1} << 17;
    for (const auto& [centre, cells] :
         {std::pair(ball.at.x, grid.x + design_.shape.lanes), {ball.at.y, grid.y}, {ball.at.z, grid.z}}) {
      if (centre <= 16 * cells - kFar || centre >= kFar)
        ports_.refusal = "no vent and no drain is so far away";
      put(centre, 18);
    }
    put(std::min(ball.radius * ball.radius, (std::int64_t{1} << 36) - 1), 36);
    put(liquid[0], 16);
    put(liquid[1], 16);
    put(liquid[2], 13);
    put(from, 32);
    put(until, 32);
  }

  void add_conduction() {
    add("lag", line_.plane + registers(StageKind::conduction));
    add_memories("east", "north", line_.column - 8, line_.plane - 13);
    add("counts_axes", p_.heat.air ? 1 : 0);
    add("finds_walls", design_.walls_in_conduction() ? 1 : 0);
    add("finds_touched", design_.freezes() ? 1 : 0);
    add_weights(p_.heat.weight_face, &rule::SolidMaterial::weight_face);
    add_curves();
  }

  // A cell takes part in windows a plane and a column long, and waits for eight registers behind each tap.
  void add_distant(StageKind kind, std::uint16_t weight, PairWeights::Row row) {
    add("lag", lag_of(kind, design_).tokens(design_.shape) + registers(kind));
    add_memories("east", "north", line_.column - 8, line_.plane - 16);
    add_memory("south_east", line_.column - 8);
    add_weights(weight, row);
    add_curves();
  }

  void add_convection() {
    add("lag", 8);
    add("weight", p_.heat.convection);
    add_curve();
  }

  void add_exchange() {
    const rule::Heat& heat = p_.heat;
    const auto square = [](std::int64_t value) { return value * value >> 16; };
    add("lag", registers(StageKind::exchange));
    ports_.wide.emplace_back("air_weights", air_rows(design_, sizes_.material_bits));
    add("glow_weights", heat.air ? static_cast<std::int64_t>(exchange_weights(heat.air_glow)) : 0);
    add("sky", square(square(heat.air_sky)));
    add_curves();
    ports_.table.assign(heat.air_temperature.begin(), heat.air_temperature.end());
  }

  void add_melt() {
    add("lag", 5);
    add("paper", design_.paper() ? 1 : 0);
    add("freezes_below", design_.freezes() ? p_.material.freezing_point : 0);
    ports_.wide.emplace_back("melting", melting_rows(design_, sizes_.material_bits));
    add("reheat", design_.paper() ? p_.flow.paper.reheat : 0);
  }

  void add_gravity() {
    const rule::Fall& fall = p_.flow.fall;
    add("lag", 40);
    add("paper", design_.paper() ? 1 : 0);
    add("hot", design_.hot() ? 1 : 0);
    add("printed", p_.flow.paper.reading == rule::EnergyReading::printed ? 1 : 0);
    add("factor", fall.factor);
    add("wall_factor", fall.wall_factor);
    add("minimum", fall.minimum);
    add("hang", fall.hang);
    add("beta", p_.flow.paper.beta);
  }

  // The shares of an axis by temperature.
  void add_shares() {
    const PaperFlow flow(p_.flow);
    std::vector<std::uint32_t> words;
    for (std::int64_t i = 0; i < 32; i += 2)
      words.push_back(static_cast<std::uint32_t>(flow.share(i << 11) | flow.share((i + 1) << 11) << 16));
    ports_.wide.emplace_back("shares", words);
    add("eight", p_.flow.paper.neighbours == 8 ? 1 : 0);
  }

  // The shares of the axes by pattern, where a table tells them.
  void add_table_shares() {
    const PaperFlow flow(p_.flow);
    std::vector<std::uint32_t> words;
    for (std::int64_t pattern = 0; pattern < 16; ++pattern)
      for (int way = 0; way < 4; way += 2)
        words.push_back(static_cast<std::uint32_t>(flow.table_share(pattern, way) |
                                                   flow.table_share(pattern, way + 1) << 16));
    ports_.wide.emplace_back("table_shares", words);
    add("by_table", p_.flow.paper.use_table ? 1 : 0);
  }

  void add_pattern() {
    const rule::PaperLaw& law = p_.flow.paper;
    const std::int64_t blocks = (design_.shape.grid.x + 7) / 8;
    add_memories("south_east", "north", line_.column - 1, line_.plane - 8);
    const std::int64_t east = add_memory("east", line_.column - 1);
    add("lag", line_.plane + east + 10);
    const SpeckKeys keys = speck_keys(p_.seed);
    ports_.wide.emplace_back("keys", std::vector<std::uint32_t>(keys.begin(), keys.end()));
    add("row_blocks", blocks);
    add("plane_blocks", blocks * design_.shape.grid.y);
    add_shares();
    add("support", law.support ? 1 : 0);
    add("downhill", law.downhill ? 1 : 0);
    add("gives_shares", law.use_table ? 0 : 1);
    add("threshold", law.threshold);
    add("margin", law.margin);
    add("slump", law.slump);
    add("margin_diagonal", 9 * law.margin >> 3);
    add("slump_diagonal", 9 * law.slump >> 3);
  }

  void add_apply() {
    const rule::PaperLaw& law = p_.flow.paper;
    add_memories("south_east", "north", line_.column - 3, line_.plane - 13);
    const std::int64_t east = add_memory("east", line_.column - 3);
    add("finished", east + 2);
    add("lag", line_.plane + east + 40);
    add_shares();
    add_table_shares();
    add("hot", design_.hot() ? 1 : 0);
    add("printed", law.reading == rule::EnergyReading::printed ? 1 : 0);
    add("alpha", static_cast<std::int64_t>(packed(law.alpha_liquid, law.alpha_solid, law.alpha_floor, 16)));
  }

  // A solid's bed follows from its amount and its heat.
  void add_bed() {
    add("hot", design_.hot() ? 1 : 0);
    ports_.wide.emplace_back("beds", bed_rows(design_, sizes_.material_bits));
  }

  void add_settle() {
    const rule::Flow& flow = p_.flow;
    add("lag", 2 * line_.column + 70);
    add("thermal", flow.thermal_viscosity ? 1 : 0);
    add("mobility_reference", flow.mobility_reference);
    add("mobility_rate", flow.mobility_rate);
    add("yield_stress", flow.viscous.yield);
    add("stiffness", flow.viscous.stiffness);
    add_bed();
  }

  void add_spread() {
    if (line_.single) ports_.refusal = "a plane has several blocks of hw.lanes cells along x";
    add("lag", line_.plane + line_.column + 57);
    add_memory("south_east", line_.column - 2);
    add_memory("north", line_.plane - line_.column);
    add_memory("finished", line_.column + 23);
    add("finds_walls", design_.needs_walls() ? 1 : 0);
    add_bed();
  }

  const Design& design_;
  RtlSizes sizes_;
  const rule::Parameters& p_;
  Line line_;
  RtlPorts ports_;
};

}  // namespace

RtlPorts rtl_ports(StageKind kind, const Design& design, const RtlSizes& sizes) {
  return Ports(kind, design, sizes).ports();
}

RtlSizes sizes_of(const Design& design) {
  return {design.parameters.vents.size(), design.parameters.drains.size(), kAny, kAny,
          design.of_materials() ? bits_for(design.materials() - 1) : 0};
}

int energy_bits(const Design& design, const RtlSizes& sizes) {
  return design.paper() ? 16 : sizes.material_bits;
}

bool is_memory(std::string_view port) {
  return port == "east" || port == "north" || port == "south_east" || port == "finished";
}

}  // namespace voxmelt::hwmodel
