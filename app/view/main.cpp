// The program voxmelt-view has the command `voxmelt view`: melt a scene by hand, in a browser. `voxmelt`
// starts it.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/run_program.h"
#include "app/view/server.h"
#include "app/view/session.h"
#include "library/journal/journal.h"

extern char** environ;

namespace voxmelt::app {
namespace {

struct ViewOptions {
  std::string scene, implementation = "auto";
  int threads = 0, port = 0;
  std::vector<std::string> sets;
  std::string journal, record, listen;
  bool open = false, headless = false;
  std::uint32_t steps = 0, every = 0;
};

// Runs a journal without a page, and prints digests as `voxmelt digest` does.
int run_headless(const ViewOptions& options, Simulation& simulation, journal::Reader& journal) {
  const std::uint32_t every = options.every == 0 ? std::max(options.steps, 1u) : options.every;
  journal::WorldOf<Simulation> world(simulation);
  const auto print_line = [&] {
    print("step {} digest {:016x}\n", simulation.steps_done(), simulation.digest());
  };
  print_line();
  while (simulation.steps_done() < options.steps) {
    stop_if_interrupted();
    journal.apply(world);
    const std::uint32_t done = simulation.steps_done();
    const std::uint32_t line = std::min(options.steps, (done / every + 1) * every);
    simulation.step(journal.steps_until_next(done, line - done));
    if (simulation.steps_done() == line) print_line();
  }
  return kDone;
}

// Shows the page in the user's browser. Nothing is lost if that fails: the address is printed.
void open_browser(const std::string& url) {
  std::string program = "xdg-open", address = url;
  char* const words[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  if (::posix_spawnp(&child, program.c_str(), nullptr, nullptr, words, environ) != 0) return;
  int status = 0;
  ::waitpid(child, &status, 0);
}

int run_view(const ViewOptions& options) {
  std::optional<journal::Reader> journal;
  if (!options.journal.empty()) journal.emplace(journal::read_journal(options.journal));
  auto open = [&options, told = false](const std::filesystem::path& checkpoint) mutable {
    Options how{{}, options.implementation, options.threads};
    if (checkpoint.empty()) how.overrides = options.sets;
    Simulation simulation(checkpoint.empty() ? find_scene(options.scene) : checkpoint, how);
    for (const std::string& warning : simulation.warnings())
      if (!told) say("warning: " + warning);
    told = true;
    return simulation;
  };
  catch_interrupts();
  if (options.headless) {
    journal::Reader none({});
    Simulation simulation = open({});
    return run_headless(options, simulation, journal ? *journal : none);
  }

  std::unique_ptr<view::Server> server;
  view::Session session(open, options.scene,
                        [&](std::optional<view::Client> client, const view::MessagePtr& message) {
                          server->send(client, message);
                        });
  if (journal) session.follow(std::move(*journal));
  if (!options.record.empty()) session.record(journal::Writer(options.record, options.scene));
  server = std::make_unique<view::Server>(
      view::Address{options.listen.empty() ? "127.0.0.1" : options.listen,
                    static_cast<std::uint16_t>(options.port),
                    options.listen.empty() ? "" : view::new_token()},
      view::Audience{[&](view::Client client) { session.come(client); },
                     [&](view::Client client, std::string line) { session.say(client, std::move(line)); },
                     [&](view::Client client) { session.leave(client); }});
  const std::string url = server->address().url();
  print("{}\n", url);
  std::fflush(stdout);  // whoever waits for the address reads a pipe
  if (options.open) open_browser(url);

  std::exception_ptr failure;
  std::thread runner([&] {
    try {
      session.run();
    } catch (...) {
      failure = std::current_exception();
    }
    server->stop();
  });
  std::atomic<bool> over{false};
  std::thread watcher([&] {
    while (!over && !interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    session.stop();
  });
  server->run();
  over = true;
  watcher.join();
  runner.join();
  if (failure) std::rethrow_exception(failure);
  return kDone;
}

void add_view(CommandLine& program) {
  const auto options = std::make_shared<ViewOptions>();
  Command command = program.add("view", std::string(description_of("view")));
  command.option("scene", options->scene, "a scene's name or file, or a checkpoint").required();
  command.option("--port", options->port, "port on the loopback address; 0: any that is free")
      .within(0, 65535)
      .shows_default();
  command.option("--listen", options->listen,
                 "listen on this address, not the loopback one; the URL has a token then");
  command.flag("--open", options->open, "show the page in the browser");
  command.option("--set", options->sets, "change a key of the scene").written_as("KEY=VALUE").one_each_time();
  command.option("--implementation", options->implementation, "see `voxmelt list implementations`")
      .shows_default();
  command.option("--threads", options->threads, "0: as many as the machine has")
      .within(0, 1024)
      .shows_default();
  command.option("--record", options->record, "write what is changed by hand into a journal");
  command.option("--journal", options->journal, "make the changes of a journal");
  command.flag("--headless", options->headless, "no page: run the journal, and print digests");
  command.option("--steps", options->steps, "with --headless: steps to run");
  command.option("--every", options->every, "with --headless: steps between two digests");
  command.runs([options] {
    try {
      return run_view(*options);
    } catch (const ResourceError& error) {
      throw scene::ResourceError(error.what());
    } catch (const Error& error) {  // of input, or of a file or port that cannot be had
      throw UsageError(error.what());
    }
  });
}

}  // namespace
}  // namespace voxmelt::app

int main(int argc, char** argv) {
  using namespace voxmelt::app;
  return run_program(
      "Melt a scene by hand, in a browser.", [](CommandLine& program) { add_view(program); }, argc, argv);
}
