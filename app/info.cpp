// The command `voxmelt info` tells what a checkpoint holds.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "app/resume.h"
#include "app/run_record.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/checkpoint_files.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

// Returns the newest checkpoint of a run's output, wherever the run has left it, or the file itself.
fs::path file_of(const fs::path& given) {
  std::error_code ignored;
  if (fs::is_regular_file(given, ignored)) return given;
  if (const std::vector<io::CheckpointFile> files = io::checkpoints_in(given); !files.empty())
    return files.front().file;
  if (fs::is_regular_file(given / io::kLastState, ignored)) return given / io::kLastState;
  const std::vector<fs::path> left = checkpoints_left(given);
  if (left.empty() && !fs::exists(given, ignored)) return given;  // its reader says so
  if (left.empty())
    throw UsageError(fmt::format("{}: error: there is no checkpoint in it, nor beside it", given.string()));
  return left.front();
}

const char* now_of(const checkpoint::FileState& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file.name, ignored)) return "gone";
  return checkpoint::state_of(file.name, file.name) == file ? "as it was" : "changed since";
}

template <template <class> class Terms>
std::string ledger_text(const state::LedgerOf<Terms>& ledger) {
  std::string text = "start " + state::to_string(ledger.start);
  for (const auto& term : Terms<state::Sum>::table())
    if (const state::Sum value = ledger.*term.value; value != 0)
      text += fmt::format(", {} {}", term.name, state::to_string(value));
  return text;
}

void print_blocks(const fs::path& file) {
  struct Column {
    std::uint64_t raw = 0, stored = 0;
    int blocks = 0;
  };
  std::vector<std::string> order;
  std::map<std::string, Column> columns;
  for (const checkpoint::BlockReader::Listed& block : checkpoint::BlockReader::list(file)) {
    if (!columns.contains(block.name.kind)) order.push_back(block.name.kind);
    Column& column = columns[block.name.kind];
    column.raw += block.raw_bytes;
    column.stored += block.stored_bytes;
    ++column.blocks;
  }
  print("\n{:<10}{:>8}{:>16}{:>14}\n", "column", "blocks", "bytes", "stored");
  for (const std::string& kind : order)
    print("{:<10}{:>8}{:>16}{:>14}\n", kind, columns[kind].blocks, columns[kind].raw, columns[kind].stored);
}

int run_info(const std::string& given) {
  const fs::path file = file_of(given);
  const checkpoint::Checkpoint whole = checkpoint::read(file);  // reading checks the whole file
  const checkpoint::Head& head = whole.head;
  const RunRecord record = run_record_of(head.command, file);
  const state::MidRun& run = head.run;
  print("checkpoint     {}\nwritten by     voxmelt {}\n", file.string(), head.version);
  print("scene          {}  {}\n", head.scene.name, head.scene.title);
  print("step           {} of {}\n", run.steps_done, record.steps);
  print("grid           {} x {} x {}\n", head.grid.x, head.grid.y, head.grid.z);
  print("digest         {:016x}\n", head.digest);
  print("cells          solid {}, liquid {}, inert {}\n", whole.volume.solid.count(),
        whole.volume.liquid.count(), whole.volume.inert.count());
  print("mass           {}\nenergy         {}\nheat           {}\n", ledger_text(run.ledger.mass),
        ledger_text(run.ledger.energy), ledger_text(run.ledger.heat));
  print("frames         {}\n", record.frames.size());
  std::string options = fmt::format("steps {}, frame every {}", record.steps, record.frame_every);
  if (!record.size.empty()) options += ", size " + record.size;
  if (record.setting != "normal") options += ", setting " + record.setting;
  if (!record.checkpoint_every.empty()) options += ", checkpoint every " + record.checkpoint_every;
  options += fmt::format(", implementation {}, threads {}", record.common.implementation,
                         record.common.threads == 0 ? "all" : std::to_string(record.common.threads));
  if (record.common.seed) options += fmt::format(", seed {}", *record.common.seed);
  for (const std::string& set : record.common.sets) options += ", set " + set;
  print("run            {}\n", options);
  for (const checkpoint::FileState& one : head.scene.files)
    print("read           {}  {} bytes, {}\n", one.name, one.bytes, now_of(one));
  print_blocks(file);
  return kDone;
}

}  // namespace

void add_info(CommandLine& program) {
  auto file = std::make_shared<std::string>();
  const Command command = program.add("info", "Say what a checkpoint holds, and that it is whole");
  command.option("file", *file, "a checkpoint, or the folder of a run that has some").required();
  command.runs([file] { return run_info(*file); });
}

}  // namespace voxmelt::app
