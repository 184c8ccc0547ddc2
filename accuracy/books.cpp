// Arithmetic: what must be exact. Mass, energy and heat balance; every implementation gives the same bits.
#include "accuracy/books.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

// Scenes in which every rule acts.
constexpr const char* kScenes[] = {"../proving_ground", "../proving_ground_viscous"};
const char* law_of(const std::string& scene) {
  return scene.ends_with("_viscous") ? "viscous law" : "paper law";
}

std::int64_t differing_cells(const state::Volume& a, const state::Volume& b) {
  std::int64_t count = 0;
  const state::Grid g = a.grid;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        const state::Slot c = a.at(x, y, z);
        count += a.amount[c] != b.amount[c] || a.energy[c] != b.energy[c] || a.heat[c] != b.heat[c] ||
                 a.solid.test(x, y, z) != b.solid.test(x, y, z);
      }
  return count;
}

}  // namespace

Outcome measure_books(const Conditions& conditions) {
  const std::uint32_t steps = conditions.quick ? 400 : 4000;
  Outcome outcome;
  for (const std::string scene : kScenes) {
    Trial trial(conditions, scene, {});
    trial.run_to(steps);
    const state::Drift drift = trial.simulation().drift();
    const auto row = [&](const char* book, state::Sum units) {
      outcome.rows.push_back({.setting = fmt::format("{}, {} steps", law_of(scene), steps),
                              .quantity = fmt::format("{}, units that the books do not explain", book),
                              .value = static_cast<double>(units),
                              .measure = Measure::absolute,
                              .gate = 0,
                              .speed = trial.speed(Trial::Books::are_asked_for)});
    };
    row("mass", drift.mass);
    row("heat", drift.heat);
    if (trial.simulation().parameters().flow.law == rule::Law::paper) row("energy", drift.energy);
  }
  return outcome;
}

Outcome measure_implementations(const Conditions& conditions) {
  const std::uint32_t steps = conditions.quick ? 100 : 1000;
  Outcome outcome;
  for (const std::string scene : kScenes) {
    Conditions plain = conditions;
    plain.implementation = run::implementations().find("reference");
    plain.baseline = false;
    Trial reference(plain, scene, {});
    reference.run_to(steps);
    for (const auto& implementation : run::implementations().all()) {
      if (!implementation.supported || implementation.name == "reference") continue;
      for (const int threads : {1, 2}) {
        Conditions other = plain;
        other.implementation = &implementation;
        other.threads_always = threads;
        Trial trial(other, scene, {});
        trial.run_to(steps);
        outcome.rows.push_back(
            {.setting = fmt::format("{}, {}, {} thread{}", law_of(scene), implementation.name, threads,
                                    threads == 1 ? "" : "s"),
             .quantity = fmt::format("cells that differ from the reference's after {} steps", steps),
             .value = static_cast<double>(differing_cells(reference.volume(), trial.volume())),
             .measure = Measure::absolute,
             .gate = 0,
             .speed = trial.speed()});
      }
    }
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
