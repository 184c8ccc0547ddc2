// This program was built without Verilator.
#include <memory>
#include <vector>

#include "hwmodel/rtl/host/rtl_model.h"

namespace voxmelt::hwmodel {

std::unique_ptr<RtlModel> make_rtl_model(StageKind /*kind*/, int /*lanes*/, int /*seed*/) { return nullptr; }
std::vector<int> rtl_lanes() { return {}; }
bool rtl_has(StageKind /*kind*/) { return false; }

}  // namespace voxmelt::hwmodel
