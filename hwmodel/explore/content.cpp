#include "hwmodel/explore/content.h"

namespace voxmelt::hwmodel::explore {

Content content_of(const Design& design, const Irradiance* irradiance) {
  Content content;
  if (irradiance != nullptr) content.irradiance_bits = IrradianceStream(*irradiance, design.shape).bits();
  return content;
}

}  // namespace voxmelt::hwmodel::explore
