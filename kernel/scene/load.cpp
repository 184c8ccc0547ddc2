#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/scene/contents.h"
#include "kernel/scene/features.h"
#include "kernel/scene/look_reader.h"
#include "kernel/scene/memory.h"
#include "kernel/scene/model_scene.h"
#include "kernel/scene/overrides.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/start.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/print.h"
#include "kernel/scene/text/reader.h"
#include "kernel/scene/text/text_file.h"
#include "kernel/scene/timeline.h"

namespace voxmelt::scene {
namespace {

constexpr double kLargestSide = 4096;
constexpr std::uint32_t kMostSteps = 0xFFFFFFFF;

state::Grid read_grid(Reader& root, rule::Parameters& parameters) {
  std::optional<Reader> reader = root.table("grid");
  if (!reader) fail_at(root.place(), "grid.size is missing: a scene needs [grid] size = [x, y, z]");
  const Vec3 size = reader->vector<3>("size", at_least(1).at_most(kLargestSide));
  const auto whole = [&](double side) {
    const int cells = static_cast<int>(side);
    if (side != cells) reader->fail("size", " must be whole numbers of cells");
    return cells;
  };
  const state::Grid grid{whole(size[0]), whole(size[1]), whole(size[2])};
  parameters.open_border = reader->choice("border", {"closed", "open"}, 0) == 1;
  reader->finish();
  check_memory(grid, reader->place("size"));
  return grid;
}

void read_run(Reader& root, Scene& scene) {
  std::optional<Reader> reader = root.table("run");
  if (!reader) return;
  scene.steps = reader->integer("steps", 0, kMostSteps, scene.steps);
  scene.frame_every = reader->integer("frame_every", 1, kMostSteps, scene.frame_every);
  scene.parameters.seed = reader->integer("seed", 0, INT64_MAX, scene.parameters.seed);
  reader->finish();
}

bool can_flow(const Contents& contents, const rule::Parameters& parameters) {
  if (!parameters.vents.empty()) return true;
  for (const Entry& entry : contents.entries)
    if (entry.role != Role::inert && !entry.cut) return true;
  return false;
}

void use_palette(Palette palette, Scene& scene) {
  scene.materials = std::move(palette.names);
  scene.parameters.materials = std::move(palette.rows);
  for (const std::optional<Vec3>& color : palette.colors)
    scene.look.materials.push_back(color.value_or(scene.look.solid));
}

// Reads everything except what fills the grid. It returns the size of the grid.
state::Grid read_settings(Reader& root, Scene& scene) {
  scene.title = root.text("title", scene.name);
  root.text("description", "");

  const state::Grid grid = read_grid(root, scene.parameters);
  read_run(root, scene);
  scene.parameters.material = read_material(root);
  scene.parameters.pieces = read_pieces(root);
  scene.parameters.heat = read_heat(root, grid.y, scene.warnings);
  scene.parameters.vents = read_vents(root);
  scene.parameters.drains = read_drains(root);
  scene.parameters.flow = read_flow(root, scene.warnings);
  scene.camera = read_camera(root, grid);
  scene.light = read_light(root);
  scene.look = read_look(root);
  scene.changes = read_timeline(root);
  use_palette(read_palette(root, scene.parameters.material, scene.parameters.heat), scene);
  return grid;
}

// Returns the text that load_settings() reads again.
std::string settings_of(Value document) {
  for (const char* list : {"solid", "liquid", "inert", "start"}) document.remove(list);
  return print_document(document);
}

Value document_of(const ModelScene& model, const std::filesystem::path& file) {
  return parse_text(model.text,
                    std::make_shared<const Origin>(Origin{file.string() + " (its scene)", {}, false}));
}

// Tells if every cell that touches this place is solid or inert. Outside the grid no cell is.
bool is_buried(const state::Volume& cells, const rule::Position& at) {
  constexpr std::int64_t cell = rule::kPositionUnit;
  const state::Grid g = cells.grid;
  const auto first = [](std::int64_t a) { return a < 0 || a % cell == 0 ? a / cell - 1 : a / cell; };
  for (std::int64_t z = first(at.z); z <= at.z / cell; ++z)
    for (std::int64_t y = first(at.y); y <= at.y / cell; ++y)
      for (std::int64_t x = first(at.x); x <= at.x / cell; ++x) {
        if (x < 0 || y < 0 || z < 0 || x >= g.x || y >= g.y || z >= g.z) return false;
        const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
        if (!cells.solid.test(i, j, k) && !cells.inert.test(i, j, k)) return false;
      }
  return true;
}

void warn_of_buried_sources(Scene& scene) {
  const rule::Heat& heat = scene.parameters.heat;
  if (!heat.radiates()) return;
  for (std::size_t i = 0; i < heat.sources.size(); ++i)
    if (heat.sources[i].kind == rule::SourceKind::point &&
        is_buried(scene.initial, heat.sources[i].keys[0].at))
      scene.warnings.push_back(
          fmt::format("heat_source.{} stands inside matter at first: there it lights nothing", i));
}

}  // namespace

std::string title_of(const std::filesystem::path& file) {
  const Value document = read_document(file);
  const Value* title = document.find("title");
  return title != nullptr && title->kind == Value::Kind::text ? title->text : "";
}

Scene load(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const FilesRead read;
  ModelScene model;
  if (is_model_file(file)) model = scene_of_model(file);
  Value document = model.text.empty() ? read_document(file) : document_of(model, file);
  for (const std::string& assignment : overrides) apply_override(document, assignment);

  Scene scene;
  scene.file = file;
  scene.name = file.stem().string();
  scene.assumed = std::move(model.assumed);
  scene.assumed_text = std::move(model.text);
  Reader root(document, "");
  const state::Grid grid = read_settings(root, scene);

  // The fields of an export replace the shapes. The terrain still determines how the ground is drawn.
  Contents contents = read_contents(root, grid, scene.parameters, scene.materials, scene.warnings);
  std::optional<Reader> start = root.table("start");
  std::filesystem::path fields;
  if (start) {
    fields = start->file("fields");
    scene.first_step = start->integer("step", 0, kMostSteps, 0);
    start->finish();
  }
  root.finish();
  if (!start && !can_flow(contents, scene.parameters))
    fail_at(document.place, "nothing can flow: a scene needs a [[solid]], a [[liquid]] or a [[vent]]");

  state::Volume cells =
      start ? read_fields(fields, grid, start->place("fields")) : voxelise(contents, grid, scene.warnings);
  // Fields that the scene does not model are dropped, with a warning.
  const std::vector<std::string> dropped = fit_fields(cells, scene.parameters);
  if (start) scene.warnings.insert(scene.warnings.end(), dropped.begin(), dropped.end());
  if (start && scene.parameters.has_materials())
    if (const std::string broken = first_broken(cells, scene.materials.size()); !broken.empty())
      fail_at(start->place("fields"), fields.string() + ": " + broken);
  fill(scene, std::move(cells));
  if (start && scene.parameters.heat.visibility_age(scene.first_step) != 0)
    scene.warnings.push_back(
        fmt::format("{}: start.step = {} is no step of visibility: what heat sources light is computed anew, "
                    "and the bits "
                    "differ from those of the run that was exported until the next such step",
                    start->place("step").text(), scene.first_step));
  warn_of_buried_sources(scene);
  scene.initial_digest = state::digest(scene.initial);
  scene.files = read.files();
  scene.terrain = std::move(contents.terrain);
  scene.text = portable_text(document);
  scene.settings = settings_of(std::move(document));
  return scene;
}

Scene load_settings(const std::string& settings, const std::string& origin) {
  const Value document = parse_text(settings, std::make_shared<const Origin>(Origin{origin, {}, false}));
  Scene scene;
  scene.name = "checkpoint";
  Reader root(document, "");
  scene.initial = state::Volume(read_settings(root, scene));
  root.finish();
  scene.settings = settings;
  return scene;
}

void check_overrides(const std::string& settings, const std::vector<std::string>& overrides) {
  Value document = parse_text(settings, std::make_shared<const Origin>(Origin{"the scene", {}, false}));
  for (const std::string& assignment : overrides) apply_override(document, assignment);
  Scene scene;
  Reader root(document, "");
  read_settings(root, scene);
  root.finish();
}

void fill(Scene& scene, state::Volume cells) {
  scene.initial = std::move(cells);
  scene.parameters.heat.walls = scene.parameters.heat.enabled && has_walls(scene.initial);
  scene.features = features_of(scene.parameters);
}

}  // namespace voxmelt::scene
