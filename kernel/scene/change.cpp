#include "kernel/scene/change.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "kernel/scene/features.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/print.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {
namespace {

Value parsed(const std::string& settings, const std::string& name) {
  return parse_text(settings, std::make_shared<const Origin>(Origin{name, {}, false}));
}

// Returns a number as TOML would have it. A whole number counts as an integer, too.
Value number(double value, const Place& place) {
  Value number;
  number.kind = Value::Kind::real;
  number.place = number.key_place = place;
  number.real = value;
  if (std::abs(value) <= 0x1p53 && value == std::floor(value)) {
    number.kind = Value::Kind::integer;
    number.integer = static_cast<std::int64_t>(value);
  }
  return number;
}

// Puts `value` at a path of tables, and makes the tables that are missing.
void put_at(Value& document, const std::string& path, Value value) {
  Value* table = &document;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    const std::string part = path.substr(begin, dot - begin);
    Value* found = table->find(part);
    if (found == nullptr) {
      Value made;
      made.place = made.key_place = value.place;
      found = &table->put(part, std::move(made));
    }
    table = found;
    begin = dot + 1;
  }
  table->put(path.substr(begin), std::move(value));
}

// Returns the grid's height in settings that were read before.
int height_of(const Value& document) {
  return static_cast<int>(document.find("grid")->find("size")->items.at(1).real);
}

void check_changeable(const Scene& scene, const std::string& key, const Place& place) {
  const std::vector<std::string>& keys = changeable_keys();
  if (std::find(keys.begin(), keys.end(), key) == keys.end())
    fail_at(place, fmt::format("{} is not one of the numbers that a run may change: {}", key,
                               fmt::join(keys, ", ")));
  if (key.starts_with("heat.") && !scene.parameters.heat.enabled)
    fail_at(place, fmt::format("{}: the scene has no [heat]: without it nothing is heated", key));
  if (key.starts_with("pieces.") && !scene.parameters.pieces.fall)
    fail_at(place, fmt::format("{}: the scene has no [pieces] that fall", key));
}

}  // namespace

const std::vector<std::string>& changeable_keys() {
  static const std::vector<std::string> keys{"heat.gamma",
                                             "heat.neighbours",
                                             "heat.convection",
                                             "heat.visibility_every",
                                             "heat.rays_per_face",
                                             "heat.air.exchange",
                                             "heat.air.bottom",
                                             "heat.air.top",
                                             "heat.air.glow",
                                             "heat.air.sky",
                                             "material.melting_point",
                                             "material.latent_heat",
                                             "material.freezing_point",
                                             "pieces.in_liquid",
                                             "pieces.density",
                                             "flow.fall.factor",
                                             "flow.fall.wall_factor",
                                             "flow.fall.minimum",
                                             "flow.fall.hang",
                                             "flow.paper.neighbours",
                                             "flow.paper.threshold",
                                             "flow.paper.share",
                                             "flow.paper.margin",
                                             "flow.paper.slump",
                                             "flow.paper.beta",
                                             "flow.paper.alpha_liquid",
                                             "flow.paper.alpha_solid",
                                             "flow.paper.alpha_floor",
                                             "flow.paper.reheat",
                                             "flow.viscous.kappa",
                                             "flow.viscous.yield",
                                             "flow.viscous.stiffness",
                                             "flow.viscous.substeps",
                                             "flow.viscous.substeps_max",
                                             "flow.viscous.stages_max",
                                             "flow.thermal.reference",
                                             "flow.thermal.doubling"};
  return keys;
}

std::map<std::string, double> said_numbers(const std::string& settings) {
  const Value document = parsed(settings, "the scene");
  std::map<std::string, double> said;
  for (const std::string& key : changeable_keys()) {
    const Value* value = &document;
    for (std::size_t begin = 0; value != nullptr && begin <= key.size();) {
      const std::size_t end = std::min(key.find('.', begin), key.size());
      value = value->kind == Value::Kind::table ? value->find(key.substr(begin, end - begin)) : nullptr;
      begin = end + 1;
    }
    if (value == nullptr) continue;
    if (value->kind == Value::Kind::integer) said[key] = static_cast<double>(value->integer);
    if (value->kind == Value::Kind::real) said[key] = value->real;
  }
  return said;
}

void change_key(Scene& scene, const std::string& key, double value, const std::string& caller) {
  Value document = parsed(scene.settings, caller + ", in the scene");
  const Place place{std::make_shared<const Origin>(Origin{caller, {}, false}), 0, 0};
  check_changeable(scene, key, place);
  put_at(document, key, number(value, place));

  Reader root(document, "");
  std::vector<std::string> warnings;
  rule::Parameters parameters = scene.parameters;
  parameters.material = read_material(root);
  parameters.pieces = read_pieces(root);
  parameters.heat = read_heat(root, height_of(document), warnings);
  parameters.materials = read_palette(root, parameters.material, parameters.heat).rows;
  parameters.flow = read_flow(root, warnings);

  // Everything that does not follow from these tables stays.
  const rule::Heat& before = scene.parameters.heat;
  parameters.heat.sources = before.sources;
  parameters.heat.radiation = before.radiation;
  parameters.heat.walls = before.walls;
  parameters.heat.ray_seed = before.ray_seed;
  scene.settings = print_document(document);
  scene.parameters = std::move(parameters);
  scene.features = features_of(scene.parameters);
  for (std::string& warning : warnings)
    if (std::find(scene.warnings.begin(), scene.warnings.end(), warning) == scene.warnings.end())
      scene.warnings.push_back(std::move(warning));
}

std::string with_lists(const std::string& settings, const Value& lists) {
  Value document = parsed(settings, "the scene");
  for (std::size_t i = 0; i < lists.keys.size(); ++i) {
    if (lists.items[i].items.empty())
      document.remove(lists.keys[i]);
    else
      document.put(lists.keys[i], lists.items[i]);
  }
  return print_document(document);
}

}  // namespace voxmelt::scene
