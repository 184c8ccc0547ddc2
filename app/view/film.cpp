#include "app/view/film.h"

#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <stop_token>
#include <utility>

#include "app/view/encode.h"
#include "app/view/scratch.h"
#include "library/journal/world.h"
#include "render/frames/film_writer.h"
#include "render/frames/webp_bytes.h"
#include "render/image/image.h"
#include "render/image/video.h"
#include "voxmelt/errors.h"

namespace voxmelt::view {
namespace {

constexpr int kFramesPerSecond = 25;

// Steps until this many are done, as far as nobody stops it.
void run_to(std::uint32_t step, Simulation& simulation, journal::Reader& changes,
            const std::stop_token& stop) {
  journal::WorldOf<Simulation> world(simulation);
  while (simulation.steps_done() < step && !stop.stop_requested()) {
    changes.apply(world);
    const std::uint32_t done = simulation.steps_done();
    simulation.step(changes.steps_until_next(done, step - done), stop);
  }
}

Film::Progress made(const Film::Plan& plan, const Film::Tell& tell, const std::stop_token& stop) {
  const std::uint32_t steps = plan.last - plan.first;
  Film::Progress progress;
  progress.planned = (steps + plan.every - 1) / plan.every + 1;
  const Scratch scratch;
  render::FilmWriter video(scratch.file(), {.frames_per_second = kFramesPerSecond,
                                            .patience = {.stop = [stop] { return stop.stop_requested(); }}});
  Simulation simulation = plan.open();
  journal::Reader changes(plan.changes);
  changes.seek(simulation.steps_done());
  for (std::uint64_t step = plan.first; progress.frames < progress.planned; step += plan.every) {
    run_to(static_cast<std::uint32_t>(std::min<std::uint64_t>(step, plan.last)), simulation, changes, stop);
    if (stop.stop_requested()) throw Stopped();
    video.add(image_of(simulation.render(plan.picture, stop)));
    ++progress.frames;
    tell(progress);
  }
  video.close();
  render::FilmMade film = video.finish();
  if (film.file.empty()) {
    progress.problem = std::move(film.note);
  } else {
    std::filesystem::rename(film.file, scratch.file());
    progress.ending = film.file.extension();
    progress.film = scratch.bytes();
  }
  return progress;
}

}  // namespace

Film::Film(Plan plan, Tell tell) {
  if (!render::ffmpeg_found() && !render::webp_is_built_in())
    throw InputError(
        "error: there is no `ffmpeg`, which makes films: Debian's package `ffmpeg` has it; `voxmelt run` "
        "draws the frames of what `Save scene` gives");
  thread_ = std::jthread([plan = std::move(plan), tell = std::move(tell)](const std::stop_token& stop) {
    constexpr int kPolite = 10;
    (void)::setpriority(PRIO_PROCESS, 0, kPolite);  // of this thread: whoever looks at the page comes first
    Progress end;
    try {
      end = made(plan, tell, stop);
    } catch (const Stopped&) {
    } catch (const std::exception& error) {
      end.problem = error.what();
    }
    end.over = true;
    tell(std::move(end));
  });
}

}  // namespace voxmelt::view
