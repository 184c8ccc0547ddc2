#include "app/report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/version.h"
#include "app/visibility.h"
#include "kernel/automaton/state/connectivity.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/io/export.h"
#include "kernel/run/trial/fastest.h"

namespace voxmelt::app {
namespace {

using json = nlohmann::ordered_json;
using state::Sum;

json integer(Sum value) {
  constexpr Sum exact = Sum{1} << 53;
  if (value < exact && value > -exact) return static_cast<std::int64_t>(value);
  return state::to_string(value);
}

// Writes a ledger. `held` lists the sums in the state, by name.
template <template <class> class Terms>
json ledger_json(const state::LedgerOf<Terms>& ledger,
                 std::initializer_list<std::pair<const char*, Sum>> held, Sum drift) {
  json result{{"start", integer(ledger.start)}};
  for (const auto& [name, sum] : held) result[name] = integer(sum);
  for (const auto& term : Terms<Sum>::table()) result[std::string(term.name)] = integer(ledger.*term.value);
  result["drift"] = integer(drift);
  return result;
}

// Writes the counters of the viscous law (section 10 of docs/automaton.md).
json limit_json(const state::LimitCounts<Sum>& limit) {
  return {{"cells", integer(limit.cells)},
          {"limited_cells", integer(limit.limited_cells)},
          {"mass", integer(limit.mass)},
          {"limited_mass", integer(limit.limited_mass)}};
}

json seconds_json(const state::Seconds& steps, const RunSeconds& run) {
  json result;
  for (const auto& row : state::Seconds::table()) result[std::string(row.name)] = steps.*row.value;
  result["update"] = run.update;
  result["render"] = run.render;
  result["on_device"] = run.on_device;
  result["encode"] = run.encode;
  result["wait"] = run.wait;
  result["total"] = run.total;
  return result;
}

// Names who followed the rays, and their number. The plain walk does not count rays.
json visibility_json(const Common& common, const run::Simulation& simulation) {
  const VisibilityChoice choice = choose_visibility(common.visibility);
  const visibility::Casts casts = simulation.casts();
  return {{"provider", simulation.provider().name()},
          {"reason", simulation.device_follows_rays() ? "the device has the masks" : choice.reason},
          {"rays", casts.asked},
          {"rays_cast", casts.cast}};
}

std::int64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace

std::string report_json(const scene::Scene& scene, const Common& common, const run::Simulation& simulation,
                        const RunSeconds& seconds, bool complete) {
  const state::Volume& volume = simulation.volume();
  const state::Holdings held = state::holdings(volume);
  const state::Ledger& ledger = simulation.ledger();
  const state::Drift drift = simulation.drift();
  const json report = {
      {"scene", scene.name},
      {"scene_file", scene.file.string()},
      {"set", common.sets},
      {"seed", simulation.parameters().seed},
      {"steps", simulation.steps_done()},
      {"complete", complete},
      {"digest", fmt::format("{:016x}", state::digest(volume))},
      {"initial_digest", fmt::format("{:016x}", scene.initial_digest)},
      {"implementation", simulation.implementation()},
      {"implementation_reason", reason_of(simulation, common)},
      {"threads", simulation.threads()},
      {"version", version_number()},
      {"law", simulation.parameters().flow.law == rule::Law::paper ? "paper" : "viscous"},
      {"features", scene.features},
      {"warnings", scene.warnings},
      {"visibility", visibility_json(common, simulation)},
      {"irradiance_capped", simulation.irradiance_capped()},
      {"grid", {volume.grid.x, volume.grid.y, volume.grid.z}},
      {"mass", ledger_json(ledger.mass, {{"solid", held.solid}, {"liquid", held.liquid}}, drift.mass)},
      {"energy", ledger_json(ledger.energy, {{"held", held.energy}}, drift.energy)},
      {"heat", ledger_json(ledger.heat, {{"held", held.heat}}, drift.heat)},
      {"limit", limit_json(ledger.limit)},
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

bool says_complete(const std::filesystem::path& folder) {
  std::ifstream file(folder / "report.json");
  const json report = json::parse(file, nullptr, false);
  return report.is_object() && report.contains("complete") && report["complete"] == true;
}

std::optional<Told> told_to(const std::filesystem::path& folder) {
  if (!says_complete(folder)) return std::nullopt;
  std::ifstream file(folder / "report.json");
  const json report = json::parse(file, nullptr, false);
  try {
    return Told{report.at("steps").get<std::uint64_t>(), report.at("seed").get<std::uint64_t>(),
                report.at("set").get<std::vector<std::string>>()};
  } catch (const json::exception&) {  // somebody else's
    return std::nullopt;
  }
}

std::string limit_text(const state::LimitCounts<state::Sum>& limit, const rule::ViscousLaw& law) {
  if (limit.limited_mass * 20 <= limit.mass) return {};
  const double share = static_cast<double>(limit.limited_mass) / static_cast<double>(limit.mass);
  return fmt::format(
      "{:.0f} % of the liquid flows more slowly than its viscosity asks; flow.viscous.{} "
      "mends that, and takes longer{}",
      100 * share,
      law.counts_substeps() ? fmt::format("substeps_max above {}", law.substeps_max) : "substeps = \"auto\"",
      law.relaxes() ? "" : "; stages_max = 16 mends most of it, and takes less");
}

void warn_of_limit(scene::Scene& scene, const Common& common, const run::Simulation& simulation) {
  const std::string text = limit_text(simulation.ledger().limit, simulation.parameters().flow.viscous);
  if (!text.empty()) warn(scene, common, {text});
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
