// The program stair_steps tells how much of the cells is seen in a surface that has none of its own: the
// drawn normal of a tilted plane and of a ball beside the exact one (docs/results/grid.md).
//
//   stair_steps
//
// It prints a line of comma-separated values for each surface: degrees of the normals, and cells of the
// place.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "accuracy/picture/exact_field.h"
#include "accuracy/picture/exact_vector.h"
#include "render/density/density_field.h"
#include "render/reference/picture_scene.h"

namespace voxmelt::accuracy {
namespace {

constexpr double kFull = 4096;  // amount of a full cell
constexpr double kDegree = std::numbers::pi / 180;

// Says how cells hold a body. `covered`: each solid cell has the part of it that the shape covers, as scenes
// leave it. `columns`: liquid stands in columns of full cells and one that is partly full, as the viscous law
// leaves it. The two of whole cells have neither.
enum class Kind { covered, whole_solid, columns, whole_liquid };
struct Named {
  Kind kind;
  const char* name;
};
constexpr Named kKinds[] = {{Kind::covered, "solid in covered parts"},
                            {Kind::whole_solid, "solid of whole cells"},
                            {Kind::columns, "liquid in columns"},
                            {Kind::whole_liquid, "liquid of whole cells"}};

using Inside = std::function<bool(Exact)>;

// Returns the part of a cell that the body covers, in 8^3 points.
double covered(const Inside& inside, int x, int y, int z) {
  constexpr int kSplit = 8;
  int count = 0;
  for (int k = 0; k < kSplit; ++k)
    for (int j = 0; j < kSplit; ++j)
      for (int i = 0; i < kSplit; ++i)
        count += inside({x + (i + 0.5) / kSplit, y + (j + 0.5) / kSplit, z + (k + 0.5) / kSplit}) ? 1 : 0;
  return count / std::pow(kSplit, 3);
}

void put(state::Volume& volume, Kind kind, int x, int y, int z, double part) {
  const auto amount = static_cast<std::uint16_t>(std::lround(part * kFull));
  if (amount == 0) return;
  const bool solid = kind == Kind::covered || kind == Kind::whole_solid;
  (solid ? volume.solid : volume.liquid).set(x, y, z, true);
  volume.amount[volume.at(x, y, z)] = amount;
}

state::Volume body(state::Grid grid, Kind kind, const Inside& inside) {
  state::Volume volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      double column = 0;
      for (int y = 0; y < grid.y; ++y) {
        const double part = covered(inside, x, y, z);
        column += part;
        if (kind == Kind::covered) put(volume, kind, x, y, z, part);
        // A cell is there if its middle is.
        if (kind == Kind::whole_solid || kind == Kind::whole_liquid)
          put(volume, kind, x, y, z, inside({x + 0.5, y + 0.5, z + 0.5}) ? 1 : 0);
      }
      for (int y = 0; kind == Kind::columns && y < column; ++y)
        put(volume, kind, x, y, z, std::min(1.0, column - y));
    }
  return volume;
}

struct Probe {
  ExactRay ray;  // at the surface, against it
  double exact;  // where it should meet
  Exact normal;
};

// Prints the rms and the largest angle between drawn and exact normals, and the rms error of the place.
void print_errors(const Named& kind, const std::string& surface, state::Grid grid, const Inside& inside,
                  const std::vector<Probe>& probes) {
  const scene::Look look;
  render::DensityField levels;
  levels.update(body(grid, kind.kind, inside), look, {});
  const render::PictureScene scene(levels, look, {}, {});
  const ExactField field(scene);
  double squares = 0, largest = 0, places = 0;
  int met = 0;
  for (const Probe& probe : probes) {
    const double t = field.first_crossing(probe.ray);
    if (t < 0) continue;
    const double angle = std::acos(std::min(1.0, dot(field.normal(probe.ray.at(t)), probe.normal))) / kDegree;
    const double length = std::sqrt(dot(probe.ray.along, probe.ray.along));
    squares += angle * angle;
    largest = std::max(largest, angle);
    places += (t - probe.exact) * (t - probe.exact) * length * length;
    ++met;
  }
  std::printf("%s,%s,%.3f,%.3f,%.4f,%d,%zu\n", kind.name, surface.c_str(), std::sqrt(squares / met), largest,
              std::sqrt(places / met), met, probes.size());
}

// The ray starts `before` in front of a place of the surface, and goes straight in.
Probe probe_at(Exact place, Exact normal, double before) {
  const double most = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
  const Exact along = normal * (-1 / most);
  return {{place + normal * before, along}, before * most, normal};
}

// The plane leans so many degrees from level, downwards along an azimuth of the grid.
void print_plane(const Named& kind, double tilt, double azimuth) {
  constexpr double kMiddle = 24, kReach = 10;
  const double s = std::sin(tilt * kDegree);
  const Exact normal{s * std::cos(azimuth * kDegree), std::cos(tilt * kDegree),
                     s * std::sin(azimuth * kDegree)};
  const Exact middle{kMiddle + 0.37, kMiddle + 0.21, kMiddle - 0.29};  // nowhere special in its cell
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-kReach, kReach);
  std::vector<Probe> probes;
  for (int i = 0; i < 2000; ++i) {
    const Exact aside{any(random), any(random), any(random)};
    probes.push_back(probe_at(middle + aside + normal * -dot(aside, normal), normal, 6));
  }
  char surface[64];
  std::snprintf(surface, sizeof surface, "plane,%g,%g", tilt, azimuth);
  print_errors(
      kind, surface, {48, 48, 48}, [&](Exact p) { return dot(p - middle, normal) <= 0; }, probes);
}

// Only the upper half of a ball of liquid is one: below it columns stand on nothing.
void print_ball(const Named& kind, double radius) {
  const int side = 2 * static_cast<int>(radius) + 12;
  const Exact middle{side / 2.0 + 0.37, side / 2.0 + 0.21, side / 2.0 - 0.29};
  const bool liquid = kind.kind == Kind::columns || kind.kind == Kind::whole_liquid;
  std::mt19937 random(2);
  std::normal_distribution<double> any;
  std::vector<Probe> probes;
  while (probes.size() < 4000) {
    const Exact normal = unit({any(random), any(random), any(random)});
    if (liquid && normal.y < std::numbers::sqrt2 / 2) continue;
    probes.push_back(probe_at(middle + normal * radius, normal, 4));
  }
  char surface[64];
  std::snprintf(surface, sizeof surface, "ball,%g,%d", radius, liquid ? 45 : 180);
  const auto inside = [&](Exact p) {
    const Exact d = p - middle;
    if (liquid && d.y < 0) return d.x * d.x + d.z * d.z <= radius * radius;  // it stands on a cylinder
    return dot(d, d) <= radius * radius;
  };
  print_errors(kind, surface, {side, side, side}, inside, probes);
}

int print_all() {
  std::printf("kind,surface,size,side,rms,largest,place,met,probes\n");
  for (const Named& kind : kKinds) {
    for (const double tilt : {0., 2., 5., 10., 20., 30., 45.})
      for (const double azimuth : {0., 15., 30., 45.}) print_plane(kind, tilt, azimuth);
    for (const double radius : {12., 24., 48.}) print_ball(kind, radius);
  }
  return 0;
}

}  // namespace
}  // namespace voxmelt::accuracy

int main() { return voxmelt::accuracy::print_all(); }
