#include "app/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "app/version.h"
#include "kernel/automaton/state/connectivity.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/io/export.h"

namespace voxmelt::app {
namespace {

using json = nlohmann::ordered_json;
using state::Sum;

json integer(Sum value) {
  constexpr Sum exact = Sum{1} << 53;
  if (value < exact && value > -exact) return static_cast<std::int64_t>(value);
  return state::to_string(value);
}

json mass_json(const state::Ledger& ledger, const state::Holdings& held, Sum drift) {
  const state::MassLedger& m = ledger.mass;
  return {{"start", integer(m.start)}, {"solid", integer(held.solid)},  {"liquid", integer(held.liquid)},
          {"added", integer(m.added)}, {"removed", integer(m.removed)}, {"drift", integer(drift)}};
}

json energy_json(const state::Ledger& ledger, const state::Holdings& held, Sum drift) {
  const state::EnergyLedger& e = ledger.energy;
  return {{"start", integer(e.start)},
          {"held", integer(held.energy)},
          {"melted", integer(e.melted)},
          {"added", integer(e.added)},
          {"removed", integer(e.removed)},
          {"reheated", integer(e.reheated)},
          {"accelerated", integer(e.accelerated)},
          {"dissipated", integer(e.dissipated)},
          {"capped", integer(e.capped)},
          {"drift", integer(drift)}};
}

json heat_json(const state::Ledger& ledger, const state::Holdings& held, Sum drift) {
  const state::HeatLedger& h = ledger.heat;
  return {{"start", integer(h.start)},
          {"held", integer(held.heat)},
          {"conducted", integer(h.conducted)},
          {"convected", integer(h.convected)},
          {"radiated", integer(h.radiated)},
          {"warmed", integer(h.warmed)},
          {"cooled", integer(h.cooled)},
          {"added", integer(h.added)},
          {"removed", integer(h.removed)},
          {"rounded", integer(h.rounded)},
          {"drift", integer(drift)}};
}

json seconds_json(const run::Simulation::Seconds& steps, const RunSeconds& run) {
  json result;
  for (std::size_t p = 0; p < step::kPhaseCount; ++p)
    result[std::string(step::kPhaseNames[p])] = steps.phase[p];
  result["visibility"] = steps.visibility;
  result["update"] = run.update;
  result["render"] = run.render;
  result["total"] = run.total;
  return result;
}

std::int64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace

std::string report_json(const scene::Scene& scene, const Common& common, const run::Simulation& simulation,
                        const RunSeconds& seconds) {
  const state::Volume& volume = simulation.volume();
  const state::Holdings held = state::holdings(volume);
  const state::Drift drift = simulation.drift();
  const json report = {
      {"scene", scene.name},
      {"scene_file", scene.file.string()},
      {"set", common.sets},
      {"seed", simulation.parameters().seed},
      {"steps", simulation.steps_done()},
      {"digest", fmt::format("{:016x}", state::digest(volume))},
      {"initial_digest", fmt::format("{:016x}", scene.initial_digest)},
      {"implementation", run::implementations().find(common.implementation)->name},
      {"threads", simulation.threads()},
      {"version", version_number()},
      {"law", simulation.parameters().flow.law == rule::Law::paper ? "paper" : "viscous"},
      {"features", scene.features},
      {"warnings", scene.warnings},
      {"grid", {volume.grid.x, volume.grid.y, volume.grid.z}},
      {"mass", mass_json(simulation.ledger(), held, drift.mass)},
      {"energy", energy_json(simulation.ledger(), held, drift.energy)},
      {"heat", heat_json(simulation.ledger(), held, drift.heat)},
      {"cells",
       {{"solid", volume.solid.count()},
        {"liquid", volume.liquid.count()},
        {"inert", volume.inert.count()},
        {"detached", state::count_detached(volume)}}},
      {"seconds", seconds_json(simulation.seconds(), seconds)},
      {"memory", {{"peak_bytes", peak_bytes()}}},
      {"parameters", json::parse(io::parameters_json(simulation.parameters(), volume.grid, 0))}};
  return report.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string drift_text(const state::Drift& drift) {
  std::string text;
  const auto add = [&](const char* name, Sum value) {
    if (value == 0) return;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {}{}", name, value > 0 ? "+" : "", state::to_string(value));
  };
  add("mass", drift.mass);
  add("energy", drift.energy);
  add("heat", drift.heat);
  return text;
}

}  // namespace voxmelt::app
