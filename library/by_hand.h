// A hand changes a run between two steps, in the units of a user. The errors are those of the public face.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "voxmelt/sources.h"

namespace voxmelt::library {

// The functions are those of voxmelt::Simulation.
class ByHand {
 public:
  // The scene's cells have moved into the simulation. Its parameters and settings stay the present ones.
  ByHand(scene::Scene& scene, run::Simulation& simulation) : scene_(scene), simulation_(simulation) {}

  std::uint32_t steps_done() const { return simulation_.steps_done(); }
  std::uint32_t step_number() const { return simulation_.step_number(); }
  std::vector<HeatSource> heat_sources() const;
  std::vector<Vent> vents() const;
  std::vector<Drain> drains() const;
  std::map<std::string, double> numbers() const;
  void set(const std::string& key, double value);
  void set_heat_sources(const std::vector<HeatSource>& sources);
  void set_vents(const std::vector<Vent>& vents);
  void set_drains(const std::vector<Drain>& drains);
  void pour(const Position& at, double radius, double temperature);
  void carve(const Position& at, double radius);

  // Returns the settings of the scene (TOML), with the present sources, vents and drains.
  std::string settings() const;

 private:
  template <class Change>
  void change_sources(const Change& change);

  scene::Scene& scene_;
  run::Simulation& simulation_;
  bool sources_changed_ = false;  // they differ from those in the scene's settings
};

}  // namespace voxmelt::library
