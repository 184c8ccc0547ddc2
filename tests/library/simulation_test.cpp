// The public interface gives what the rooms inside give, and its errors are its own.
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <limits>
#include <locale>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "library/ledgers.h"
#include "library/translate.h"
#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

using Library = SceneFile;

// The approved digests were agreed on by the oracle, a second program.
TEST_F(Library, HasTheApprovedDigestsAndCounts) {
  std::ifstream approved_file(VOXMELT_APPROVED_DIGESTS);
  const nlohmann::json approved = nlohmann::json::parse(approved_file);
  for (const std::string scene :
       {"bunny_small", "proving_ground", "proving_ground_viscous", "lesson_tubes"}) {
    std::vector<Implementation> all = implementations();
    if (scene == "lesson_tubes")  // a device builds a program for each scene
      for (const Implementation& one : devices()) all.push_back(one);
    for (const Implementation& one : all) {
      if (!one.supported) continue;
      Options options;
      options.implementation = one.name;
      Simulation simulation(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene + ".toml"), options);
      EXPECT_EQ(simulation.implementation(), one.name);
      simulation.step(10);
      std::array<char, 200> line{};
      std::snprintf(line.data(), line.size(), "step %u digest %016llx mass %s solid %zu liquid %zu",
                    simulation.steps_done(), static_cast<unsigned long long>(simulation.digest()),
                    to_string(simulation.ledgers().mass.held).c_str(), simulation.state().solid.count(),
                    simulation.state().liquid.count());
      EXPECT_EQ(line.data(), approved.at(scene).at("10").get<std::string>()) << one.name;
      EXPECT_TRUE(simulation.ledgers().balance());
    }
  }
}

// Writes 1.234,5 where the classic locale writes 1234.5.
class CommasAndPoints : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// The program around the library has a locale of its own. The scene has a mesh, or a height field with
// decimals.
TEST_F(Library, NoLocaleChangesWhatItReadsAndWrites) {
  const auto outcome = [&](const char* scene) {
    Simulation simulation(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (std::string(scene) + ".toml"));
    simulation.step(5);
    const std::filesystem::path exported = "locale_test_export";
    simulation.export_state(exported, "vti");
    std::ifstream vti(exported / "volume.vti", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(vti), {}};
    std::filesystem::remove_all(exported);
    return std::pair(simulation.digest(), bytes);
  };
  for (const char* scene : {"bunny_small", "lava"}) {
    const auto classic = outcome(scene);
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommasAndPoints));
    const auto other = outcome(scene);
    std::locale::global(before);
    EXPECT_EQ(other.first, classic.first) << scene;
    EXPECT_TRUE(other.second == classic.second) << scene;
  }
}

// The digest of section 13 of docs/automaton.md follows from the views alone: their values, their order,
// their padding.
TEST_F(Library, TheDigestFollowsFromTheViews) {
  Simulation simulation(std::filesystem::path(VOXMELT_SCENES_FOLDER) / "proving_ground.toml");
  simulation.step(40);
  const State s = simulation.state();
  ASSERT_GT(s.liquid.count(), 0u);
  std::uint64_t sum = 0, index = 0;
  for (int z = 0; z < s.grid.z; ++z)
    for (int y = 0; y < s.grid.y; ++y)
      for (int x = 0; x < s.grid.x; ++x, ++index) {
        const std::uint64_t packed =
            s.amount.at(x, y, z) | std::uint64_t{s.energy.at(x, y, z)} << 16 |
            std::uint64_t{s.heat.at(x, y, z)} << 32 | std::uint64_t{s.solid.test(x, y, z)} << 48 |
            std::uint64_t{s.liquid.test(x, y, z)} << 49 | std::uint64_t{s.inert.test(x, y, z)} << 50;
        if (packed == 0) continue;
        std::uint64_t v = packed + 0x9E3779B97F4A7C15u * (index + 1);
        v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
        v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
        sum += v ^ (v >> 31);
      }
  EXPECT_EQ(sum, simulation.digest());
}

// The terms have the names in report.json, and each ledger adds up to what the views hold.
TEST_F(Library, LedgersAddUpToWhatIsThere) {
  Simulation simulation(std::filesystem::path(VOXMELT_SCENES_FOLDER) / "proving_ground.toml");
  simulation.step(60);
  const State s = simulation.state();
  Sum mass = 0, energy = 0, heat = 0;
  for (int z = 0; z < s.grid.z; ++z)
    for (int y = 0; y < s.grid.y; ++y)
      for (int x = 0; x < s.grid.x; ++x) {
        if (s.inert.test(x, y, z)) continue;
        mass += s.amount.at(x, y, z);
        energy += s.energy.at(x, y, z);
        heat += Sum{s.amount.at(x, y, z)} * s.heat.at(x, y, z);
      }
  const Ledgers books = simulation.ledgers();
  const auto check = [](const Ledger& ledger, Sum held, const std::vector<std::string>& names) {
    EXPECT_TRUE(ledger.held == held);
    std::vector<std::string> found;
    Sum sum = ledger.start;
    for (const Term& term : ledger.terms) {
      found.push_back(term.name);
      sum += term.value;
    }
    EXPECT_EQ(found, names);
    EXPECT_TRUE(sum == held);
  };
  check(books.mass, mass, {"added", "removed"});
  check(books.energy, energy,
        {"melted", "frozen", "added", "removed", "reheated", "accelerated", "dissipated", "capped"});
  check(books.heat, heat,
        {"conducted", "walls", "convected", "radiated", "warmed", "cooled", "melted", "added", "removed",
         "rounded"});

  Ledgers broken = books;
  broken.heat.held += 1;
  EXPECT_EQ(to_string(broken.heat.drift()), "1");
  EXPECT_FALSE(broken.balance());
}

// Section 12 says which terms are subtracted.
TEST_F(Library, TermsHaveTheirSigns) {
  state::Ledger ledger;
  ledger.mass.start = ledger.energy.start = ledger.heat.start = 1;
  ledger.mass.added = 2;
  ledger.mass.removed = 3;
  state::EnergyLedger& e = ledger.energy;
  e.melted = 2;
  e.frozen = 9;
  e.added = 3;
  e.removed = 4;
  e.reheated = 5;
  e.accelerated = 6;
  e.dissipated = 7;
  e.capped = 8;
  state::HeatLedger& h = ledger.heat;
  h.conducted = 2;
  h.convected = 3;
  h.radiated = 4;
  h.warmed = 5;
  h.cooled = 6;
  h.added = 7;
  h.removed = 8;
  h.rounded = 9;
  h.walls = 10;
  h.melted = 11;
  const Ledgers books = library::to_ledgers(ledger, {.solid = 10, .liquid = 20, .energy = 30, .heat = 40});
  const auto text = [](const Ledger& one) {
    std::string all = to_string(one.start) + " ";
    for (const Term& term : one.terms) all += term.name + " " + to_string(term.value) + " ";
    return all + to_string(one.held);
  };
  EXPECT_EQ(text(books.mass), "1 added 2 removed -3 30");
  EXPECT_EQ(text(books.energy),
            "1 melted 2 frozen -9 added 3 removed -4 reheated 5 accelerated 6 dissipated -7 capped -8 30");
  EXPECT_EQ(
      text(books.heat),
      "1 conducted 2 walls 10 convected 3 radiated 4 warmed 5 cooled -6 melted 11 added 7 removed -8 rounded "
      "9 40");
}

TEST_F(Library, OverridesThreadsAndSteps) {
  Options options;
  options.overrides = {"run.steps=77", "title=other"};
  options.threads = 1;
  Simulation simulation(file, options);
  EXPECT_EQ(simulation.title(), "other");
  EXPECT_EQ(simulation.scene_steps(), 77u);
  EXPECT_EQ(simulation.threads(), 1);
  EXPECT_EQ(simulation.grid(), (Grid{70, 12, 20}));
  simulation.step();
  simulation.step(2);
  EXPECT_EQ(simulation.steps_done(), 3u);
  EXPECT_EQ(simulation.step_number(), 3u);
  Simulation moved = std::move(simulation);
  EXPECT_EQ(moved.steps_done(), 3u);
}

// The same fields are found by their names, each cell as in the view that the state has of it.
TEST_F(Library, EveryFieldIsFoundByItsName) {
  Simulation simulation(std::filesystem::path(VOXMELT_SCENES_FOLDER) / "proving_ground.toml");
  simulation.step(40);
  const State s = simulation.state();
  std::string names;
  for (const NamedField& field : s.fields) names += std::string(field.name) + " ";
  ASSERT_EQ(names, "solid liquid inert amount energy heat ");
  EXPECT_EQ(s.fields[0].unit, "");
  EXPECT_EQ(s.fields[3].unit, "1/4096 of a full cell");
  for (int z = 0; z < s.grid.z; ++z)
    for (int y = 0; y < s.grid.y; ++y)
      for (int x = 0; x < s.grid.x; ++x) {
        ASSERT_EQ(s.fields[0].at(x, y, z), s.solid.test(x, y, z) ? 1u : 0u);
        ASSERT_EQ(s.fields[1].at(x, y, z), s.liquid.test(x, y, z) ? 1u : 0u);
        ASSERT_EQ(s.fields[2].at(x, y, z), s.inert.test(x, y, z) ? 1u : 0u);
        ASSERT_EQ(s.fields[3].at(x, y, z), s.amount.at(x, y, z));
        ASSERT_EQ(s.fields[4].at(x, y, z), s.energy.at(x, y, z));
        ASSERT_EQ(s.fields[5].at(x, y, z), s.heat.at(x, y, z));
      }
}

TEST_F(Library, AnExportGoesOnTheSame) {
  Simulation simulation(file);
  simulation.step(8);
  simulation.export_state(folder / "there");
  simulation.export_state(folder / "there");  // over itself
  simulation.export_state(folder / "vti", "vti");
  EXPECT_TRUE(std::filesystem::exists(folder / "vti/volume.vti"));
  EXPECT_TRUE(message_of<InputError>([&] {
                simulation.export_state(folder / "none", "tiff");
              }).starts_with("export_state: error: format = \"tiff\" is not one of npy, vti"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none"));
  std::vector<std::string> names;
  for (const Format& format : formats()) names.push_back(format.name);
  ASSERT_GE(names.size(), 2u);
  EXPECT_EQ(names[0], "npy");
  EXPECT_EQ(names[1], "vti");
  Options options;
  options.overrides = {"start={fields=\"" + (folder / "there").string() + "\", step=8}"};
  Simulation again(file, options);
  EXPECT_EQ(again.step_number(), 8u);
  EXPECT_EQ(again.digest(), simulation.digest());
  simulation.step(9);
  again.step(9);
  EXPECT_EQ(again.digest(), simulation.digest());
}

TEST_F(Library, DrawsWithTheScenesCameraOrAnother) {
  Simulation simulation(file);
  Picture small;
  small.width = 64;
  small.height = 48;
  const auto bytes = [&](const Picture& picture) {
    simulation.draw(folder / "p.png", picture);
    std::ifstream png(folder / "p.png", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(png), {});
  };
  const std::string first = bytes(small);
  EXPECT_EQ(first.substr(1, 3), "PNG");
  EXPECT_EQ(first.substr(16, 8), std::string("\0\0\0\x40\0\0\0\x30", 8));
  EXPECT_EQ(bytes(small), first);
  small.azimuth = 90;
  const std::string aside = bytes(small);
  EXPECT_NE(aside, first);
  simulation.step(120);
  EXPECT_NE(bytes(small), aside) << "it has melted";
}

TEST_F(Library, ErrorsAreItsOwn) {
  const auto open = [](const std::filesystem::path& scene, const Options& options = {}) {
    return [=] { Simulation simulation(scene, options); };
  };
  EXPECT_NE(message_of<InputError>(open(folder / "no.toml")).find("no.toml"), std::string::npos);
  const auto wrong = write("wrong.toml", "[grid]\nsize = [1, 2]\n");
  EXPECT_NE(message_of<InputError>(open(wrong)).find("wrong.toml:2:8: error: grid.size"), std::string::npos);
  EXPECT_EQ(message_of<InputError>(open(file, {{"heat.gamma=7"}, "auto", 0})),
            "--set heat.gamma=7: error: heat.gamma = 7 exceeds 0.5236, the bound for 6 neighbours");
  EXPECT_NE(message_of<InputError>(open(file, {{}, "abacus", 0})).find("abacus"), std::string::npos);
  for (const int threads : {-1, 1025})
    EXPECT_NE(message_of<InputError>(open(file, {{}, "auto", threads})).find("threads"), std::string::npos);

  Simulation simulation(file);
  EXPECT_NE(message_of<OutputError>([&] { simulation.draw(folder / "no/p.png"); }).find("p.png"),
            std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { simulation.export_state(file); }), "nothing");
  Picture picture;
  picture.width = 16385;
  EXPECT_EQ(message_of<InputError>([&] { simulation.draw(folder / "p.png", picture); }),
            "Picture: error: width = 16385 is outside 16..16384");
  picture = {};
  picture.azimuth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of<InputError>([&] { simulation.draw(folder / "p.png", picture); }), "nothing");
  simulation.step();
  EXPECT_NE(message_of<InputError>([&] { simulation.step(0xFFFFFFFFu); }), "nothing");
  EXPECT_EQ(simulation.steps_done(), 1u);
}

// No test can use up memory or disk on every machine, so errors are translated directly.
TEST(Errors, OfTheRoomsInsideBecomePublicOnes) {
  const auto thrown = [](const auto& error) { return [&] { library::translated([&] { throw error; }); }; };
  EXPECT_EQ(message_of<InputError>(thrown(scene::InputError("a"))), "a");
  EXPECT_EQ(message_of<ResourceError>(thrown(scene::ResourceError("b"))), "b");
  EXPECT_EQ(message_of<OutputError>(thrown(io::OutputError("c", false))), "c");
  EXPECT_EQ(message_of<ResourceError>(thrown(io::OutputError("d", true))), "d");
  EXPECT_EQ(message_of<OutputError>(thrown(render::ImageError("e", false))), "e");
  EXPECT_EQ(message_of<ResourceError>(thrown(render::ImageError("f", true))), "f");
  EXPECT_EQ(message_of<ResourceError>(thrown(std::bad_alloc())), "error: out of memory");
  EXPECT_EQ(message_of<std::logic_error>(thrown(std::logic_error("g"))), "g") << "a bug stays one";
}

}  // namespace
}  // namespace voxmelt
