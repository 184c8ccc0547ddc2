// A grid is cut into tiles so that a plane of a tile fits the memories. A step changes a cell by cells that
// lie at most as far away along x as the sum of what its stages reach. So a pass of T steps spoils T times
// that many cells beside a cut. They are the halo. Neither y nor z is ever cut.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

// Counts the cells along x that a time step reaches, by all stages that the scene uses.
int reach_of_step(const Design& design);

// Returns the design of a configuration. All tiles are alike, and as narrow as their number allows. Throws
// std::invalid_argument if there is a problem.
Design design_of(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration);

// Tells if the host needs the state before each step: it counts sub-steps, or finds the pieces that fall. A
// pass then has one time step.
bool host_sees_each_step(const rule::Parameters& parameters);

// Tells which rule of a scene has no stage. The text is empty if all have.
std::string unmodelled_rule(const rule::Parameters& parameters);

// Tells why the tiles of a configuration would be too narrow. The text is empty if they are not.
std::string tile_problem(const rule::Parameters& parameters, state::Grid grid,
                         const Configuration& configuration);

// Returns the narrowest tile, in cells, with which a grid goes through in so many tiles. Returns none if no
// width cuts it so.
std::optional<int> narrowest_tile(const rule::Parameters& parameters, state::Grid grid,
                                  const Configuration& configuration, int tiles);

// Counts the cells of the grid that a pass computes more than once.
std::int64_t recomputed_cells(const Shape& shape);

}  // namespace voxmelt::hwmodel
