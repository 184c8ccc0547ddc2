// The command `voxmelt sweep` makes the runs of a plan, and gathers what they left.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/runs/check_runs.h"
#include "app/runs/emit.h"
#include "app/runs/gather.h"
#include "app/runs/sweep_folder.h"
#include "app/runs/workers.h"

namespace voxmelt::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenLooks{5}, kBetweenBusyLooks{500};
constexpr std::chrono::seconds kBetweenTables{30};

struct SweepOptions {
  std::string plan, out, implementation, emit;
  int jobs = 0, threads = 1;
  std::uint32_t per_task = 10;
  bool gather = false, quiet = false;
};

// Makes the runs that are not complete, several at a time.
class Sweep {
 public:
  Sweep(const SweepOptions& options, const Plan& plan, const std::vector<PlannedRun>& runs,
        const SweepFolder& folder, std::vector<std::string> more)
      : options_(options), plan_(plan), runs_(runs), folder_(folder), more_(std::move(more)) {
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (folder.is_complete(runs[i]))
        ++complete_;
      else
        waiting_.push_back(i);
    const unsigned here = std::max(1u, std::thread::hardware_concurrency());
    jobs_ = options.jobs > 0 ? static_cast<std::size_t>(options.jobs) : std::max(1u, here / options.threads);
  }

  const Failures& failures() const { return failures_; }

  // Returns once every run has ended, or after an interrupt once the children have.
  void to_end() {
    while (!workers_.empty() || (!waiting_.empty() && !interrupted())) {
      while (workers_.size() < jobs_ && !waiting_.empty() && !interrupted() && begin_one()) {
      }
      if (interrupted() && !terminated_)
        for (const Worker& worker : workers_) worker.terminate();
      terminated_ = interrupted();
      look();
      if (Clock::now() - gathered_ > kBetweenTables) {
        gather(plan_, runs_, folder_, failures_);
        gathered_ = Clock::now();
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
  }

 private:
  // Begins the next run at which no other process works. Returns false if there is none.
  bool begin_one() {
    if (Clock::now() < busy_until_) return false;
    for (std::size_t tried = waiting_.size(); tried > 0; --tried) {
      const std::size_t i = waiting_.front();
      waiting_.pop_front();
      if (folder_.is_at_work(runs_[i])) {
        waiting_.push_back(i);
        continue;
      }
      if (folder_.is_complete(runs_[i])) {  // somebody else has made it
        told(runs_[i], "made by another process");
        return true;
      }
      workers_.emplace_back(program_, folder_.words_of(runs_[i], more_), folder_.place(),
                            folder_.log_of(runs_[i]), i);
      return true;
    }
    busy_until_ = Clock::now() + kBetweenBusyLooks;
    return false;
  }

  void told(const PlannedRun& run, const std::string& how) {
    ++complete_;
    if (!options_.quiet) print_error("{}/{}  {}  {}\n", complete_, runs_.size(), run.name, how);
  }

  // Takes the workers that have ended.
  void look() {
    for (std::size_t i = 0; i < workers_.size();) {
      int code = 0;
      if (!workers_[i].has_ended(code)) {
        ++i;
        continue;
      }
      ended(workers_[i], code);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  void ended(const Worker& worker, int code) {
    const PlannedRun& run = runs_[worker.job()];
    if (code == kDone && folder_.is_complete(run)) {
      std::error_code ignored;
      std::filesystem::remove(folder_.log_of(run), ignored);
      told(run, fmt::format("{:.1f} s", worker.seconds()));
      return;
    }
    if (interrupted()) return;
    if (folder_.is_at_work(run)) {  // somebody was faster
      waiting_.push_back(worker.job());
      return;
    }
    std::string why = last_line_of(folder_.log_of(run));
    if (why.empty()) why = code == 128 ? "it was killed" : fmt::format("it ended with exit code {}", code);
    failures_[run.name] = why;
    say(fmt::format("run {} failed: {}", run.name, why));
  }

  const SweepOptions& options_;
  const Plan& plan_;
  const std::vector<PlannedRun>& runs_;
  const SweepFolder& folder_;
  std::vector<std::string> more_;
  std::filesystem::path program_ = voxmelt_program();
  std::size_t jobs_ = 1, complete_ = 0;
  std::deque<std::size_t> waiting_;
  std::vector<Worker> workers_;
  Failures failures_;
  bool terminated_ = false;
  Clock::time_point gathered_ = Clock::now(), busy_until_;
};

// Options of each run that change no result.
std::vector<std::string> more_words(const SweepOptions& options) {
  std::vector<std::string> words{"--threads", std::to_string(options.threads)};
  if (!options.implementation.empty())
    words.insert(words.end(), {"--implementation", options.implementation});
  return words;
}

int finish(const SweepOptions& options, const SweepFolder& folder, std::size_t complete, std::size_t all,
           const Failures& failures) {
  const std::string place = seen_from_here(folder.place());
  if (!options.quiet)
    print("{} of {} runs are complete\ntable  {}/table.csv\npage   {}/index.html\n", complete, all, place,
          place);
  if (interrupted()) {
    say(fmt::format("interrupted; what was made is kept in {}, and the same command goes on", place));
    return kInterrupted;
  }
  if (failures.empty()) return kDone;
  say(fmt::format("error: {} of {} runs failed, the first one {}: {}; {}/logs/ has their words",
                  failures.size(), all, failures.begin()->first, failures.begin()->second, place));
  return kCheckFailed;
}

int run_sweep(const SweepOptions& options) {
  const Plan plan = read_plan(options.plan);
  const std::vector<PlannedRun> runs = runs_of(plan);
  SweepFolder folder(options.out.empty() ? "out/" + plan.file.stem().string() : options.out, plan);
  if (options.gather) {
    folder.check_expanded();
    return finish(options, folder, gather(plan, runs, folder, {}), runs.size(), {});
  }
  const scene::Scene scene = scene_of(plan);
  check_runs(plan, runs, scene);
  voxmelt_program();
  catch_interrupts();
  folder.expand(scene);
  if (!options.emit.empty()) {
    const Emitted written =
        emit(options.emit, runs, folder, more_words(options), options.per_task, options.threads);
    const std::string place = seen_from_here(folder.place());
    if (!options.quiet)
      print("{} runs  {}/{}\nbegin     {}\nthen      voxmelt sweep {} --gather\n", runs.size(), place,
            written.file, written.command, options.plan);
    return kDone;
  }
  folder.lock();
  Sweep sweep(options, plan, runs, folder, more_words(options));
  sweep.to_end();
  const std::size_t complete = gather(plan, runs, folder, sweep.failures());
  return finish(options, folder, complete, runs.size(), sweep.failures());
}

}  // namespace

void add_sweep(CommandLine& program) {
  auto options = std::make_shared<SweepOptions>();
  const Command command =
      program.add("sweep", "Make many runs that differ in some keys, and one table of them");
  command.option("plan", options->plan, "file (TOML) that says which keys have which values").required();
  command.option("--out", options->out, "folder to write (default: out/PLAN)");
  command.option("--jobs", options->jobs, "runs at a time (default: as many as threads are here)")
      .within(1, 1024);
  command.option("--threads", options->threads, "threads of each run; no result depends on it")
      .within(1, 1024)
      .shows_default();
  command.option("--implementation", options->implementation, "who computes (default: auto)");
  const Option gather = command.flag("--gather", options->gather, "run nothing; gather what is complete");
  command
      .option("--emit", options->emit,
              "run nothing; write a file that makes the runs: a job array of Slurm, a list for GNU parallel, "
              "or a makefile")
      .one_of({kEngines.begin(), kEngines.end()})
      .excludes(gather);
  command.option("--per-task", options->per_task, "runs that a job of Slurm makes, one after the other")
      .within(std::uint32_t{1}, std::uint32_t{kMostRuns})
      .shows_default();
  command.flag("--quiet", options->quiet, "no line for each run");
  command.runs([options] { return run_sweep(*options); });
}

}  // namespace voxmelt::app
