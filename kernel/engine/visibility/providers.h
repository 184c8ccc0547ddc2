// The providers of irradiance are listed by name, a row each. A folder that has some adds them. No result
// depends on the choice.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "kernel/engine/visibility/visibility.h"

namespace voxmelt::visibility {

struct ProviderRow {
  std::string_view name, description;
  std::unique_ptr<Provider> (*create)(int threads);
  bool built_in = true;  // if not, this build lacks it, and it may not be created
};
using Providers = std::vector<ProviderRow>;

void add_providers(Providers& all);  // walk and two-level

// Is the provider that `auto` means, and that a simulation takes if it is given none. It was no slower than
// Embree at any size of grid that was measured (docs/decisions/rays-only-what-changed.md).
inline constexpr std::string_view kUsual = "two-level";
std::unique_ptr<Provider> usual_provider(int threads);

}  // namespace voxmelt::visibility
