#include "app/view/world_message.h"

#include <cstddef>
#include <nlohmann/json.hpp>

namespace voxmelt::view {
namespace {

using json = nlohmann::ordered_json;

json array_of(const Position& p) { return {p[0], p[1], p[2]}; }

json source_json(const HeatSource& source) {
  constexpr const char* kKinds[kHeatSourceKinds] = {"point", "sphere", "directional", "sky"};
  json keys = json::array();
  for (const Keyframe& key : source.keyframes)
    keys.push_back({{"step", key.step},
                    {"at", array_of(key.at)},
                    {"power", key.power},
                    {"radius", key.radius},
                    {"direction", array_of(key.direction)}});
  return {{"kind", kKinds[static_cast<std::size_t>(source.kind)]}, {"keyframes", keys}};
}

}  // namespace

std::string world_of(const Simulation& simulation, const std::string& scene) {
  json sources = json::array(), vents = json::array(), drains = json::array();
  const auto is_open = [step = simulation.step_number()](const auto& one) {
    return one.from <= step && step < one.until;
  };
  for (const HeatSource& source : simulation.heat_sources()) sources.push_back(source_json(source));
  for (const Vent& vent : simulation.vents())
    vents.push_back({{"at", array_of(vent.at)},
                     {"radius", vent.radius},
                     {"rate", vent.rate},
                     {"temperature", vent.temperature},
                     {"open", is_open(vent)}});
  for (const Drain& drain : simulation.drains())
    drains.push_back({{"at", array_of(drain.at)},
                      {"radius", drain.radius},
                      {"rate", drain.rate},
                      {"open", is_open(drain)}});
  const Grid grid = simulation.grid();
  return json{{"type", "world"},
              {"scene", scene},
              {"title", simulation.title()},
              {"grid", {grid.x, grid.y, grid.z}},
              {"step_number", simulation.step_number()},
              {"implementation", simulation.implementation()},
              {"threads", simulation.threads()},
              {"keys", changeable_keys()},
              {"numbers", simulation.numbers()},
              {"heat_sources", sources},
              {"vents", vents},
              {"drains", drains}}
      .dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace voxmelt::view
