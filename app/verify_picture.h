// voxmelt verify --picture: the ray caster in lock-step with the software's picture.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::app {

struct PictureChoice {
  bool asked = false, compare = true;
  bool machine = false;  // the whole machine is asked for
  std::string view, size, setting = "normal", png, plant, pixel;
  int frames = 1;
  std::string html;  // of the pipeline's run, too
  std::string vcd;
  std::optional<std::int64_t> vcd_from;
  std::string again;  // what to type to see the picture again
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

int verify_caster(const Common& common, const PictureChoice& choice, const scene::Scene& scene,
                  const run::Simulation& state, const std::filesystem::path& preset,
                  const std::vector<std::string>& hw_sets);

}  // namespace voxmelt::app
