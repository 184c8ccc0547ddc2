#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/fields.h"
#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/change.h"
#include "kernel/scene/timeline.h"
#include "library/ledgers.h"
#include "library/parts.h"
#include "library/translate.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt {
namespace {

using library::translated;

const io::Format& find_format(const std::string& name) {
  if (const io::Format* found = io::find_format(name)) return *found;
  std::string known;
  for (const io::Format& one : io::formats()) known += (known.empty() ? "" : ", ") + std::string(one.name);
  throw InputError("export_state: error: format = \"" + name + "\" is not one of " + known);
}

template <class Number>
NumberView<Number> view_of(const state::Field<Number>& field, Grid grid) {
  return {field.data(), grid, field.layout().row(), field.layout().slice()};
}
MaskView view_of(const state::BitPlane& plane, Grid grid) { return {plane.data(), grid}; }

std::vector<NamedField> fields_of(const state::Volume& volume, Grid grid) {
  std::vector<NamedField> fields;
  state::for_each_field([&](const auto& row) {
    const auto& column = volume.*row.column;
    if (!column.empty()) fields.push_back({row.name, row.unit, view_of(column, grid)});
  });
  return fields;
}

}  // namespace

std::string version() { return VOXMELT_VERSION; }

namespace {

std::vector<Implementation> all_of(const step::Registry& registry) {
  std::vector<Implementation> all;
  for (const step::Implementation& one : registry.all())
    all.push_back({one.name, one.description, one.supported});
  return all;
}

}  // namespace

std::vector<Implementation> implementations() { return all_of(run::implementations()); }
std::vector<Implementation> devices() { return all_of(run::devices()); }

std::vector<Format> formats() {
  std::vector<Format> all;
  for (const io::Format& one : io::formats())
    all.push_back({std::string(one.name), std::string(one.description)});
  return all;
}

std::vector<std::string> changeable_keys() { return scene::changeable_keys(); }

std::string with_changes(const std::string& scene_text, const std::vector<SceneChange>& more) {
  std::vector<scene::Change> changes;
  changes.reserve(more.size());
  for (const SceneChange& one : more) changes.push_back({one.steps_done, one.what});
  return translated([&] { return scene::with_timeline(scene_text, changes); });
}

Simulation::Simulation(const std::filesystem::path& scene, const Options& options)
    : parts_(translated([&] { return std::make_unique<Parts>(scene, options); })) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

const std::string& Simulation::title() const { return parts_->scene().title; }
const std::vector<std::string>& Simulation::warnings() const { return parts_->scene().warnings; }
std::uint32_t Simulation::scene_steps() const { return parts_->scene().steps; }
const std::string& Simulation::implementation() const { return parts_->implementation.name; }
int Simulation::threads() const { return parts_->simulation.threads(); }
std::uint32_t Simulation::steps_done() const { return parts_->simulation.steps_done(); }
std::uint32_t Simulation::step_number() const { return parts_->simulation.step_number(); }

std::uint32_t Simulation::step(std::uint32_t count, const std::stop_token& stop, const Progress& progress) {
  constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  if (count > last - step_number())
    throw InputError("step: error: count = " + std::to_string(count) + " exceeds " +
                     std::to_string(last - step_number()) + ": step numbers end at " + std::to_string(last));
  std::uint32_t done = 0;
  while (done < count && !stop.stop_requested()) {
    translated([&] { parts_->step(); });
    ++done;
    if (progress) progress(done, count);
  }
  return done;
}

void Simulation::restart() {
  translated([&] { parts_->restart(); });
}

const std::string& Simulation::scene_text() const { return parts_->scene().text; }

Grid Simulation::grid() const {
  const state::Grid g = parts_->simulation.volume().grid;
  return {g.x, g.y, g.z};
}

State Simulation::state() const {
  const state::Volume& v = parts_->simulation.volume();
  const Grid g = grid();
  return {g,
          view_of(v.solid, g),
          view_of(v.liquid, g),
          view_of(v.inert, g),
          view_of(v.amount, g),
          view_of(v.energy, g),
          view_of(v.heat, g),
          fields_of(v, g)};
}

std::int64_t Simulation::loose_cells() const { return parts_->simulation.loose_cells(); }
std::uint64_t Simulation::digest() const { return state::digest(parts_->simulation.volume()); }

Ledgers Simulation::ledgers() const {
  return library::to_ledgers(parts_->simulation.ledger(), state::holdings(parts_->simulation.volume()));
}

Changes Simulation::changes(std::uint64_t version) { return parts_->changes(version); }

std::map<std::string, double> Simulation::numbers() const { return parts_->by_hand.numbers(); }

void Simulation::set(const std::string& key, double value) { parts_->by_hand.set(key, value); }

std::vector<HeatSource> Simulation::heat_sources() const { return parts_->by_hand.heat_sources(); }
std::vector<Vent> Simulation::vents() const { return parts_->by_hand.vents(); }
std::vector<Drain> Simulation::drains() const { return parts_->by_hand.drains(); }

void Simulation::set_heat_sources(const std::vector<HeatSource>& sources) {
  parts_->by_hand.set_heat_sources(sources);
}
void Simulation::set_vents(const std::vector<Vent>& vents) { parts_->by_hand.set_vents(vents); }
void Simulation::set_drains(const std::vector<Drain>& drains) { parts_->by_hand.set_drains(drains); }

void Simulation::pour(const Position& at, double radius, double temperature) {
  parts_->by_hand.pour(at, radius, temperature);
}
void Simulation::carve(const Position& at, double radius) { parts_->by_hand.carve(at, radius); }

void Simulation::export_state(const std::filesystem::path& folder, const std::string& format) const {
  const io::Format& chosen = find_format(format);
  translated([&] {
    const run::Simulation& simulation = parts_->simulation;
    io::OutputFolder out(folder);
    io::Moment moment(simulation.volume());
    moment.ledger = &simulation.ledger();
    moment.step = simulation.steps_done();
    moment.parameters = &simulation.parameters();
    moment.version = version();
    moment.scene = parts_->scene().name;
    chosen.write(moment, out.partial(), {});
    io::write_file(
        out.partial() / "parameters.json",
        io::parameters_json(simulation.parameters(), simulation.volume().grid, simulation.step_number()));
    out.commit();
  });
}

void Simulation::save(const std::filesystem::path& file) const {
  translated([&] { parts_->save(file); });
}

}  // namespace voxmelt
