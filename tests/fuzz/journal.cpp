// The target reads a journal, and makes its changes in a small world that steps between them. The first byte
// says which law. The text of the lines gives the same lines again.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "library/journal/journal.h"
#include "library/journal/world.h"
#include "tests/fuzz/small_world.h"
#include "tests/fuzz/target.h"
#include "voxmelt/voxmelt.h"

namespace {

constexpr const char* kLaws[] = {"[flow]\nlaw = \"paper\"\n",
                                 "[flow]\nlaw = \"viscous\"\n[flow.viscous]\nkappa = 0.1\n"};
constexpr std::uint32_t kSteps = 6;

bool same(const std::vector<voxmelt::journal::Line>& a, const std::vector<voxmelt::journal::Line>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.step == other.step && one.change == other.change;
  });
}

// A change that is refused changes nothing, and the books balance whatever was changed.
void run(std::vector<voxmelt::journal::Line> lines, bool viscous) {
  using namespace voxmelt;
  static const auto file = fuzz::write("scene.toml", std::string(fuzz::kSmallWorld) + kLaws[0]);
  static const auto other = fuzz::write("viscous.toml", std::string(fuzz::kSmallWorld) + kLaws[1]);
  Simulation simulation(viscous ? other : file, {{}, "reference", 1});
  journal::WorldOf<Simulation> world(simulation);
  for (journal::Line& line : lines) {
    line.step = std::min(line.step, kSteps);
    simulation.step(line.step - std::min(line.step, simulation.steps_done()));
    const std::uint64_t before = simulation.digest();
    try {
      journal::apply(line.change, world);
    } catch (const InputError&) {
      if (simulation.digest() != before) fuzz::found("a change that was refused has changed something");
    }
  }
  simulation.step();
  if (!simulation.ledgers().balance()) fuzz::found("the ledgers do not balance");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  if (size == 0 || size > 2000) return 0;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  try {
    std::vector<journal::Line> lines = journal::parse_journal(text, "journal");
    if (!same(lines, journal::parse_journal(journal::text_of(lines), "again")))
      fuzz::found("the text gives other lines");
    if (lines.size() > 20) lines.resize(20);
    run(std::move(lines), data[0] & 1);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos)
      fuzz::found("a message of two lines");
    fuzz::check_message(error.what());
  }
  return 0;
}
