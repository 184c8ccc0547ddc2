// Some numbers of a scene may change while it runs: those that the rules read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "kernel/scene/scene.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// Lists the keys whose numbers may change between two steps (docs/library.md). Every state of a run is one
// that a scene with another value could begin from. So the next step is that scene's.
const std::vector<std::string>& changeable_keys();

// Returns those that the settings of a scene say, with their values. All others have their defaults.
std::map<std::string, double> said_numbers(const std::string& settings);

// Gives one of them another value, in the scene's settings and in the parameters that follow. The sources
// stay. `caller` stands in messages in place of a file's name. It throws InputError for a number out of its
// range, for any other key, and for heat in a scene without [heat]. Then nothing has changed.
void change_key(Scene& scene, const std::string& key, double value, const std::string& caller);

// Returns settings with other lists of [[heat_source]], [[vent]] and so on: all that the top of `lists` has.
// An empty list is removed.
std::string with_lists(const std::string& settings, const Value& lists);

}  // namespace voxmelt::scene
