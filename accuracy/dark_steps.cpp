// A cell that melting bares is dark until the next step of visibility. This case says what that costs.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "accuracy/cells.h"
#include "accuracy/light.h"
#include "accuracy/trial.h"

namespace voxmelt::accuracy {
namespace {

constexpr int kPeriods[] = {1, 2, 8, 32};
constexpr std::uint32_t kSteps = 300;

// Returns the heat that light brought, in the scene's range x full cells.
double brought(const Trial& trial) {
  return static_cast<double>(trial.simulation().ledger().heat.radiated) / (kOne * kHottest);
}

Row row_of(const std::string& body, int period, const Trial& trial, double exact,
           const std::string& reference) {
  return {.setting = fmt::format("{}, visibility every {} step{}", body, period, period == 1 ? "" : "s"),
          .quantity = "heat taken up over that " + reference,
          .value = brought(trial) / exact,
          .exact = 1,
          .speed = trial.speed()};
}

void put_ball(state::Volume& v) {
  constexpr double kMiddle = 16, kRadius = 10;
  for_each_cell(v.grid, [&](int x, int y, int z) {
    if (std::hypot(x + 0.5 - kMiddle, y + 0.5 - kMiddle, z + 0.5 - kMiddle) <= kRadius) put_solid(v, x, y, z);
  });
}

}  // namespace

// A sun stands above a slab, of which it melts twelve layers. The sun brings the same to every column in
// every step, whatever lies there. A ball is lit from one side, by a source that is near.
Outcome measure_dark_steps(const Conditions& conditions) {
  Outcome outcome;
  for (const int period : kPeriods) {
    Trial slab(conditions, "sunlit", {fmt::format("heat.visibility_every={}", period)});
    slab.run_to(kSteps);
    outcome.rows.push_back(row_of("a slab", period, slab, 0.02 * kSteps * 16 * 16, "of the sun"));
    if (period == 1) outcome.rows.back().gate = 0.003;
  }
  std::optional<double> every_step;
  for (const int period : kPeriods) {
    Trial ball(conditions, "sunlit",
               {fmt::format("heat.visibility_every={}", period), "grid.size=[32,32,32]",
                "heat_source=[{kind=\"point\",at=[40,40,24],power=20}]"},
               put_ball);
    ball.run_to(kSteps);
    if (!every_step) every_step = brought(ball);
    outcome.rows.push_back(row_of("a ball", period, ball, *every_step, "of every step"));
  }
  return outcome;
}

}  // namespace voxmelt::accuracy
