#include "hwmodel/explore/content.h"

namespace voxmelt::hwmodel::explore {

Content content_of(const Design& design, const Irradiance* irradiance, const state::Volume* volume) {
  Content content;
  if (irradiance != nullptr) content.irradiance_bits = IrradianceStream(*irradiance, design.shape).bits();
  if (volume != nullptr) {
    CodedState coded{CodeLayout(design)};
    coded.store(*volume);
    content.coded_bits = coded.moved_bits();
  }
  return content;
}

}  // namespace voxmelt::hwmodel::explore
