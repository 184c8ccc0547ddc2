#include "measure/finer_grids.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

#include "kernel/run/simulation.h"
#include "measure/clocks.h"
#include "measure/measure.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"

namespace voxmelt::measure {
namespace {

struct Times {
  Least fast, normal;
};

// The field is not kept: on the finest grid it takes gigabytes.
render::Picture picture_of(const state::Volume& volume, const scene::Scene& scene, int threads) {
  render::DensityField field;
  field.update(volume, scene.look, scene.terrain, threads);
  render::Picture picture;
  picture.update(field, scene.look, scene.light, scene.terrain, nullptr, threads);
  return picture;
}

}  // namespace

std::optional<double> growth_of_normal(const std::vector<FinerGrid>& grids, std::size_t grid,
                                       std::size_t timing) {
  if (grid == 0) return std::nullopt;
  return grids[grid].timings[timing].normal / grids[grid - 1].timings[timing].normal;
}

std::vector<FinerGrid> measure_finer_grids(const std::vector<scene::Scene>& scenes,
                                           const std::vector<Drawer>& drawers, int threads,
                                           const Rounds& rounds, std::uint32_t step) {
  std::vector<FinerGrid> result;
  std::vector<render::Picture> pictures;
  std::vector<scene::Camera> cameras;
  for (const scene::Scene& scene : scenes) {
    const Workload middle = scene_at(scene, step, threads);
    FinerGrid& grid = result.emplace_back();
    grid.scene = middle.name;
    grid.grid = middle.start.grid;
    pictures.push_back(picture_of(middle.start, scene, threads));
    cameras.push_back(square_camera(scene.camera, kPictureSide));
  }
  const auto draw = [&](std::size_t i, const Drawer& by, render::Setting setting) {
    return pictures[i].draw(cameras[i], setting, 1, *by.packets);
  };
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const render::Image first = draw(i, drawers.front(), render::Setting::normal);
    for (const Drawer& by : drawers)
      if (!(draw(i, by, render::Setting::normal) == first))
        throw Mismatch(fmt::format("{} on {}: not the picture of the first instruction set",
                                   cpu::name_of(by.set), result[i].scene));
  }

  std::vector<std::vector<Times>> least(pictures.size(), std::vector<Times>(drawers.size()));
  const RoundClock clock(rounds);
  int done = 0;
  for (; clock.more(done); ++done)
    for (std::size_t d = 0; d < drawers.size(); ++d)
      for (std::size_t i = 0; i < pictures.size(); ++i) {
        const auto seconds = [&](render::Setting setting) {
          return seconds_for(Clock::thread, [&] { draw(i, drawers[d], setting); });
        };
        least[i][d].fast.add(seconds(render::Setting::fast));
        least[i][d].normal.add(seconds(render::Setting::normal));
      }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    result[i].rounds = done;
    for (std::size_t d = 0; d < drawers.size(); ++d)
      result[i].timings.push_back({drawers[d].set, least[i][d].fast.value(), least[i][d].normal.value()});
  }
  return result;
}

}  // namespace voxmelt::measure
