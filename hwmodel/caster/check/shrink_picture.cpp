#include "hwmodel/caster/check/shrink_picture.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "hwmodel/caster/check/replay_pixel.h"
#include "hwmodel/check/shrink/small_scene.h"
#include "kernel/scene/excerpt.h"
#include "render/packet/scene_in_integers.h"

namespace voxmelt::hwmodel::raycast {

const PictureCase& PictureShrinker::shrink(const std::optional<std::array<int, 3>>& near) {
  shrink_window();
  shrink_machine();
  try_change([](PictureCase& one) { one.without = {"terrain"}; });
  if (near) crop_around(*near);
  while (crop()) shrink_window();
  shrink_machine();
  remove_matter();
  return best();
}

// Cuts strips off the four sides, broad ones first.
void PictureShrinker::shrink_window() {
  const auto cut = [&](auto side, std::int32_t by) {
    Window part = best().window;
    part.*side += by;
    return part.right > part.left && part.bottom > part.top &&
           try_change([&](PictureCase& one) { one.window = part; });
  };
  const Window all = best().window;
  for (std::int32_t strip = std::max(all.right - all.left, all.bottom - all.top) / 2; strip > 0; strip /= 2) {
    while (cut(&Window::left, strip) || cut(&Window::right, -strip)) {
    }
    while (cut(&Window::top, strip) || cut(&Window::bottom, -strip)) {
    }
  }
}

void PictureShrinker::shrink_machine() {
  const auto attempt = [&](auto member, auto value) {
    if (best().configuration.*member != value)
      try_change([&](PictureCase& one) { one.configuration.*member = value; });
  };
  attempt(&Configuration::stall_seed, std::uint64_t{0});
  attempt(&Configuration::pipes, 1);
  attempt(&Configuration::fifo_depth, Configuration{}.fifo_depth);
  for (const render::Setting plainer : {render::Setting::fast, render::Setting::normal})
    if (plainer < best().setting && try_change([&](PictureCase& one) { one.setting = plainer; })) break;
}

namespace {

class Search {
 public:
  Search(const PictureShrinkRequest& request, const PictureReport& report)
      : request_(request),
        report_(report),
        excerpt_(request.scene.file, request.overrides),
        camera_(request.input.camera),
        workplace_(request.fields) {
    // In every part of the grid the camera stands where it stood.
    if (camera_.distance == 0) camera_.distance = render::distance_of(camera_, request.input.volume.grid);
  }

  std::string text_of(const PictureCase& one, const std::string& fields) const {
    const state::Grid& grid = one.volume.grid;
    return excerpt_.picture_text({one.from, {grid.x, grid.y, grid.z}, one.without}, fields, camera_);
  }

  bool fails(const PictureCase& one) const {
    if (request_.options.poll) request_.options.poll();
    const std::unique_ptr<scene::Scene> scene = workplace_.load(one.volume, text_of(one, "."));
    if (scene == nullptr) return false;
    PictureOptions options = request_.options;
    options.configuration = one.configuration;
    options.window = one.window;
    options.waves = false;
    const PictureReport again = verify_picture(
        {scene->initial, scene->look, scene->light, scene->terrain, scene->camera, one.setting}, options);
    return is_the_same(again);
  }

 private:
  bool is_the_same(const PictureReport& again) const {
    if (report_.found_where_planted() && !again.found_where_planted()) return false;
    if (report_.difference) return again.difference && again.difference->stage == report_.difference->stage;
    if (!report_.hang.empty()) return !again.hang.empty();
    return !again.difference && again.hang.empty() && !again.good();
  }

  const PictureShrinkRequest& request_;
  const PictureReport& report_;
  const scene::Excerpt excerpt_;
  scene::Camera camera_;
  const check::Workplace workplace_;
};

std::optional<std::array<int, 3>> cell_of(const PictureReport& report) {
  if (!report.difference || !report.difference->has_position) return {};
  const Vec at = report.difference->position >> kCellBits;
  return std::array{static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)};
}

}  // namespace

std::optional<SmallPicture> shrink_to_scene(const PictureShrinkRequest& request,
                                            const PictureReport& report) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(request.seconds));
  const PictureInput& input = request.input;
  const Search search(request, report);
  PictureCase first{
      input.volume, {}, request.options.window, input.setting, request.options.configuration, {}};
  // One pixel is tried first, because the rest of the search is quick then.
  const std::optional<PixelReplay> pixel = replay_pixel(input, request.options, report);
  first.window.right = std::min(first.window.right, input.camera.width);
  first.window.bottom = std::min(first.window.bottom, input.camera.height);
  const Window whole = first.window;
  if (pixel && pixel->fails) first.window = pixel->part;
  if (!search.fails(first)) {
    first.window = whole;
    if (!search.fails(first)) return {};
  }
  PictureShrinker shrinker(
      std::move(first), [&](const PictureCase& one) { return search.fails(one); },
      [&] { return Clock::now() < end; });
  const PictureCase& small = shrinker.shrink(cell_of(report));
  return SmallPicture{small, check::count_matter(small.volume), shrinker.tried(),
                      report.difference ? report.difference->stage : std::string{},
                      search.text_of(small, request.fields.filename().string())};
}

}  // namespace voxmelt::hwmodel::raycast
