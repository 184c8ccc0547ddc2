// voxmelt: melts solid voxel models and lets them flow.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/version.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"
#include "render/image/png.h"

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
    "  voxmelt list scenes\n\n"
    "A scene is a TOML file; docs/scenes.md explains its keys. Exit codes: 0 done, 1 a check failed,\n"
    "2 bad usage or input, 3 out of memory or disk.";

// The message of CLI11 would say only that a subcommand is required.
void check_subcommand(const CLI::App& program, const char* given) {
  if (given[0] == '-') return;
  std::string known;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == given) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw voxmelt::app::UsageError("error: unknown command '" + std::string(given) + "'; there are " + known);
}

int fail(const std::string& message, int code) {
  std::cerr << message << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace voxmelt;
  try {
    CLI::App program(kIntroduction, "voxmelt");
    program.set_version_flag("--version", app::version_text());
    program.require_subcommand(1);
    app::Chosen chosen;
    app::add_run(program, chosen);
    app::add_digest(program, chosen);
    app::add_export(program, chosen);
    app::add_render(program, chosen);
    app::add_bench(program, chosen);
    app::add_accuracy(program, chosen);
    app::add_verify(program, chosen);
    app::add_list(program, chosen);
    if (argc > 1) check_subcommand(program, argv[1]);
    try {
      program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return program.exit(error) == 0 ? app::kDone : app::kBadInput;
    }
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error message, not a crash
    const int code = chosen();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      return fail(std::string("standard output: error: cannot write: ") + std::strerror(errno),
                  app::kOutOfResources);
    return code;
  } catch (const scene::InputError& error) {
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
  } catch (const std::exception& error) {
    return fail(std::string("error: ") + error.what(), app::kCheckFailed);
  }
}
