#include "hwmodel/pipeline/check/mismatch.h"

#include <fmt/format.h>

#include "hwmodel/pipeline/model/stage_kind.h"
#include "hwmodel/pipeline/model/volume_port.h"
#include "kernel/automaton/state/difference.h"

namespace voxmelt::hwmodel {

const char* name_of(Mismatch::Kind kind) {
  using enum Mismatch::Kind;
  switch (kind) {
    case stage:
      return "stage";
    case channel:
      return "channel";
    case memory:
      return "memory";
    case books:
      return "books";
    case software:
      return "software";
    case asleep:
      return "asleep";
    case missing:
      return "missing stage";
    case width:
      return "width";
    case address:
      return "address";
    case halo:
      return "halo";
    case cycles:
      return "cycles";
    case hang:
      return "hang";
  }
  return "";
}

std::string text_of(const Mismatch& m) {
  using enum Mismatch::Kind;
  std::string place = fmt::format("step {}", m.step);
  if (m.phase) place += fmt::format(", phase {}", name_of(m.phase));
  const bool of_software = m.kind == software || m.kind == asleep;
  if (!of_software && m.kind != missing && m.kind != cycles && m.kind != halo)
    place += fmt::format(", cascade position {}, lane {}, cycle {}", m.cascade, m.lane, m.cycle);
  if (m.kind == hang)
    return fmt::format(
        "the pipeline hangs: nothing moves any more at {}\n  {}\n  cell ({}, {}, {}) is waited for\n  {}\n",
        m.where, place, m.x, m.y, m.z, m.detail);
  std::string text = fmt::format("first mismatch ({}): {}\n  {}\n", name_of(m.kind), m.where, place);
  if (m.kind == cycles)
    return text + fmt::format("  the pass took {} cycles, not the {} of the closed form; {}\n", m.actual,
                              m.expected, m.detail);
  if (of_software && !m.detail.empty()) return text + "  " + m.detail + '\n';
  text += fmt::format("  cell ({}, {}, {})", m.x, m.y, m.z);
  if (m.kind == width || m.kind == address || m.kind == halo) return text + ": " + m.detail + '\n';
  text += fmt::format(": {} expected {} = {:#06x}, is {} = {:#06x}, bits that differ {:#06x}\n", m.field,
                      m.expected, m.expected, m.actual, m.actual, m.expected ^ m.actual);
  if (m.neighbourhood.empty()) return text;
  text += "  before it, around it (state and amount, # outside; x to the right, z downwards):\n";
  for (const std::string& line : m.neighbourhood) text += "    " + line + '\n';
  return text;
}

std::vector<std::string> neighbourhood(const state::Volume& volume, int x, int y, int z) {
  constexpr const char* kLetters = "-lsi";  // air, liquid, solid, inert
  std::vector<std::string> lines;
  for (int dy = 1; dy >= -1; --dy) {
    lines.push_back(fmt::format("y = {}", y + dy));
    for (int dz = -1; dz <= 1; ++dz) {
      std::string line;
      for (int dx = -1; dx <= 1; ++dx) {
        const int cx = x + dx, cy = y + dy, cz = z + dz;
        const bool centre = dx == 0 && dy == 0 && dz == 0;
        std::string cell = "#";
        if (volume.grid.contains(cx, cy, cz))
          cell = fmt::format("{}{}", kLetters[static_cast<int>(state_at(volume, cx, cy, cz))],
                             volume.amount[volume.at(cx, cy, cz)]);
        line += fmt::format("{:>9}", centre ? "[" + cell + "]" : cell);
      }
      lines.push_back(line);
    }
  }
  return lines;
}

Difference first_difference(const state::Volume& expected, const state::Volume& actual) {
  const std::optional<state::Difference> found = state::first_difference(expected, actual);
  if (!found) return {};
  const auto [x, y, z, field, wanted, is] = *found;
  const auto a = static_cast<int>(state_at(expected, x, y, z)),
             b = static_cast<int>(state_at(actual, x, y, z));
  if (a != b) return {x, y, z, "state", a, b};
  return {x, y, z, std::string(field), wanted, is};
}

}  // namespace voxmelt::hwmodel
