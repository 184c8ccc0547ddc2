// Several subcommands share these options. Their errors end the program in the same way.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

enum ExitCode : int { kDone = 0, kCheckFailed = 1, kBadInput = 2, kOutOfResources = 3, kInterrupted = 4 };

// Is thrown when a signal ended the command before anything was written. The exit code is 4.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

struct Common {
  std::string scene;
  std::string implementation = "auto";
  std::string visibility = "auto";
  int threads = 0;  // 0: as many as the machine has
  std::optional<std::uint64_t> seed;
  std::vector<std::string> sets;
  std::string report;
  bool quiet = false;
};

void add_scene(Command command, Common& common);
void add_common(Command command, Common& common);

// Returns the file of a scene, given as a path or by the name of a scene that came with the program.
std::filesystem::path find_scene(const std::string& given);
// Loads a scene from a path, or by the name of a scene that came with the program.
scene::Scene load_scene(const Common& common);
// Refuses a scene that will still change itself ([[change]]). Throws UsageError.
void refuse_changes(const scene::Scene& scene, const char* command);
// Adds warnings to those of the scene, which the report lists, and prints them.
void warn(scene::Scene& scene, const Common& common, const std::vector<std::string>& warnings);
// They throw UsageError. The second one is for commands that look into a step, which a device does not let.
const step::Implementation& find_implementation(const Common& common);
const step::Implementation& find_phased_implementation(const Common& common);
// Makes the simulation. It moves the scene's initial state away, because a large one need not be held twice.
// Where nobody looks at single phases, `auto` may be a graphics card, and a processor is its spare.
enum class Steps : std::uint8_t { whole, of_a_processor };
run::Simulation make_simulation(scene::Scene& scene, const Common& common, Steps steps = Steps::whole);
// Says for the report why this implementation runs it.
std::string reason_of(const run::Simulation& simulation, const Common& common);
int thread_count(const Common& common);

// An output may not take the place of a file that a scene reads, nor of a folder above it. Empty places do
// not count. Throws UsageError.
struct Output {
  std::string option, place;
};
void keep_inputs(const scene::Scene& scene, const std::vector<Output>& outputs);
// Fails at once if the file that an option names could not be written later. `out` is the output folder,
// empty for none. Throws UsageError.
void check_place(const std::string& option, const std::string& file, const std::string& out);
void check_report_place(const Common& common, const std::string& out);
void write_report(const Common& common, const std::string& text);  // if --report was given

// Lists the folders that are searched for scenes given by name.
std::vector<std::filesystem::path> scene_folders();
// Lists the names of the scenes there, in order. A program that was copied alone has none, and the text says
// so.
std::vector<std::string> scene_names();
std::string no_scenes_text();

}  // namespace voxmelt::app
