// The functions here print the lines of `voxmelt bench`.
#pragma once

#include <vector>

#include "measure/suite.h"

namespace voxmelt::app {

void print_case_heading();
void print_workload(const measure::Workload& workload, const measure::Result& result,
                    const std::vector<measure::Case>& cases);
void print_drawing(const measure::Drawing& drawing);
void print_finer_grids(const std::vector<measure::FinerGrid>& grids);
void print_film(const measure::MeltFilm& film);
void print_device_case(const measure::DeviceMachine& machine, const measure::DeviceCase& one);

}  // namespace voxmelt::app
