#include "measure/melt_film.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "kernel/run/simulation.h"
#include "measure/clocks.h"
#include "measure/drawing.h"
#include "measure/measure.h"
#include "render/frames/work_line.h"
#include "render/packet/picture.h"

namespace voxmelt::measure {
namespace {

constexpr int kPart = 25;  // frames that are timed together

struct Round {
  std::vector<double> parts;  // seconds
  double processor_seconds = 0;
  std::uint32_t steps = 0;  // steps done
  int frames = 0;           // frames drawn
};

Round film_once(const scene::Scene& scene, int frames, int threads) {
  step::Tuning tuning;
  tuning.threads = threads;
  run::Simulation simulation(scene.parameters, scene.initial, run::implementations().widest(), tuning);
  const scene::Camera camera = square_camera(scene.camera, kPictureSide);
  render::Picture picture;
  render::Image last;
  std::vector<double> ends;
  const auto draw = [&] {
    last = picture.draw(camera, render::Setting::normal, threads);
    ends.push_back(now(Clock::wall));
  };

  Round round;
  const double begin = now(Clock::wall), processor = now(Clock::process);
  {
    render::WorkLine<int> drawing(threads > 1 ? 1 : 0, 1, [&](int&) { draw(); });
    for (int frame = 1; frame <= frames; ++frame) {
      const auto until = static_cast<std::uint32_t>(std::uint64_t{scene.steps} * frame / frames);
      while (simulation.steps_done() < until) simulation.step();
      drawing.wait();
      picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, threads);
      drawing.put(int{frame});
    }
    drawing.wait();
  }
  round.processor_seconds = now(Clock::process) - processor;
  round.steps = simulation.steps_done();
  round.frames = static_cast<int>(ends.size());
  double from = begin;
  for (std::size_t end = kPart; end < ends.size() + kPart; end += kPart) {
    const double at = ends[std::min(end, ends.size()) - 1];
    round.parts.push_back(at - from);
    from = at;
  }

  render::Picture alone;
  alone.update(simulation.volume(), scene.look, scene.light, scene.terrain, threads);
  if (!(alone.draw(camera, render::Setting::normal, threads) == last))
    throw Mismatch(scene.name + ": the film's last picture is not that of its state");
  return round;
}

}  // namespace

MeltFilm measure_melt_film(const scene::Scene& scene, int frames, int threads, int rounds) {
  MeltFilm film;
  film.scene = scene.name;
  film.grid = scene.initial.grid;
  film.threads = threads;
  film.rounds = rounds;
  std::vector<Least> parts;
  Least processor;
  for (int i = 0; i < rounds; ++i) {
    const Round round = film_once(scene, frames, threads);
    parts.resize(round.parts.size());
    for (std::size_t part = 0; part < parts.size(); ++part) parts[part].add(round.parts[part]);
    processor.add(round.processor_seconds);
    film.steps = round.steps;
    film.frames = round.frames;
  }
  for (const Least& part : parts) film.seconds += part.value();
  film.processor_seconds = processor.value();
  return film;
}

}  // namespace voxmelt::measure
