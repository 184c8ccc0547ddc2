// The reader takes parameters.json and checks the ranges that a scene may use (docs/automaton.md section 14).
#include "parameters.h"

#include "kinds.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace oracle {
namespace {

using Json = nlohmann::json;

void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error("parameters.json: " + what);
}

const Json& member(const Json& json, const char* key) {
  require(json.is_object() && json.contains(key), std::string("no key ") + key);
  return json.at(key);
}

Int whole(const Json& value, const std::string& name) {
  require(value.is_number_integer(), name + " is not an integer");
  if (value.is_number_unsigned()) {
    const std::uint64_t number = value.get<std::uint64_t>();
    const std::uint64_t most = std::numeric_limits<Int>::max();
    return static_cast<Int>(number < most ? number : most);  // `until` may mean "for ever"
  }
  return value.get<Int>();
}

Int integer(const Json& json, const char* key, Int low, Int high) {
  const Int value = whole(member(json, key), key);
  require(value >= low && value <= high, std::string(key) + " is out of range: " + std::to_string(value));
  return value;
}

bool yes(const Json& json, const char* key) {
  const Json& value = member(json, key);
  if (value.is_boolean()) return value.get<bool>();
  const Int number = whole(value, key);
  require(number == 0 || number == 1, std::string(key) + " is not a truth value");
  return number == 1;
}

constexpr Int MOST = std::numeric_limits<Int>::max();
constexpr Int LAST_STEP = (Int{1} << 32) - 1;
constexpr Int FAR = Int{1} << 24;  // the farthest position, in sixteenths: visibility multiplies two of them

std::vector<Int> integers(const Json& json, const std::string& name, Int low, Int high) {
  require(json.is_array(), name + " is no array");
  std::vector<Int> values;
  for (const Json& value : json) {
    values.push_back(whole(value, name));
    require(values.back() >= low && values.back() <= high, name + " is out of range");
  }
  return values;
}

Point point(const Json& json, const char* key, Int low, Int high) {
  const std::vector<Int> values = integers(member(json, key), key, low, high);
  require(values.size() == 3, std::string(key) + " has not three numbers");
  return {values[0], values[1], values[2]};
}

std::vector<Region> read_regions(const Json& json, bool vents) {
  std::vector<Region> regions;
  for (const Json& entry : json) {
    Region region;
    region.at = point(entry, "at", -FAR, FAR);
    region.radius = integer(entry, "radius", 0, FAR);
    region.rate = integer(entry, "rate", 0, MOST);
    region.from = integer(entry, "from", 0, MOST);
    region.until = integer(entry, "until", 0, MOST);
    if (vents) {
      region.temperature = integer(entry, "temperature", 0, 65535);
      region.energy = integer(entry, "energy", 0, 4096);
    }
    regions.push_back(region);
  }
  return regions;
}

// A source without `kind` is a point.
const Kind& read_kind(const Json& json) {
  const Kind* kind = kind_named(json.contains("kind") ? json.at("kind").get<std::string>() : "point");
  require(kind != nullptr, "no source is of this kind");
  require(!json.contains("kind") || json.at("kind") != "point", "a point does not say its kind");
  return *kind;
}

// Keys have only what their kind has.
Key read_key(const Json& json, const Kind& kind) {
  Key key;
  key.step = integer(json, "step", 0, LAST_STEP);
  key.power = integer(json, "power", 0, (Int{1} << 50) - 1);
  if (kind.at) key.at = point(json, "at", -FAR, FAR);
  if (kind.radius) key.radius = integer(json, "radius", 0, FAR);
  if (kind.direction) key.direction = point(json, "direction", -65536, 65536);
  const std::size_t members = 2 + kind.at + kind.radius + kind.direction;
  require(json.size() == members, "a key of a source has what its kind has not");
  return key;
}

RadiationSource read_radiation_source(const Json& json) {
  RadiationSource source;
  source.kind = &read_kind(json);
  for (const Json& entry : member(json, "keys")) {
    const Key key = read_key(entry, *source.kind);
    require(source.keys.empty() || source.keys.back().step < key.step, "keys do not ascend");
    source.keys.push_back(key);
  }
  require(!source.keys.empty(), "a source without keys");
  return source;
}

Heat read_heat(const Json& json, Int ny) {
  Heat heat;
  heat.enabled = yes(json, "enabled");
  if (!heat.enabled) return heat;
  heat.neighbours = integer(json, "neighbours", 6, 26);
  require(heat.neighbours == 6 || heat.neighbours == 18 || heat.neighbours == 26, "heat.neighbours");
  heat.weight_face = integer(json, "weight_face", 0, 10922);
  heat.weight_edge = integer(json, "weight_edge", 0, 5461);
  heat.weight_corner = integer(json, "weight_corner", 0, 3640);
  heat.convection = integer(json, "convection", 0, 32767);
  heat.walls = yes(json, "walls");
  heat.radiation = yes(json, "radiation");
  if (heat.radiation) {
    heat.visibility_every = integer(json, "visibility_every", 1, 1024);
    heat.rays_per_face = integer(json, "rays_per_face", 1, 16);
    require(heat.rays_per_face == 1 || heat.rays_per_face == 4 || heat.rays_per_face == 16,
            "heat.rays_per_face is neither 1, 4 nor 16");
    for (const Json& entry : member(json, "sources")) heat.sources.push_back(read_radiation_source(entry));
  }
  heat.air = yes(json, "air");
  if (heat.air) {
    heat.air_exchange = integer(json, "air_exchange", 0, 43690);
    heat.air_temperature = integers(member(json, "air_temperature"), "air_temperature", 0, 65535);
    require(static_cast<Int>(heat.air_temperature.size()) == ny, "air_temperature has not ny numbers");
    heat.air_glow = integer(json, "air_glow", 0, 10922);
    heat.air_sky = integer(json, "air_sky", 0, 65535);
  }
  return heat;
}

// Without `materials` there is one, which no pair tells from another one.
Material only_material(const Json& json, const Heat& heat) {
  Material material;
  material.melting_point = integer(json, "melting_point", 0, 65535);
  material.latent_heat = integer(json, "latent_heat", 0, 65535 - material.melting_point);
  material.find_F();
  material.air_exchange = heat.air_exchange;
  material.weight_face = {heat.weight_face};
  material.weight_edge = {heat.weight_edge};
  material.weight_corner = {heat.weight_corner};
  return material;
}

std::vector<Int> read_weights(const Json& row, const char* key, Int most, std::size_t materials) {
  const std::vector<Int> weights = integers(member(row, key), key, 0, most);
  require(weights.size() == materials, std::string(key) + " has not a number for each material");
  return weights;
}

Material read_material(const Json& row, std::size_t materials) {
  Material material;
  material.melting_point = integer(row, "melting_point", 0, 65535);
  material.latent_heat = integer(row, "latent_heat", 0, 65535);
  material.warmth = integer(row, "warmth", 4096, 65536);
  material.find_F();
  material.air_exchange = integer(row, "air_exchange", 0, 43690);
  material.weight_face = read_weights(row, "weight_face", 10922, materials);
  material.weight_edge = read_weights(row, "weight_edge", 5461, materials);
  material.weight_corner = read_weights(row, "weight_corner", 3640, materials);
  require(material.F <= 65535, "a material needs more heat than 65535 to melt");
  return material;
}

// A pair has one weight, whichever of its cells it is looked up by.
void require_symmetry(const std::vector<Material>& materials) {
  for (std::size_t a = 0; a < materials.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      require(materials[a].weight_face[b] == materials[b].weight_face[a] &&
                  materials[a].weight_edge[b] == materials[b].weight_edge[a] &&
                  materials[a].weight_corner[b] == materials[b].weight_corner[a],
              "a pair of materials has two weights");
}

// The first row repeats `material` and `heat`, as far as these are used.
void require_repetition(const Material& first, const Material& alone, const Heat& heat) {
  require(first.melting_point == alone.melting_point && first.latent_heat == alone.latent_heat &&
              first.warmth == 65536,
          "materials[0] is not `material`");
  if (!heat.enabled) return;
  require(first.weight_face[0] == heat.weight_face && first.weight_edge[0] == heat.weight_edge &&
              first.weight_corner[0] == heat.weight_corner &&
              (!heat.air || first.air_exchange == heat.air_exchange),
          "materials[0] is not `heat`");
}

void read_materials(const Json& json, Parameters& p) {
  const Material alone = only_material(member(json, "material"), p.heat);
  const Json& rows = member(json, "materials");
  require(rows.is_array() && rows.size() != 1 && rows.size() <= 16, "materials has not 0 or 2..16 rows");
  p.several_materials = !rows.empty();
  for (const Json& row : rows) p.materials.push_back(read_material(row, rows.size()));
  if (p.several_materials) {
    require_symmetry(p.materials);
    require_repetition(p.materials[0], alone, p.heat);
    p.top = top_of(p.materials);
  } else {
    p.materials = {alone};
  }
}

PiecesFall read_pieces(const Json& json) {
  PiecesFall pieces;
  pieces.fall = yes(json, "fall");
  pieces.in_liquid = integer(json, "in_liquid", 1, 1024);
  pieces.density = integer(json, "density", 1, 65536);
  return pieces;
}

PaperFlow read_paper(const Json& json) {
  PaperFlow paper;
  paper.neighbours = integer(json, "neighbours", 4, 8);
  require(paper.neighbours == 4 || paper.neighbours == 8, "flow.paper.neighbours");
  paper.threshold = integer(json, "threshold", 0, 65535);
  paper.use_table = yes(json, "use_table");
  if (paper.use_table) {
    // There are 16 rows, one per pattern, of 4 factors, one per direction.
    require(paper.neighbours == 4, "a table wants 4 neighbours");
    for (const Json& row : member(json, "table")) {
      paper.table.push_back(integers(row, "table", 0, 65536));
      Int sum = 0;
      for (const Int entry : paper.table.back()) sum += entry;
      require(sum <= 65536, "the sum of a row of the table");
      require(paper.table.back().size() == 4, "a row of the table has not 4 numbers");
    }
    require(paper.table.size() == 16, "the table has not 16 rows");
  } else {
    paper.share = integer(json, "share", 0, paper.neighbours == 8 ? 13107 : 16384);
  }
  paper.downhill = yes(json, "downhill");
  paper.margin = integer(json, "margin", 0, 65535);
  paper.support = yes(json, "support");
  paper.slump = integer(json, "slump", 0, 65535);
  const Json& reading = member(json, "energy");
  require(reading == "text" || reading == "printed", "flow.paper.energy is neither text nor printed");
  paper.printed = reading == "printed";
  paper.beta = integer(json, "beta", 0, 262144);
  paper.alpha_liquid = integer(json, "alpha_liquid", 0, 65535);
  paper.alpha_solid = integer(json, "alpha_solid", 0, 65535);
  paper.alpha_floor = integer(json, "alpha_floor", 0, 65535);
  paper.reheat = integer(json, "reheat", 0, 65535);
  return paper;
}

std::uint64_t read_seed(const Json& json) {
  require(json.is_number_unsigned(), "seed is not a number from 0");
  return json.get<std::uint64_t>();
}

}  // namespace

Parameters read_parameters(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  const Json json = Json::parse(file);

  Parameters p;
  p.grid = point(json, "grid", 1, Int{1} << 16);
  const Json& border = member(json, "border");
  require(border == "open" || border == "closed", "border is neither open nor closed");
  p.open_border = border == "open";
  p.step = integer(json, "step", 0, MOST);
  p.seed = read_seed(member(json, "seed"));
  p.pieces = read_pieces(member(json, "pieces"));
  p.heat = read_heat(member(json, "heat"), p.grid[1]);
  read_materials(json, p);
  p.freezing_point = integer(member(json, "material"), "freezing_point", 0, 65535);
  for (const Material& material : p.materials)
    require(material.melting_point >= p.freezing_point, "a material melts below the freezing point");
  p.vents = read_regions(member(json, "vents"), true);
  p.drains = read_regions(member(json, "drains"), false);

  const Json& flow = member(json, "flow");
  const Json& law = member(flow, "law");
  require(law == "paper" || law == "viscous", "flow.law is neither paper nor viscous");
  p.paper_law = law == "paper";
  const Json& fall = member(flow, "fall");
  p.fall.factor = integer(fall, "factor", 0, 65536);
  p.fall.wall_factor = integer(fall, "wall_factor", 0, 65536);
  p.fall.minimum = integer(fall, "minimum", 0, 65535);
  p.fall.hang = integer(fall, "hang", 0, 65535);
  if (p.paper_law) {
    p.paper = read_paper(member(flow, "paper"));
  } else {
    const Json& viscous = member(flow, "viscous");
    p.viscous.mobility = integer(viscous, "mobility", 0, (Int{1} << 36) - 1);
    p.viscous.yield = integer(viscous, "yield", 0, (Int{1} << 24) - 1);
    p.viscous.stiffness = integer(viscous, "stiffness", 1, 8);
    p.viscous.substeps = integer(viscous, "substeps", 0, 1024);
    p.viscous.substeps_max = integer(viscous, "substeps_max", 1, 1024);
    p.viscous.stages_max = integer(viscous, "stages_max", 1, 16);
  }
  p.thermal_viscosity = yes(flow, "thermal_viscosity");
  if (p.thermal_viscosity && p.paper_law) {
    // The numbers have 16 bits: docs/proofs.md, "Widths".
    p.mobility_table = integers(member(flow, "mobility_table"), "mobility_table", 0, 65535);
    require(p.mobility_table.size() == 32, "mobility_table has not 32 numbers");
  }
  if (p.thermal_viscosity && !p.paper_law) {
    p.mobility_reference = integer(flow, "mobility_reference", 0, 65535);
    p.mobility_rate = integer(flow, "mobility_rate", 0, 32767);
  }
  return p;
}

}  // namespace oracle
