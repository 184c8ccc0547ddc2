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

#include "kernel/scene/mesh_file/mesh_file.h"
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

// Models for printing stand on z = 0. Those of the other formats mostly have y up.
bool has_z_up(const std::filesystem::path& model) {
  std::string ending = model.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), lower_case);
  return ending == ".stl";
}

}  // namespace

bool is_model_file(const std::filesystem::path& file) { return is_mesh_file(file) || is_voxel_file(file); }

ModelScene scene_of_model(const std::filesystem::path& model) {
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
