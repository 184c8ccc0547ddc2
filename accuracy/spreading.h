#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_huppert(const Conditions&);
Outcome measure_thin_film(const Conditions&);
Outcome measure_flux_vent(const Conditions&);
Outcome measure_dam_length(const Conditions&);
Outcome measure_dam_width(const Conditions&);
Outcome measure_dam_refined(const Conditions&);
Outcome measure_dam_viscosity(const Conditions&);
Outcome measure_deep_lake(const Conditions&);
Outcome measure_flood(const Conditions&);
Outcome measure_hump(const Conditions&);
Outcome measure_drop_shape(const Conditions&);

}  // namespace voxmelt::accuracy
