#include "accuracy/front/subject.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace voxmelt::accuracy::front {
namespace {

constexpr double kFloor = 2;     // height of the floor in the scenes' files
constexpr int kFloorOfGrid = 1;  // on any grid: a thin floor is as good as a thick one

// Holds numbers from the scenes' files.
struct Numbers {
  double gamma, exchange, convection, power, rate, wall_factor, alpha_liquid, alpha_solid, kappa, yield;
};
Numbers numbers_of(const std::string& name) {
  if (name == "cello") return {0.1, 0, 0, 70, 0, 0.25, 0.96, 0.92, 0.01, 0.02};
  if (name == "goblet") return {0.39, 0.00222, 0.05, 0, 0, 0.125, 0.96, 0.92, 0.01, 0.02};
  if (name == "lava") return {0.02, 0.0017, 0, 0, 0.03, 1, 0.99, 0.99, 0.02, 0.01};
  return {0.08, 0, 0, 80, 0, 0.25, 0.96, 0.92, 0.005, 0.02};
}
constexpr double kShare = 0.125, kMinimum = 1. / 128, kViscousWallFactor = 0.125;

struct Size {
  int x, y, z;
};
Size size_of(const std::string& name) {
  if (name == "cello") return {107, 127, 107};
  if (name == "goblet") return {141, 94, 141};
  if (name == "lava") return {128, 100, 128};
  return {128, 128, 128};
}
bool has_floor(const std::string& name) { return name != "lava"; }

std::string list(double x, double y, double z) { return fmt::format("[{:.6f},{:.6f},{:.6f}]", x, y, z); }

// Conduction with n neighbours is as fast as with 6 if gamma is less by this factor. It is the ratio of the
// sums of x^2 / l^2 over the neighbours.
double slowness(int neighbours) { return neighbours == 6 ? 1 : neighbours == 18 ? 3 : 13.0 / 3; }

constexpr double kMostGamma = 0.5236;

double gamma_at(const Setting& setting, double gamma) {
  return gamma * setting.grid * setting.step / slowness(setting.neighbours);
}

}  // namespace

std::vector<std::string> Subject::sets(const Setting& setting) const {
  const double s = setting.grid, dt = setting.step / s;
  const Numbers n = numbers_of(name);
  const Size size = size_of(name);
  const bool floor = has_floor(name);
  const auto height = [&](double y) { return floor ? (y - kFloor) * s + kFloorOfGrid : y * s; };
  const auto at = [&](double x, double y, double z) { return list(x * s, height(y), z * s); };

  std::vector<std::string> sets{fmt::format("grid.size=[{:.0f},{:.0f},{:.0f}]", std::ceil(size.x * s),
                                            std::ceil(height(size.y)), std::ceil(size.z * s)),
                                fmt::format("heat.gamma={:.9f}", gamma_at(setting, n.gamma)),
                                fmt::format("heat.neighbours={}", setting.neighbours),
                                fmt::format("heat.visibility_every={}", setting.interval),
                                fmt::format("heat.rays_per_face={}", setting.rays),
                                "pieces.fall=false"};
  const auto set = [&](std::initializer_list<std::string> more) { sets.insert(sets.end(), more); };
  if (floor) set({fmt::format("inert.0.thickness={}", kFloorOfGrid)});
  if (name == "cello")
    set({"solid.0.at=" + at(53.5, 12.3, 61), fmt::format("solid.0.scale={:.6f}", 0.96 * s),
         "heat_source.0.at=" + at(84, 138, 92)});
  else if (name == "goblet")
    set({"solid.0.at=" + at(70.5, 2, 70.5), fmt::format("solid.0.scale={:.6f}", s)});
  else if (name == "lava")
    set({fmt::format("inert.0.vertical_scale={:.6f}", 0.68 * s), fmt::format("inert.0.base={:.6f}", 3 * s),
         "vent.0.at=" + at(42.5, 45, 56.5), fmt::format("vent.0.radius={:.6f}", 5 * s),
         fmt::format("vent.0.rate={:.9f}", n.rate * dt),
         fmt::format("vent.0.until={:.0f}", std::round(2400 / dt))});
  else
    set({"solid.0.at=" + at(64, 2, 64), fmt::format("solid.0.height={:.6f}", 60 * s),
         "heat_source.0.at=" + at(110, 110, 110)});
  if (n.power > 0) set({fmt::format("heat_source.0.power={:.9f}", n.power * s * s * s * dt)});
  if (n.exchange > 0) set({fmt::format("heat.air.exchange={:.9f}", n.exchange * s * dt)});
  if (n.convection > 0) set({fmt::format("heat.convection={:.9f}", n.convection * s * dt)});
  if (const double m = setting.step; m < 1) {
    const double wall = name == "lava" ? 1 : viscous ? kViscousWallFactor : n.wall_factor;
    set({fmt::format("flow.fall.factor={:.9f}", m), fmt::format("flow.fall.wall_factor={:.9f}", wall * m),
         fmt::format("flow.fall.minimum={:.9f}", kMinimum * m)});
    if (!viscous)
      set({fmt::format("flow.paper.share={:.9f}", kShare * m),
           fmt::format("flow.paper.alpha_liquid={:.9f}", std::pow(n.alpha_liquid, m)),
           fmt::format("flow.paper.alpha_solid={:.9f}", std::pow(n.alpha_solid, m)),
           fmt::format("flow.paper.alpha_floor={:.9f}", std::pow(n.alpha_solid, m))});
  }
  if (viscous)
    set({fmt::format("flow.viscous.kappa={:.9f}", n.kappa * dt / s),
         fmt::format("flow.viscous.yield={:.9f}", n.yield * s), "flow.viscous.substeps=\"auto\"",
         fmt::format("flow.viscous.substeps_max={}", setting.substeps_max),
         fmt::format("flow.viscous.stages_max={}", setting.stages_max)});
  return sets;
}

bool Subject::allows(const Setting& setting) const {
  return gamma_at(setting, numbers_of(name).gamma) <= kMostGamma;
}

Scale Subject::scale(const Setting& setting) const {
  const Size size = size_of(name);
  return {setting.grid, has_floor(name) ? 1. * kFloorOfGrid : 0, size.x / 2.0, size.z / 2.0};
}

std::uint32_t Subject::steps_to(const Setting& setting, std::uint32_t sample_index) const {
  return static_cast<std::uint32_t>(std::lround(sample_index * sample * setting.grid / setting.step));
}

const std::vector<Subject>& all_subjects() {
  static const std::vector<Subject> all = [] {
    std::vector<Subject> subjects{{"cello", "cello", false, true, 112, 13},
                                  {"goblet", "goblet", false, false, 144, 13},
                                  {"lava", "lava", false, false, 128, 13},
                                  {"bunny", "bunny", false, true, 112, 12}};
    for (std::size_t i = 0; i < 4; ++i) {
      Subject viscous = subjects[i];
      viscous.scene += "_viscous";
      viscous.viscous = true;
      subjects.push_back(std::move(viscous));
    }
    return subjects;
  }();
  return all;
}

}  // namespace voxmelt::accuracy::front
