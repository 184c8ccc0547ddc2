#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/run/io/export.h"

namespace voxmelt::io {
namespace {

using json = nlohmann::ordered_json;

json position(rule::Position p) { return {p.x, p.y, p.z}; }

json source_json(const rule::HeatSource& source) {
  const rule::SourceKindRow& kind = rule::row_of(source.kind);
  json json_of_source = json::object();
  if (source.kind != rule::SourceKind::point) json_of_source["kind"] = kind.name;
  json keys = json::array();
  for (const rule::SourceKey& key : source.keys) {
    json json_of_key = {{"step", key.step}};
    if (kind.at) json_of_key["at"] = position(key.at);
    if (kind.radius) json_of_key["radius"] = key.radius;
    if (kind.direction) json_of_key["direction"] = position(key.direction);
    json_of_key["power"] = key.power;
    keys.push_back(json_of_key);
  }
  json_of_source["keys"] = keys;
  return json_of_source;
}

json sources_json(const rule::Heat& heat) {
  json sources = json::array();
  for (const rule::HeatSource& source : heat.sources) sources.push_back(source_json(source));
  return sources;
}

json heat_json(const rule::Heat& heat) {
  return {{"enabled", heat.enabled},
          {"neighbours", heat.neighbours},
          {"weight_face", heat.weight_face},
          {"weight_edge", heat.weight_edge},
          {"weight_corner", heat.weight_corner},
          {"convection", heat.convection},
          {"walls", heat.walls},
          {"radiation", heat.radiation},
          {"visibility_every", heat.visibility_every},
          {"rays_per_face", heat.rays_per_face},
          {"sources", sources_json(heat)},
          {"air", heat.air},
          {"air_exchange", heat.air_exchange},
          {"air_temperature", heat.air_temperature},
          {"air_glow", heat.air_glow},
          {"air_sky", heat.air_sky}};
}

json materials_json(const std::vector<rule::SolidMaterial>& materials) {
  json rows = json::array();
  for (const rule::SolidMaterial& material : materials) {
    const auto weights = [&](const rule::SolidMaterial::Weights& all) {
      return std::vector<std::uint16_t>(all.begin(),
                                        all.begin() + static_cast<std::ptrdiff_t>(materials.size()));
    };
    rows.push_back({{"melting_point", material.melting_point},
                    {"latent_heat", material.latent_heat},
                    {"warmth", material.warmth},
                    {"air_exchange", material.air_exchange},
                    {"weight_face", weights(material.weight_face)},
                    {"weight_edge", weights(material.weight_edge)},
                    {"weight_corner", weights(material.weight_corner)}});
  }
  return rows;
}

json regions_json(const rule::Parameters& p) {
  json vents = json::array(), drains = json::array();
  for (const rule::Vent& vent : p.vents)
    vents.push_back({{"at", position(vent.region.at)},
                     {"radius", vent.region.radius},
                     {"rate", vent.rate},
                     {"temperature", vent.temperature},
                     {"energy", vent.energy},
                     {"from", vent.from},
                     {"until", vent.until}});
  for (const rule::Drain& drain : p.drains)
    drains.push_back({{"at", position(drain.region.at)},
                      {"radius", drain.region.radius},
                      {"rate", drain.rate},
                      {"from", drain.from},
                      {"until", drain.until}});
  return {{"vents", vents}, {"drains", drains}};
}

json flow_json(const rule::Flow& flow) {
  const rule::PaperLaw& paper = flow.paper;
  return {{"law", flow.law == rule::Law::paper ? "paper" : "viscous"},
          {"fall",
           {{"factor", flow.fall.factor},
            {"wall_factor", flow.fall.wall_factor},
            {"minimum", flow.fall.minimum},
            {"hang", flow.fall.hang}}},
          {"paper",
           {{"neighbours", paper.neighbours},
            {"threshold", paper.threshold},
            {"use_table", paper.use_table},
            {"table", paper.table},
            {"share", paper.share},
            {"downhill", paper.downhill},
            {"margin", paper.margin},
            {"support", paper.support},
            {"slump", paper.slump},
            {"energy", paper.reading == rule::EnergyReading::text ? "text" : "printed"},
            {"beta", paper.beta},
            {"alpha_liquid", paper.alpha_liquid},
            {"alpha_solid", paper.alpha_solid},
            {"alpha_floor", paper.alpha_floor},
            {"reheat", paper.reheat}}},
          {"viscous",
           {{"mobility", flow.viscous.mobility},
            {"yield", flow.viscous.yield},
            {"stiffness", flow.viscous.stiffness},
            {"substeps", flow.viscous.substeps},
            {"substeps_max", flow.viscous.substeps_max},
            {"stages_max", flow.viscous.stages_max}}},
          {"thermal_viscosity", flow.thermal_viscosity},
          {"mobility_table", flow.mobility_table},
          {"mobility_reference", flow.mobility_reference},
          {"mobility_rate", flow.mobility_rate}};
}

json all_json(const rule::Parameters& parameters, state::Grid grid, std::uint32_t step) {
  json result = {{"grid", {grid.x, grid.y, grid.z}},
                 {"border", parameters.open_border ? "open" : "closed"},
                 {"step", step},
                 {"seed", parameters.seed},
                 {"material",
                  {{"melting_point", parameters.material.melting_point},
                   {"latent_heat", parameters.material.latent_heat},
                   {"freezing_point", parameters.material.freezing_point}}},
                 {"materials", materials_json(parameters.materials)},
                 {"pieces",
                  {{"fall", parameters.pieces.fall},
                   {"in_liquid", parameters.pieces.in_liquid},
                   {"density", parameters.pieces.density}}},
                 {"heat", heat_json(parameters.heat)},
                 {"flow", flow_json(parameters.flow)}};
  result.update(regions_json(parameters));
  return result;
}

// Tells if it is a number, or a list of some.
bool is_row(const json& value) {
  const auto is_number = [](const json& one) { return one.is_number() || one.is_boolean(); };
  return is_number(value) || (value.is_array() && !value.empty() && std::ranges::all_of(value, is_number));
}

// Tells if it is a list of rows of equal lengths.
bool is_matrix(const json& value) {
  const auto fits = [&](const json& row) {
    return row.is_array() && is_row(row) && row.size() == value[0].size();
  };
  return value.is_array() && !value.empty() && std::ranges::all_of(value, fits);
}

// Tells if it is a list of objects whose members are rows, of equal lengths in all of them.
bool is_table(const json& value) {
  const auto fits = [&](const json& object) {
    if (!object.is_object() || object.size() != value[0].size()) return false;
    return std::ranges::all_of(object.items(), [&](const auto& member) {
      const auto first = value[0].find(member.key());
      return is_row(member.value()) && first != value[0].end() && first->size() == member.value().size();
    });
  };
  return value.is_array() && !value.empty() && value[0].is_object() && std::ranges::all_of(value, fits);
}

// Adds the numbers of a row. All of a value have its type.
void append(NamedValue& to, const json& row) {
  for (const json& number : row.is_array() ? row : json::array({row})) {
    to.text += to.text.empty() ? "" : " ";
    to.text += number.is_boolean() ? (number.get<bool>() ? "1" : "0") : number.dump();
    if (number.is_number_float()) to.type = "Float64";
  }
}

void flatten(const json& value, const std::string& name, std::vector<NamedValue>& values) {
  const std::string before = name.empty() ? "" : name + ".";
  if (value.is_string()) {
    values.push_back(named_word(name, value.get<std::string>()));
  } else if (is_row(value)) {
    NamedValue row{.name = name, .type = "Int64", .tuples = value.size()};
    append(row, value);
    values.push_back(std::move(row));
  } else if (is_matrix(value)) {
    NamedValue matrix{.name = name, .type = "Int64", .components = value[0].size(), .tuples = value.size()};
    for (const json& row : value) append(matrix, row);
    values.push_back(std::move(matrix));
  } else if (is_table(value)) {
    for (const auto& [key, first] : value[0].items()) {
      NamedValue table{
          .name = before + key, .type = "Int64", .components = first.size(), .tuples = value.size()};
      for (const json& object : value) append(table, object[key]);
      values.push_back(std::move(table));
    }
  } else if (value.is_structured()) {
    for (const auto& [key, member] : value.items()) flatten(member, before + key, values);
  }
}

}  // namespace

NamedValue named_word(std::string name, std::string_view word) {
  NamedValue value{.name = std::move(name), .type = "String"};
  for (const char c : word) value.text += std::to_string(static_cast<unsigned char>(c)) + " ";
  value.text += "0";
  return value;
}

std::vector<NamedValue> named_values(const rule::Parameters& parameters) {
  json all = all_json(parameters, {}, 0);
  for (const char* const key : {"grid", "step"}) all.erase(key);
  std::vector<NamedValue> values;
  flatten(all, "", values);
  return values;
}

std::string parameters_json(const rule::Parameters& parameters, state::Grid grid, std::uint32_t step) {
  return all_json(parameters, grid, step).dump(2) + "\n";
}

}  // namespace voxmelt::io
