// Sources, vents and drains are converted from the units of a user to the automaton's integers, and back.
#pragma once

#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/scene/text/document.h"
#include "voxmelt/sources.h"

namespace voxmelt::library {

// The readers of scene files check and round the numbers. They throw scene::InputError that names the key, as
// for a scene: "set_vents: error: vent.0.rate = 2 exceeds 1, a full cell per cell and step".
std::vector<rule::HeatSource> to_rules(const std::vector<HeatSource>& sources);
std::vector<rule::Vent> to_rules(const std::vector<Vent>& vents);
std::vector<rule::Drain> to_rules(const std::vector<Drain>& drains);

// The same for a ball of pour and carve, whose `caller` stands in messages.
rule::Region to_region(const char* caller, const Position& at, double radius);
rule::Temperature to_temperature(const char* caller, double temperature);

// The conversion is exact: to_rules gives the same integers again.
HeatSource from_rule(const rule::HeatSource& source);
Vent from_rule(const rule::Vent& vent);
Drain from_rule(const rule::Drain& drain);

// Returns all of them as a scene file would list them, in [[heat_source]], [[vent]] and [[drain]].
scene::Value lists_of(const rule::Parameters& parameters);

}  // namespace voxmelt::library
