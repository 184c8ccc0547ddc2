// A hand pours and carves between two steps. Every engine then gives the bits of one that begins from that
// state, and the books balance to the unit.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

using ByHand = SceneFile;

std::filesystem::path scene(const std::string& name) {
  return std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml");
}

Sum value_of(const Ledger& ledger, const std::string& name) {
  for (const Term& term : ledger.terms)
    if (term.name == name) return term.value;
  ADD_FAILURE() << name;
  return 0;
}

bool in_ball(const Position& at, double radius, int x, int y, int z) {
  const double dx = x + 0.5 - at[0], dy = y + 0.5 - at[1], dz = z + 0.5 - at[2];
  return dx * dx + dy * dy + dz * dz <= radius * radius;
}

struct Was {
  bool solid, liquid, inert;
  std::uint16_t amount, energy, heat;
  friend bool operator==(const Was&, const Was&) = default;
};

std::vector<Was> cells_of(const Simulation& simulation) {
  const State s = simulation.state();
  std::vector<Was> cells;
  for (int z = 0; z < s.grid.z; ++z)
    for (int y = 0; y < s.grid.y; ++y)
      for (int x = 0; x < s.grid.x; ++x)
        cells.push_back({s.solid.test(x, y, z), s.liquid.test(x, y, z), s.inert.test(x, y, z),
                         s.amount.at(x, y, z), s.energy.at(x, y, z), s.heat.at(x, y, z)});
  return cells;
}

// Calls visit(cell before, cell after, in the ball) for all cells.
template <class Visit>
void compare(const Simulation& simulation, const std::vector<Was>& before, const Position& at, double radius,
             const Visit& visit) {
  const std::vector<Was> after = cells_of(simulation);
  const Grid g = simulation.grid();
  std::size_t i = 0;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x, ++i) visit(before[i], after[i], in_ball(at, radius, x, y, z));
}

int materials_of_no_solid(const Simulation& simulation) {
  const State state = simulation.state();
  int count = 0;
  for (const NamedField& field : state.fields) {
    if (field.name != "material") continue;
    for (int z = 0; z < state.grid.z; ++z)
      for (int y = 0; y < state.grid.y; ++y)
        for (int x = 0; x < state.grid.x; ++x) count += field.at(x, y, z) != 0 && !state.solid.test(x, y, z);
  }
  return count;
}

TEST_F(ByHand, PouringFillsTheAirOfTheBall) {
  for (const char* name : {"proving_ground", "proving_ground_viscous"}) {
    Simulation simulation(scene(name));
    simulation.step(12);
    const std::vector<Was> before = cells_of(simulation);
    const Ledgers books = simulation.ledgers();
    const Grid g = simulation.grid();
    const Position at{g.x / 2.0, g.y / 2.0, g.z / 2.0};
    const double radius = 6.25;
    simulation.pour(at, radius, 0.75);
    const bool paper = std::string(name) == "proving_ground";
    const Was liquid{false, true, false, 4096, static_cast<std::uint16_t>(paper ? 4096 : 0), 49151};
    Sum poured = 0;
    compare(simulation, before, at, radius, [&](const Was& was, const Was& is, bool in) {
      const bool air = !was.solid && !was.liquid && !was.inert;
      ASSERT_EQ(is, in && air ? liquid : was);
      poured += in && air ? 1 : 0;
    });
    EXPECT_GT(poured, 100);
    const Ledgers now = simulation.ledgers();
    EXPECT_TRUE(value_of(now.mass, "added") - value_of(books.mass, "added") == 4096 * poured);
    EXPECT_TRUE(value_of(now.heat, "added") - value_of(books.heat, "added") == 4096 * 49151 * poured);
    EXPECT_TRUE(now.balance());
    simulation.step(20);
    EXPECT_TRUE(simulation.ledgers().balance());
  }
}

TEST_F(ByHand, CarvingTakesMatterAndLeavesTheInert) {
  for (const char* name : {"proving_ground", "proving_ground_viscous", "chocolate_nuts"}) {
    Simulation simulation(scene(name));
    simulation.step(12);
    const std::vector<Was> before = cells_of(simulation);
    const Ledgers books = simulation.ledgers();
    const Grid g = simulation.grid();
    const Position at{g.x / 2.0, 3, g.z / 2.0};
    const double radius = std::floor(g.x / 3.0);  // whole, so that no rounding matters
    simulation.carve(at, radius);
    Sum mass = 0, heat = 0;
    int inert = 0;
    compare(simulation, before, at, radius, [&](const Was& was, const Was& is, bool in) {
      const bool matter = was.solid || was.liquid;
      ASSERT_EQ(is, in && matter ? Was{} : was);
      mass += in && matter ? was.amount : 0;
      heat += in && matter ? Sum{was.amount} * was.heat : 0;
      inert += in && was.inert;
    });
    EXPECT_TRUE(mass > 0) << name;
    EXPECT_TRUE(inert > 0 || std::string(name) == "chocolate_nuts") << name;
    const Ledgers now = simulation.ledgers();
    EXPECT_TRUE(value_of(books.mass, "removed") - value_of(now.mass, "removed") == mass);
    EXPECT_TRUE(value_of(books.heat, "removed") - value_of(now.heat, "removed") == heat);
    EXPECT_TRUE(now.balance());
    EXPECT_EQ(materials_of_no_solid(simulation), 0) << name;
    simulation.step(20);
    EXPECT_TRUE(simulation.ledgers().balance());
    EXPECT_EQ(materials_of_no_solid(simulation), 0) << name;
  }
}

// A scene that begins from an export has an engine that knows nothing of before: nothing sleeps in it. Its
// light comes from a checkpoint, because no export holds it.
TEST_F(ByHand, EveryEngineGoesOnLikeOneThatHasJustBegun) {
  struct Hand {
    bool pours;
    double x, y, z, radius;  // parts of the grid
  };
  const Hand hands[] = {{true, 0.5, 0.6, 0.5, 5},
                        {false, 0.5, 0.2, 0.4, 7},
                        {false, 0.9, 0.5, 0.9, 4},
                        {true, 0.1, 0.9, 0.2, 3},
                        {false, 0.5, 0.5, 0.5, 3}};
  for (const char* name : {"proving_ground", "proving_ground_viscous", "proving_ground_ends", "lesson_freeze",
                           "lesson_fall", "chocolate_nuts"}) {
    std::vector<std::uint64_t> wanted;
    for (const Implementation& one : implementations()) {
      if (!one.supported) continue;
      for (const int threads : {1, 2}) {
        std::optional<Simulation> simulation(std::in_place, scene(name), Options{{}, one.name, threads});
        const Grid g = simulation->grid();
        const bool anew = wanted.empty();  // the reference, opened again after each change
        std::size_t at = 0;
        simulation->step(40);
        for (const Hand& hand : hands) {
          const Position place{hand.x * g.x, hand.y * g.y, hand.z * g.z};
          if (hand.pours)
            simulation->pour(place, hand.radius, 0.9);
          else
            simulation->carve(place, hand.radius);
          if (anew) {
            simulation->save(folder / "now.vxc");
            simulation.emplace(folder / "now.vxc", Options{{}, one.name, threads});
          }
          for (int step = 0; step < 5; ++step, ++at) {
            simulation->step();
            if (anew) wanted.push_back(simulation->digest());
            ASSERT_EQ(simulation->digest(), wanted[at])
                << name << ", " << one.name << ", " << threads << " threads, step " << at;
          }
        }
        EXPECT_TRUE(simulation->ledgers().balance()) << name << ", " << one.name;
        if (one.name == "reference") break;
      }
    }
  }
}

// A lake at rest sleeps. Liquid that is poured onto it, and a hole in its dam, must wake it.
TEST_F(ByHand, WhatSleepsWakes) {
  const auto lake = write("lake.toml", R"(
[grid]
size = [96, 20, 24]
[[liquid]]
shape = "box"
size = [40, 8, 24]
at = [20, 4, 12]
[[solid]]
shape = "box"
size = [4, 14, 24]
at = [42, 7, 12]
[flow]
law = "viscous"
[flow.viscous]
kappa = 0.05
)");
  std::vector<std::uint64_t> digests;
  for (const char* implementation : {"reference", "auto"}) {
    Simulation simulation(lake, {{}, implementation, 1});
    simulation.step(20);
    const std::uint64_t still = simulation.digest();
    simulation.step(1);
    EXPECT_EQ(simulation.digest(), still) << "it shall sleep";
    simulation.carve({42, 4, 12}, 5);
    simulation.step(16);
    EXPECT_GT(simulation.state().amount.at(43, 3, 12), 0) << "it runs through the hole";
    digests.push_back(simulation.digest());
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST_F(ByHand, ThePictureAndWhoeverAsksSeeIt) {
  Simulation simulation(file);
  simulation.step(3);
  simulation.render();
  const std::uint64_t seen = simulation.changes().version;
  simulation.carve({10, 5, 10}, 2);
  const Changes changes = simulation.changes(seen);
  EXPECT_FALSE(changes.everything);
  ASSERT_FALSE(changes.bricks.empty());
  for (const ChangedBrick& brick : changes.bricks) EXPECT_TRUE(brick.matter && brick.x <= 63);
  simulation.save(folder / "now.vxc");
  Simulation fresh(folder / "now.vxc");
  EXPECT_EQ(simulation.render().rgb, fresh.render().rgb);
}

// A device draws the states that it has, and the host those that a hand has changed.
TEST_F(ByHand, ADeviceDrawsTheSamePictures) {
  const std::vector<Implementation> found = devices();
  if (found.empty()) GTEST_SKIP() << "no device of OpenCL here (Debian: pocl-opencl-icd)";
  Options options;
  options.implementation = found.front().name;
  Simulation device(file, options), host(file);
  Picture picture;
  picture.width = picture.height = 48;
  const auto both = [&](const auto& change) {
    change(device);
    change(host);
    EXPECT_EQ(device.render(picture).rgb, host.render(picture).rgb);
    picture.azimuth = picture.azimuth.value_or(10) + 35;
    EXPECT_EQ(device.render(picture).rgb, host.render(picture).rgb) << "from another side";
    return host.render(picture).rgb;
  };
  const auto begin = both([](Simulation&) {});
  both([](Simulation& one) { one.step(3); });
  both([](Simulation& one) { one.carve({10, 5, 10}, 2); });
  both([](Simulation& one) { one.pour({40, 6, 10}, 3, 0.8); });
  const auto end = both([](Simulation& one) { one.step(2); });
  both([](Simulation& one) { one.restart(); });
  both([](Simulation& one) { one.step(5); });
  EXPECT_NE(begin, end);
}

TEST_F(ByHand, ACheckpointAfterItGoesOn) {
  Simulation simulation(file);
  simulation.step(5);
  simulation.pour({40, 6, 10}, 3, 0.8);
  simulation.carve({10, 5, 10}, 2);
  simulation.save(folder / "now.vxc");
  Simulation again(folder / "now.vxc", {{}, "reference", 1});
  simulation.step(30);
  again.step(30);
  EXPECT_EQ(simulation.digest(), again.digest());
  EXPECT_TRUE(again.ledgers().balance());
  EXPECT_TRUE(value_of(again.ledgers().mass, "added") == value_of(simulation.ledgers().mass, "added"));
}

TEST_F(ByHand, WhatIsWrongIsRefusedAndChangesNothing) {
  Simulation simulation(file);
  const std::uint64_t before = simulation.digest();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto pour = [&](Position at, double radius, double temperature) {
    return message_of<InputError>([&] { simulation.pour(at, radius, temperature); });
  };
  EXPECT_EQ(pour({-9, 5, 5}, 3, 0.5), "pour: error: no cell of the grid is in the ball");
  EXPECT_EQ(pour({5, 5, 5}, 0.01, 0.5), "pour: error: no cell of the grid is in the ball");
  EXPECT_EQ(message_of<InputError>([&] {
              simulation.carve({5, 40, 5}, 20);
            }),
            "carve: error: no cell of the grid is in the ball");
  EXPECT_EQ(pour({5, 5, 5}, 0, 0.5), "pour: error: radius = 0 must be more than 0");
  EXPECT_EQ(pour({5, 5, 5}, 9000, 0.5), "pour: error: radius = 9000 exceeds 8192");
  EXPECT_EQ(pour({5, 5, 5}, 3, 1.5), "pour: error: temperature = 1.5 exceeds 1");
  for (const Position& at : {Position{nan, 5, 5}, Position{5, 1e300, 5}})
    EXPECT_NE(pour(at, 3, 0.5), "nothing");
  EXPECT_NE(pour({5, 5, 5}, nan, 0.5), "nothing");
  EXPECT_NE(pour({5, 5, 5}, 3, nan), "nothing");
  EXPECT_EQ(simulation.digest(), before);
  EXPECT_TRUE(simulation.ledgers().balance());
}

}  // namespace
}  // namespace voxmelt
