// The providers of irradiance by name, a row each. A room that has some adds them; no result depends on which
// one is taken.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {

struct ProviderRow {
  std::string_view name, description;
  std::unique_ptr<Provider> (*create)(int threads);
  bool built_in = true;  // else this build lacks it, and it may not be created
};
using Providers = std::vector<ProviderRow>;

void add_providers(Providers& all);  // those of this room: walk and two-level

// What `auto` means, and what a simulation takes that is given none: two-level. It was no slower than Embree
// at any size of grid that was measured (docs/decisions/rays-only-what-changed.md).
inline constexpr std::string_view kUsual = "two-level";
std::unique_ptr<Provider> usual_provider(int threads);

}  // namespace voxmelt::visibility
