#include "app/programs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/command_line.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

// Returns the program that has the command, or nothing if it is this one.
std::string_view program_of(int argc, char** argv) {
  const std::string_view command = argc > 1 ? argv[1] : "", what = argc > 2 ? argv[2] : "";
  for (const Elsewhere& row : kElsewhere)
    if (row.command == command) {
      if (row.there) return row.program;
      throw UsageError(fmt::format(
          "error: this build has no voxmelt {}: apt-get install {}, then configure and build again", command,
          row.brings));
    }
  if (command == "list")
    for (const ListedElsewhere& row : kListedElsewhere)
      if (row.what == what) return row.program;
  return {};
}

}  // namespace

void become_program(int argc, char** argv) {
  const std::string_view program = program_of(argc, argv);
  if (program.empty()) return;
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path other = self.parent_path() / program;
  execv(other.c_str(), argv);
  const std::string reason = std::error_code(errno, std::generic_category()).message();
  const fs::path build = self.parent_path().parent_path();
  if (!fs::exists(other, error) && fs::exists(build / "CMakeCache.txt", error))
    throw UsageError(
        fmt::format("error: {} is not built yet; this builds it:\n  cmake --build {} --target {}", program,
                    build.string(), program));
  throw UsageError(fmt::format("error: {}: {}", other.string(), reason));
}

}  // namespace voxmelt::app
