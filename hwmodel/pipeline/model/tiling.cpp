#include "hwmodel/pipeline/model/tiling.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "hwmodel/pipeline/model/lag.h"

namespace voxmelt::hwmodel {
namespace {

// Returns the halo in blocks, for a grid that is cut.
int halo_of(const Design& uncut, const Configuration& configuration) {
  const int cells = configuration.cascade * reach_of_step(uncut);
  return (cells + configuration.lanes - 1) / configuration.lanes;
}

// Returns the width of a tile in blocks, such that all tiles of this number are alike.
int width_of(int blocks, int halo, int tiles) {
  return (blocks + 2 * halo * (tiles - 1) + tiles - 1) / tiles;
}

}  // namespace

int reach_of_step(const Design& design) {
  int reach = 0;
  for (const StageKind stage : stages_of_step(design)) reach += lag_of(stage, design).reach;
  return reach;
}

Design design_of(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration) {
  if (const std::string problem = unmodelled_rule(parameters); !problem.empty())
    throw std::invalid_argument(problem);
  Design design{parameters, {grid, configuration.lanes}, configuration.substeps, configuration.registers};
  Shape& shape = design.shape;
  const int blocks = shape.grid_blocks(), widest = configuration.tile / configuration.lanes;
  if (configuration.tile == 0 || widest >= blocks) return design;
  if (const std::string problem = tile_problem(parameters, grid, configuration); !problem.empty())
    throw std::invalid_argument(problem);
  shape.halo = halo_of(design, configuration);
  shape.tile = widest;
  shape.tile = width_of(blocks, shape.halo, shape.tiles());  // no wider than before
  return design;
}

bool host_sees_each_step(const rule::Parameters& parameters) {
  const bool paper = parameters.flow.law == rule::Law::paper;
  return parameters.pieces.fall || (!paper && parameters.flow.viscous.counts_substeps());
}

std::string unmodelled_rule(const rule::Parameters& parameters) {
  if (parameters.flow.law == rule::Law::paper || !parameters.flow.viscous.relaxes()) return {};
  return "flow.viscous.stages_max above 1: the pipeline has no stage that relaxes heads";
}

std::string tile_problem(const rule::Parameters& parameters, state::Grid grid,
                         const Configuration& configuration) {
  const Design uncut{parameters, {grid, configuration.lanes}, configuration.substeps};
  const int blocks = uncut.shape.grid_blocks(), widest = configuration.tile / configuration.lanes;
  if (configuration.tile == 0 || widest >= blocks) return {};
  const int halo = halo_of(uncut, configuration);
  if (widest > 2 * halo) return {};
  const int least = std::min(2 * halo + 1, blocks) * configuration.lanes;
  return "a tile of " + std::to_string(configuration.tile) +
         " columns is too narrow: " + std::to_string(configuration.cascade) + " time steps reach " +
         std::to_string(configuration.cascade * reach_of_step(uncut)) +
         " cells beyond each cut; it needs at least " + std::to_string(least);
}

std::optional<int> narrowest_tile(const rule::Parameters& parameters, state::Grid grid,
                                  const Configuration& configuration, int tiles) {
  const Design uncut{parameters, {grid, configuration.lanes}, configuration.substeps};
  Shape shape = uncut.shape;
  shape.halo = halo_of(uncut, configuration);
  shape.tile = width_of(shape.grid_blocks(), shape.halo, tiles);
  if (shape.tile <= 2 * shape.halo || !shape.tiled() || shape.tiles() != tiles) return {};
  return shape.tile * configuration.lanes;
}

std::int64_t recomputed_cells(const Shape& shape) {
  std::int64_t columns = 0;
  for (int k = 0; k < shape.tiles(); ++k) {
    const int begin = shape.first_block(k) * shape.lanes;
    columns += std::min(begin + shape.blocks() * shape.lanes, shape.grid.x) - begin;
  }
  return (columns - shape.grid.x) * std::int64_t{shape.grid.y} * shape.grid.z;
}

}  // namespace voxmelt::hwmodel
