// What may change in a scene while it runs: numbers that the rules read.
#pragma once

#include <string>
#include <vector>

#include "kernel/scene/scene.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

// The keys whose numbers may change between two steps: docs/library.md lists them. Every state of a run is
// one that a scene with another value could begin from, so the next step is that scene's.
const std::vector<std::string>& changeable_keys();

// Gives one of them another value, in the scene's settings and in the parameters that follow; the sources
// stay. `caller` stands in messages where a file's name would. Throws InputError for a number out of its
// range, for any other key, and for heat in a scene without [heat]; then nothing has changed.
void change_key(Scene& scene, const std::string& key, double value, const std::string& caller);

// Settings with other lists of [[heat_source]], [[vent]] and so on: all that the top of `lists` has. An empty
// list is removed.
std::string with_lists(const std::string& settings, const Value& lists);

}  // namespace voxmelt::scene
