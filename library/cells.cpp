// A Simulation draws its cells here, as boxes in false colours.
#include "voxmelt/cells.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/engine/cpu/workers.h"
#include "library/parts.h"
#include "library/picture_input.h"
#include "library/translate.h"
#include "render/cells/cell_caster.h"
#include "render/cells/cell_colours.h"
#include "render/cells/cell_picture.h"
#include "render/cells/filled_cells.h"
#include "render/packet/scene_in_integers.h"
#include "render/rule/camera.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt {
namespace {

render::CellColours inner(CellColours colours) {
  switch (colours) {
    case CellColours::temperature:
      return render::CellColours::temperature;
    case CellColours::sleep:
      return render::CellColours::sleep;
    default:
      return render::CellColours::phase;
  }
}

std::optional<render::CellCut> cut_of(const CellView& view, Grid grid) {
  if (!view.cut) return std::nullopt;
  const auto axis = static_cast<std::size_t>(view.cut->axis);
  const int side = std::array{grid.x, grid.y, grid.z}.at(axis);
  return render::CellCut{static_cast<int>(axis),
                         library::checked("cut.at", view.cut->at, 0, side, "CellView")};
}

void check_colours(const run::Simulation& simulation, CellColours colours) {
  if (colours == CellColours::temperature && !simulation.parameters().heat.enabled)
    throw InputError("CellView: error: colours = temperature: the scene has no [heat]");
}

render::ColourOf colour_of(const run::Simulation& simulation, CellColours colours) {
  const state::Volume& volume = simulation.volume();
  if (colours == CellColours::sleep) return render::by_sleep(simulation.awake());
  if (colours == CellColours::phase) return render::by_phase(volume);
  return render::by_temperature(volume, simulation.parameters());
}

// Holds what a ray through the cells needs.
struct Cast {
  Cast(const state::Volume& volume, const scene::Camera& camera, const std::optional<render::CellCut>& cut,
       int threads)
      : workers(std::min(threads, cpu::Workers::most())),
        filled(volume, workers),
        view(picture::view_of(render::camera_in_integers(camera),
                              {volume.grid.x, volume.grid.y, volume.grid.z})),
        caster(filled, view, cut) {}
  Cast(const Cast&) = delete;
  Cast& operator=(const Cast&) = delete;

  cpu::Workers workers;
  render::FilledCells filled;
  picture::View view;
  render::CellCaster caster;
};

int samples_of(Quality quality) {
  constexpr int kNormal = 2, kBest = 4;
  if (quality == Quality::fast) return 1;
  return quality == Quality::normal ? kNormal : kBest;
}

double depth_of(const Position& place, const picture::View& view) {
  const auto whole = [](double cells) { return static_cast<std::int64_t>(cells * picture::kCell); };
  const picture::Vector position{whole(place[0]), whole(place[1]), whole(place[2])};
  return static_cast<double>(picture::depth_from_eye(view, position)) / picture::kDepthUnit;
}

Shown shown_at(const state::Volume& volume, const Cell& c) {
  if (volume.solid.test(c.x, c.y, c.z)) return Shown::solid;
  return volume.liquid.test(c.x, c.y, c.z) ? Shown::liquid : Shown::obstacle;
}

}  // namespace

std::vector<LegendMark> legend(CellColours colours) {
  std::vector<LegendMark> marks;
  for (const render::ColourMark& mark : render::marks_of(inner(colours)))
    marks.push_back({std::string(mark.name), mark.colour});
  return marks;
}

Frame Simulation::render_cells(const CellView& view, const Picture& picture) {
  const scene::Camera camera = library::camera_of(parts_->scene().camera, picture);
  const int alignment = library::row_alignment_of(picture);
  const std::optional<render::CellCut> cut = cut_of(view, grid());
  check_colours(parts_->simulation, view.colours);
  const render::ColourOf colours = colour_of(parts_->simulation, view.colours);
  return library::translated([&] {
    Cast cast(parts_->simulation.volume(), camera, cut, parts_->threads);
    return library::frame_of(render::draw_cells(cast.caster, camera.width, camera.height,
                                                samples_of(picture.quality), colours, cast.workers),
                             alignment);
  });
}

std::optional<Hit> Simulation::pick_cell(int x, int y, const CellView& view, const Picture& picture) {
  const scene::Camera camera = library::camera_of(parts_->scene().camera, picture);
  library::checked("x", x, 0, camera.width - 1, "pick");
  library::checked("y", y, 0, camera.height - 1, "pick");
  const std::optional<render::CellCut> cut = cut_of(view, grid());
  check_colours(parts_->simulation, view.colours);
  return library::translated([&]() -> std::optional<Hit> {
    const state::Volume& volume = parts_->simulation.volume();
    const Cast cast(volume, camera, cut, parts_->threads);
    const auto middle = [](int pixel) { return picture::kPixel * pixel + picture::kPixel / 2; };
    const std::optional<render::SeenCell> seen = cast.caster.see(middle(x), middle(y));
    if (!seen) return std::nullopt;
    const Cell cell{seen->cell[0], seen->cell[1], seen->cell[2]};
    Hit hit{shown_at(volume, cell), seen->position, {}, depth_of(seen->position, cast.view), cell, cell};
    if (seen->axis >= 0) hit.normal[static_cast<std::size_t>(seen->axis)] = seen->outwards;
    return hit;
  });
}

}  // namespace voxmelt
