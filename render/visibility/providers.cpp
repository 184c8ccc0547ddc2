#include "render/visibility/providers.h"

#include <memory>

#include "kernel/engine/visibility/kept_rays.h"
#include "render/visibility/embree_caster.h"

namespace voxmelt::visibility {

void add_embree(Providers& all) {
  all.push_back({"embree", "what changed, by Embree's tree of bricks",
                 [](int threads) -> std::unique_ptr<Provider> {
                   return std::make_unique<KeptRays>(std::make_unique<EmbreeCaster>(), threads);
                 },
                 EmbreeCaster::built_in()});
}

}  // namespace voxmelt::visibility
