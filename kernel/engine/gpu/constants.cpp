#include "kernel/engine/gpu/constants.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "kernel/automaton/rule/materials.h"
#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/rule/ray_geometry.h"

namespace voxmelt::gpu {
namespace {

using Named = std::pair<std::string_view, std::int64_t>;

// Where each table begins: the same numbers stand in program/constants.cl.
constexpr std::size_t kMaterialRows = 16, kMaterialRow = 12, kWeights = 208, kPatternTable = 976,
                      kMobilityTable = 1040, kRayKeys = 1072, kAirTemperatures = 1088;

std::vector<Named> of_shape(const Shape& s) {
  return {{"NX", s.grid.x},         {"NY", s.grid.y},        {"NZ", s.grid.z},   {"ROW", s.row},
          {"SLICE", s.slice},       {"FIRST", s.first},      {"CELLS", s.cells}, {"BRICKS_X", s.bricks.x},
          {"BRICKS_Y", s.bricks.y}, {"BRICKS_Z", s.bricks.z}};
}

// Returns the highest temperature that every material can have.
std::int32_t top_temperature(const rule::Parameters& p) {
  const rule::Materials materials(p);
  std::int32_t top = rule::kTemperatureMax;
  for (std::size_t m = 0; m < p.materials.size(); ++m)
    top = std::min(top, materials.temperature(rule::kTemperatureMax, static_cast<int>(m)));
  return top;
}

std::vector<Named> of_heat(const rule::Parameters& p) {
  const rule::Heat& h = p.heat;
  return {{"PAPER", p.flow.law == rule::Law::paper},
          {"HEAT", h.enabled},
          {"MATERIALS", p.has_materials()},
          {"MELTING_POINT", p.material.melting_point},
          {"LATENT_HEAT", p.material.latent_heat},
          {"FREEZING_POINT", p.freezes() ? p.material.freezing_point : 0},
          {"TOP", top_temperature(p)},
          {"WALLS", h.walls},
          {"CONVECTION", h.convection},
          {"AIR", h.air},
          {"AIR_EXCHANGE", h.air_exchange},
          {"AIR_GLOW", h.air_glow},
          {"AIR_SKY", h.air_sky}};
}

std::vector<Named> of_flow(const rule::Parameters& p) {
  const rule::Flow& f = p.flow;
  const rule::PaperLaw& law = f.paper;
  return {{"FACTOR", f.fall.factor},
          {"WALL_FACTOR", f.fall.wall_factor},
          {"MINIMUM", f.fall.minimum},
          {"HANG", f.fall.hang},
          {"SEES_SIDES", p.falls_by_sides()},
          {"NEIGHBOURS", law.neighbours},
          {"THRESHOLD", law.threshold},
          {"USE_TABLE", law.use_table},
          {"SHARE", law.share},
          {"DOWNHILL", law.downhill},
          {"MARGIN", law.margin},
          {"SUPPORT", law.support},
          {"SLUMP", law.slump},
          {"PRINTED", law.reading == rule::EnergyReading::printed},
          {"BETA", law.beta},
          {"ALPHA_LIQUID", law.alpha_liquid},
          {"ALPHA_SOLID", law.alpha_solid},
          {"ALPHA_FLOOR", law.alpha_floor},
          {"REHEAT", law.reheat},
          {"MOBILITY", static_cast<std::int64_t>(f.viscous.mobility)},
          {"YIELD", f.viscous.yield},
          {"STIFFNESS", f.viscous.stiffness},
          {"THERMAL", f.thermal_viscosity},
          {"MOBILITY_REFERENCE", f.mobility_reference},
          {"MOBILITY_RATE", f.mobility_rate}};
}

std::vector<Named> of_light(const rule::Parameters& p) {
  return {{"RAY_SIDE", rule::ray_setting({}, p.heat).side}, {"KINDS", source_kinds(p.heat)}};
}

// The numbers in the order of program/constants.cl. Their names are for a program of one scene.
std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const auto& part : {of_shape(Shape({1, 1, 1})), of_heat({}), of_flow({}), of_light({})})
    for (const Named& one : part) all.push_back(one.first);
  return all;
}

// Numbers of a material: docs/automaton.md, sections 6 and 10 ("Bed offsets").
std::array<std::int32_t, 9> material_row(const rule::Parameters& p, std::size_t m) {
  const rule::Materials materials(p);
  rule::SolidMaterial row{.melting_point = p.material.melting_point,
                          .latent_heat = p.material.latent_heat,
                          .air_exchange = p.heat.air_exchange};
  if (p.has_materials()) row = p.materials[m];
  const std::int32_t liquid_from = materials.liquid_from(static_cast<int>(m));
  const std::int32_t as_first =
      row.melting_point + (row.melting_point > p.material.melting_point ? p.material.latent_heat : 0);
  const std::int32_t range = std::max<std::int32_t>(row.latent_heat, rule::kOne);
  std::int32_t shift = 0;
  while (range << (shift + 1) < 65536) ++shift;
  const std::int32_t whole = range << shift;
  return {row.melting_point,
          liquid_from - row.melting_point,
          static_cast<std::int32_t>(row.warmth),
          as_first,
          row.air_exchange,
          liquid_from,
          range,
          shift,
          ((1 << 28) + whole - 1) / whole};
}

}  // namespace

std::int32_t source_kinds(const rule::Heat& heat) {
  std::int32_t kinds = 0;
  for (const rule::HeatSource& source : heat.sources) kinds |= 1 << rule::index_of(source.kind);
  return kinds;
}

Constants constants_of(const rule::Parameters& p, const Shape& shape) {
  Constants constants;
  for (const auto& part : {of_shape(shape), of_heat(p), of_flow(p), of_light(p)})
    for (const Named& one : part) constants.numbers.push_back(one.second);

  std::vector<std::int32_t>& t = constants.tables;
  t.resize(kAirTemperatures + static_cast<std::size_t>(shape.grid.y));
  const rule::RoundKeys keys = rule::round_keys(p.seed);
  const rule::RoundKeys ray_keys = rule::round_keys(p.heat.ray_seed, rule::kRayWord);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    t[i] = static_cast<std::int32_t>(keys[i]);
    t[kRayKeys + i] = static_cast<std::int32_t>(ray_keys[i]);
  }
  for (std::size_t m = 0; m < std::max<std::size_t>(1, p.materials.size()); ++m) {
    const auto row = material_row(p, m);
    std::copy(row.begin(), row.end(),
              t.begin() + static_cast<std::ptrdiff_t>(kMaterialRows + kMaterialRow * m));
  }
  for (std::size_t m = 0; m < p.materials.size(); ++m)
    for (std::size_t n = 0; n < p.materials.size(); ++n) {
      const rule::SolidMaterial& one = p.materials[m];
      t[kWeights + 16 * m + n] = one.weight_face[n];
      t[kWeights + 256 + 16 * m + n] = one.weight_edge[n];
      t[kWeights + 512 + 16 * m + n] = one.weight_corner[n];
    }
  for (std::size_t i = 0; i < 64; ++i) t[kPatternTable + i] = p.flow.paper.table[i / 4][i % 4];
  for (std::size_t i = 0; i < 32; ++i) t[kMobilityTable + i] = p.flow.mobility_table[i];
  const std::size_t heights = std::min(p.heat.air_temperature.size(), static_cast<std::size_t>(shape.grid.y));
  for (std::size_t y = 0; y < heights; ++y) t[kAirTemperatures + y] = p.heat.air_temperature[y];
  return constants;
}

std::string specialised_options(const Constants& constants) {
  std::string options = " -D SPECIALISED";
  const std::vector<std::string_view> all = names();
  for (std::size_t i = 0; i < all.size(); ++i) {
    options += " -D " + std::string(all[i]) + "=" + std::to_string(constants.numbers[i]);
    if (all[i] == "MOBILITY") options += "L";
  }
  return options;
}

std::vector<std::int64_t> shape_numbers(const Shape& shape) {
  std::vector<std::int64_t> numbers;
  for (const Named& one : of_shape(shape)) numbers.push_back(one.second);
  return numbers;
}

std::string specialised_options(const Shape& shape) {
  std::string options = " -D SPECIALISED";
  for (const auto& [name, number] : of_shape(shape))
    options += " -D " + std::string(name) + "=" + std::to_string(number);
  return options;
}

}  // namespace voxmelt::gpu
