// A whole melt is drawn frame by frame: steps, update and picture at once, as `voxmelt run` has them, but no
// file is written.
#pragma once

#include <cstdint>
#include <string>

#include "kernel/scene/scene.h"

namespace voxmelt::measure {

inline constexpr int kFilmFrames = 1200;

struct MeltFilm {
  std::string scene;
  state::Grid grid;
  std::uint32_t steps = 0;
  int frames = 0, threads = 1, rounds = 0;
  double seconds = 0;            // wall-clock time, the least of each part of the film
  double processor_seconds = 0;  // all threads, in the least busy round
  double frames_per_second() const { return frames / seconds; }
};

// Runs the scene's steps in `frames` frames, at setting `normal`. Throws Mismatch if the last picture is not
// that of the last state alone.
MeltFilm measure_melt_film(const scene::Scene& scene, int frames, int threads, int rounds);

}  // namespace voxmelt::measure
