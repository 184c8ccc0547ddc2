#include "hwmodel/pipeline/check/verify.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/check/waves.h"
#include "hwmodel/pipeline/check/checker.h"
#include "hwmodel/pipeline/check/column_checker.h"
#include "hwmodel/pipeline/check/diagnosis.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/check/feed_checker.h"
#include "hwmodel/pipeline/check/halo_check.h"
#include "hwmodel/pipeline/faults/planted_faults.h"
#include "hwmodel/pipeline/faults/planted_stages.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/ledger.h"

namespace voxmelt::hwmodel {
namespace {

// Returns the number of steps of a pass. No pass reaches beyond a step of visibility, where irradiance
// changes.
int steps_of_pass(const Design& design, const Configuration& configuration, std::uint32_t step,
                  std::uint32_t left) {
  std::uint32_t steps = std::min<std::uint32_t>(left, configuration.cascade);
  const rule::Heat& heat = design.parameters.heat;
  if (heat.radiates()) steps = std::min(steps, heat.visibility_every - heat.visibility_age(step));
  return steps;
}

}  // namespace

class Lockstep::Run {
 public:
  Run(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
      const step::Implementation& fast, const step::Tuning& tuning, const VerifyOptions& options)
      : options_(options),
        plan_(options.fault, options.fault_step),
        given_(options.machine ? options.machine() : nullptr),
        pipeline_(given_ ? nullptr : make_pipeline(parameters, start.grid)),
        machine_(given_ ? *given_ : *pipeline_),
        checker_(machine_),
        feed_checker_(machine_, checker_),
        column_checker_(machine_, checker_),
        software_(parameters, start, first_step, fast, tuning,
                  stages_of_step({parameters, machine_.design().shape})),
        memory_(start) {
    if (pipeline_ != nullptr && options.fault != Fault::none) planted_.emplace(plan_, *pipeline_);
    machine_.watch(&checker_);
    machine_.watch_feeds(&feed_checker_);
    machine_.watch_falls(&feed_checker_);
    machine_.watch_columns(&column_checker_);
    machine_.poll(options.poll);
    if (options.waves) {
      waves_.emplace(machine_, "pipeline", options.waves_from);
      machine_.probe(&*waves_);
      checker_.stop_at_difference(false);
    }
    if (options.timeline || options.waves) machine_.each_cycle([this] { end_cycle(); });
    machine_.memory(options.memory);
    report_.first_step = first_step;
  }

  VerifyReport run() {
    while (report_.steps < options_.steps && report_.mismatch == nullptr && !stopped_) advance();
    if (report_.mismatch == nullptr && !stopped_ && options_.steps > 0 && checker_.compared_cells() == 0)
      throw std::logic_error("lock-step compared nothing");
    report_.compared_cells = checker_.compared_cells();
    report_.software_cells = software_.compared_cells();
    report_.strike = plan_.struck();
    if (waves_) waves_->end();
    if (waves_ && !waves_->empty()) report_.waves = waves_->vcd();
    if (options_.timeline) report_.timeline.end(machine_.accounts());
    report_.stages = machine_.stages();
    report_.channels = machine_.channels();
    report_.digest = state::digest(memory_);
    check_accounts();
    return std::move(report_);
  }

  void end_cycle() {
    const std::int64_t cycles = report_.cycles + machine_.cycle() + 1;
    if (options_.timeline && report_.timeline.wants(cycles)) report_.timeline.add(machine_.accounts());
    if (!waves_) return;
    waves_->end_cycle();
    if (checker_.mismatch() != nullptr && !waves_->wants_more()) machine_.stop();
  }

 private:
  // Makes the SystemC model, in which a planted fault strikes.
  std::unique_ptr<Pipeline> make_pipeline(const rule::Parameters& parameters, state::Grid grid) {
    StageMaker make = options_.make;
    if (!make) make = options_.fault == Fault::none ? StageMaker(make_stage) : planted_stages(plan_);
    return std::make_unique<Pipeline>(parameters, grid, options_.configuration, make, options_.simulation);
  }

  // Runs a train of passes over several time steps each, or several passes over one step with many sub-steps.
  void advance() {
    const std::uint32_t step = next_step_ = report_.first_step + report_.steps;
    if (starts_replay(step)) {
      report_.replay = memory_;
      report_.replay_step = step;
    }
    if ((report_.mismatch = narrow_halo(machine_.design(), options_.configuration.cascade))) {
      report_.mismatch->step = step;
      report_.pass_end = step + 1;
      return;
    }
    software_.begin_step();
    falling_ = software_.falling();
    find_falling(step);
    Pass pass{.first = step, .substeps = software_.substeps(), .falls = falls_.has_value()};
    pass.count = std::min(pass.substeps, options_.configuration.substeps);
    if (host_waits()) report_.substeps.push_back(pass.substeps);
    if (pass.ends() && !host_waits()) pass.steps = steps_of(step);
    if (!run_software(pass)) {
      report_.mismatch = std::move(software_mismatch_);
      return;
    }
    const std::uint32_t done = report_.steps;
    for (; pass.substep < pass.substeps; pass.substep += pass.count) {
      pass.count = std::min(pass.count, pass.substeps - pass.substep);
      for (pass.tile = 0; pass.tile < machine_.design().shape.tiles(); pass.tile = last_tile_ + 1)
        if (!run_train(pass)) return;
    }
    report_.steps = done + (next_step_ - step);
    report_.mismatch = std::move(software_mismatch_);
    if (report_.mismatch != nullptr || options_.visit_every == 0 || report_.steps % options_.visit_every != 0)
      return;
    report_.stages = machine_.stages();
    stopped_ = !options_.visit(memory_, report_);
  }

  // The host finds the cells that fall, in the memory before the pass.
  void find_falling(std::uint32_t step) {
    falls_.reset();
    const Design& design = machine_.design();
    if (const auto falling = cells_that_fall(design.parameters, step, memory_))
      falls_.emplace(*falling, design.shape);
  }
  bool host_waits() const { return host_sees_each_step(machine_.design().parameters); }
  // Returns the steps of a pass, which does not reach beyond a step at which `visit` is called.
  int steps_of(std::uint32_t step) const {
    const std::uint32_t done = step - report_.first_step, every = options_.visit_every;
    const std::uint32_t left = options_.steps - done;
    return steps_of_pass(machine_.design(), options_.configuration, step,
                         every == 0 ? left : std::min(left, every - done % every));
  }

  // Runs the software over the steps of a pass. Returns false if its kernels differ.
  bool run_software(const Pass& pass) {
    report_.pass_end = pass.first + pass.steps;
    expected_.clear();
    for (int t = 0; t < pass.steps; ++t) {
      const std::uint32_t done = pass.first + t + 1 - report_.first_step;
      Expectation::Step one = software_.step(done % options_.every == 0 || done == options_.steps);
      if (options_.poll) options_.poll();
      expected_.push_back(std::move(one.stages));
      if ((software_mismatch_ = std::move(one.mismatch))) return false;
    }
    next_step_ = report_.pass_end;
    return true;
  }

  bool is_visited(std::uint32_t step) const {
    return options_.visit_every != 0 && (step - report_.first_step) % options_.visit_every == 0;
  }

  bool is_last_tile(const Pass& pass) const { return pass.tile + 1 == machine_.design().shape.tiles(); }

  // Gives the next tile, or the pass that follows without a gap. Only a step of visibility needs the whole
  // state before it begins.
  std::optional<Pass> next_pass(Pass last) {
    if (checker_.mismatch() != nullptr) return {};
    if (!is_last_tile(last)) {
      if (!tiles_follow(machine_.design(), options_.configuration, last)) return {};
      ++last.tile;
      add_pass(last);
      return last;
    }
    const std::uint32_t step = last.first + last.steps;
    const Design& design = machine_.design();
    const rule::Heat& heat = design.parameters.heat;
    if (!passes_overlap(design, options_.configuration, last) || host_waits() ||
        step == report_.first_step + options_.steps || is_visited(step) ||
        (heat.radiates() && heat.visibility_age(step) == 0))
      return {};
    last.first = step;
    last.tile = 0;
    last.steps = steps_of(step);
    if (!run_software(last)) return {};  // tokens under way can still be compared
    add_pass(last);
    return last;
  }

  void add_pass(const Pass& pass) {
    Checker::Wanted wanted{pass, {}, nullptr, {}, nullptr};
    for (const std::vector<Expected>& step : expected_) wanted.steps.push_back(expected_of(pass, step));
    if (pass.ends() && wanted.steps.back().empty()) {
      if (pass.tile == 0) written_ = std::make_shared<const state::Volume>(software_.volume());
      wanted.written = written_;
    }
    wanted.left = wanted.steps.back().empty() ? wanted.written : wanted.steps.back().back().after;
    if (is_last_tile(pass) && wanted.left != nullptr) wanted.held = state::holdings(*wanted.left);
    checker_.add_pass(std::move(wanted));
    if (planted_) planted_->add_pass(pass);
    feed_checker_.add_pass(pass);
  }

  bool run_train(const Pass& first) {
    checker_.begin_train();
    if (planted_) planted_->begin_train();
    feed_checker_.begin_train(software_.irradiance(), first.falls ? falling_ : std::nullopt);
    add_pass(first);
    std::vector<Pass> passes{first};
    const auto next = [&]() -> std::optional<Pass> {
      std::optional<Pass> pass = next_pass(passes.back());
      if (pass) passes.push_back(*pass);
      return pass;
    };
    if (!run_model(passes, next, software_.irradiance())) return false;
    const Pass& last = passes.back();
    last_tile_ = last.tile;
    if (!is_last_tile(last)) return true;
    report_.cell_steps +=
        first.ends() ? static_cast<std::int64_t>(memory_.grid.cells()) * (next_step_ - first.first) : 0;
    const std::uint32_t step = last.first + last.steps - 1;
    if (software_mismatch_ != nullptr) return true;
    if (last.ends())
      compare_memory(step, software_.volume());
    else if (!expected_.front().empty())
      compare_memory(step, *expected_of(last, expected_.front()).back().after);
    return report_.mismatch == nullptr;
  }

  // Returns what one pass has to give behind every stage, from what the sub-steps of a time step give.
  std::vector<Expected> expected_of(const Pass& pass, const std::vector<Expected>& step) const {
    if (machine_.design().paper() || step.empty()) return step;
    const std::vector<StageKind> stages = stages_of_step(machine_.design());
    const std::size_t before = std::find(stages.begin(), stages.end(), StageKind::settle) - stages.begin();
    std::vector<Expected> expected;
    std::size_t next = before + 2 * static_cast<std::size_t>(pass.substep);  // index in `step`
    std::shared_ptr<const state::Volume> now = pass.begins() ? step.front().before : step[next - 1].after;
    SideBands bands;
    if (!pass.begins()) bands.set = step[next - 1].bands.set;
    int copy = -1;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stages[i] == StageKind::settle) ++copy;
      if (!pass.uses(stages[i], copy))
        expected.push_back({now, now, bands});  // the stage hands on what came
      else
        expected.push_back(i < before ? step[i] : step[next++]);
      now = expected.back().after;
      bands = expected.back().bands;
    }
    return expected;
  }

  // Returns false when a mismatch was found.
  bool run_model(const std::vector<Pass>& passes, const StreamMachine::Next& next,
                 const step::Irradiance* irradiance) {
    const Pass first = passes.front();
    const auto begin = std::chrono::steady_clock::now();
    PassEnd end;
    if (waves_) waves_->begin_train(report_.cycles);
    std::optional<IrradianceStream> stream;
    if (irradiance != nullptr)
      report_.irradiance = stream.emplace(*irradiance, machine_.design().shape).counts();
    const Fed fed(stream ? &*stream : nullptr, first.falls ? &*falls_ : nullptr);
    try {
      end = machine_.run_train(first, next, fed, memory_);
    } catch (const StageError& error) {
      if (checker_.mismatch() != nullptr) {  // an error may follow from a difference
        report_.mismatch = std::make_unique<Mismatch>(*checker_.mismatch());
        return false;
      }
      report_.mismatch = std::make_unique<Mismatch>(Mismatch{
          .kind = error.kind == StageError::Kind::width ? Mismatch::Kind::width : Mismatch::Kind::address,
          .where = std::string(name_of(error.stage)),
          .phase = phase_of(error.stage),
          .step = error.step,
          .cascade = error.cascade,
          .lane = error.spot.lane,
          .cycle = error.cycle,
          .x = error.spot.token.x + error.spot.lane,
          .y = error.spot.token.y,
          .z = error.spot.token.z,
          .detail = error.what(),
      });
      return false;
    }
    report_.model_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    report_.passes += (first.tile + end.passes) / machine_.design().shape.tiles();
    report_.cycles += end.cycles;
    if (end.complete) {
      const std::int64_t predicted =
          predicted_cycles(machine_.design(), options_.configuration, first, end.passes);
      report_.predicted_cycles += predicted;
      report_.trains.push_back({first.first, end.passes, end.cycles, predicted});
      const Configuration& c = options_.configuration;
      const bool exact = c.stall_seed == 0 && options_.memory == nullptr && end.held == 0;
      if (exact && c.channels_alike() && end.cycles != predicted)
        report_.mismatch =
            std::make_unique<Mismatch>(cycles_of(machine_, first.first, predicted, end.cycles));
    }
    if (checker_.mismatch() != nullptr) report_.mismatch = std::make_unique<Mismatch>(*checker_.mismatch());
    if (report_.mismatch == nullptr && end.hangs)
      report_.mismatch = std::make_unique<Mismatch>(hang_of(machine_, first, end.cycles));
    if (options_.streamed) options_.streamed(passes, fed);
    return report_.mismatch == nullptr;
  }

  void compare_memory(std::uint32_t step, const state::Volume& wanted) {
    const Difference d = first_difference(wanted, memory_);
    if (d.field.empty()) return;
    const Shape& shape = machine_.design().shape;
    report_.mismatch = std::make_unique<Mismatch>(Mismatch{
        .kind = Mismatch::Kind::memory,
        .where = std::string(name_of(StageKind::writer)),
        .step = step,
        .cascade = options_.configuration.cascade - 1,
        .lane = d.x % shape.lanes,
        .cycle = checker_.written_in(owned_ordinal(shape, d.x, d.y, d.z)),
        .x = d.x,
        .y = d.y,
        .z = d.z,
        .field = d.field,
        .expected = d.expected,
        .actual = d.actual,
    });
  }

  // Returns true where a replay may begin: where visibility is computed, or where this run began.
  bool starts_replay(std::uint32_t step) const {
    return step == report_.first_step || machine_.design().parameters.heat.visibility_age(step) == 0;
  }

  // Checks that every cycle of every stage is accounted for exactly once.
  void check_accounts() const {
    for (const StageReport& stage : report_.stages)
      if (stage.cycles.total() != report_.cycles && report_.mismatch == nullptr)
        throw std::logic_error("cycles of stage " + std::string(name_of(stage.kind)) + ": " +
                               std::to_string(stage.cycles.total()) + " are accounted for, " +
                               std::to_string(report_.cycles) + " have passed");
  }

  const VerifyOptions& options_;
  FaultPlan plan_;
  std::unique_ptr<StreamMachine> given_;  // null: the machine is the pipeline
  std::unique_ptr<Pipeline> pipeline_;
  std::optional<PlantedFaults> planted_;  // faults in the pipeline
  StreamMachine& machine_;
  Checker checker_;
  FeedChecker feed_checker_;
  ColumnChecker column_checker_;
  Expectation software_;
  state::Volume memory_;
  std::vector<std::vector<Expected>> expected_;   // for the pass that the software has run last
  std::shared_ptr<const state::Volume> written_;  // its state, where steps are not compared
  std::optional<FallStream> falls_;               // cells that fall, in the memory of the machine
  std::optional<state::BitPlane> falling_;        // the same by the software
  std::unique_ptr<Mismatch> software_mismatch_;
  std::optional<Waves> waves_;
  std::uint32_t next_step_ = 0;  // step after that pass
  int last_tile_ = 0;            // last tile of the last train
  VerifyReport report_;
  bool stopped_ = false;  // `visit` ended the run
};

Lockstep::Lockstep(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
                   const step::Implementation& fast, const step::Tuning& tuning, const VerifyOptions& options)
    : run_(std::make_unique<Run>(parameters, start, first_step, fast, tuning, options)) {}
Lockstep::~Lockstep() = default;
VerifyReport Lockstep::run() { return run_->run(); }

bool VerifyReport::found_where_planted() const {
  if (!strike || mismatch == nullptr) return false;
  return mismatch->where == strike->where && mismatch->step == strike->step && mismatch->x == strike->x &&
         mismatch->y == strike->y && mismatch->z == strike->z;
}

VerifyReport verify(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step,
                    const step::Implementation& fast, const step::Tuning& tuning,
                    const VerifyOptions& options) {
  return Lockstep(parameters, start, first_step, fast, tuning, options).run();
}

}  // namespace voxmelt::hwmodel
