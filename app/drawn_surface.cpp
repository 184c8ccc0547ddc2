#include "app/drawn_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "app/run_record.h"

namespace voxmelt::app {
namespace {

constexpr std::uint16_t kInside = render::kFull / 2;

// Returns the matter of a state alone. Where there is none, the copy takes no memory.
state::Volume matter_of(const state::Volume& from) {
  state::Volume matter(from.grid);
  for (int z = 0; z < from.grid.z; ++z)
    for (int y = 0; y < from.grid.y; ++y) {
      const auto solid = from.solid.row(y, z), liquid = from.liquid.row(y, z);
      for (std::size_t word = 0; word < solid.size(); ++word) {
        if ((solid[word] | liquid[word]) == 0) continue;
        matter.solid.row(y, z)[word] = solid[word];
        matter.liquid.row(y, z)[word] = liquid[word];
        for (int x = static_cast<int>(64 * word); x < from.grid.x && x < static_cast<int>(64 * word) + 64;
             ++x)
          if (((solid[word] | liquid[word]) >> (x & 63) & 1) != 0)
            matter.amount[matter.at(x, y, z)] = from.amount[from.at(x, y, z)];
      }
    }
  return matter;
}

}  // namespace

Option add_surface(Command command, std::string& surface) {
  return command
      .option(
          "--surface", surface,
          "what ply, glb, stl and obj show: the smooth surface of the picture, or cells that are half full "
          "(default: picture)")
      .one_of({kSurfaces.begin(), kSurfaces.end()});
}

std::string surface_named(const std::string& surface, const std::vector<std::string>& formats) {
  const bool asked =
      std::ranges::any_of(formats, [](const std::string& name) { return io::find_format(name)->of_surface; });
  if (!surface.empty() && !asked)
    throw UsageError(fmt::format("--surface {}: error: only ply, glb, stl and obj write a surface", surface));
  return surface;
}

io::Lattice DrawnSurface::of(const state::Volume& volume, const scene::Scene& scene, int threads) {
  scene::Look plain = scene.look;
  plain.glow = false;  // what matter is made of comes from its cells
  plain.materials.clear();
  field_.update(volume, plain, scene.terrain, threads);
  if (volume.inert.count() == 0) return {field_.intensity().data(), kInside};
  matter_field_.update(matter_of(volume), plain, {}, threads);
  numbers_ = render::Values<std::uint16_t>(field_.intensity().size());
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y) leave_ground_out(volume, y, z);
  return {numbers_.data(), kInside};
}

// Inert cells are outside. They carry thin liquid, so matter has the whole field. But where there is no
// matter, only matter may bring a cell inside.
void DrawnSurface::leave_ground_out(const state::Volume& volume, int y, int z) {
  const std::size_t first = volume.grid.index(0, y, z);
  const std::uint16_t* const all = field_.intensity().data() + first;
  const std::uint16_t* const alone = matter_field_.intensity().data() + first;
  for (int x = 0; x < volume.grid.x; ++x) {
    if (all[x] == 0 || volume.inert.test(x, y, z)) continue;
    const bool matter = volume.solid.test(x, y, z) || volume.liquid.test(x, y, z);
    const bool carried = !matter && alone[x] < kInside;
    numbers_[first + static_cast<std::size_t>(x)] =
        carried ? std::min<std::uint16_t>(all[x], kInside - 1) : all[x];
  }
}

}  // namespace voxmelt::app
