
#include <cstdint>

#include "kernel/scene/shape/mesh.h"
#include "kernel/scene/shape/mesh_layers.h"
#include "kernel/scene/shape/mesh_shells.h"
#include "kernel/scene/shape/mesh_thin.h"

namespace voxmelt::scene {

Box Mesh::bounds() const {
  const Point first = vertices[corners.front()];
  Box box{first, first};
  for (const std::uint32_t vertex : corners) box.include(vertices[vertex]);
  return box;
}

MeshCoverage cover(const Mesh& mesh, Inside inside, state::Grid grid) {
  MeshCoverage result;
  result.coverage.window = window_of(mesh.bounds(), grid);
  result.coverage.samples.resize(result.coverage.window.size.cells());
  const Surface surface = surface_of(mesh, result.findings);
  if (result.coverage.samples.empty()) return result;
  MeshLayers layers(surface, inside, result.coverage);
  layers.run();
  if (inside == Inside::winding && layers.overlaps())
    result.findings.emplace_back("shells overlap, or one crosses itself: united");
  result.edges = length_of_edges(mesh, result.coverage);
  return result;
}

}  // namespace voxmelt::scene
