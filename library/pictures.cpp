// A Simulation draws its pictures here. Values pass from the units of a user to those of the renderer, and
// back.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>

#include "library/parts.h"
#include "library/picture_input.h"
#include "library/translate.h"
#include "render/image/png.h"
#include "render/packet/scene_in_integers.h"
#include "render/rule/camera.h"

namespace voxmelt {
namespace {

using library::camera_of;
using library::checked;
using library::frame_of;
using library::translated;

render::Setting setting_of(Quality quality) {
  switch (quality) {
    case Quality::fast:
      return render::Setting::fast;
    case Quality::best:
      return render::Setting::best;
    default:
      return render::Setting::normal;
  }
}

double in_cells(std::int64_t position) { return static_cast<double>(position) / picture::kCell; }
Position in_cells(picture::Vector p) { return {in_cells(p.x), in_cells(p.y), in_cells(p.z)}; }

Shown shown_by(const render::Sight& sight) {
  if (sight.ground) return Shown::ground;
  constexpr int kHalf = 128;  // half of 255
  if (sight.matter.obstacle >= kHalf) return Shown::obstacle;
  return sight.matter.liquid >= kHalf ? Shown::liquid : Shown::solid;
}

// Returns the cell that contains a position. For a position outside the grid this is the nearest cell.
Cell cell_at(picture::Vector p, state::Grid grid) {
  const auto along = [](std::int64_t at, int cells) {
    return static_cast<int>(std::clamp<std::int64_t>(at >> picture::kPositionBits, 0, cells - 1));
  };
  return {along(p.x, grid.x), along(p.y, grid.y), along(p.z, grid.z)};
}

bool is_filled(const state::Volume& volume, Cell c) {
  return volume.solid.test(c.x, c.y, c.z) || volume.liquid.test(c.x, c.y, c.z) ||
         volume.inert.test(c.x, c.y, c.z);
}

// Returns the first cell along the ray, within four cells, that is not air.
Cell first_filled(const state::Volume& volume, const render::Sight& sight, Cell otherwise) {
  const auto inside = [](std::int64_t at, int cells) { return at >= 0 && at < cells * picture::kCell; };
  picture::Vector p = sight.position;
  const auto moved = [&](std::int64_t at, std::int64_t from) { return std::abs(at - from); };
  while (std::max({moved(p.x, sight.position.x), moved(p.y, sight.position.y),
                   moved(p.z, sight.position.z)}) <= 4 * picture::kCell) {
    if (inside(p.x, volume.grid.x) && inside(p.y, volume.grid.y) && inside(p.z, volume.grid.z))
      if (const Cell cell = cell_at(p, volume.grid); is_filled(volume, cell)) return cell;
    p = p + sight.step;
  }
  return otherwise;
}

}  // namespace

Camera Simulation::camera(const Picture& picture) const {
  const scene::Camera camera = camera_of(parts_->scene().camera, picture);
  return {camera.target,        render::distance_of(camera, parts_->simulation.volume().grid),
          camera.azimuth,       camera.elevation,
          camera.field_of_view, camera.orthographic ? Projection::orthographic : Projection::perspective};
}

Frame Simulation::render(const Picture& picture, const std::stop_token& stop) {
  const scene::Camera camera = camera_of(parts_->scene().camera, picture);
  const int alignment = library::row_alignment_of(picture);
  const render::Setting setting = setting_of(picture.quality);
  return translated([&] {
    if (stop.stop_requested()) throw render::Stopped{};
    if (!picture.depth)
      if (const auto image = parts_->drawn_on_device(camera, setting)) return frame_of(*image, alignment);
    render::Picture& drawn = parts_->up_to_date();
    drawn.stop_when([stop] { return stop.stop_requested(); });
    Frame frame = frame_of(drawn.draw(camera, setting, parts_->threads), alignment);
    if (!picture.depth) return frame;
    if (stop.stop_requested()) throw render::Stopped{};
    frame.depth = drawn.depths(camera, setting, parts_->threads);
    frame.eye = in_cells(drawn.data(render::camera_in_integers(camera), setting).view.eye);
    return frame;
  });
}

std::optional<Hit> Simulation::pick(int x, int y, const Picture& picture) {
  const scene::Camera camera = camera_of(parts_->scene().camera, picture);
  checked("x", x, 0, camera.width - 1, "pick");
  checked("y", y, 0, camera.height - 1, "pick");
  return translated([&]() -> std::optional<Hit> {
    const render::Setting setting = setting_of(picture.quality);
    const render::Picture& drawn = parts_->up_to_date();
    const std::optional<render::Sight> sight = drawn.see(camera, setting, x, y);
    if (!sight) return std::nullopt;
    const state::Volume& volume = parts_->simulation.volume();
    const picture::View view = drawn.data(render::camera_in_integers(camera), setting).view;
    const auto part = [](std::int64_t value) {
      return static_cast<double>(value) / (1 << picture::kNormalBits);
    };
    Hit hit{shown_by(*sight),
            in_cells(sight->position),
            {part(sight->normal.x), part(sight->normal.y), part(sight->normal.z)},
            static_cast<double>(picture::depth_from_eye(view, sight->position)) / picture::kDepthUnit,
            cell_at(sight->position, volume.grid),
            {}};
    hit.matter = first_filled(volume, *sight, hit.cell);
    return hit;
  });
}

void Simulation::draw(const std::filesystem::path& file, const Picture& picture) {
  const scene::Camera camera = camera_of(parts_->scene().camera, picture);
  const render::Setting setting = setting_of(picture.quality);
  translated([&] {
    if (const auto image = parts_->drawn_on_device(camera, setting)) return render::write_png(file, *image);
    render::Picture& drawn = parts_->up_to_date();
    drawn.stop_when({});
    render::write_png(file, drawn.draw(camera, setting, parts_->threads));
  });
}

}  // namespace voxmelt
