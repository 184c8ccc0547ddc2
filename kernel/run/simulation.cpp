#include "kernel/run/simulation.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "kernel/automaton/state/connectivity.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/engine/gpu/stepper.h"
#include "kernel/engine/scalar/by_hand.h"
#include "kernel/engine/scalar/pieces.h"
#include "kernel/engine/scalar/substeps.h"
#include "kernel/engine/visibility/providers.h"

namespace voxmelt::run {
namespace {

class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Simulation::Simulation(rule::Parameters parameters, state::Volume initial,
                       const step::Implementation& implementation, const step::Tuning& tuning,
                       std::unique_ptr<visibility::Provider> provider)
    : parameters_(std::move(parameters)),
      volume_(std::move(initial)),
      name_(implementation.name),
      create_(implementation.create),
      spare_(implementation.spare),
      told_(implementation.told),
      tuning_(tuning),
      provider_(provider != nullptr ? std::move(provider) : visibility::usual_provider(tuning.threads)),
      ledger_(state::Ledger::open(volume_)),
      threads_(std::min(tuning.threads, cpu::Workers::most())) {
  parameters_.heat.ray_seed = parameters_.seed;  // providers of irradiance see heat alone
  make_stepper();
  make_irradiance();
  volume_.changed.follow(volume_.grid);
}

void Simulation::make_stepper() {
  if (spare_ != nullptr && parameters_.pieces.fall) use_spare("pieces fall in the memory of the host");
  try {
    stepper_ = create_(parameters_, volume_.grid, tuning_);
  } catch (const step::DeviceError& why) {
    if (spare_ == nullptr) throw;
    use_spare(why.what());
    if (told_) told_(why);
    stepper_ = create_(parameters_, volume_.grid, tuning_);
  }
  host_ = dynamic_cast<step::HostStepper*>(stepper_.get());
  device_ = dynamic_cast<step::DeviceStepper*>(stepper_.get());
}

// Makes the irradiance, and keeps it from then on. Sources that have been removed shine until the next step
// of visibility.
void Simulation::make_irradiance() {
  if (parameters_.heat.radiates() && irradiance_.empty()) irradiance_ = step::Irradiance(volume_.grid);
}

void Simulation::change_sources(Sources sources) {
  if (spare_ != nullptr) fetch();  // it may go on from here, and must not begin earlier with these sources
  parameters_.heat.sources = std::move(sources.heat);
  parameters_.heat.radiation = parameters_.heat.radiation || !parameters_.heat.sources.empty();
  parameters_.vents = std::move(sources.vents);
  parameters_.drains = std::move(sources.drains);
  make_irradiance();
  stepper_->change_sources(parameters_);
}

// Makes a new stepper. Between two steps a stepper knows nothing that another one lacks, except changes that
// it has not told.
void Simulation::change_parameters(rule::Parameters parameters) {
  fetch();
  fetch_light();
  tell_changes();
  keep_counts(counts());
  device_has_light_ = false;
  parameters_ = std::move(parameters);
  parameters_.heat.ray_seed = parameters_.seed;
  make_stepper();
  uploaded_ = false;
  make_irradiance();
}

// The run loop itself tells the readers of the volume, because a device does not know. It takes the state
// anew at the next step.
template <class Edit>
bool Simulation::edit(const rule::Region& region, const Edit& by_hand) {
  if (!scalar::meets(region, volume_.grid)) return false;
  fetch();
  tell_changes();
  const state::ChangedRows rows = by_hand();
  volume_.changed.new_version();
  for (const state::ChangedRow& row : rows)
    volume_.changed.mark(state::ChangedBricks::kMatter, row.words, row.y / state::kBrickSide,
                         row.z / state::kBrickSide);
  provider_->forget_amounts();
  if (host_ != nullptr) host_->tell_matter(rows, volume_);
  uploaded_ = false;
  return true;
}

std::optional<gpu::StateOnDevice> Simulation::state_on_device() const {
  const auto* stepper = dynamic_cast<const gpu::Stepper*>(device_);
  if (stepper == nullptr || !uploaded_) return std::nullopt;
  return stepper->where();
}

bool Simulation::pour(const rule::Region& region, rule::Temperature temperature) {
  return edit(region, [&] { return scalar::pour(region, temperature, parameters_, volume_, ledger_); });
}

bool Simulation::carve(const rule::Region& region) {
  return edit(region, [&] { return scalar::carve(region, volume_, ledger_); });
}

void Simulation::resume(state::MidRun run) {
  steps_done_ = run.steps_done;
  ledger_ = run.ledger;
  if (!run.irradiance.empty()) irradiance_ = std::move(run.irradiance);
  irradiance_capped_ = run.irradiance_capped;
  casts_before_ = {run.rays, run.rays_cast};
  seconds_ = run.seconds;
  know_state(counts());
}

state::MidRun Simulation::mid_run() const {
  return {steps_done_, ledger(), {}, irradiance_capped(), casts().asked, casts().cast, seconds_};
}

void Simulation::begin_step() {
  if (device_ != nullptr && !uploaded_) {
    device_->upload(volume_, ledger_);
    uploaded_ = true;
  }
  substep_ = 0;
  if (parameters_.pieces.fall) let_pieces_fall();
  if (parameters_.heat.is_visibility_step(step_number())) find_irradiance();
  volume_.changed.begin();
  if (host_ != nullptr) cadence_ = count_substeps();  // a device counts its own
}

std::int64_t Simulation::loose_cells() const { return scalar::loose_cells(volume()); }

void Simulation::let_pieces_fall() {
  volume_.changed.begin();
  if (!(host_ != nullptr ? host_->let_pieces_fall(step_number(), volume_) : let_pieces_fall_for_device())) {
    if (!untold_) volume_.changed.end();  // as before: all has been told, and nothing has moved
    return;
  }
  untold_ = true;
  provider_->forget_amounts();
}

void Simulation::fetch_masks() {
  if (spare_ != nullptr) fetch();  // a state with new masks is none that a spare could go on from
  if (masks_are_old_ && behind_) device_->download_masks(volume_);
  masks_are_old_ = false;
}

// A device has no such rule. It sends its masks, and the rest of its state only if something is loose.
bool Simulation::let_pieces_fall_for_device() {
  fetch_masks();
  if (state::loose_solids(volume_).count() == 0) return false;
  fetch();
  if (!scalar::let_pieces_fall(parameters_.pieces, step_number(), volume_)) return false;
  device_->upload(volume_, ledger_);
  return true;
}

// Every provider gives the same bits. So does the walk of a device, and it stands for the usual one. If a
// user names another one, that one has its way.
bool Simulation::device_follows_rays() const {
  return device_ != nullptr && provider_->name() == visibility::kUsual &&
         device_->follows_rays(parameters_.heat);
}

// The provider does not find there what it has written, so it must write all of it the next time.
void Simulation::fetch_light() const {
  if (!light_is_old_) return;
  if (spare_ != nullptr) return fetch();
  device_->download_irradiance(irradiance_);
  provider_->forget_amounts();
  light_is_old_ = false;
}

// Masks that a device has sent without the rest of its state count as changed everywhere.
void Simulation::find_irradiance() {
  const Stopwatch watch(seconds_.visibility);
  device_has_light_ = light_is_old_ = device_follows_rays();
  if (device_has_light_) return device_->find_irradiance(step_number());
  // Between two of these steps a cell may melt, and another amount may freeze there.
  if (parameters_.freezes() && parameters_.heat.visibility_every > 1) provider_->forget_amounts();
  if (behind_) {
    volume_.changed.begin();
    fetch_masks();
  } else {
    tell_changes();
  }
  irradiance_capped_ += provider_->irradiance(volume_, parameters_.heat, step_number(), irradiance_);
  const state::ChangedRows* const changed = provider_->changed();
  if (changed != nullptr) stepper_->tell_irradiance(*changed);
}

step::Cadence Simulation::count_substeps() const {
  if (parameters_.flow.law == rule::Law::paper) return {};
  return scalar::count_substeps(parameters_, volume_);
}

std::vector<step::Phase> Simulation::phases() const {
  return step::phase_order(parameters_.flow.law, cadence_.substeps);
}

void Simulation::run_phase(step::Phase phase) {
  if (host_ == nullptr) throw std::logic_error("a device stepper runs whole steps only, not one phase");
  run(phase, moment());
}

void Simulation::run(step::Phase phase, step::Moment moment) {
  volume_.changed.begin();
  const Stopwatch watch(seconds_.*step::time_of(phase));
  host_->run(phase, moment, irradiance(), volume_, ledger_);
  if (phase == step::Phase::spread) ++substep_;
}

// Tells the changes when somebody asks for the volume. Until then everything counts as changed. The same
// holds after a change by hand.
void Simulation::tell_changes() const {
  if (!untold_) return;
  untold_ = false;
  state::ChangedBricks& changed = volume_.changed;
  if (!changed.followed()) changed.follow(volume_.grid);
  changed.new_version();
  stepper_->tell_changes(changed);
  changed.end();
}

void Simulation::step() {
  bool done = false;
  on_device([&] {
    take_step();
    done = true;
  });
  if (!done) take_step();
}

void Simulation::take_step() {
  begin_step();
  if (device_ != nullptr) {
    device_->run_step(step_number(), device_has_light_ ? nullptr : host_light());
    behind_ = true;
    masks_are_old_ = true;
  } else {
    const std::vector<step::Phase> all = phases();
    for (const step::Phase& phase : all) {
      step::Moment now = moment();
      now.unseen = &phase != &all.back();
      run(phase, now);
    }
  }
  end_step();
}

// With a spare, the irradiance comes with the state, and nothing is written before all of it is here.
void Simulation::download() const {
  on_device([&] {
    step::Irradiance light;
    Counts now;
    const bool with_light = spare_ != nullptr && light_is_old_;
    if (with_light) device_->download_irradiance(light = step::Irradiance(volume_.grid));
    if (spare_ != nullptr) now = counts_with(device_->count_rays());
    device_->download(volume_, ledger_);
    behind_ = false;
    if (with_light) {
      irradiance_ = std::move(light);
      provider_->forget_amounts();
      light_is_old_ = false;
    }
    know_state(now);
  });
}

// Lets the spare go on if the device fails. It then stands where the device stood.
template <class Work>
void Simulation::on_device(const Work& work) const {
  try {
    work();
  } catch (const step::DeviceError& why) {
    if (spare_ == nullptr) throw;
    const_cast<Simulation*>(this)->leave_device(why);  // no simulation is a constant
  }
}

void Simulation::use_spare(const std::string& why) {
  failure_ = name_ + ": " + why;
  name_ = spare_->name;
  create_ = spare_->create;
  spare_ = nullptr;
}

// Takes the steps again that the device has done since its state was fetched.
void Simulation::leave_device(const step::DeviceError& why) {
  // The driver of a lost device may still write where the stepper wanted it to, so that one never ends.
  static auto& lost = *new std::vector<std::unique_ptr<step::Stepper>>;
  if (dynamic_cast<const step::DeviceLost*>(&why) != nullptr) lost.push_back(std::move(stepper_));
  use_spare(why.what());
  const std::uint32_t wanted = std::exchange(steps_done_, known_steps_);
  keep_counts(known_counts_);
  behind_ = masks_are_old_ = device_has_light_ = light_is_old_ = false;
  make_stepper();
  provider_->forget_amounts();
  volume_.changed.forget();
  if (told_) told_(why);
  while (steps_done_ < wanted) take_step();
}

Simulation::Counts Simulation::counts() const {
  step::RayCounts found;
  on_device([&] {
    if (device_ != nullptr) found = device_->count_rays();
  });
  return counts_with(found);
}

// A device follows every ray each time.
Simulation::Counts Simulation::counts_with(const step::RayCounts& of_device) const {
  Counts all{irradiance_capped_ + of_device.capped, casts_before_};
  all.casts += provider_->casts();
  all.casts += {of_device.rays, of_device.rays};
  return all;
}

// Makes these the counts of the run, for a device that has counted nothing yet, or for none.
void Simulation::keep_counts(const Counts& counts) {
  const visibility::Casts own = provider_->casts();
  irradiance_capped_ = counts.capped;
  casts_before_ = {counts.casts.asked - own.asked, counts.casts.cast - own.cast};
}

void Simulation::know_state(const Counts& counts) const {
  known_steps_ = steps_done_;
  known_counts_ = counts;
}

}  // namespace voxmelt::run
