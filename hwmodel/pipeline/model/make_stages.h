// These functions make each stage without faults. Each template is compiled in a file of its own. If one file
// held all of them, the compiler would inline less.
#pragma once

#include <memory>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

std::unique_ptr<Stage> make_fall(const Design& design);
std::unique_ptr<Stage> make_source(const Design& design);
std::unique_ptr<Stage> make_conduction(const Design& design);
std::unique_ptr<Stage> make_edge_conduction(const Design& design);
std::unique_ptr<Stage> make_corner_conduction(const Design& design);
std::unique_ptr<Stage> make_convection(const Design& design);
std::unique_ptr<Stage> make_exchange(const Design& design);
std::unique_ptr<Stage> make_melt(const Design& design);
std::unique_ptr<Stage> make_walls(const Design& design);
std::unique_ptr<Stage> make_gravity(const Design& design);
std::unique_ptr<Stage> make_pattern(const Design& design);
std::unique_ptr<Stage> make_apply(const Design& design);
std::unique_ptr<Stage> make_settle(const Design& design);
std::unique_ptr<Stage> make_viscous_spread(const Design& design);

}  // namespace voxmelt::hwmodel
