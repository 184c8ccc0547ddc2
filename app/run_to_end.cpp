#include "app/run_to_end.h"

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/checkpoints.h"
#include "app/ending.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/resume.h"
#include "app/run_journal.h"
#include "app/shell_word.h"
#include "app/watch.h"
#include "app/written_states.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/io/checkpoint_files.h"

namespace voxmelt::app {
namespace {

using Clock = std::chrono::steady_clock;

// Does `work`, and returns what it throws, or null.
template <class Work>
std::exception_ptr tried(Work&& work) {
  try {
    work();
    return nullptr;
  } catch (...) {
    return std::current_exception();
  }
}

RunSeconds sum_of(const RunSeconds& a, const RunSeconds& b) {
  return {a.update + b.update, a.render + b.render, a.encode + b.encode,
          a.wait + b.wait,     a.total + b.total,   a.on_device + b.on_device};
}

bool holds_frames(const std::filesystem::path& partial) {
  std::error_code ignored;
  return std::filesystem::exists(partial / "frames" / render::Frames::file_name(0), ignored);
}

class Run {
 public:
  Run(PreparedRun run, std::optional<Interval> interval, Clock::time_point start)
      : run_(std::move(run)),
        interval_(interval),
        start_(start),
        begun_at_(run_.scene.mid_run ? run_.scene.mid_run->steps_done : 0),
        simulation_(make_simulation(run_.scene, common())),
        journal_(record().journal, record().journal_name, run_.scene, simulation_),
        film_(std::in_place, run_.scene, out().partial(), plan(), setting_of(record().setting)),
        checkpoints_(out().partial(), run_.scene, std::move(run_.text), thread_count(common())),
        written_(record(), out().partial(), begun_at_),
        watch_(record().seen) {
    film_->keep(record().frame_steps);
  }

  int to_end() {
    std::exception_ptr failed = tried([&] { step_on(); });
    const bool complete = !failed && simulation_.steps_done() == steps();
    warn_of_what_was_seen(complete);
    place_ = seen_from_here(out().place());
    std::string report;
    if (!failed) failed = tried([&] { report = put_into_place(complete); });
    if (failed) return keep_incomplete(failed);
    // The output stands in its place. Nothing that fails from here on takes it away.
    if (complete) clear_after(out().place(), record().id);
    if (!common().quiet) print_outputs();
    write_report(common(), report);
    return verdict(complete);
  }

 private:
  const RunRecord& record() const { return run_.record; }
  const Common& common() const { return run_.record.common; }
  io::OutputFolder& out() const { return *run_.out; }
  std::uint32_t steps() const { return run_.record.steps; }
  std::string resume_command() const { return "`voxmelt run --resume " + shell_word(place_) + "` goes on"; }

  render::Frames::Plan plan() const {
    return {.count = frames_due_before(record(), steps()) + (frame_is_due(record(), steps()) ? 1 : 0),
            .threads = thread_count(common()),
            .frames_per_second = record().frames_per_second,
            .film = is_kept(record(), "film"),
            .kind = render::film_kind_named(record().film).value_or(render::FilmKind::automatic),
            .stop = interrupted};
  }
  RunSeconds seconds_now() const {
    RunSeconds now = film_->seconds();
    now.total = std::chrono::duration<double>(Clock::now() - start_).count();
    return sum_of(record().seconds, now);
  }

  bool is_late() const { return run_.wall_clock && Clock::now() - start_ >= *run_.wall_clock; }
  bool checkpoint() {
    written_.settle();
    film_->settle();  // then the times of its threads are known
    return checkpoints_.write(record(), *film_, simulation_, watch_.seen(), seconds_now());
  }
  void show(std::uint32_t step) {
    if (film_->is_slow() && checkpoints_.affordable())
      checkpoint();  // an interrupt may lose this frame; then the run goes on from here
    film_->add_frame(simulation_, step);
    if (watch_.may_find(film_->pressed())) watch_.look(simulation_.volume(), step);
  }

  // Steps until the last step, or an interrupt.
  void step_on() {
    if (interval_ && begun_at_ == 0) checkpoint();
    if (frame_is_due(record(), begun_at_) &&
        record().frame_steps.size() == frames_due_before(record(), begun_at_))
      show(begun_at_);
    if (begun_at_ == 0) written_.add(simulation_, run_.scene);
    Progress progress(steps(), common().quiet, begun_at_);
    while (simulation_.steps_done() < steps() && !interrupted() && !is_late()) {
      if (journal_.apply()) checkpoints_.change_settings(journal_.settings(), simulation_.volume().grid);
      simulation_.step();
      film_->check();
      const std::uint32_t done = simulation_.steps_done();
      written_.add(simulation_, run_.scene);
      if (done < steps() && checkpoints_.due(interval_, done)) checkpoint();
      if (frame_is_due(record(), done)) show(done);
      progress.show(done, simulation_);
    }
    if (simulation_.steps_done() < steps()) resumable_ = checkpoint() || io::holds_work(out().partial());
    written_.settle();
    film_made_ = film_->finish();
  }

  void warn_of_what_was_seen(bool complete) {
    watch_.look(simulation_.volume(), simulation_.steps_done());
    std::vector<std::string> warnings = watch_.warnings(simulation_);
    if (complete && steps() > 0 && state::digest(simulation_.volume()) == run_.scene.initial_digest)
      warnings.push_back(
          fmt::format("nothing has changed in {} step{}: no liquid can move, and no heat comes to a solid",
                      steps(), steps() == 1 ? "" : "s"));
    warn(run_.scene, common(), warnings);
  }

  std::string put_into_place(bool complete) {
    // Where there is no room for the last state, there still is room for the rest.
    if (complete && is_kept(record(), "state"))
      (void)tried(
          [&] { checkpoints_.write_last(record(), *film_, simulation_, watch_.seen(), seconds_now()); });
    std::string report = report_json(run_.scene, common(), simulation_, seconds_now(), complete);
    io::write_file(out().partial() / "report.json", report);
    if (complete) remove_what_is_not_kept();
    out().commit();
    return report;
  }

  void remove_what_is_not_kept() const {
    for (const auto& [name, place] : {std::pair("frames", "frames"), std::pair("sheet", "contact_sheet.png"),
                                      std::pair("film", "film.mp4"), std::pair("film", "film.webp")})
      if (!is_kept(record(), name)) std::filesystem::remove_all(out().partial() / place);
  }

  // Keeps what was made before the failure. If nothing was, it is the failure's.
  int keep_incomplete(const std::exception_ptr& failed) {
    const Ending ending = ending_of(failed);
    film_.reset();  // nothing is written beside what follows
    if (!holds_frames(out().partial()) && !io::holds_work(out().partial()) && ending.code != kOutOfResources)
      std::rethrow_exception(failed);
    out().release_reserve();
    (void)tried([&] {  // the frames are worth more than their report
      io::write_file(out().partial() / "report.json",
                     report_json(run_.scene, common(), simulation_, RunSeconds{}, false));
    });
    const bool goes_on = io::holds_work(out().partial());
    const std::string kept = seen_from_here(out().keep_incomplete());
    say(fmt::format("{}; the run ended after step {} of {}, and what was made is kept in {}/{}",
                    ending.message, simulation_.steps_done(), steps(), kept,
                    !goes_on                         ? ""
                    : ending.code == kOutOfResources ? "; with more room, " + resume_command()
                                                     : "; " + resume_command()));
    return ending.code;
  }

  std::string film_text() const {
    if (film_made_.file.empty()) return film_made_.note;
    const std::string file = place_ + "/" + film_made_.file.filename().string();
    return film_made_.note.empty() ? file : file + "; " + film_made_.note;
  }

  void print_outputs() const {
    if (is_kept(record(), "frames")) print("{} frames      {}/frames/\n", film_->frame_count(), place_);
    if (is_kept(record(), "sheet")) print("contact sheet  {}/contact_sheet.png\n", place_);
    if (is_kept(record(), "film")) print("film           {}\n", film_text());
    print("report         {}/report.json\n", place_);
    written_.print_place(place_);
    if (!run_.scene.assumed.empty())
      print("scene          {}/scene.toml; change it, then: voxmelt run {}\n", place_,
            shell_word(place_ + "/scene.toml"));
    if (const std::string limit =
            limit_text(simulation_.ledger().limit, simulation_.parameters().flow.viscous);
        !limit.empty())
      print("note           {}\n", limit);
  }

  int verdict(bool complete) const {
    const std::string drift = drift_text(simulation_.drift());
    if (!drift.empty()) {
      say("error: the ledgers do not balance: " + drift);
      return kCheckFailed;
    }
    if (complete) return kDone;
    say(fmt::format("{} after step {} of {}; what was made is kept{}",
                    interrupted() ? "interrupted" : "the time of --wall-clock is over",
                    simulation_.steps_done(), steps(), resumable_ ? "; " + resume_command() : ""));
    return kInterrupted;
  }

  PreparedRun run_;  // its text has moved on
  std::optional<Interval> interval_;
  Clock::time_point start_;
  std::uint32_t begun_at_;  // steps done before
  run::Simulation simulation_;
  RunJournal journal_;
  std::optional<Film> film_;
  Checkpoints checkpoints_;
  WrittenStates written_;
  Watch watch_;
  std::string place_;  // place of the output, for messages
  render::FilmMade film_made_;
  bool resumable_ = true;
};

}  // namespace

int run_to_end(PreparedRun run, Clock::time_point start) {
  const std::optional<Interval> interval = interval_of(run.record.checkpoint_every);
  return Run(std::move(run), interval, start).to_end();
}

}  // namespace voxmelt::app
