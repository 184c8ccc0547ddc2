#include "kernel/engine/visibility/providers.h"

#include "kernel/engine/visibility/kept_rays.h"

namespace voxmelt::visibility {

std::unique_ptr<Provider> usual_provider(int threads) {
  return std::make_unique<KeptRays>(std::make_unique<TwoLevelCaster>(), threads);
}

void add_providers(Providers& all) {
  all.push_back(
      {"walk", "every ray each time, from cell to cell", [](int threads) -> std::unique_ptr<Provider> {
         return std::make_unique<VoxelWalkProvider>(threads);
       }});
  all.push_back({kUsual, "what changed, over empty bricks at once", usual_provider});
}

}  // namespace voxmelt::visibility
