#include "library/by_hand.h"

#include <utility>

#include "kernel/scene/change.h"
#include "library/sources.h"
#include "library/translate.h"

namespace voxmelt::library {
namespace {

template <class Rules>
auto from_rules(const Rules& rules) {
  std::vector<decltype(from_rule(rules.front()))> result;
  result.reserve(rules.size());
  for (const auto& one : rules) result.push_back(from_rule(one));
  return result;
}

}  // namespace

std::vector<HeatSource> ByHand::heat_sources() const {
  return from_rules(simulation_.parameters().heat.sources);
}
std::vector<Vent> ByHand::vents() const { return from_rules(simulation_.parameters().vents); }
std::vector<Drain> ByHand::drains() const { return from_rules(simulation_.parameters().drains); }

std::map<std::string, double> ByHand::numbers() const { return scene::said_numbers(scene_.settings); }

void ByHand::set(const std::string& key, double value) {
  translated([&] {
    scene::change_key(scene_, key, value, "set");
    simulation_.change_parameters(scene_.parameters);
  });
}

// Replaces one kind of source. The other kinds stay.
template <class Change>
void ByHand::change_sources(const Change& change) {
  translated([&] {
    const rule::Parameters& now = simulation_.parameters();
    run::Simulation::Sources sources{now.heat.sources, now.vents, now.drains};
    change(sources);
    simulation_.change_sources(std::move(sources));
    scene_.parameters = simulation_.parameters();
    sources_changed_ = true;
  });
}

void ByHand::set_heat_sources(const std::vector<HeatSource>& sources) {
  if (!sources.empty() && !simulation_.parameters().heat.enabled)
    throw InputError("set_heat_sources: error: the scene has no [heat]: without it nothing is heated");
  change_sources([&](auto& all) { all.heat = to_rules(sources); });
}

void ByHand::set_vents(const std::vector<Vent>& vents) {
  change_sources([&](auto& all) { all.vents = to_rules(vents); });
}

void ByHand::set_drains(const std::vector<Drain>& drains) {
  change_sources([&](auto& all) { all.drains = to_rules(drains); });
}

void ByHand::pour(const Position& at, double radius, double temperature) {
  translated([&] {
    const rule::Region ball = to_region("pour", at, radius);
    if (!simulation_.pour(ball, to_temperature("pour", temperature)))
      throw InputError("pour: error: no cell of the grid is in the ball");
  });
}

void ByHand::carve(const Position& at, double radius) {
  translated([&] {
    if (!simulation_.carve(to_region("carve", at, radius)))
      throw InputError("carve: error: no cell of the grid is in the ball");
  });
}

std::string ByHand::settings() const {
  if (!sources_changed_) return scene_.settings;
  return scene::with_lists(scene_.settings, lists_of(simulation_.parameters()));
}

}  // namespace voxmelt::library
