#include "measure/baseline/phases.h"

namespace voxmelt::baseline {

template class Baseline<float, Variant::native>;
template class Baseline<double, Variant::native>;

}  // namespace voxmelt::baseline
