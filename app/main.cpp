// voxmelt: melts solid voxel models and lets them flow.
#include <csignal>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/version.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"
#include "render/image/png.h"
#include "render/packet/draw_picture.h"

namespace {

constexpr const char* kIntroduction =
    "voxmelt melts solid voxel models and lets them flow, with an exact cellular automaton.\n\n"
    "  voxmelt run cello                    melt the cello: frames, contact sheet and report in out/cello\n"
    "  voxmelt run cello_viscous --steps 800\n"
    "  voxmelt run lava --set flow.paper.share=0.1 --out /tmp/lava\n"
    "  voxmelt digest goblet --steps 10     one line per step; equal lines mean equal bits\n"
    "  voxmelt export bunny --steps 500 --out bunny500 --format vti\n"
    "  voxmelt render lava --steps 1200 --size 1280x960 --out lava.png\n"
    "  voxmelt verify lava --from 400 --set hw.lanes=16     the hardware model in lock-step with the "
    "software\n"
    "  voxmelt bench --quick                how fast, and how near to what this machine can do\n"
    "  voxmelt accuracy --quick             how well, against what mathematics says\n"
    "  voxmelt run bunny --checkpoint-every 60s, and after a power cut: voxmelt run --resume out/bunny\n"
    "  voxmelt list scenes\n\n"
    "A scene is a TOML file; docs/scenes.md explains its keys. Exit codes: 0 done, 1 a check failed,\n"
    "2 bad usage or input, 3 out of memory or disk, 4 interrupted.";

int fail(const std::string& message, int code) {
  voxmelt::app::say(message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace voxmelt;
  app::open_standard_streams();
  // A file that grows too large and a pipe that is closed are error messages, not ends of the program.
  for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
  app::end_at_interrupts();
  try {
    app::CommandLine program("voxmelt", kIntroduction, app::version_text());
    app::add_run(program);
    app::add_digest(program);
    app::add_export(program);
    app::add_render(program);
    app::add_bench(program);
    app::add_accuracy(program);
    app::add_verify(program);
    app::add_explore(program);
    app::add_info(program);
    app::add_list(program);
    const std::function<int()> work = program.read(argc, argv);
    const int code = work ? work() : app::kDone;
    return app::standard_output_is_well() ? code : app::kOutOfResources;
  } catch (const app::OutputStopped& stopped) {
    app::standard_output_is_well(stopped.error);
    return app::kOutOfResources;
  } catch (const app::Interrupted& interrupted) {
    return fail(interrupted.what(), app::kInterrupted);
  } catch (const render::Stopped&) {
    return fail(app::Interrupted().what(), app::kInterrupted);
  } catch (const scene::InputError& error) {
    return fail(error.what(), app::kBadInput);
  } catch (const checkpoint::Error& error) {
    return fail(error.what(), app::kBadInput);
  } catch (const app::UsageError& error) {
    return fail(error.what(), app::kBadInput);
  } catch (const scene::ResourceError& error) {
    return fail(error.what(), app::kOutOfResources);
  } catch (const io::OutputError& error) {
    return fail(error.what(), error.out_of_space() ? app::kOutOfResources : app::kBadInput);
  } catch (const render::ImageError& error) {
    return fail(error.what(), error.out_of_space() ? app::kOutOfResources : app::kBadInput);
  } catch (const std::bad_alloc&) {
    return fail("error: out of memory", app::kOutOfResources);
  } catch (const std::filesystem::filesystem_error& error) {  // a place that cannot be used
    return fail(app::place_message(error), app::kBadInput);
  } catch (const std::exception& error) {
    return fail(std::string("error: ") + error.what(), app::kCheckFailed);
  }
}
