#include "kernel/scene/stand.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
double read_unit(Reader& reader) {
  if (!reader.has("unit")) return 1;
  constexpr std::array metres{1.0, 0.01, 0.001, 0.0254, 0.3048};
  const double metre = metres[reader.choice("unit", {"m", "cm", "mm", "in", "ft"})];
  if (!reader.has("scale")) reader.fail("unit", " needs scale, which counts cells per metre then");
  return metre;
}

std::optional<Stand> read_fit(Reader& reader, const std::filesystem::path& file, const Box& box,
                              state::Grid grid) {
  std::optional<Reader> fit = reader.table("fit");
  if (!fit) return std::nullopt;
  for (const char* key : {"height", "scale", "at"})
    if (reader.has(key)) reader.fail(key, " and fit exclude each other");
  const double margin = fit->number("margin", at_most(kLargestMeshCoordinate), 2.0);
  const double floor = fit->number("floor", at_most(grid.y).because("the height of the grid"), 0.0);
  fit->finish();
  const std::array room{grid.x - 2 * margin, grid.y - floor - margin, grid.z - 2 * margin};
  if (std::min({room[0], room[1], room[2]}) <= 0)
    reader.fail("fit", fmt::format(": a margin of {} and a floor of {} leave no room", margin, floor));
  const Point size = box.high - box.low;
  double scale = std::numeric_limits<double>::infinity();
  for (const auto& [side, space] : {std::pair{size.x, room[0]}, {size.y, room[1]}, {size.z, room[2]}})
    if (side > 0) scale = std::min(scale, space / side);
  if (!std::isfinite(scale)) reader.fail("fit", ": " + file.string() + " has no size to fit");
  return Stand{{grid.x / 2.0, floor, grid.z / 2.0}, scale};
}

}  // namespace voxmelt::scene
