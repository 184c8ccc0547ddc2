// The surface that pictures show, for formats of meshes (docs/output.md, "The surface as a mesh").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/run/io/export.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/density/values.h"

namespace voxmelt::app {

// Adds the option --surface.
Option add_surface(Command command, std::string& surface);

// Returns --surface if it is one of these. Throws UsageError for others, and where no format asks for it.
std::string surface_named(const std::string& surface, const std::vector<std::string>& formats);

class DrawnSurface {
 public:
  // Filters a state as a picture does (docs/picture/field.md), and leaves obstacles and ground out. The
  // numbers are good until the next call.
  io::Lattice of(const state::Volume& volume, const scene::Scene& scene, int threads);

 private:
  void leave_ground_out(const state::Volume& volume, int y, int z);

  render::DensityField field_;
  render::DensityField matter_field_;  // of matter alone
  render::Values<std::uint16_t> numbers_;
};

}  // namespace voxmelt::app
