#include "app/list.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string>
#include <system_error>

#include "app/options.h"
#include "app/print.h"
#include "kernel/run/trial/fastest.h"
#include "kernel/scene/features.h"

namespace voxmelt::app {

namespace fs = std::filesystem;

void list_implementations() {
  const run::Choice& chosen = run::fastest();
  for (const auto& one : run::implementations().all())
    print("{:<12} {}{}\n", one.name, one.description, one.supported ? "" : " (not on this processor)");
  for (const auto& one : run::devices().all()) print("{:<12} {}\n", one.name, one.description);
  const run::Choice& steps = run::fastest_for_steps();
  const std::string card = steps.spare == nullptr ? ""
                                                  : fmt::format("; {} in run, digest, render and export: {}",
                                                                steps.implementation->name, steps.reason);
  print("{:<12} {}: {}{}\n", "auto", chosen.implementation->name, chosen.reason, card);
}

void list_scenes() {
  if (scene_names().empty()) throw UsageError("error: " + no_scenes_text());
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
      print("{:<24} {}\n", file.stem().string(), title);
    }
  }
}

void list_features() {
  for (const std::string& name : scene::feature_names()) print("{}\n", name);
}

}  // namespace voxmelt::app
