#include "measure/baseline/phases.h"

namespace voxmelt::baseline {

template class Baseline<float, Variant::plain>;
template class Baseline<double, Variant::plain>;

}  // namespace voxmelt::baseline
