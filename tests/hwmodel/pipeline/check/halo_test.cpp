// The check of halos counts the cells on which a step depends. The reference shows the same number. The halo
// of every configuration is wide enough, and one block less is not.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hwmodel/pipeline/check/halo_check.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

// Takes the cells of a plane across x from another state.
void take_plane(state::Volume& volume, const state::Volume& other, int plane) {
  const state::Grid& g = volume.grid;
  worlds::for_each({plane, 0, 0, plane + 1, g.y, g.z}, [&](int x, int y, int z) {
    const state::Slot slot = volume.at(x, y, z);
    volume.solid.set(x, y, z, other.solid.test(x, y, z));
    volume.liquid.set(x, y, z, other.liquid.test(x, y, z));
    volume.inert.set(x, y, z, other.inert.test(x, y, z));
    volume.amount[slot] = other.amount[slot];
    if (!volume.energy.empty()) volume.energy[slot] = other.energy.empty() ? 0 : other.energy[slot];
    if (!volume.heat.empty()) volume.heat[slot] = other.heat.empty() ? 0 : other.heat[slot];
  });
}

// Returns how far from a plane the reference's states differ after a step, if they differed in it before.
int farthest(const Start& start, const state::Volume& other, int plane) {
  state::Volume changed = start.volume;
  take_plane(changed, other, plane);
  const step::Implementation& reference = *run::implementations().find("reference");
  run::Simulation one(start.parameters, start.volume, reference), two(start.parameters, changed, reference);
  one.step();
  two.step();
  int far = 0;
  worlds::for_each(worlds::whole(start.volume.grid), [&](int x, int y, int z) {
    const auto cell = [&](const state::Volume& v) {
      const state::Slot slot = v.at(x, y, z);
      return std::vector<int>{v.solid.test(x, y, z), v.liquid.test(x, y, z), v.amount[slot],
                              v.energy.empty() ? 0 : v.energy[slot], v.heat.empty() ? 0 : v.heat[slot]};
    };
    if (cell(one.volume()) != cell(two.volume())) far = std::max(far, std::abs(x - plane));
  });
  return far;
}

// Lets shares depend on the pattern of the giver, and so on the neighbours of a neighbour.
void give_by_pattern(worlds::Random& random, rule::Flow& flow) {
  flow.paper.neighbours = 4;
  flow.paper.use_table = true;
  for (auto& row : flow.paper.table)
    for (std::uint16_t& share : row) share = static_cast<std::uint16_t>(random.below(16384));
  flow.paper.threshold = 0;
  flow.paper.margin = 0;
  flow.paper.support = false;
}

// Hostile worlds are sorted by law, conduction and sub-steps. In each kind some world is changed as far away
// as the check says, and none farther. Heat goes the last cell only by a chain of chances: it melts a cell
// just now, or is carried in each of several sub-steps.
TEST(Halo, AStepDependsOnWhatAChangeReaches) {
  struct Reach {
    int said = 0, seen = 0;
    bool chancy = false;
  };
  std::map<std::string, Reach> kinds;
  constexpr int kPlane = 10;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    Start start = hostile_start(seed + 100, law, {2 * kPlane + 1, 5, 5});
    rule::Parameters& p = start.parameters;
    p.heat.radiation = p.pieces.fall = false;  // both go by the whole state
    if (p.has_materials()) continue;
    int substeps = 1;
    if (law == rule::Law::viscous) {
      substeps = p.flow.viscous.substeps = static_cast<std::uint16_t>(1 + seed % 3);
      p.flow.viscous.stages_max = 1;
    }
    worlds::Random random(seed + 5);
    if (law == rule::Law::paper) give_by_pattern(random, p.flow);
    if (law == rule::Law::viscous) {
      p.flow.viscous.mobility = 819200000;
      p.flow.viscous.yield = 0;
    }
    const state::Volume other = worlds::hostile_volume(random, p, start.volume.grid);
    const Design design{p, {start.volume.grid, 1}, substeps};
    const std::string heat = p.heat.enabled ? std::to_string(p.heat.neighbours) : "cold";
    const std::string sides =
        law == rule::Law::paper && !p.heat.enabled && design.needs_walls() ? " sides" : "";
    std::string kind = std::to_string(static_cast<int>(law));
    kind.append(" ").append(heat).append(sides).append(" ").append(std::to_string(substeps));
    Reach& reach = kinds[kind];
    reach.said = dependence_of_step(design);
    reach.chancy = (substeps > 1 || law == rule::Law::paper) && p.heat.enabled;
    EXPECT_EQ(reach_of_step(design), reach.said) << "the machine's own list, " << start.name;
    const int seen = farthest(start, other, kPlane);
    ASSERT_LE(seen, reach.said) << start.name;
    reach.seen = std::max(reach.seen, seen);
  }
  EXPECT_GE(kinds.size(), 16u);
  for (const auto& [kind, reach] : kinds) EXPECT_GE(reach.seen, reach.said - (reach.chancy ? 1 : 0)) << kind;
}

// Configurations give every rest of the reach by the lanes. One block less than the halo is too narrow.
TEST(Halo, EveryRestOfTheReachByTheLanes) {
  std::map<int, std::set<int>> rests;
  for (const int lanes : {1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 31, 32})
    for (int cascade = 1; cascade <= 32; ++cascade)
      for (const int neighbours : {0, 6, 18, 26})
        for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
          rule::Parameters p;
          p.flow.law = law;
          p.heat.enabled = neighbours > 0;
          p.heat.neighbours = static_cast<std::uint8_t>(neighbours);
          p.flow.fall.hang = cascade % 2 == 0 ? 1024 : 0;
          const state::Grid grid{1200, 2, 2};
          Configuration c{lanes, cascade, 2, 0};
          const int cells = cascade * dependence_of_step({p, {grid, lanes}, 1});
          c.tile = (2 * ((cells + lanes - 1) / lanes) + 1) * lanes;
          Design design = design_of(p, grid, c);
          ASSERT_TRUE(design.shape.tiled());
          rests[lanes].insert(cells % lanes);
          ASSERT_EQ(narrow_halo(design, cascade), nullptr) << lanes << " lanes, " << cascade << " steps";
          ASSERT_NE(narrow_halo(design, cascade + lanes), nullptr) << "steps that the halo is not for";
          --design.shape.halo;
          const auto found = narrow_halo(design, cascade);
          ASSERT_NE(found, nullptr) << lanes << " lanes, " << cascade << " steps";
          EXPECT_EQ(found->kind, Mismatch::Kind::halo);
          EXPECT_EQ(found->expected, cells);
          EXPECT_EQ(found->x, design.shape.owned_end(0) * lanes - 1) << "the first cut, from the left";
          EXPECT_EQ(found->actual, design.shape.halo * lanes);
        }
  for (const auto& [lanes, seen] : rests) EXPECT_EQ(seen.size(), static_cast<std::size_t>(lanes));
}

}  // namespace
}  // namespace voxmelt::hwmodel
