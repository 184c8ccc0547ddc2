#include "kernel/engine/gpu/stepper.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/relax.h"
#include "kernel/automaton/rule/source.h"
#include "kernel/automaton/state/ledger_terms.h"
#include "kernel/engine/gpu/constants.h"
#include "kernel/engine/gpu/transfer.h"

namespace voxmelt::gpu {
namespace {

constexpr int kColumnNumbers = 8;  // of a Column (program/settle.cl)
constexpr int kDirections = 8;

bool is_paper(const rule::Parameters& p) { return p.flow.law == rule::Law::paper; }
bool has_transients(const rule::Parameters& p) {
  return p.heat.enabled && (p.freezes() || (is_paper(p) && p.falls_by_sides()));
}
bool may_count(const rule::Parameters& p) {
  return !is_paper(p) && (p.flow.viscous.counts_substeps() || p.flow.viscous.relaxes());
}

std::uint64_t new_version() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

std::int32_t as_int(std::int64_t number) { return static_cast<std::int32_t>(number); }
std::int32_t as_int(std::uint32_t number) { return static_cast<std::int32_t>(number); }

// A box that holds the cells of a region, cut to the grid.
struct RegionBox {
  std::int32_t from[3], size[3];
  bool empty() const { return size[0] <= 0 || size[1] <= 0 || size[2] <= 0; }
};
RegionBox box_of(const rule::Region& region, state::Grid grid) {
  const std::int64_t at[3] = {region.at.x, region.at.y, region.at.z};
  const int sides[3] = {grid.x, grid.y, grid.z};
  RegionBox box{};
  for (int a = 0; a < 3; ++a) {
    const std::int64_t unit = rule::kPositionUnit;
    const std::int64_t first = std::max<std::int64_t>(0, (at[a] - region.radius) / unit - 1);
    const std::int64_t last = std::min<std::int64_t>(sides[a] - 1, (at[a] + region.radius) / unit + 1);
    box.from[a] = as_int(first);
    box.size[a] = as_int(std::max<std::int64_t>(0, last - first + 1));
  }
  return box;
}

// The ledgers' part of the books of one group, in the order of program/cells.cl.
state::LedgerTerms<std::int64_t> terms_of(const std::int64_t* slot) {
  state::LedgerTerms<std::int64_t> terms;
  const auto take = [&](auto& ledger) {
    for (const auto& row : std::remove_reference_t<decltype(ledger)>::table()) ledger.*row.value = *slot++;
  };
  take(terms.mass);
  take(terms.energy);
  take(terms.heat);
  terms.limit = {slot[0], slot[1], slot[2], slot[3]};
  return terms;
}

}  // namespace

Stepper::Stepper(std::shared_ptr<Device> device, const rule::Parameters& parameters, state::Grid grid,
                 bool sleep)
    : device_(std::move(device)),
      parameters_(parameters),
      shape_(grid),
      sleep_(sleep),
      kinds_(source_kinds(parameters.heat)) {
  if (shape_.cells > std::numeric_limits<std::int32_t>::max())
    throw DeviceError("the scene's grid is too large for a device: 2^31 cells are the most");
  const auto bricks = static_cast<std::int64_t>(shape_.bricks.cells());
  groups_ = as_int(std::min<std::int64_t>(bricks, device_->most_groups()));
  const auto cells = static_cast<std::size_t>(shape_.cells);
  const bool paper = is_paper(parameters), hot = parameters.heat.enabled;

  const Constants constants = constants_of(parameters, shape_);
  const std::size_t numbers = constants.numbers.size() * sizeof(std::int64_t);
  const std::size_t tables = constants.tables.size() * sizeof(std::int32_t);
  constants_ = allocate(numbers);
  tables_ = allocate(tables);
  device_->write(*constants_, constants.numbers.data(), numbers);
  device_->write(*tables_, constants.tables.data(), tables);

  flags_ = allocate(cells);
  for (Buffer* field : {&amount_.now, &amount_.next}) *field = allocate(2 * cells);
  if (paper) {
    for (Buffer* field : {&energy_.now, &energy_.next}) *field = allocate(2 * cells);
    pattern_ = allocate(cells);
  } else {
    run_ = allocate(2 * cells);
    records_ = allocate(sizeof(std::int32_t) * kColumnNumbers * cells);
    limits_ = allocate(limit_bytes());
    standing_ = allocate(book_bytes());
  }
  if (hot)
    for (Buffer* field : {&heat_.now, &heat_.next}) *field = allocate(2 * cells);
  if (has_transients(parameters)) transient_ = allocate(cells);
  if (!paper && parameters.flow.viscous.relaxes()) {
    leveling_ = allocate(2 * kDirections * cells);
    for (Buffer* field : {&impetus_, &change_, &heads_.now, &heads_.next}) *field = allocate(4 * cells);
  }
  const std::size_t all = shape_.bricks.cells();
  moments_ = allocate(sizeof(std::int32_t) * kMoments * all);
  for (Buffer* field : {&full_, &near_, &giving_, &columns_}) *field = allocate(4 * all);
  for (Buffer* counts : {&counts_, &other_counts_}) *counts = allocate(4 * sizeof(std::int32_t));
  most_ = allocate(sizeof(std::int32_t));
  books_ = allocate(book_bytes());
}

Stepper::Buffer Stepper::allocate(std::size_t bytes) {
  bytes_ += bytes;
  const std::uint64_t room = device_->memory();
  if (bytes > device_->largest_piece() || bytes_ > room - room / 16)
    throw DeviceError("the scene's grid is too large for the device: it has " + std::to_string(room >> 20) +
                      " MiB, of which " + std::to_string(device_->largest_piece() >> 20) +
                      " MiB in one piece");
  return device_->allocate(bytes);
}

StateOnDevice Stepper::where() const {
  return {device_, &shape_, flags_.get(), amount_.now.get(), heat_.now.get(), bytes_, groups_, version_};
}

void Stepper::tell_irradiance(const state::ChangedRows& changed) { new_light_ = changed; }

void Stepper::change_sources(const rule::Parameters& parameters) { parameters_ = parameters; }

void Stepper::upload(const state::Volume& volume, const state::Ledger& ledger) {
  version_ = new_version();
  const Packed& state = in_flight(packed(volume, shape_));
  const std::size_t bytes = 2 * state.amount.size();
  device_->write(*flags_, state.flags.data(), state.flags.size());
  const auto both = [&](Twice& field, const std::vector<std::uint16_t>& numbers) {
    if (field.now == nullptr) return;
    device_->write(*field.now, numbers.data(), bytes);
    device_->write(*field.next, numbers.data(), bytes);
  };
  both(amount_, state.amount);
  both(energy_, state.energy);
  both(heat_, state.heat);
  device_->clear(*books_, book_bytes());
  forget_moments();
  ledger_ = ledger;
  steps_in_books_ = 0;
  knows_light_ = false;
  new_light_.reset();
  in_flight_.reset();
}

void Stepper::download_masks(state::Volume& volume) {
  auto& flags = in_flight(std::vector<std::uint8_t>(static_cast<std::size_t>(shape_.cells)));
  device_->read(*flags_, flags.data(), flags.size());
  unpack_masks(flags, shape_, volume);
  in_flight_.reset();
}

// It writes nothing before it has everything.
void Stepper::download(state::Volume& volume, state::Ledger& ledger) {
  const auto cells = static_cast<std::size_t>(shape_.cells);
  collect_books();
  Packed& state =
      in_flight(Packed{std::vector<std::uint8_t>(cells), std::vector<std::uint16_t>(cells), {}, {}});
  device_->read(*flags_, state.flags.data(), cells);
  device_->read(*amount_.now, state.amount.data(), 2 * cells);
  const auto read = [&](const Twice& field, std::vector<std::uint16_t>& numbers) {
    if (field.now == nullptr) return;
    numbers.resize(cells);
    device_->read(*field.now, numbers.data(), 2 * cells);
  };
  read(energy_, state.energy);
  read(heat_, state.heat);
  fetch_changes();
  unpack(state, shape_, volume);
  ledger = ledger_;
  in_flight_.reset();
}

void Stepper::collect_books() {
  auto& sums = in_flight(
      std::vector<std::int64_t>(static_cast<std::size_t>(kTerms) * static_cast<std::size_t>(groups_)));
  device_->read(*books_, sums.data(), sizeof(std::int64_t) * sums.size());
  device_->clear(*books_, sizeof(std::int64_t) * sums.size());
  for (std::size_t slot = 0; slot < sums.size(); slot += kTerms) {
    ledger_.book(terms_of(sums.data() + slot));
    ray_counts_.capped += sums[slot + kLightCut];
    ray_counts_.rays += sums[slot + kLightRays];
  }
  steps_in_books_ = 0;
  in_flight_.reset();
}

void Stepper::run_step(std::uint32_t step, const step::Irradiance* irradiance) {
  version_ = new_version();
  if (moment_ > kLastMoment) forget_moments();
  const step::Cadence cadence = count_substeps();
  if (parameters_.heat.enabled && upload_irradiance(step, irradiance)) awake_.all = true;
  source(step);
  list_awake();
  if (parameters_.open_border)
    device_->run(Kernel::border, groups_,
                 {constants_.get(), flags_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(),
                  moments_.get(), books_.get(), full_.get(), counts_.get(), next_moment()});
  if (parameters_.heat.enabled) {
    heat(step, irradiance != nullptr || own_light_);
    melt();
    if (audits_) audit_heat();
  }
  if (is_paper(parameters_)) {
    gravity(step);
    if (audits_) audit_gravity();
    list_givers();
    spread(step);
    if (audits_) audit_spread();
  } else {
    for (int k = 0; k < cadence.substeps; ++k) {
      settle(step, k, cadence);
      list_pairs(cadence);
      if (cadence.stages > 1) relax(cadence.stages);
      spread_runs(step, k, cadence);
      if (audits_) audit_spread();
    }
    list_falls();
    gravity(step);
    if (audits_) audit_gravity();
  }
  // A slot of the books grows by less than 2^32 per cell and rule, of which there are some 16 in a step.
  // The counters of the limits are those of all columns, of less than 2^16 per cell, in every sub-step.
  const std::int64_t cells = 1 + shape_.cells / groups_;
  const std::int64_t most = std::min((std::int64_t{1} << 26) / (cells * cadence.substeps),
                                     (std::int64_t{1} << 46) / (shape_.cells * cadence.substeps));
  if (++steps_in_books_ >= std::max<std::int64_t>(1, most)) collect_books();
  device_->flush();
}

// Lists the bricks that hold matter, and the columns.
void Stepper::list_bricks() {
  counts_.swap(other_counts_);
  device_->run(
      Kernel::list_bricks, groups_,
      {constants_.get(), moments_.get(), full_.get(), columns_.get(), counts_.get(), other_counts_.get()});
}

void Stepper::source(std::uint32_t step) {
  const auto groups_for = [&](const RegionBox& box) {
    const std::int64_t cells = std::int64_t{box.size[0]} * box.size[1] * box.size[2];
    return as_int(std::min<std::int64_t>(groups_, (cells + 127) / 128));
  };
  for (const rule::Vent& vent : parameters_.vents) {
    const RegionBox box = box_of(vent.region, shape_.grid);
    if (box.empty() || !rule::is_open(vent.from, vent.until, step)) continue;
    const rule::Position& at = vent.region.at;
    device_->run(Kernel::vent, groups_for(box),
                 {constants_.get(),
                  flags_.get(),
                  amount_.now.get(),
                  energy_.now.get(),
                  heat_.now.get(),
                  moments_.get(),
                  books_.get(),
                  box.from[0],
                  box.from[1],
                  box.from[2],
                  box.size[0],
                  box.size[1],
                  box.size[2],
                  as_int(at.x),
                  as_int(at.y),
                  as_int(at.z),
                  as_int(vent.region.radius),
                  std::int32_t{vent.rate},
                  std::int32_t{vent.temperature},
                  std::int32_t{vent.energy},
                  rule::dither(step),
                  next_moment()});
  }
  for (const rule::Drain& drain : parameters_.drains) {
    const RegionBox box = box_of(drain.region, shape_.grid);
    if (box.empty() || !rule::is_open(drain.from, drain.until, step)) continue;
    const rule::Position& at = drain.region.at;
    device_->run(Kernel::drain, groups_for(box),
                 {constants_.get(), flags_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(),
                  moments_.get(), books_.get(), box.from[0], box.from[1], box.from[2], box.size[0],
                  box.size[1], box.size[2], as_int(at.x), as_int(at.y), as_int(at.z),
                  as_int(drain.region.radius), std::int32_t{drain.rate}, next_moment()});
  }
}

// The heats go from one memory to the other, pass by pass. In the end they are where they were: what no
// kernel visits is right there alone.
void Stepper::heat(std::uint32_t step, bool radiates) {
  const rule::Heat& heat = parameters_.heat;
  const Memory *from = heat_.now.get(), *to = heat_.next.get();
  const auto conduct = [&](int axes, std::int32_t weight) {
    device_->run(
        Kernel::conduct, groups_,
        {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), from, to, books_.get(),
         full_.get(), counts_.get(), moments_.get(), axes, weight, rule::dither(step), next_moment()});
    std::swap(from, to);
  };
  conduct(3, heat.weight_face);
  if (heat.neighbours >= 18) conduct(6, heat.weight_edge);
  if (heat.neighbours >= 26) conduct(4, heat.weight_corner);

  const bool back = from == heat_.next.get(), alone = heat.convection == 0;
  if (!back && alone) to = from;  // each cell by itself, in place
  if (back || !alone || radiates || heat.air)
    device_->run(Kernel::exchange, groups_,
                 {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), from, to,
                  irradiance_.get(), books_.get(), full_.get(), counts_.get(), moments_.get(),
                  radiates ? 1 : 0, rule::dither(step), next_moment()});
  if (!back && !alone)
    device_->run(Kernel::copy_heat, groups_, {constants_.get(), to, from, full_.get(), counts_.get()});
}

void Stepper::melt() {
  if (parameters_.freezes())
    device_->run(Kernel::find_cold, groups_,
                 {constants_.get(), flags_.get(), amount_.now.get(), heat_.now.get(), transient_.get(),
                  full_.get(), counts_.get(), moments_.get(), next_moment()});
  device_->run(
      Kernel::melt, groups_,
      {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(),
       transient_.get(), books_.get(), full_.get(), counts_.get(), moments_.get(), next_moment()});
}

void Stepper::gravity(std::uint32_t step) {
  device_->run(Kernel::gravity, groups_,
               {constants_.get(), flags_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(),
                transient_.get(), run_.get(), books_.get(), moments_.get(), columns_.get(), counts_.get(),
                rule::dither(step), falls_from_, next_moment()});
}

void Stepper::spread(std::uint32_t step) {
  device_->run(Kernel::find_patterns, groups_,
               {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), energy_.now.get(),
                heat_.now.get(), transient_.get(), pattern_.get(), moments_.get(), near_.get(), giving_.get(),
                counts_.get(), as_int(step), next_moment()});
  device_->run(
      Kernel::apply_patterns, groups_,
      {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(),
       amount_.next.get(), energy_.next.get(), heat_.next.get(), pattern_.get(), moments_.get(), books_.get(),
       giving_.get(), counts_.get(), rule::dither(step), next_moment()});
  take_over();
}

// Brings what spread has written back to where the state is.
void Stepper::take_over() {
  device_->run(Kernel::take_over, groups_,
               {constants_.get(), amount_.now.get(), energy_.now.get(), heat_.now.get(), amount_.next.get(),
                energy_.next.get(), heat_.next.get(), giving_.get(), counts_.get()});
}

step::Cadence Stepper::count_substeps() {
  const rule::ViscousLaw& law = parameters_.flow.viscous;
  if (!may_count(parameters_)) return {is_paper(parameters_) ? 1 : law.substeps};
  const std::int32_t one = 1;
  std::int32_t most = 0;
  list_bricks();
  device_->write(*most_, &one, sizeof one);
  device_->run(Kernel::count_substeps, groups_,
               {constants_.get(), flags_.get(), amount_.now.get(), heat_.now.get(), moments_.get(),
                columns_.get(), counts_.get(), most_.get()});
  device_->read(*most_, &most, sizeof most);
  const int substeps = law.counts_substeps() ? std::min<int>(most, law.substeps_max) : law.substeps;
  return {substeps, rule::stages_for((std::int64_t{most} + substeps - 1) / substeps, law.stages_max)};
}

void Stepper::settle(std::uint32_t step, int substep, step::Cadence cadence) {
  const rule::Relaxation how{cadence.stages};
  const std::int32_t dither =
      (rule::dither(step) + rule::dither(static_cast<std::uint32_t>(substep))) & 0xFFFF;
  const std::int32_t since = columns_listing_.since;
  list_columns(cadence);
  device_->run(Kernel::settle, groups_,
               {constants_.get(),
                tables_.get(),
                flags_.get(),
                amount_.now.get(),
                heat_.now.get(),
                amount_.next.get(),
                run_.get(),
                records_.get(),
                limits_.get(),
                standing_.get(),
                books_.get(),
                moments_.get(),
                columns_.get(),
                counts_.get(),
                cadence.substeps,
                how.reach(),
                how.bits(),
                dither,
                since,
                next_moment()});
}

void Stepper::relax(int stages) {
  device_->run(Kernel::begin_relaxing, groups_,
               {constants_.get(), tables_.get(), flags_.get(), amount_.now.get(), heat_.now.get(),
                transient_.get(), run_.get(), records_.get(), leveling_.get(), heads_.now.get(),
                impetus_.get(), change_.get(), full_.get(), counts_.get(), stages});
  for (int stage = 1; stage < stages; ++stage) {
    device_->run(
        Kernel::relax, groups_,
        {constants_.get(), run_.get(), records_.get(), leveling_.get(), heads_.now.get(), heads_.next.get(),
         impetus_.get(), change_.get(), full_.get(), counts_.get(), stages, stage});
    heads_.swap();
  }
}

void Stepper::spread_runs(std::uint32_t step, int substep, step::Cadence cadence) {
  const std::int32_t dither =
      (rule::dither(step) + rule::dither(static_cast<std::uint32_t>(substep))) & 0xFFFF;
  device_->run(Kernel::spread_runs, groups_, {constants_.get(),  tables_.get(),    flags_.get(),
                                              amount_.now.get(), heat_.now.get(),  amount_.next.get(),
                                              heat_.next.get(),  transient_.get(), run_.get(),
                                              records_.get(),    heads_.now.get(), moments_.get(),
                                              books_.get(),      near_.get(),      giving_.get(),
                                              counts_.get(),     as_int(step),     substep,
                                              cadence.substeps,  cadence.stages,   dither,
                                              next_moment()});
  take_over();
}

}  // namespace voxmelt::gpu
