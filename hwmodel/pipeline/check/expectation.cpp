#include "hwmodel/pipeline/check/expectation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/check/falling.h"
#include "kernel/automaton/state/ledger_difference.h"
#include "kernel/run/sleep_audit.h"

namespace voxmelt::hwmodel {

Expectation::Expectation(const rule::Parameters& parameters, const state::Volume& start,
                         std::uint32_t first_step, const step::Implementation& fast,
                         const step::Tuning& tuning, std::vector<StageKind> stages)
    : parameters_(parameters),
      reference_(parameters, start, *run::implementations().find("reference")),
      fast_(parameters, start, fast, tuning),
      fast_name_(fast.name),
      stages_(std::move(stages)) {
  reference_.begin_at(first_step);
  fast_.begin_at(first_step);
}

void Expectation::begin_step() {
  if (begun_) return;
  if (parameters_.pieces.fall) unfallen_ = snapshots_.of(reference_.volume());
  reference_.begin_step();
  fast_.begin_step();
  begun_ = true;
}

std::optional<state::BitPlane> Expectation::falling() const {
  if (unfallen_ == nullptr) return {};
  return cells_that_fall(parameters_, step_number(), *unfallen_);
}

Expectation::Step Expectation::step(bool keep) {
  begin_step();
  around_ = nullptr;
  Step result;
  Snapshot before = keep ? snapshots_.of(reference_.volume()) : nullptr;
  if (keep && unfallen_ != nullptr) result.stages.push_back({unfallen_, before, {}});  // behind `fall`
  Snapshot before_flow;
  const std::vector<step::Phase> phases = reference_.phases();
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const step::Phase phase = phases[i];
    if (run::begins_flow(phases, i)) before_flow = snapshots_.of(reference_.volume());
    const bool staged =
        std::any_of(stages_.begin(), stages_.end(), [&](StageKind one) { return phase_of(one) == phase; });
    const step::Moment moment = reference_.moment();
    reference_.run_phase(phase);
    fast_.run_phase(phase);
    if ((result.mismatch = compare_software(phase))) return result;
    compared_cells_ += volume().grid.cells();
    if (!keep) continue;
    if (!staged) {
      const Difference changed = first_difference(*before, volume());
      if (changed.field.empty()) continue;
      result.mismatch = std::make_unique<Mismatch>(Mismatch{
          .kind = Mismatch::Kind::missing,
          .where = "no stage for this phase",
          .phase = phase,
          .step = step_number(),
          .x = changed.x,
          .y = changed.y,
          .z = changed.z,
          .field = changed.field,
          .expected = changed.actual,
          .actual = changed.expected,
      });
      return result;
    }
    const Snapshot after = snapshots_.of(volume());
    expect_inside(phase, moment, before, after, result.stages);
    before = after;
  }
  result.mismatch = compare_sleep(*before_flow, phases.back());
  reference_.end_step();
  fast_.end_step();
  begun_ = false;
  return result;
}

std::unique_ptr<Mismatch> Expectation::compare_software(step::Phase phase) const {
  if (reference_.volume() == fast_.volume() && reference_.ledger() == fast_.ledger()) return nullptr;
  Mismatch found{.kind = Mismatch::Kind::software,
                 .where = fast_name_,
                 .phase = phase,
                 .step = step_number(),
                 .field = "ledger"};
  if (const auto term = state::first_difference(reference_.ledger(), fast_.ledger()))
    found.detail = "no cell differs, but the books do: " + term->term + " expected " +
                   state::to_string(term->expected) + ", is " + state::to_string(term->actual);
  const Difference d = first_difference(reference_.volume(), fast_.volume());
  if (!d.field.empty()) {
    found.x = d.x;
    found.y = d.y;
    found.z = d.z;
    found.field = d.field;
    found.expected = d.expected;
    found.actual = d.actual;
    found.detail.clear();
  }
  return std::make_unique<Mismatch>(std::move(found));
}

std::unique_ptr<Mismatch> Expectation::compare_sleep(const state::Volume& before_flow,
                                                     step::Phase last) const {
  const auto found = run::sleeps_beside_change(before_flow, volume(), fast_.awake());
  if (!found) return nullptr;
  return std::make_unique<Mismatch>(Mismatch{.kind = Mismatch::Kind::asleep,
                                             .where = fast_name_,
                                             .phase = last,
                                             .step = step_number(),
                                             .x = found->x,
                                             .y = found->y,
                                             .z = found->z,
                                             .detail = found->text()});
}

void Expectation::expect_inside(step::Phase phase, step::Moment moment, const Snapshot& before,
                                const Snapshot& after, std::vector<Expected>& stages) {
  std::vector<StageKind> kinds;
  for (const StageKind stage : stages_)
    if (phase_of(stage) == phase) kinds.push_back(stage);
  Snapshot last = before;
  for (const StageKind kind : kinds) {
    Expected expected{last, after, bands_behind(kind, moment, *before)};
    if (kind != kinds.back())  // inside the phase
      expected.after = phase == step::Phase::heat ? heat_up_to(kind, *before) : last;
    last = expected.after;
    stages.push_back(std::move(expected));
  }
}

SideBands Expectation::bands_behind(StageKind stage, step::Moment moment, const state::Volume& before) {
  using enum StageKind;
  const bool paper = parameters_.flow.law == rule::Law::paper;
  SideBands bands;
  const auto look_around = [&] {
    if (around_ == nullptr) around_ = std::make_shared<const Surroundings>(before);
    return around_;
  };
  switch (stage) {
    case conduction:
    case edges:
    case corners:
    case convection:
      if (parameters_.heat.air) bands.axes = look_around();
      [[fallthrough]];
    case exchange:
      if (parameters_.freezes()) bands.touched = look_around();
      [[fallthrough]];
    case melt:  // the paper law's sides are older than what melts
    case walls:
      if (stage == melt && parameters_.freezes()) bands.set = set_ = set_cells(before);
      if (paper && falls_by_sides()) bands.sides = look_around();
      bands.sides_of_blocked = true;
      break;
    case gravity:
      if (paper) bands.set = set_;
      break;
    case pattern:
      bands.pattern = patterns(before);
      break;
    case settle:
      bands.runs = shown_ = runs(moment, before);
      bands.shown = true;
      bands.set = set_;
      if (moment.substep == 0) around_ = nullptr;  // the viscous law's sides are those after melt
      break;
    case viscous_spread:  // no sub-step melts anything
      bands.runs = shown_;
      bands.set = set_;
      if (falls_by_sides()) bands.sides = look_around();
      break;
    default:
      break;
  }
  return bands;
}

bool Expectation::falls_by_sides() const {
  const rule::Fall& fall = parameters_.flow.fall;
  return fall.hang > 0 || fall.factor != fall.wall_factor || parameters_.freezes();
}

Expectation::Snapshot Expectation::heat_up_to(StageKind stage, const state::Volume& before) {
  rule::Parameters cut = parameters_;
  rule::Heat& heat = cut.heat;
  heat.radiation = heat.air = false;
  if (stage != StageKind::convection) heat.convection = 0;
  if (stage == StageKind::conduction) heat.neighbours = 6;
  if (stage == StageKind::edges) heat.neighbours = 18;
  const std::shared_ptr<state::Volume> result = snapshots_.of(before);
  state::Ledger ledger;
  scalar::Reference(cut, before.grid)
      .run(step::Phase::heat, step::Moment(step_number()), nullptr, *result, ledger);
  return result;
}

std::shared_ptr<const state::BitPlane> Expectation::set_cells(const state::Volume& before) {
  const std::shared_ptr<state::Volume> scratch = snapshots_.of(before);
  state::Ledger ledger;
  melted_ = std::make_unique<scalar::Reference>(parameters_, before.grid);  // it has no patterns yet
  melted_->run(step::Phase::melt, step::Moment(step_number()), nullptr, *scratch, ledger);
  return std::make_shared<const state::BitPlane>(melted_->set_cells());
}

std::shared_ptr<const state::Field<std::uint8_t>> Expectation::patterns(const state::Volume& before) {
  const std::shared_ptr<state::Volume> scratch = snapshots_.of(before);
  state::Ledger ledger;
  scalar::Reference fresh(parameters_, before.grid);
  scalar::Reference& reference = melted_ != nullptr ? *melted_ : fresh;
  reference.run(step::Phase::spread, step::Moment(step_number()), nullptr, *scratch, ledger);
  return std::make_shared<const state::Field<std::uint8_t>>(reference.pattern());
}

std::shared_ptr<const ShownRuns> Expectation::runs(step::Moment moment, const state::Volume& before) {
  const std::shared_ptr<state::Volume> scratch = snapshots_.of(before);
  state::Ledger ledger;
  scalar::Reference reference(parameters_, before.grid);
  reference.run(step::Phase::excess, moment, nullptr, *scratch, ledger);
  return std::make_shared<const ShownRuns>(reference, before.grid);
}

}  // namespace voxmelt::hwmodel
