#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/scene/conduction.h"
#include "kernel/scene/look_reader.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

constexpr double kMostConductivity = 256, kMostCapacity = 16;

// Holds what [heat] says of all materials.
struct Conducting {
  double gamma = kGamma;
  double exchange = 0;  // with the air, as the scene says it
};

Conducting read_conducting(Reader& root) {
  Conducting result;
  std::optional<Reader> heat = root.table("heat");
  if (!heat) return result;
  result.gamma = heat->number("gamma", at_most(kLargestGamma), kGamma);
  if (std::optional<Reader> air = heat->table("air"))
    result.exchange = air->number("exchange", at_most(1), 0.0);
  return result;
}

bool is_of_word(char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '_'; }

std::string read_name(Reader& reader, const std::vector<std::string>& names) {
  std::string name = reader.text("name");
  if (name.empty() || !std::ranges::all_of(name, is_of_word))
    reader.fail("name", " = \"" + name + "\" is not one word of letters, digits, - and _");
  if (std::ranges::find(names, name) != names.end())
    reader.fail("name", " = \"" + name + "\" is the name of another one");
  return name;
}

rule::SolidMaterial read_row(Reader& reader, const rule::Material& first) {
  rule::SolidMaterial row;
  const double melting_point = reader.number("melting_point", above(0).at_most(1), 0.5);
  const double latent_heat = reader.number("latent_heat", fraction(), 0.0);
  const double capacity = reader.number("capacity", at_least(1).at_most(kMostCapacity), 1.0);
  if (exceeds_range(capacity * melting_point + latent_heat))
    reader.fail("melting_point",
                fmt::format(" = {} needs capacity x melting_point + latent_heat = {:g} of heat, "
                            "and 1 is the most: it could never melt",
                            melting_point, capacity * melting_point + latent_heat));
  row.melting_point = to_temperature(melting_point);
  row.warmth = static_cast<std::uint32_t>(std::floor(rule::kWarmthOne / capacity));
  // All is rounded apart, so that it might be some units too high together.
  while (row.heat_at(row.melting_point) > rule::kTemperatureMax) --row.melting_point;
  if (row.melting_point < first.freezing_point)
    reader.fail(
        "melting_point",
        fmt::format(" = {} is below material.freezing_point: what melts would freeze", melting_point));
  const std::int64_t most = rule::kTemperatureMax - row.heat_at(row.melting_point);
  row.latent_heat = static_cast<rule::Temperature>(std::min<std::int64_t>(to_temperature(latent_heat), most));
  return row;
}

// Sets the weights of all pairs. Two cells conduct as two layers one behind the other do.
void set_weights(Palette& palette, const std::vector<double>& conductivity, const Conducting& conducting,
                 const rule::Heat& heat) {
  const std::size_t count = conductivity.size();
  for (std::size_t a = 0; a < count; ++a) {
    rule::SolidMaterial& row = palette.rows[a];
    for (std::size_t b = 0; b < count; ++b) {
      const double sum = conductivity[a] + conductivity[b];
      const double gamma = sum > 0 ? conducting.gamma * 2 * conductivity[a] * conductivity[b] / sum : 0;
      row.weight_face[b] = conduction_weight(gamma, 1);
      if (heat.neighbours >= 18) row.weight_edge[b] = conduction_weight(gamma, 2);
      if (heat.neighbours == 26) row.weight_corner[b] = conduction_weight(gamma, 3);
    }
    const double half = half_cell(row.weight_face[a], row.weight_edge[a], row.weight_corner[a]);
    if (heat.air) row.air_exchange = to_factor16(behind_half_cell(conducting.exchange, half));
  }
}

}  // namespace

Palette read_palette(Reader& root, const rule::Material& material, const rule::Heat& heat) {
  Palette palette;
  std::vector<Reader> readers = root.tables("materials");
  if (readers.empty()) return palette;
  if (readers.size() >= rule::kMostMaterials)
    fail_at(readers.back().place(), fmt::format("at most {} further materials", rule::kMostMaterials - 1));
  const Conducting conducting = read_conducting(root);
  palette.names.emplace_back();
  palette.colors.emplace_back();
  palette.rows.push_back({.melting_point = material.melting_point, .latent_heat = material.latent_heat});
  std::vector<double> conductivity{1};
  for (Reader& reader : readers) {
    palette.names.push_back(read_name(reader, palette.names));
    palette.rows.push_back(read_row(reader, material));
    const double most = std::min(kMostConductivity, kLargestGamma / std::max(conducting.gamma, 1e-9));
    conductivity.push_back(
        reader.number("conductivity", at_most(most).because("the bound of gamma x conductivity"), 1.0));
    std::optional<Vec3> color;
    if (reader.has("color")) color = read_color(reader, "color", {});
    palette.colors.push_back(color);
    reader.finish();
  }
  set_weights(palette, conductivity, conducting, heat);
  palette.rows[0].air_exchange = heat.air_exchange;
  return palette;
}

}  // namespace voxmelt::scene
