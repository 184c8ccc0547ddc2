// The option --visibility chooses who follows the rays of heat sources, out of the providers of all rooms.
#pragma once

#include <memory>
#include <string>

#include "app/options.h"
#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::app {

struct VisibilityChoice {
  std::string name;    // name of a provider
  std::string reason;  // for the report
};

void add_visibility(Command command, Common& common);
// Throws UsageError if this build does not have what was asked for.
VisibilityChoice choose_visibility(const std::string& asked);
std::unique_ptr<visibility::Provider> make_provider(const VisibilityChoice& choice, int threads);

}  // namespace voxmelt::app
