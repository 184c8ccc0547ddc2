// The command `voxmelt new` writes a scene with comments, from which somebody begins.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/shell_word.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string kind, file;
};

// Returns the first folder of such scenes that is there.
fs::path folder_of_kinds() {
  for (const fs::path& folder : scene_folders()) {
    std::error_code ignored;
    if (fs::is_directory(folder / "new", ignored)) return folder / "new";
  }
  throw UsageError("error: " + no_scenes_text());
}

std::string kinds_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

int write_new(const NewOptions& options) {
  const fs::path folder = folder_of_kinds(), file = options.file;
  std::ifstream source(folder / (fs::path(options.kind).filename().string() + ".toml"), std::ios::binary);
  if (!source || fs::path(options.kind).has_parent_path())
    throw UsageError(
        fmt::format("error: no kind of scene is called '{}'; there are {}", options.kind, kinds_in(folder)));
  if (file.extension() != ".toml")
    throw UsageError(fmt::format("{}: error: the name of a scene ends with .toml", options.file));
  check_place("file", options.file, "");
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)))
    throw UsageError(fmt::format("{}: error: is there already, and is not replaced", options.file));
  io::write_file(file, {std::istreambuf_iterator(source), {}});
  print("{}; change it as you like, then: voxmelt run {}\n", options.file, shell_word(options.file));
  return kDone;
}

}  // namespace

void add_new(CommandLine& program) {
  auto options = std::make_shared<NewOptions>();
  const Command command = program.add("new", "Write a scene with comments, to begin from");
  command.option("kind", options->kind, "candle, lava or oven").required();
  command.option("file", options->file, "the scene to write, NAME.toml; none is replaced").required();
  command.runs([options] { return write_new(*options); });
}

}  // namespace voxmelt::app
