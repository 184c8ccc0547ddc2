// These cases check the arithmetic that must be exact. Mass, energy and heat balance, and every
// implementation gives the same bits.
#include "accuracy/books.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "accuracy/cells.h"
#include "accuracy/trial.h"
#include "kernel/automaton/state/difference.h"

namespace voxmelt::accuracy {
namespace {

// In these scenes every rule acts.
constexpr const char* kScenes[] = {"../proving_ground", "../proving_ground_viscous"};
const char* law_of(const std::string& scene) {
  return scene.ends_with("_viscous") ? "viscous law" : "paper law";
}

std::int64_t differing_cells(const state::Volume& a, const state::Volume& b) {
  std::int64_t count = 0;
  const state::Grid g = a.grid;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) count += !state::same_cell(a, b, x, y, z);
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

// The scene has three still pools of 3 x 3 columns at kappa 0.2. The limit cuts 2/9 kappa d^2 at 1/(5 (d +
// 1)) with d + 1 whole, and at an eighth of that where a roof presses. So it cuts the pool of depth 4 (36
// cells) and the one that a roof at 1 squeezes to 5/4 (9 cells of 5/4). It does not cut the one of depth 1/2
// (9 cells of 1/2). The first one needs 18 sub-steps: 2/9 x 0.2 x 16 x 25 = 17.8.
Outcome measure_limit(const Conditions& conditions) {
  constexpr std::uint32_t kSteps = 10;
  Outcome outcome;
  for (const bool choose : {false, true}) {
    Trial trial(conditions, "flow",
                {"grid.size=[11,6,3]", "flow.viscous.kappa=0.2",
                 fmt::format("flow.viscous.substeps={}", choose ? "\"auto\"" : "1")},
                [](state::Volume& v) {
                  for_each_cell(v.grid, [&](int x, int y, int z) {
                    if (x % 4 == 3 || (x > 7 && y > 0)) put_inert(v, x, y, z);
                  });
                  for (int z = 0; z < 3; ++z)
                    for (int x = 0; x < 3; ++x) {
                      put_column(v, x, z, 0.5);
                      put_column(v, x + 4, z, 4);
                      put_liquid(v, x + 8, 0, z, 1.25);
                    }
                });
    trial.run_to(kSteps);
    const auto& counted = trial.simulation().ledger().limit;
    const auto row = [&](const char* what, double value, double exact) {
      outcome.rows.push_back({.setting = choose ? "as many sub-steps as the pools need" : "one sub-step",
                              .quantity = fmt::format("{}, in {} steps", what, kSteps),
                              .value = value,
                              .exact = kSteps * exact,
                              .measure = Measure::absolute,
                              .gate = 0,
                              .speed = trial.speed()});
    };
    const int substeps = choose ? 18 : 1;
    row("cells counted", static_cast<double>(counted.cells), substeps * 54);
    row("liquid counted, cells", static_cast<double>(counted.mass) / kOne, substeps * (4.5 + 36 + 11.25));
    row("cells whose mobility the limit cuts", static_cast<double>(counted.limited_cells),
        choose ? 0 : 36 + 9);
    row("liquid whose mobility the limit cuts, cells", static_cast<double>(counted.limited_mass) / kOne,
        choose ? 0 : 36 + 11.25);
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
