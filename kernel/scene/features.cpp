#include "kernel/scene/features.h"

namespace voxmelt::scene {
namespace {

struct Feature {
  const char* name;
  bool (*used)(const rule::Parameters&);
};

using P = const rule::Parameters&;
bool paper(P p) { return p.flow.law == rule::Law::paper; }

constexpr Feature kFeatures[] = {
    {"heat", [](P p) { return p.heat.enabled; }},
    {"walls", [](P p) { return p.heat.walls; }},
    {"radiation", [](P p) { return p.heat.radiation; }},
    {"air", [](P p) { return p.heat.air; }},
    {"convection", [](P p) { return p.heat.convection > 0; }},
    {"latent_heat", [](P p) { return p.material.latent_heat > 0; }},
    {"freezing", [](P p) { return p.freezes(); }},
    {"glow", [](P p) { return p.heat.air && p.heat.air_glow > 0; }},
    {"materials", [](P p) { return p.has_materials(); }},
    {"pieces", [](P p) { return p.pieces.fall; }},
    {"vent", [](P p) { return !p.vents.empty(); }},
    {"drain", [](P p) { return !p.drains.empty(); }},
    {"open_border", [](P p) { return p.open_border; }},
    {"diagonal", [](P p) { return paper(p) && p.flow.paper.neighbours == 8; }},
    {"adhesion", [](P p) { return p.flow.fall.wall_factor != p.flow.fall.factor; }},
    {"drip", [](P p) { return p.flow.fall.hang > 0; }},
    {"support", [](P p) { return paper(p) && p.flow.paper.support; }},
    {"slump", [](P p) { return paper(p) && p.flow.paper.slump; }},
    {"reheat", [](P p) { return paper(p) && p.flow.paper.reheat > 0; }},
    {"thermal_viscosity", [](P p) { return p.flow.thermal_viscosity; }},
    {"substeps", [](P p) { return !paper(p) && p.flow.viscous.substeps != 1; }},
    {"table", [](P p) { return paper(p) && p.flow.paper.use_table; }},
};

}  // namespace

const std::vector<std::string>& feature_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Feature& feature : kFeatures) all.emplace_back(feature.name);
    return all;
  }();
  return names;
}

std::vector<std::string> features_of(const rule::Parameters& parameters) {
  std::vector<std::string> used;
  for (const Feature& feature : kFeatures)
    if (feature.used(parameters)) used.emplace_back(feature.name);
  return used;
}

}  // namespace voxmelt::scene
