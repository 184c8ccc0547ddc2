// The program times rays by each caster on one thread: millions in a second of its processor time. The scene
// is a ball with pits, by slices. `rays` are all rays of its surface towards three points, and `sky` leave
// its upper faces for the open sky. `prepare` is the time to build what a caster keeps. `refit` is the time
// to bring it up to date after some cells have melted.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/engine/visibility/surface.h"
#include "render/visibility/embree_caster.h"

namespace voxmelt {
namespace {

using visibility::Cell;
using visibility::Ray;

// Returns the processor time of this thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

state::Volume pitted_ball(int n) {
  state::Volume v(state::Grid{n, n, n});
  const auto squared = [&](int x, int y, int z) {
    const std::int64_t dx = 2 * x + 1 - n, dy = 2 * y + 1 - n, dz = 2 * z + 1 - n;
    return dx * dx + dy * dy + dz * dz;
  };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) v.solid.set(x, y, z, squared(x, y, z) * 100 < std::int64_t{81} * n * n);
  std::uint64_t random = 1;  // pits: little balls about its surface
  const auto drawn = [&] {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(random >> 40) / (1 << 24);
  };
  for (int pit = 0; pit < 400; ++pit) {
    const double height = 2 * drawn() - 1, turn = 2 * std::numbers::pi * drawn();
    const double out = 0.45 * n, flat = out * std::sqrt(1 - height * height);
    const double radius = n * (0.01 + 0.05 * drawn());
    const std::array<double, 3> middle{n / 2.0 + flat * std::cos(turn), n / 2.0 + out * height,
                                       n / 2.0 + flat * std::sin(turn)};
    const auto low = [&](std::size_t a) { return std::max(0, static_cast<int>(middle[a] - radius)); };
    const auto high = [&](std::size_t a) { return std::min(n, static_cast<int>(middle[a] + radius) + 1); };
    for (int z = low(2); z < high(2); ++z)
      for (int y = low(1); y < high(1); ++y)
        for (int x = low(0); x < high(0); ++x)
          if (std::hypot(x - middle[0], y - middle[1], z - middle[2]) < radius) v.solid.set(x, y, z, false);
  }
  return v;
}

std::vector<Ray> all_rays(const visibility::Opaque& opaque, const rule::Position& source) {
  const state::Grid& g = opaque.grid();
  const visibility::Surface surface(g, rule::SourceKind::point, {0, source, 1});
  std::vector<Ray> rays;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        if ((x & 63) == 0 && opaque.solid().row(y, z)[static_cast<std::size_t>(x) / 64] == 0) {
          x += 63;
          continue;
        }
        const auto faces = surface.faces(opaque, static_cast<std::size_t>(x) / 64, y, z);
        const Cell cell{x, y, z};
        for (std::size_t f = 0; f < faces.size(); ++f) {
          if ((faces[f] >> (x & 63) & 1) == 0) continue;
          const std::size_t a = f / 2;
          Cell beyond = cell;
          beyond[a] += f % 2 == 0 ? 1 : -1;
          std::array<std::int64_t, 3> start{16 * x + 8, 16 * y + 8, 16 * z + 8};
          start[a] = 16 * std::max(cell[a], beyond[a]);
          rays.push_back({beyond, {start[0], start[1], start[2]}, source});
        }
      }
  return rays;
}

// Sends rays from the upper face of each cell that has one, in four directions of the upper half, out of the
// grid.
std::vector<Ray> sky_rays(const visibility::Opaque& opaque) {
  const state::Grid& g = opaque.grid();
  const std::int64_t far = std::int64_t{32} * g.x;
  std::uint64_t random = 7;
  const auto drawn = [&](std::int64_t most) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::int64_t>((random >> 33) % static_cast<std::uint64_t>(2 * most + 1)) - most;
  };
  std::vector<Ray> rays;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        if (!opaque.solid().test(x, y, z) || opaque.test({x, y + 1, z})) continue;
        const rule::Position start{16 * x + 8, 16 * (y + 1), 16 * z + 8};
        for (int n = 0; n < 4; ++n) {
          rule::Position way;
          do {
            way = {drawn(far), std::abs(drawn(far)), drawn(far)};
          } while (way.y == 0 || way.x * way.x + way.y * way.y + way.z * way.z > far * far);
          const std::int64_t longest = std::max({std::abs(way.x), way.y, std::abs(way.z)});
          const auto scaled = [&](std::int64_t part) { return part * far / longest; };
          rays.push_back({{x, y + 1, z},
                          start,
                          {start.x + scaled(way.x), start.y + std::max<std::int64_t>(1, scaled(way.y)),
                           start.z + scaled(way.z)}});
        }
      }
  return rays;
}

struct World {
  explicit World(int n) : volume(pitted_ball(n)) {
    cpu::Workers workers(1);
    news = opaque.take(volume, workers);
    const std::int64_t side = 16 * n;
    for (const rule::Position& source :
         {rule::Position{2 * side, side * 3 / 2, -side / 2}, rule::Position{side / 3, side * 5 / 4, side / 4},
          rule::Position{-side / 8, side / 2, side / 2}}) {
      const std::vector<Ray> more = all_rays(opaque, source);
      to_points.insert(to_points.end(), more.begin(), more.end());
    }
    to_sky = sky_rays(opaque);
  }
  state::Volume volume;
  visibility::Opaque opaque;
  visibility::Opaque::News news;
  std::vector<Ray> to_points, to_sky;
};

World& world(int n) {
  static std::unique_ptr<World> last;  // one world is kept at a time
  if (last == nullptr || last->volume.grid.x != n) last = std::make_unique<World>(n);
  return *last;
}

struct Case {
  int n;
  std::vector<Ray> World::*rays;
};

void cast(benchmark::State& state, const Case& one,
          const std::function<std::unique_ptr<visibility::Caster>()>& make) {
  World& w = world(one.n);
  const std::vector<Ray>& rays = w.*one.rays;
  const std::unique_ptr<visibility::Caster> caster = make();
  const double begin = processor_seconds();
  caster->prepare(w.opaque, w.news);
  state.counters["prepare_ms"] = 1e3 * (processor_seconds() - begin);
  const double middle = processor_seconds();
  visibility::Opaque::News melted;
  melted.vanished = true;
  caster->prepare(w.opaque, melted);
  state.counters["refit_ms"] = 1e3 * (processor_seconds() - middle);
  std::vector<visibility::Fate> fates(rays.size());
  double least = std::numeric_limits<double>::infinity();
  for ([[maybe_unused]] auto _ : state) {
    const double start = processor_seconds();
    for (std::size_t first = 0; first < fates.size(); first += 1024) {  // KeptRays casts as many at once
      const std::size_t count = std::min<std::size_t>(1024, fates.size() - first);
      caster->cast(w.opaque, {rays.data() + first, count}, {fates.data() + first, count});
    }
    const double seconds = processor_seconds() - start;
    state.SetIterationTime(seconds);
    least = std::min(least, seconds);
  }
  const auto seeing = std::count(fates.begin(), fates.end(), visibility::kSees);
  state.counters["rays"] = static_cast<double>(rays.size());
  state.counters["seeing"] = static_cast<double>(seeing);  // the same for every caster
  state.counters["Mray_per_s"] = static_cast<double>(rays.size()) / least / 1e6;
}

}  // namespace
}  // namespace voxmelt

int main(int argc, char** argv) {
  using namespace voxmelt;
  using namespace voxmelt::visibility;
  using Make = std::function<std::unique_ptr<Caster>()>;
  std::vector<std::pair<std::string, Make>> casters{
      {"walk", [] { return std::make_unique<PlainCaster>(); }},
      {"two-level", [] { return std::make_unique<TwoLevelCaster>(); }}};
  if (EmbreeCaster::built_in())
    for (const Packet packet : {Packet::one, Packet::eight, Packet::sixteen})
      casters.emplace_back("embree-" + std::to_string(static_cast<int>(packet)),
                           [packet] { return std::make_unique<EmbreeCaster>(packet); });
  for (const int n : {64, 128, 256, 512, 1024})
    for (const auto& [kind, rays] : {std::pair{"rays/", &World::to_points}, {"sky/", &World::to_sky}})
      for (const auto& [name, make] : casters)
        benchmark::RegisterBenchmark((kind + std::to_string(n) + "/" + name).c_str(),
                                     [n, rays = rays, make = make](benchmark::State& state) {
                                       cast(state, {n, rays}, make);
                                     })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond)
            ->Iterations(n > 256 ? 3 : 8);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
