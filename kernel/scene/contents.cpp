#include "kernel/scene/contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "kernel/scene/look.h"
#include "kernel/scene/mesh_reader.h"
#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/shape_reader.h"
#include "kernel/scene/text/units.h"
#include "kernel/scene/volume_reader.h"

namespace voxmelt::scene {
namespace {

constexpr double kLargestScale = 1e9;

void raise(Terrain& terrain, const std::vector<double>& height) {
  for (std::size_t i = 0; i < height.size(); ++i)
    terrain.height[i] = std::max(terrain.height[i], static_cast<float>(height[i]));
}

// Returns the heat content at which a wall has the temperature that is asked for. It is 0 if none is.
rule::Temperature read_wall(Reader& reader, const rule::Material& material) {
  if (!reader.has("temperature")) return 0;
  const double asked = reader.number("temperature", fraction());
  const rule::Temperature temperature = std::max<rule::Temperature>(1, to_temperature(asked));
  if (temperature <= material.melting_point) return temperature;
  const int heat = temperature + material.latent_heat;
  const double latent = material.latent_heat / double{rule::kTemperatureMax};
  // Both are rounded, each by half a unit at most.
  if (heat > rule::kTemperatureMax + 1 || exceeds_range(asked + latent))
    reader.fail("temperature", fmt::format(" = {} exceeds {:.6g}: latent heat takes the rest of the range",
                                           asked, 1 - latent));
  return static_cast<rule::Temperature>(std::min(heat, rule::kTemperatureMax));
}

void read_floor(Reader& reader, Terrain& terrain, state::Grid grid) {
  const int thickness = reader.integer("thickness", 1, grid.y, 1);
  raise(terrain, std::vector<double>(terrain.height.size(), thickness));
}

// Warns of a stretched map. A map is stretched over the whole plan, and twice as much along one side as along
// the other is seldom meant.
void warn_of_stretching(const Elevation& elevation, state::Grid grid, const std::string& file,
                        std::vector<std::string>& warnings) {
  const double wide = elevation.columns * elevation.cell_x, deep = elevation.rows * elevation.cell_y;
  const double ratio = wide / deep * grid.z / grid.x;
  if (ratio >= 0.5 && ratio <= 2) return;
  warnings.push_back(fmt::format("{}: a map of {:g} x {:g} is stretched over {} x {} cells", file, wide, deep,
                                 grid.x, grid.z));
}

void read_heightfield(Reader& reader, Terrain& terrain, state::Grid grid,
                      std::vector<std::string>& warnings) {
  const std::filesystem::path file = reader.file("file");
  const double scale = reader.number("vertical_scale", above(0).at_most(kLargestScale));
  const double base = reader.number("base", at_most(grid.y).because("the height of the grid"), 1.0);
  const int passes = reader.integer("smooth", 0, 64, 1);

  Elevation elevation = read_elevation(file, reader.place("file"));
  if (elevation.missing > 0)
    warnings.push_back(fmt::format("{}: {} cells without data{} take the lowest elevation", file.string(),
                                   elevation.missing,
                                   elevation.unnamed == 0 ? "" : " (-9999; no NODATA_value is named)"));
  warn_of_stretching(elevation, grid, file.string(), warnings);
  const auto [lowest, tallest] = std::ranges::minmax(elevation.value);
  smooth(elevation, passes);
  std::vector<double> height = resample(elevation, grid.x, grid.z);
  for (double& h : height) h = base + scale * h;
  const double highest = *std::max_element(height.begin(), height.end());
  if (highest > grid.y)
    reader.fail("vertical_scale",
                fmt::format(" = {} raises the terrain to {:.1f} cells, above the grid's {}; its "
                            "elevations are {:g} to {:g}",
                            scale, highest, grid.y, lowest, tallest));
  raise(terrain, height);
  terrain.textured = true;
}

int read_material_name(Reader& reader, const std::vector<std::string>& materials) {
  if (!reader.has("material")) return 0;
  if (materials.empty()) reader.fail("material", " needs [[materials]]: the scene has one material");
  return 1 + static_cast<int>(reader.choice("material", {materials.begin() + 1, materials.end()}));
}

void read_state(Reader& reader, const rule::Material& material, const std::vector<std::string>& materials,
                Entry& entry) {
  if (entry.cut) return;
  if (entry.role == Role::inert) {
    entry.wall = read_wall(reader, material);
    return;
  }
  if (entry.role == Role::solid) entry.material = read_material_name(reader, materials);
  entry.temperature = reader.number("temperature", fraction(), 0.0);
  if (entry.role != Role::liquid) return;
  entry.amount = reader.number("amount", above(0).at_most(kLargestAmount), 1.0);
  entry.energy = reader.number("energy", at_most(entry.amount).because("the amount"), entry.amount);
}

}  // namespace

Contents read_contents(Reader& root, state::Grid grid, const rule::Parameters& parameters,
                       const std::vector<std::string>& materials, std::vector<std::string>& warnings) {
  Contents contents;
  contents.materials = parameters.materials;
  contents.terrain.x = grid.x;
  contents.terrain.z = grid.z;
  contents.terrain.height.resize(grid.columns());

  const std::vector<std::pair<const char*, Role>> lists{
      {"solid", Role::solid}, {"liquid", Role::liquid}, {"inert", Role::inert}};
  for (const auto& [list, role] : lists) {
    std::vector<Reader> readers = root.tables(list);
    for (std::size_t i = 0; i < readers.size(); ++i) {
      Reader& reader = readers[i];
      std::vector<std::string> names = shape_names();
      names.insert(names.end(), {"mesh", "volume", "heightfield", "floor"});
      const std::string shape = names[reader.choice("shape", names)];
      if (shape == "floor" || shape == "heightfield") {
        if (role != Role::inert) reader.fail("shape", fmt::format(" = \"{}\" is for [[inert]] only", shape));
        if (const rule::Temperature wall = read_wall(reader, parameters.material); wall > 0)
          contents.ground_wall = wall;
        if (shape == "floor") read_floor(reader, contents.terrain, grid);
        if (shape == "heightfield") read_heightfield(reader, contents.terrain, grid, warnings);
      } else {
        Entry entry;
        entry.role = role;
        entry.name = fmt::format("{}.{}", list, i);
        entry.cut = reader.flag("cut", false);
        read_state(reader, parameters.material, materials, entry);
        if (shape == "mesh")
          read_mesh_entry(reader, grid, entry);
        else if (shape == "volume")
          read_volume_entry(reader, grid, entry, warnings);
        else
          entry.shape = read_shape(reader, shape);
        contents.entries.push_back(std::move(entry));
      }
      reader.finish();
    }
  }
  return contents;
}

}  // namespace voxmelt::scene
