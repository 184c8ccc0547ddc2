// The command `voxmelt verify --picture` runs the ray caster in lock-step with the software's picture.
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
  std::string html;  // file of --html, also for a run of the pipeline
};
void add_picture_choice(Command command, PictureChoice& choice);

// Returns the first line, the verdict of --quiet.
std::string first_line(const std::string& text);

// Returns the scene's camera as chosen. Throws UsageError.
scene::Camera camera_of(const PictureChoice& choice, const scene::Scene& scene);

// Writes the waves of a run. Returns why there are none, or nothing if there are some or nobody asked.
std::string write_waves(const std::string& vcd, std::optional<std::int64_t> from, const std::string& waves);

// Checks that the place of --html fits the other options. Throws UsageError.
void check_html_place(const Common& common, const PictureChoice& choice, const std::string& out);

}  // namespace voxmelt::app
