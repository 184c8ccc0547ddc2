#include "app/run_program.h"

#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <string>

#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/version.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/scene.h"
#include "render/image/png.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::app {
namespace {

int fail(const std::string& message, int code) {
  say(message);
  return code;
}

}  // namespace

int run_program(const std::string& introduction, const std::function<void(CommandLine&)>& add_commands,
                int argc, char** argv) {
  try {
    CommandLine program("voxmelt", introduction, version_text());
    add_commands(program);
    open_standard_streams();
    // A file that grows too large and a pipe that is closed are error messages, not ends of the program.
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
    end_at_interrupts();
    const std::function<int()> work = program.read(argc, argv);
    const int code = work ? work() : kDone;
    return standard_output_is_well() ? code : kOutOfResources;
  } catch (const OutputStopped& stopped) {
    standard_output_is_well(stopped.error);
    return kOutOfResources;
  } catch (const Interrupted& interrupted) {
    return fail(interrupted.what(), kInterrupted);
  } catch (const render::Stopped&) {
    return fail(Interrupted().what(), kInterrupted);
  } catch (const scene::InputError& error) {
    return fail(error.what(), kBadInput);
  } catch (const checkpoint::Error& error) {
    return fail(error.what(), kBadInput);
  } catch (const UsageError& error) {
    return fail(error.what(), kBadInput);
  } catch (const scene::ResourceError& error) {
    return fail(error.what(), kOutOfResources);
  } catch (const io::OutputError& error) {
    return fail(error.what(), error.out_of_space() ? kOutOfResources : kBadInput);
  } catch (const render::ImageError& error) {
    return fail(error.what(), error.out_of_space() ? kOutOfResources : kBadInput);
  } catch (const std::bad_alloc&) {
    return fail("error: out of memory", kOutOfResources);
  } catch (const std::filesystem::filesystem_error& error) {  // a place that cannot be used
    return fail(place_message(error), kBadInput);
  } catch (const std::exception& error) {
    return fail(std::string("error: ") + error.what(), kCheckFailed);
  }
}

}  // namespace voxmelt::app
