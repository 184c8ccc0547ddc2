#include "kernel/scene/model_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/scene/mesh_file/mesh_file.h"
#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/print.h"
#include "kernel/scene/volume_reader.h"
#include "kernel/scene/voxel_file/voxels.h"

namespace voxmelt::scene {
namespace {

// The longest side of the grid has 128 cells. The melt needs some of them beside the model.
constexpr int kSide = 128, kBeside = 16, kFloor = 2, kMargin = 4, kLeastHeight = 8;
constexpr int kSteps = 600, kFrames = 12;
constexpr double kGain = 0.03;  // temperature that a cell in the middle gains in a step, seen face-on

struct Plan {
  std::array<int, 3> grid{}, lamp{};
  double scale = 1;  // cells per unit of the file
  int power = 0;
};

// Returns the size of the model, as it stands.
Point size_of(const std::filesystem::path& model, bool z_is_up) {
  const Place place{std::make_shared<const Origin>(Origin{model.string(), {}, false})};
  if (is_voxel_file(model)) return size_of_volume(model, place);
  const Box box = read_mesh(model, place).bounds();
  const Point size = box.high - box.low;
  if (!(std::max({size.x, size.y, size.z}) > 0)) fail_at(place, "the model has no size");
  return z_is_up ? Point{size.x, size.z, size.y} : size;
}

Plan plan_of(Point size) {
  Plan plan;
  plan.scale = std::numeric_limits<double>::infinity();
  const double room = kSide - 2 * kBeside, height = kSide - kFloor - kMargin;
  for (const auto& [side, cells] : {std::pair{size.x, room}, {size.y, height}, {size.z, room}})
    if (side > 0) plan.scale = std::min(plan.scale, cells / side);
  const auto cells = [&](double side) { return static_cast<int>(std::ceil(side * plan.scale - 1e-6)); };
  plan.grid = {cells(size.x) + 2 * kBeside, kFloor + std::max(kLeastHeight, cells(size.y)) + kMargin,
               cells(size.z) + 2 * kBeside};
  plan.lamp = {plan.grid[0], plan.grid[1] * 11 / 10, plan.grid[2]};
  double square = 0;  // of the distance to the middle
  for (std::size_t i = 0; i < 3; ++i) square += std::pow(plan.lamp[i] - plan.grid[i] / 2.0, 2);
  plan.power = static_cast<int>(std::ceil(kGain * square));
  return plan;
}

// The numbers of flow and look are those of the bunny, which look well on most models.
constexpr std::string_view kText = R"(title = {title}
# voxmelt assumed all of this, as the model came without a scene. docs/scenes.md lists every key.

[grid]
size = [{x}, {y}, {z}]   # cells: x to the right, y up, z to the front
border = "open"          # what reaches the edge leaves the grid

[run]
steps = {steps}
frame_every = {every}

[[solid]]
shape = "{shape}"
file = {file}
up = "{up}"                 # the axis of the file that points up
fit = {{ margin = {margin}, floor = {floor} }}   # cells that stay free; `scale` and `at` place it by hand
temperature = 0.0        # at the beginning; 0 to 1 are the scene's

[[inert]]
shape = "floor"
thickness = {floor}

[material]
melting_point = 0.5

[heat]
gamma = 0.1              # conduction

[[heat_source]]          # a lamp at the upper right, in front
kind = "point"
at = [{lamp_x}, {lamp_y}, {lamp_z}]
power = {power}              # a face-on cell at distance d gains power / d^2 per step

[pieces]                 # what melts free falls
in_liquid = 4            # steps per cell

[flow]
law = "paper"            # or "viscous"

[flow.fall]
wall_factor = 0.25

[flow.paper]
neighbours = 8
threshold = 0.3
support = true           # only what stands on something spreads
alpha_liquid = 0.96
alpha_solid = 0.92
alpha_floor = 0.92
slump = 0.35

[look]                   # wax
solid = [0.56, 0.34, 0.17]
liquid = [0.58, 0.36, 0.19]
shininess = 50
specular = 0.45
)";

// A map has lava on its highest place. The numbers are those of `voxmelt new lava`.
constexpr int kRelief = 48, kAir = 16, kGround = 2, kNarrowest = 16;
constexpr int kLandSteps = 900, kVentRadius = 4;

struct Land {
  std::array<int, 3> grid{}, vent{};
  double scale = 1;  // cells per unit of the file
  double lowest = 0, highest = 0;
  int columns = 0, rows = 0;
};

// Finds where lava comes from: on the highest place that is an eighth or more away from each edge.
std::array<int, 3> summit(const std::vector<double>& height, int nx, int nz, double scale) {
  std::array<int, 3> best{nx / 2, 0, nz / 2};
  double highest = -1;
  for (int z = nz / 8; z < nz - nz / 8; ++z)
    for (int x = nx / 8; x < nx - nx / 8; ++x) {
      const double here = height[static_cast<std::size_t>(z) * nx + x];
      if (here <= highest) continue;
      highest = here;
      best = {x, kGround + static_cast<int>(std::ceil(here * scale)), z};
    }
  return best;
}

Land land_of(const std::filesystem::path& file) {
  const Place place{std::make_shared<const Origin>(Origin{file.string(), {}, false})};
  Elevation elevation = read_elevation(file, place);
  const auto [lowest, highest] = std::ranges::minmax(elevation.value);
  const double wide = elevation.columns * elevation.cell_x, deep = elevation.rows * elevation.cell_y;
  const auto cells = [&](double side) {
    return std::max(kNarrowest, static_cast<int>(std::lround(kSide * side / std::max(wide, deep))));
  };
  Land land{{cells(wide), kGround + kRelief + kAir, cells(deep)}, {}, 1, lowest, highest, 0, 0};
  land.columns = elevation.columns;
  land.rows = elevation.rows;
  if (highest > lowest) land.scale = std::min(kRelief / (highest - lowest), kHighestElevation);
  smooth(elevation, 1);
  land.vent = summit(resample(elevation, land.grid[0], land.grid[2]), land.grid[0], land.grid[2], land.scale);
  return land;
}

constexpr std::string_view kLandText = R"(title = {title}
# voxmelt assumed all of this, as the heights came without a scene. docs/scenes.md lists every key.

[grid]
size = [{x}, {y}, {z}]   # cells: x to the east, y up, z to the south
border = "open"          # what reaches the edge leaves the grid

[run]
steps = {steps}
frame_every = {every}

[[inert]]
shape = "heightfield"    # the ground: it never melts
file = {file}
vertical_scale = {scale:.6g}   # cells for a unit of height; less is flatter
base = {base}                 # cells below the lowest point

[[vent]]                 # where lava comes from
at = [{vent_x}, {vent_y}, {vent_z}]
radius = {radius}
rate = 0.04              # amount for each cell of the vent and step; 1 fills a cell
temperature = 0.95
from = 0
until = {until}

[material]
melting_point = 0.5

[heat]
gamma = 0.05             # conduction

[heat.air]               # lava cools where it meets the air
exchange = 0.004
bottom = 0.0

[flow]
law = "paper"            # or "viscous"

[flow.paper]
threshold = 0.2
support = true           # only what stands on something spreads
alpha_floor = 0.99
slump = 0.3

[flow.thermal]           # hot lava runs, cold lava crawls
reference = 0.6
doubling = 0.12

[camera]
elevation = 32           # degrees above the horizon

[look]
ground = [0.34, 0.32, 0.25]
liquid = [0.95, 0.42, 0.10]
glow = true              # hot lava shines
)";

ModelScene scene_of_land(const std::filesystem::path& file) {
  const Land land = land_of(file);
  const auto& [x, y, z] = land.grid;
  const auto& [vent_x, vent_y, vent_z] = land.vent;
  constexpr int until = kLandSteps * 7 / 9;
  const std::string name = file.filename().string();
  using fmt::arg;
  ModelScene scene;
  scene.text = fmt::format(kLandText, arg("title", toml_string(name)), arg("x", x), arg("y", y), arg("z", z),
                           arg("steps", kLandSteps), arg("every", kLandSteps / kFrames),
                           arg("file", toml_string(std::filesystem::absolute(file).string())),
                           arg("scale", land.scale), arg("base", kGround), arg("vent_x", vent_x),
                           arg("vent_y", vent_y), arg("vent_z", vent_z), arg("radius", kVentRadius),
                           arg("until", until));
  scene.assumed = {
      fmt::format("the {} x {} heights of {} are the ground of a grid of {} x {} x {} cells, {:.4g} to their "
                  "unit: {:g} to {:g} is {} cells high",
                  land.columns, land.rows, name, x, y, z, land.scale, land.lowest, land.highest,
                  land.highest > land.lowest ? kRelief : 0),
      fmt::format("lava of temperature 0.95 comes from [{}, {}, {}], the highest place, until step {}",
                  vent_x, vent_y, vent_z, until),
      fmt::format("it cools in air of temperature 0, and leaves at the edge; {} steps", kLandSteps)};
  return scene;
}

// Models for printing stand on z = 0. Those of the other formats mostly have y up.
bool has_z_up(const std::filesystem::path& model) {
  std::string ending = model.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), lower_case);
  return ending == ".stl";
}

}  // namespace

bool is_model_file(const std::filesystem::path& file) {
  return is_mesh_file(file) || is_voxel_file(file) || is_height_file(file);
}

ModelScene scene_of_model(const std::filesystem::path& model) {
  if (is_height_file(model)) return scene_of_land(model);
  const bool z_is_up = has_z_up(model);
  const Plan plan = plan_of(size_of(model, z_is_up));
  const auto& [x, y, z] = plan.grid;
  const auto& [lamp_x, lamp_y, lamp_z] = plan.lamp;
  const std::string name = model.filename().string();
  using fmt::arg;
  ModelScene scene;
  scene.text = fmt::format(
      kText, arg("title", toml_string(name)), arg("x", x), arg("y", y), arg("z", z), arg("steps", kSteps),
      arg("every", kSteps / kFrames), arg("file", toml_string(std::filesystem::absolute(model).string())),
      arg("shape", is_voxel_file(model) ? "volume" : "mesh"), arg("up", z_is_up ? "z" : "y"),
      arg("margin", kMargin), arg("floor", kFloor), arg("lamp_x", lamp_x), arg("lamp_y", lamp_y),
      arg("lamp_z", lamp_z), arg("power", plan.power));
  scene.assumed = {
      fmt::format("{} points up in {}; it is fitted to a grid of {} x {} x {} cells, {:.4g} to its unit",
                  z_is_up ? "z" : "y", name, x, y, z, plan.scale),
      "it stands on a floor, begins at temperature 0 and melts at 0.5",
      fmt::format("a lamp of power {} shines from [{}, {}, {}]; {} steps", plan.power, lamp_x, lamp_y, lamp_z,
                  kSteps)};
  return scene;
}

}  // namespace voxmelt::scene
