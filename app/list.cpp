// voxmelt list: what this build and its scenes can do.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <system_error>

#include "accuracy/case.h"
#include "app/commands.h"
#include "app/options.h"
#include "app/resources.h"
#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/pipeline/faults/faults.h"
#include "kernel/run/trial/fastest.h"
#include "kernel/scene/features.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

int list_implementations() {
  const run::Choice& chosen = run::fastest();
  for (const auto& one : run::implementations().all())
    fmt::print("{:<12} {}{}\n", one.name, one.description, one.supported ? "" : " (not on this processor)");
  fmt::print("{:<12} {}: {}\n", "auto", chosen.implementation->name, chosen.reason);
  return kDone;
}

int list_scenes() {
  std::set<std::string> seen;
  for (const fs::path& folder : scene_folders()) {
    std::error_code ignored;
    std::set<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".toml" && entry.is_regular_file(ignored)) files.insert(entry.path());
    for (const fs::path& file : files) {
      if (!seen.insert(file.stem().string()).second) continue;
      std::string title;
      try {
        title = scene::title_of(file);
      } catch (const scene::InputError& error) {
        title = fmt::format("(cannot be read: {})", error.what());
      }
      fmt::print("{:<24} {}\n", file.stem().string(), title);
    }
  }
  return kDone;
}

int list_features() {
  for (const std::string& name : scene::feature_names()) fmt::print("{}\n", name);
  return kDone;
}

int list_cases() {
  for (const accuracy::Case& one : accuracy::all_cases()) fmt::print("{:<24} {}\n", one.name, one.title);
  return kDone;
}

int list_faults() {
  for (const hwmodel::FaultInfo& fault : hwmodel::all_faults())
    fmt::print("{:<24} {:<14} {}\n", fault.name, fault.stage, fault.what);
  fmt::print("\nwith --picture, in the ray caster:\n");
  for (const hwmodel::raycast::FaultInfo& fault : hwmodel::raycast::all_faults())
    fmt::print("{:<24} {:<14} {}\n", fault.name, fault.stage, fault.what);
  return kDone;
}

int list_presets() {
  std::set<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(resource_folder("presets"), ignored))
    if (entry.path().extension() == ".toml") files.insert(entry.path());
  for (const fs::path& file : files)
    fmt::print("{:<24} {}\n", file.stem().string(), hwmodel::load_preset(file, {}).title);
  return kDone;
}

}  // namespace

void add_list(CommandLine& program) {
  auto what = std::make_shared<std::string>();
  const Command command = program.add(
      "list", "Name the implementations, scenes, features, cases, presets or faults of this build");
  command
      .option(
          "what", *what,
          "implementations, scenes, features, cases (of accuracy), presets (hardware) or faults (to plant)")
      .required()
      .one_of({"implementations", "scenes", "features", "cases", "presets", "faults"});
  command.runs([what] {
    if (*what == "implementations") return list_implementations();
    if (*what == "scenes") return list_scenes();
    if (*what == "cases") return list_cases();
    if (*what == "presets") return list_presets();
    if (*what == "faults") return list_faults();
    return list_features();
  });
}

}  // namespace voxmelt::app
