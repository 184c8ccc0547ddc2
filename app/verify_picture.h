// voxmelt verify --picture: the ray caster in lock-step with the software's picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/options.h"
#include "kernel/scene/scene.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::app {

struct PictureChoice {
  bool asked = false, compare = true;
  bool machine = false;  // the whole machine is asked for
  std::string view, size, setting = "normal", png, pixel;
  int frames = 1;
  std::string html;  // of the pipeline's run, too
};
void add_picture_choice(Command command, PictureChoice& choice);

// The verdict of --quiet.
std::string first_line(const std::string& text);

// The scene's camera as chosen; throws UsageError.
scene::Camera camera_of(const PictureChoice& choice, const scene::Scene& scene);
render::Setting setting_of(const PictureChoice& choice);

// Writes the waves of a run. Why there are none; empty: there are, or nobody asked.
std::string write_waves(const std::string& vcd, std::optional<std::int64_t> from, const std::string& waves);

// Does it fit the other options? Throws UsageError.
void check_html_place(const Common& common, const PictureChoice& choice, const std::string& out);

}  // namespace voxmelt::app
