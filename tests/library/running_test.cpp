// A user does much to a run between its steps: stop it, restart it, save and open it, change its parameters,
// ask what has changed. Each leaves the bits of a run that says so from its beginning.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

using Running = SceneFile;

std::filesystem::path scene(const std::string& name) {
  return std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml");
}

std::string books_of(const Simulation& simulation) {
  const Ledgers books = simulation.ledgers();
  std::string text;
  for (const Ledger* ledger : {&books.mass, &books.energy, &books.heat}) {
    text += to_string(ledger->start) + ' ' + to_string(ledger->held);
    for (const Term& term : ledger->terms) text += ' ' + to_string(term.value);
  }
  return text;
}

void expect_same(Simulation& a, Simulation& b, int steps) {
  for (int step = 0; step <= steps; ++step) {
    ASSERT_EQ(a.step_number(), b.step_number());
    ASSERT_EQ(a.digest(), b.digest()) << "at step " << a.step_number();
    ASSERT_EQ(books_of(a), books_of(b)) << "at step " << a.step_number();
    a.step();
    b.step();
  }
}

// Two cubes: one stands on the floor, one hangs three cells above it, and falls by one of them a step.
TEST_F(Running, LooseCellsAreThoseThatNothingHolds) {
  const std::string world = R"([grid]
size = [16, 12, 8]
[[inert]]
shape = "floor"
thickness = 2
[[solid]]
shape = "box"
size = [3, 3, 3]
at = [3.5, 3.5, 3.5]
[[solid]]
shape = "box"
size = [2, 3, 4]
at = [11, 6.5, 4]
)";
  Simulation hangs(write("hangs.toml", world)), falls(write("falls.toml", world + "[pieces]\n"));
  EXPECT_EQ(hangs.state().solid.count(), 27u + 24u);
  for (const int loose : {24, 24, 24, 0}) {
    EXPECT_EQ(hangs.loose_cells(), 24);
    EXPECT_EQ(falls.loose_cells(), loose) << "after step " << falls.steps_done();
    hangs.step();
    falls.step();
  }
}

TEST_F(Running, AStopEndsBetweenTwoSteps) {
  Simulation simulation(file), other(file);
  std::stop_source source;
  std::vector<std::uint32_t> told;
  const std::uint32_t done =
      simulation.step(10, source.get_token(), [&](std::uint32_t now, std::uint32_t value) {
        EXPECT_EQ(value, 10u);
        EXPECT_EQ(simulation.steps_done(), now) << "it may be looked at";
        told.push_back(now);
        if (now == 4) source.request_stop();
      });
  EXPECT_EQ(done, 4u);
  EXPECT_EQ(told, (std::vector<std::uint32_t>{1, 2, 3, 4}));
  EXPECT_EQ(simulation.step(5, source.get_token()), 0u) << "it was requested before";
  other.step(4);
  expect_same(simulation, other, 3);

  std::stop_source late;
  std::jthread thread([&] { late.request_stop(); });
  EXPECT_LT(simulation.step(100000000, late.get_token()), 100000000u) << "by another thread";
}

TEST_F(Running, WhatProgressThrowsComesThrough) {
  Simulation simulation(file);
  const auto step = [&] {
    simulation.step(5, {}, [](std::uint32_t, std::uint32_t) { throw std::domain_error("mine"); });
  };
  EXPECT_EQ(message_of<std::domain_error>(step), "mine");
  EXPECT_EQ(simulation.steps_done(), 1u);
}

TEST_F(Running, ARestartBeginsAgainAndKeepsWhatWasSet) {
  for (const char* name : {"proving_ground", "proving_ground_viscous"}) {
    Simulation simulation(scene(name)), fresh(scene(name));
    simulation.step(30);
    EXPECT_NE(simulation.digest(), fresh.digest());
    simulation.restart();
    EXPECT_EQ(simulation.steps_done(), 0u);
    expect_same(simulation, fresh, 12);

    const Vent vent{{10, 18, 4}, 2, 0.2, 0.9};
    simulation.set("heat.gamma", 0.1);
    simulation.set_vents({vent});
    simulation.restart();
    Simulation said(scene(name), {{"heat.gamma=0.1"}, "auto", 0});
    said.set_vents({vent});
    expect_same(simulation, said, 12);
  }
}

TEST_F(Running, ARestartRefusesAnotherScene) {
  Simulation simulation(file);
  simulation.step(3);
  const std::uint64_t before = simulation.digest();
  std::string text = kSmallScene;
  write("scene.toml", text.replace(text.find("temperature = 0.45"), 18, "temperature = 0.25"));
  EXPECT_NE(message_of<InputError>([&] { simulation.restart(); }).find("scene.toml has changed"),
            std::string::npos);
  EXPECT_EQ(simulation.digest(), before);
  EXPECT_EQ(simulation.steps_done(), 3u);
}

// A checkpoint may be of any step, also between two steps of visibility, when light is kept that no file has.
TEST_F(Running, ACheckpointGoesOnTheSame) {
  for (const char* name : {"proving_ground", "proving_ground_viscous"})
    for (const std::uint32_t steps : {0u, 8u, 11u}) {
      Simulation simulation(scene(name));
      simulation.step(steps);
      simulation.save(folder / "there.vxc");
      Simulation again(folder / "there.vxc");
      EXPECT_EQ(again.title(), simulation.title());
      EXPECT_EQ(again.steps_done(), steps);
      EXPECT_EQ(again.scene_steps(), simulation.scene_steps());
      EXPECT_EQ(again.camera().distance, simulation.camera().distance);
      expect_same(again, simulation, 6);
    }
}

TEST_F(Running, ACheckpointHasWhatWasSet) {
  Simulation simulation(file);
  simulation.step(5);
  simulation.set_vents({{{55, 8, 10}, 2.5, 0.125, 0.75, 0.5, 2, 30}});
  simulation.set_drains({{{54, 3, 10}, 3, 0.0625}});
  simulation.set_heat_sources(
      {HeatSource::fixed({1, 11, 10.5}, 9),
       {{{4, {20, 11, 10}, 3, 1.5}, {16, {30, 11, 10}, 40, 1.5}}, HeatSourceKind::sphere},
       {{{0, {}, 0.03, 0, {0.3, 1, -0.2}}}, HeatSourceKind::directional},
       {{{0, {}, 0.02}}, HeatSourceKind::sky}});
  simulation.set("material.melting_point", 0.42);
  simulation.set("flow.fall.minimum", 0.25);
  simulation.step(1);
  simulation.save(folder / "there.vxc");
  Simulation again(folder / "there.vxc");
  ASSERT_EQ(again.heat_sources().size(), 4u);
  again.save(folder / "there.vxc");  // over itself
  Simulation third(folder / "there.vxc");
  expect_same(again, simulation, 0);
  again.restart();
  EXPECT_EQ(again.steps_done(), 6u) << "it began there";
  simulation.restart();
  EXPECT_EQ(simulation.steps_done(), 0u);
  simulation.step(6);
  EXPECT_NE(simulation.digest(), third.digest()) << "the vent came later";
  again.step(20);
  third.step(20);
  EXPECT_EQ(again.digest(), third.digest());
}

// Their light stays until the next step of visibility.
TEST_F(Running, ACheckpointHasTheLightOfSourcesThatWereTakenAway) {
  Simulation simulation(file), dark(file);
  simulation.step(5);
  simulation.set_heat_sources({});
  simulation.save(folder / "there.vxc");
  Simulation again(folder / "there.vxc");
  const Sum before = again.ledgers().heat.terms[3].value;  // radiated
  again.step();
  EXPECT_TRUE(again.ledgers().heat.terms[3].value > before);
  simulation.step();
  expect_same(again, simulation, 8);
}

TEST_F(Running, WhatIsNoCheckpointIsRefused) {
  Simulation simulation(file);
  simulation.save(folder / "there.vxc");
  const auto open = [](const std::filesystem::path& place, const Options& options = {}) {
    return message_of<InputError>([&] { Simulation opened(place, options); });
  };
  EXPECT_NE(open(folder / "there.vxc", {{"heat.gamma=0.1"}, "auto", 0}).find("come too late"),
            std::string::npos);
  EXPECT_NE(open(folder / "no.vxc").find("there is no such file"), std::string::npos);
  std::ifstream whole(folder / "there.vxc", std::ios::binary);
  std::stringstream bytes;
  bytes << whole.rdbuf();
  std::string damaged = bytes.str();
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_NE(open(write("damaged.vxc", damaged)).find("damaged.vxc: error: "), std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { simulation.save(folder / "no/there.vxc"); }), "nothing");
}

// These values differ from those of the proving grounds, and have an effect there.
struct Other {
  const char* key;
  double value;
};
const std::vector<Other> kPaper = {{"heat.gamma", 0.1},
                                   {"heat.neighbours", 18},
                                   {"heat.convection", 0.05},
                                   {"heat.visibility_every", 2},
                                   {"heat.rays_per_face", 4},
                                   {"heat.air.exchange", 0.3},
                                   {"heat.air.bottom", 0.9},
                                   {"heat.air.top", 0.1},
                                   {"material.melting_point", 0.46},
                                   {"material.latent_heat", 0.03},
                                   {"flow.fall.factor", 0.5},
                                   {"flow.fall.wall_factor", 0.7},
                                   {"flow.fall.minimum", 0.5},
                                   {"flow.fall.hang", 0},
                                   {"flow.paper.neighbours", 4},
                                   {"flow.paper.threshold", 0.9},
                                   {"flow.paper.share", 0.05},
                                   {"flow.paper.margin", 0.5},
                                   {"flow.paper.slump", 0},
                                   {"flow.paper.beta", 0.5},
                                   {"flow.paper.alpha_liquid", 0.5},
                                   {"flow.paper.alpha_floor", 0.3},
                                   {"flow.paper.reheat", 0.5},
                                   {"flow.thermal.reference", 0.3},
                                   {"flow.thermal.doubling", 0.3}};
const std::vector<Other> kOnSolid = {{"flow.paper.alpha_solid", 0.2}};
const std::vector<Other> kCooling = {
    {"heat.air.glow", 0.05}, {"heat.air.sky", 0.4}, {"material.freezing_point", 0.44}};
const std::vector<Other> kFloating = {{"pieces.in_liquid", 5}, {"pieces.density", 0.3}};
const std::vector<Other> kTubes = {{"flow.viscous.stiffness", 1}};
const std::vector<Other> kViscous = {
    {"heat.neighbours", 6},          {"flow.fall.factor", 0.5},        {"flow.viscous.kappa", 0.5},
    {"flow.viscous.yield", 1},       {"flow.viscous.substeps", 4},     {"flow.viscous.substeps_max", 1},
    {"flow.viscous.stages_max", 16}, {"material.melting_point", 0.46}, {"flow.thermal.reference", 0.9}};

// The second program is a scene that begins from an export, and has the other value from its start.
void expect_a_set_value_acts_as_said(const std::filesystem::path& file, const std::vector<Other>& others,
                                     const std::filesystem::path& folder) {
  constexpr std::uint32_t kBefore = 8, kAfter = 9;  // 8 is a step of visibility
  Simulation plain(file);
  plain.step(kBefore);
  plain.export_state(folder / "state");
  plain.save(folder / "state.vxc");
  plain.step(kAfter);
  const std::string start = "start={fields=\"" + (folder / "state").string() + "\", step=8}";
  for (const Other& other : others) {
    std::ostringstream assignment;
    assignment << other.key << '=' << other.value;
    Simulation said(file, {{start, assignment.str()}, "reference", 1});
    said.step(kAfter);
    EXPECT_NE(said.digest(), plain.digest()) << other.key << " does nothing here";
    for (const char* implementation : {"reference", "auto"}) {
      Simulation changed(folder / "state.vxc", {{}, implementation, 2});
      changed.set(other.key, other.value);
      changed.step(kAfter);
      EXPECT_EQ(changed.digest(), said.digest()) << other.key << ", " << changed.implementation();
      EXPECT_TRUE(changed.ledgers().balance()) << other.key;
    }
  }
}

TEST_F(Running, ASetValueGivesTheBitsOfASceneThatBeginsWithIt) {
  expect_a_set_value_acts_as_said(scene("proving_ground"), kPaper, folder);
  const auto on_solid = write("on_solid.toml", R"(
[grid]
size = [20, 12, 20]
[[solid]]
shape = "box"
size = [20, 3, 20]
at = [10, 1.5, 10]
[[liquid]]
shape = "box"
size = [5, 6, 5]
at = [10, 6, 10]
)");
  expect_a_set_value_acts_as_said(on_solid, kOnSolid, folder);
  const auto cooling = write("cooling.toml", R"(
[grid]
size = [12, 8, 12]
[material]
freezing_point = 0.2
[[liquid]]
shape = "box"
size = [8, 3, 8]
at = [6, 1.5, 6]
temperature = 0.45
[heat]
[heat.air]
exchange = 0.01
bottom = 0.1
glow = 0.01
sky = 0.1
)");
  expect_a_set_value_acts_as_said(cooling, kCooling, folder);
  const auto floating = write("floating.toml", R"(
[grid]
size = [16, 40, 16]
[pieces]
in_liquid = 2
density = 0.9
[[liquid]]
shape = "box"
size = [16, 24, 16]
at = [8, 12, 8]
[[solid]]
shape = "box"
size = [6, 6, 6]
at = [8, 27, 8]
)");
  expect_a_set_value_acts_as_said(floating, kFloating, folder);
}
TEST_F(Running, ASetValueGivesTheBitsOfASceneThatBeginsWithItViscous) {
  expect_a_set_value_acts_as_said(scene("proving_ground_viscous"), kViscous, folder);
  expect_a_set_value_acts_as_said(scene("lesson_tubes"), kTubes, folder);
}

// The value is set in a run that has stepped, with what its machine knows of sleeping tiles and of rays.
TEST_F(Running, ASetValueInTheMiddleOfARun) {
  for (const Implementation& one : implementations()) {
    if (!one.supported) continue;
    Simulation changed(scene("proving_ground"), {{}, one.name, 2});
    changed.step(20);
    changed.export_state(folder / "state");
    changed.set("heat.gamma", 0.1);
    changed.set("flow.paper.share", 0.05);
    const std::string start = "start={fields=\"" + (folder / "state").string() + "\", step=20}";
    Simulation said(scene("proving_ground"),
                    {{start, "heat.gamma=0.1", "flow.paper.share=0.05"}, "reference", 1});
    for (int step = 0; step < 12; ++step) {
      changed.step();
      said.step();
      ASSERT_EQ(changed.digest(), said.digest()) << one.name << ", step " << step;
    }
  }
}

TEST_F(Running, EveryChangeableKeyIsTestedAndInTheDocs) {
  std::map<std::string, int> tested;
  for (const auto* others : {&kPaper, &kOnSolid, &kCooling, &kFloating, &kViscous, &kTubes})
    for (const Other& other : *others) ++tested[other.key];
  std::ifstream page(std::filesystem::path(VOXMELT_SCENES_FOLDER).parent_path() / "docs/library.md");
  std::stringstream text;
  text << page.rdbuf();
  const std::string docs = text.str();
  for (const std::string& key : changeable_keys()) {
    EXPECT_EQ(tested.count(key), 1u) << key;
    EXPECT_NE(docs.find("`" + key + "`"), std::string::npos) << key << " is not in docs/library.md";
    tested.erase(key);
  }
  EXPECT_TRUE(tested.empty());
}

TEST_F(Running, WhatCannotBeSetIsNamed) {
  Simulation simulation(file);
  const std::uint64_t before = simulation.digest();
  const auto said = [&](const char* key, double value) {
    return message_of<InputError>([&] { simulation.set(key, value); });
  };
  EXPECT_EQ(said("heat.gamma", 7), "set: error: heat.gamma = 7 exceeds 0.5236, the bound for 6 neighbours");
  EXPECT_EQ(said("heat.visibility_every", 2.5),
            "set: error: heat.visibility_every must be an integer, not a number");
  const std::string unknown = said("grid.size", 7);
  EXPECT_EQ(
      unknown.find("set: error: grid.size is not one of the numbers that a run may change: heat.gamma, "),
      0u);
  EXPECT_NE(unknown.find("flow.viscous.kappa"), std::string::npos) << "it names the list";
  EXPECT_NE(said("flow.viscous.kappa", 0.1).find("is not used by law = \"paper\""), std::string::npos);
  EXPECT_NE(said("pieces.density", 0.5).find("no [pieces]"), std::string::npos);
  EXPECT_NE(said("heat.air.top", 0.1).find("heat.air.exchange"), std::string::npos) << "there is no air";
  EXPECT_NE(said("flow.fall.factor", std::numeric_limits<double>::quiet_NaN()), "nothing");
  Simulation cold(
      write("cold.toml",
            "[grid]\nsize = [8, 8, 8]\n[[liquid]]\nshape = \"box\"\nsize = [3, 3, 3]\nat = [4, 4, 4]\n"));
  EXPECT_EQ(message_of<InputError>([&] { cold.set("heat.gamma", 0.1); }),
            "set: error: heat.gamma: the scene has no [heat]: without it nothing is heated");
  Simulation other(file);
  EXPECT_EQ(simulation.digest(), before);
  expect_same(simulation, other, 8);
}

// Copies all cells, to be compared.
std::vector<std::uint64_t> cells_of(const Simulation& simulation, bool matter_alone) {
  const State s = simulation.state();
  std::vector<std::uint64_t> cells;
  cells.reserve(s.grid.cells());
  for (int z = 0; z < s.grid.z; ++z)
    for (int y = 0; y < s.grid.y; ++y)
      for (int x = 0; x < s.grid.x; ++x)
        cells.push_back(s.amount.at(x, y, z) | std::uint64_t{s.energy.at(x, y, z)} << 16 |
                        (matter_alone ? 0 : std::uint64_t{s.heat.at(x, y, z)} << 32) |
                        std::uint64_t{s.solid.test(x, y, z)} << 48 |
                        std::uint64_t{s.liquid.test(x, y, z)} << 49 |
                        std::uint64_t{s.inert.test(x, y, z)} << 50);
  return cells;
}

// Expects that no cell outside of the bricks that are listed has changed.
void expect_covered(const Changes& changes, Grid grid, const std::vector<std::uint64_t>& before,
                    const std::vector<std::uint64_t>& now, bool matter_alone) {
  std::vector<std::uint8_t> listed(grid.cells());
  const auto index = [&](int x, int y, int z) {
    return static_cast<std::size_t>((z * grid.y + y) * grid.x + x);
  };
  for (const ChangedBrick& brick : changes.bricks)
    for (int z = brick.z; z < std::min(brick.z + kBrickSide, grid.z); ++z)
      for (int y = brick.y; y < std::min(brick.y + kBrickSide, grid.y); ++y)
        for (int x = brick.x; x < std::min(brick.x + kBrickSide, grid.x); ++x)
          if (!matter_alone || brick.matter) listed[index(x, y, z)] = 1;
  for (std::size_t i = 0; i < listed.size(); ++i) ASSERT_TRUE(listed[i] != 0 || before[i] == now[i]) << i;
}

TEST_F(Running, ChangesCoverWhatHasChanged) {
  for (const char* name : {"bunny_small", "bunny_small_viscous"}) {
    Simulation simulation(scene(name));
    const Grid grid = simulation.grid();
    Changes first = simulation.changes();
    EXPECT_TRUE(first.everything);
    const auto bricks =
        static_cast<std::size_t>(((grid.x + 7) / 8) * ((grid.y + 7) / 8) * ((grid.z + 7) / 8));
    EXPECT_EQ(first.bricks.size(), bricks);
    EXPECT_TRUE(simulation.changes(first.version).bricks.empty()) << "nothing was done";

    const auto old_matter = cells_of(simulation, true), old_cells = cells_of(simulation, false);
    std::uint64_t version = first.version;
    std::size_t fewest = bricks;
    for (int look = 0; look < 30; ++look) {
      const auto matter = cells_of(simulation, true), cells = cells_of(simulation, false);
      simulation.step(1 + static_cast<std::uint32_t>(look % 3));
      if (look == 12) simulation.set("flow.fall.minimum", 0.25);
      const Changes since = simulation.changes(version);
      EXPECT_FALSE(since.everything);
      EXPECT_GT(since.version, version);
      expect_covered(since, grid, matter, cells_of(simulation, true), true);
      expect_covered(since, grid, cells, cells_of(simulation, false), false);
      fewest = std::min(fewest, since.bricks.size());
      version = since.version;
    }
    EXPECT_LT(fewest, bricks) << "some bricks rest";
    const Changes all = simulation.changes(first.version);
    expect_covered(all, grid, old_matter, cells_of(simulation, true), true);
    expect_covered(all, grid, old_cells, cells_of(simulation, false), false);
    EXPECT_TRUE(simulation.changes(version + 1).everything) << "no call gave it";

    simulation.restart();
    EXPECT_TRUE(simulation.changes(version).everything);
    EXPECT_GT(simulation.changes().version, version);
  }
}

}  // namespace
}  // namespace voxmelt
