// The film draws the pictures of a run, and makes a contact sheet and a film of them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/report.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/device/picture_on_device.h"
#include "render/frames/frames.h"
#include "render/frames/work_line.h"
#include "render/packet/draw_picture.h"
#include "render/packet/picture.h"

namespace voxmelt::app {

// Sets the camera's size from "640x480". Throws UsageError.
void set_size(scene::Camera& camera, const std::string& size);
// Adds the option --setting. `what` begins its text.
Option add_setting(Command command, std::string& setting, const std::string& what = {});
render::Setting setting_of(const std::string& name);  // a name that the option takes

// Frames are drawn, written and joined to a film beside the steps that follow, unless there is one thread
// only.
class Film {
 public:
  // Frames go into `folder`. The plan need not say how large they are: the scene does.
  Film(const scene::Scene& scene, const std::filesystem::path& folder, const render::Frames::Plan& plan,
       render::Setting setting);

  // Takes over the state and returns. It waits for the last frame's drawing, because that reads the picture.
  // Where a device has the state and can draw it, the frame is drawn there and then.
  void add_frame(const run::Simulation& simulation, std::uint32_t step);

  // Returns the largest amount of liquid in the open that is more than two cells, or 0, if a device has drawn
  // the last frame. Then who watches the run need not fetch the state for that.
  std::optional<std::int32_t> pressed() const { return pressed_; }

  // Says that frames of these steps are in the folder already, from an earlier part of the run. It is called
  // before the first add_frame().
  void keep(const std::vector<std::uint32_t>& steps);

  // Waits until every frame is in its file, and gives their steps. After an interrupt the last one may be
  // missing.
  const std::vector<std::uint32_t>& settle();

  // Tells if a frame takes so long that an interrupt may lose it.
  bool is_slow() const;

  // Throws the error that stopped a frame. A run that calls it often ends soon after such an error.
  void check();

  // Writes contact_sheet.png, and film.mp4 or film.webp.
  render::FilmMade finish();

  std::size_t frame_count() const { return frames_.count(); }
  RunSeconds seconds() const;  // called after finish(); without the total

 private:
  struct Shot {
    std::uint32_t step = 0;
    std::optional<render::Image> image;  // that a device has drawn
  };
  void draw(Shot& shot);
  std::optional<render::Image> drawn_on_device(const run::Simulation& simulation);

  const scene::Scene& scene_;
  int threads_;
  render::Setting setting_;
  render::Picture picture_;
  render::PictureOnDevice on_device_;
  render::Frames frames_;
  std::vector<std::uint32_t> steps_;  // steps of the frames
  std::optional<std::int32_t> pressed_;
  std::atomic<bool> slow_ = false;
  RunSeconds seconds_;
  render::WorkLine<Shot> drawing_;  // last: its thread uses all of the above
};

}  // namespace voxmelt::app
