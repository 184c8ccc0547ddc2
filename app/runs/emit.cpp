#include "app/runs/emit.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/message.h"
#include "app/shell_word.h"
#include "kernel/run/io/file_writer.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCommands = "commands.txt";

std::string shell_path(const fs::path& path) {
  return shell_word(fs::absolute(path).lexically_normal().string());
}

// shell_word() would write "./" before an option.
std::string option_word(const std::string& word) { return word.starts_with("--") ? word : shell_word(word); }

// Returns the command of a run for a shell: in the folder, and with its errors in its log.
std::string command_of(const PlannedRun& run, const SweepFolder& folder,
                       const std::vector<std::string>& more) {
  std::string line = "cd " + shell_path(folder.place()) + " && " + shell_path(voxmelt_program());
  for (const std::string& word : folder.words_of(run, more)) line.append(1, ' ').append(option_word(word));
  return line + " 2> logs/" + run.name + ".log";
}

std::string commands(const std::vector<PlannedRun>& runs, const SweepFolder& folder,
                     const std::vector<std::string>& more) {
  std::string text;
  for (const PlannedRun& run : runs) text += command_of(run, folder, more) + "\n";
  return text;
}

// A $ is one of make unless it is doubled, and a # in a recipe is the shell's.
std::string for_make(const std::string& line) {
  std::string text;
  for (const char c : line) text += c == '$' ? std::string("$$") : std::string(1, c);
  return text;
}

std::string makefile(const std::vector<PlannedRun>& runs, const SweepFolder& folder,
                     const std::vector<std::string>& more) {
  std::string names, rules;
  for (const PlannedRun& run : runs) {
    names.append(1, ' ').append(run.name);
    rules += fmt::format("{}:\n\t@{}\n", run.name, for_make(command_of(run, folder, more)));
  }
  return fmt::format(
      "# The runs of a sweep of voxmelt: make -k -j 4. A run that is complete is not made again.\n"
      "SHELL = /bin/sh\n.PHONY: all{0}\nall:{0}\n{1}",
      names, rules);
}

std::string slurm_script(std::size_t runs, const SweepFolder& folder, std::size_t per_task, int threads) {
  const std::size_t tasks = (runs + per_task - 1) / per_task;
  const std::string place = fs::absolute(folder.place()).lexically_normal().string();
  return fmt::format(
      R"(#!/bin/bash
# The runs of a sweep of voxmelt, as an array of jobs. A job makes {per} of them, one after the other.
# A run that is complete is not made again, so the array may be submitted as often as one likes.
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={threads}
#SBATCH --output="{logs}/slurm_%A_%a.log"
#SBATCH --open-mode=append
failed=0
while IFS= read -r command; do
  bash -c "$command" < /dev/null || failed=1
done < <(sed -n "$((SLURM_ARRAY_TASK_ID * {per} + 1)),$(((SLURM_ARRAY_TASK_ID + 1) * {per}))p" {commands})
exit $failed
)",
      fmt::arg("per", per_task), fmt::arg("name", "voxmelt"), fmt::arg("last", tasks - 1),
      fmt::arg("threads", threads), fmt::arg("logs", place + "/logs"),
      fmt::arg("commands", shell_word(place + "/" + kCommands)));
}

}  // namespace

Emitted emit(const std::string& engine, const std::vector<PlannedRun>& runs, const SweepFolder& folder,
             const std::vector<std::string>& more, std::size_t per_task, int threads) {
  const fs::path& place = folder.place();
  const std::string shown = shell_word(seen_from_here(place));
  if (engine == "make") {
    io::write_file(place / "Makefile", makefile(runs, folder, more));
    return {"Makefile", fmt::format("make -k -j 4 -f {}/Makefile", shown)};
  }
  io::write_file(place / kCommands, commands(runs, folder, more));
  if (engine == "parallel") return {kCommands, fmt::format("parallel -j 4 < {}/{}", shown, kCommands)};
  io::write_file(place / "sweep.sbatch", slurm_script(runs.size(), folder, per_task, threads));
  return {"sweep.sbatch", fmt::format("sbatch {}/sweep.sbatch", shown)};
}

}  // namespace voxmelt::app
