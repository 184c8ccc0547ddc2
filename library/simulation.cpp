#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/fields.h"
#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/simulation.h"
#include "kernel/run/trial/fastest.h"
#include "kernel/scene/scene.h"
#include "library/ledgers.h"
#include "library/sources.h"
#include "library/translate.h"
#include "render/image/png.h"
#include "render/packet/picture.h"
#include "voxmelt/voxmelt.h"

namespace voxmelt {
namespace {

using library::translated;

constexpr int kMostThreads = 1024;

const step::Implementation& find_implementation(const std::string& name) {
  try {
    return *run::chosen(name).implementation;
  } catch (const std::invalid_argument& error) {
    throw InputError("Options: error: implementation = \"" + name + "\": " + error.what());
  }
}

const io::Format& find_format(const std::string& name) {
  if (const io::Format* found = io::find_format(name)) return *found;
  std::string known;
  for (const io::Format& one : io::formats()) known += (known.empty() ? "" : ", ") + std::string(one.name);
  throw InputError("export_state: error: format = \"" + name + "\" is not one of " + known);
}

int checked_threads(int threads) {
  if (threads < 0 || threads > kMostThreads)
    throw InputError("Options: error: threads = " + std::to_string(threads) + " is outside 0.." +
                     std::to_string(kMostThreads));
  return threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

template <class Number>
Number checked(const char* name, Number value, Number lowest, Number highest) {
  if (value >= lowest && value <= highest) return value;  // false for a NaN
  throw InputError("Picture: error: " + std::string(name) + " = " + std::to_string(value) + " is outside " +
                   std::to_string(lowest) + ".." + std::to_string(highest));
}

render::Setting setting_of(Quality quality) {
  switch (quality) {
    case Quality::fast:
      return render::Setting::fast;
    case Quality::best:
      return render::Setting::best;
    default:
      return render::Setting::normal;
  }
}

scene::Camera camera_of(scene::Camera camera, const Picture& picture) {
  if (picture.width) camera.width = checked("width", *picture.width, 16, 8192);
  if (picture.height) camera.height = checked("height", *picture.height, 16, 8192);
  if (picture.azimuth) camera.azimuth = checked("azimuth", *picture.azimuth, -360.0, 360.0);
  if (picture.elevation) camera.elevation = checked("elevation", *picture.elevation, -89.0, 89.0);
  return camera;
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

std::vector<Implementation> implementations() {
  std::vector<Implementation> all;
  for (const step::Implementation& one : run::implementations().all())
    all.push_back({one.name, one.description, one.supported});
  return all;
}

std::vector<Format> formats() {
  std::vector<Format> all;
  for (const io::Format& one : io::formats())
    all.push_back({std::string(one.name), std::string(one.description)});
  return all;
}

class Simulation::Parts {
 public:
  Parts(const std::filesystem::path& file, const Options& options)
      : implementation(find_implementation(options.implementation)),
        threads(checked_threads(options.threads)),
        scene(scene::load(file, options.overrides)),
        simulation(scene.parameters, std::move(scene.initial), implementation, {.threads = threads}) {
    simulation.begin_at(scene.first_step);
  }

  // Replaces one kind of source; the others stay.
  template <class Change>
  void change_sources(const Change& change) {
    const rule::Parameters& now = simulation.parameters();
    run::Simulation::Sources sources{now.heat.sources, now.vents, now.drains};
    change(sources);
    simulation.change_sources(std::move(sources));
  }

  const step::Implementation& implementation;
  int threads;
  scene::Scene scene;  // its initial state has moved into the simulation
  run::Simulation simulation;
  render::Picture picture;  // the last one: the next one updates what has changed
};

Simulation::Simulation(const std::filesystem::path& scene, const Options& options)
    : parts_(translated([&] { return std::make_unique<Parts>(scene, options); })) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

const std::string& Simulation::title() const { return parts_->scene.title; }
const std::vector<std::string>& Simulation::warnings() const { return parts_->scene.warnings; }
std::uint32_t Simulation::scene_steps() const { return parts_->scene.steps; }
const std::string& Simulation::implementation() const { return parts_->implementation.name; }
int Simulation::threads() const { return parts_->simulation.threads(); }
std::uint32_t Simulation::steps_done() const { return parts_->simulation.steps_done(); }
std::uint32_t Simulation::step_number() const { return parts_->simulation.step_number(); }

void Simulation::step(std::uint32_t count) {
  constexpr std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  if (count > last - step_number())
    throw InputError("step: error: count = " + std::to_string(count) + " exceeds " +
                     std::to_string(last - step_number()) + ": step numbers end at " + std::to_string(last));
  translated([&] {
    for (std::uint32_t i = 0; i < count; ++i) parts_->simulation.step();
  });
}

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

std::uint64_t Simulation::digest() const { return state::digest(parts_->simulation.volume()); }

Ledgers Simulation::ledgers() const {
  return library::to_ledgers(parts_->simulation.ledger(), state::holdings(parts_->simulation.volume()));
}

std::vector<HeatSource> Simulation::heat_sources() const {
  std::vector<HeatSource> result;
  for (const auto& one : parts_->simulation.parameters().heat.sources)
    result.push_back(library::from_rule(one));
  return result;
}

std::vector<Vent> Simulation::vents() const {
  std::vector<Vent> result;
  for (const auto& one : parts_->simulation.parameters().vents) result.push_back(library::from_rule(one));
  return result;
}

std::vector<Drain> Simulation::drains() const {
  std::vector<Drain> result;
  for (const auto& one : parts_->simulation.parameters().drains) result.push_back(library::from_rule(one));
  return result;
}

void Simulation::set_heat_sources(const std::vector<HeatSource>& sources) {
  if (!sources.empty() && !parts_->simulation.parameters().heat.enabled)
    throw InputError("set_heat_sources: error: the scene has no [heat]: without it nothing is heated");
  translated([&] { parts_->change_sources([&](auto& all) { all.heat = library::to_rules(sources); }); });
}

void Simulation::set_vents(const std::vector<Vent>& vents) {
  translated([&] { parts_->change_sources([&](auto& all) { all.vents = library::to_rules(vents); }); });
}

void Simulation::set_drains(const std::vector<Drain>& drains) {
  translated([&] { parts_->change_sources([&](auto& all) { all.drains = library::to_rules(drains); }); });
}

void Simulation::export_state(const std::filesystem::path& folder, const std::string& format) const {
  const io::Format& chosen = find_format(format);
  translated([&] {
    const run::Simulation& simulation = parts_->simulation;
    io::OutputFolder out(folder);
    chosen.write(simulation.volume(), out.partial(), {});
    io::write_file(
        out.partial() / "parameters.json",
        io::parameters_json(simulation.parameters(), simulation.volume().grid, simulation.step_number()));
    out.commit();
  });
}

void Simulation::draw(const std::filesystem::path& file, const Picture& picture) {
  const scene::Scene& scene = parts_->scene;
  const scene::Camera camera = camera_of(scene.camera, picture);
  translated([&] {
    parts_->picture.update(parts_->simulation.volume(), scene.look, scene.light, scene.terrain,
                           parts_->threads);
    render::write_png(file, parts_->picture.draw(camera, setting_of(picture.quality), parts_->threads));
  });
}

}  // namespace voxmelt
