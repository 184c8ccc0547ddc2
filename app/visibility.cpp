#include "app/visibility.h"

#include <algorithm>
#include <vector>

#include "kernel/engine/visibility/providers.h"
#include "render/visibility/providers.h"

namespace voxmelt::app {
namespace {

const visibility::Providers& all_providers() {
  static const visibility::Providers all = [] {
    visibility::Providers rows;
    visibility::add_providers(rows);
    visibility::add_embree(rows);
    return rows;
  }();
  return all;
}

const visibility::ProviderRow& row_of(const std::string& name) {
  return *std::ranges::find(all_providers(), name, &visibility::ProviderRow::name);
}

}  // namespace

void add_visibility(Command command, Common& common) {
  std::vector<std::string> names{"auto"};
  for (const visibility::ProviderRow& row : all_providers()) names.emplace_back(row.name);
  command
      .option("--visibility", common.visibility,
              "who follows the rays of heat sources; no result depends on it")
      .one_of(names)
      .shows_default();
}

VisibilityChoice choose_visibility(const std::string& asked) {
  if (asked == "auto")
    return {std::string(visibility::kUsual), "no slower than embree at any size of grid that was measured"};
  if (row_of(asked).built_in) return {asked, "asked for"};
  std::string others;
  for (const visibility::ProviderRow& row : all_providers())
    if (row.built_in) others += (others.empty() ? "" : ", ") + std::string(row.name);
  // Only Embree can be missing.
  throw UsageError("--visibility " + asked +
                   ": error: this build has no Embree: apt-get install libembree-dev, then configure and "
                   "build again; it has " +
                   others);
}

std::unique_ptr<visibility::Provider> make_provider(const VisibilityChoice& choice, int threads) {
  return row_of(choice.name).create(threads);
}

}  // namespace voxmelt::app
