#pragma once

#include "accuracy/case.h"

namespace voxmelt::accuracy {

Outcome measure_nusselt(const Conditions&);
Outcome measure_melting_film(const Conditions&);
Outcome measure_narrow_film(const Conditions&);
Outcome measure_thermal_film(const Conditions&);
Outcome measure_cylinder_film(const Conditions&);
Outcome measure_stairs(const Conditions&);
Outcome measure_film_front(const Conditions&);
Outcome measure_blob(const Conditions&);

}  // namespace voxmelt::accuracy
