// A world is what a journal changes. Its functions have the names and the meaning of those of
// voxmelt::Simulation, and throw the same errors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "voxmelt/sources.h"

namespace voxmelt::journal {

class World {
 public:
  virtual ~World() = default;
  virtual std::uint32_t steps_done() const = 0;
  virtual std::uint32_t step_number() const = 0;
  virtual std::vector<HeatSource> heat_sources() const = 0;
  virtual std::vector<Vent> vents() const = 0;
  virtual std::vector<Drain> drains() const = 0;
  virtual void set(const std::string& key, double value) = 0;
  virtual void set_heat_sources(const std::vector<HeatSource>& sources) = 0;
  virtual void set_vents(const std::vector<Vent>& vents) = 0;
  virtual void set_drains(const std::vector<Drain>& drains) = 0;
  virtual void pour(const Position& at, double radius, double temperature) = 0;
  virtual void carve(const Position& at, double radius) = 0;
};

// Is any class that has these functions, as a world.
template <class Simulation>
class WorldOf final : public World {
 public:
  explicit WorldOf(Simulation& simulation) : simulation_(simulation) {}
  std::uint32_t steps_done() const override { return simulation_.steps_done(); }
  std::uint32_t step_number() const override { return simulation_.step_number(); }
  std::vector<HeatSource> heat_sources() const override { return simulation_.heat_sources(); }
  std::vector<Vent> vents() const override { return simulation_.vents(); }
  std::vector<Drain> drains() const override { return simulation_.drains(); }
  void set(const std::string& key, double value) override { simulation_.set(key, value); }
  void set_heat_sources(const std::vector<HeatSource>& all) override { simulation_.set_heat_sources(all); }
  void set_vents(const std::vector<Vent>& all) override { simulation_.set_vents(all); }
  void set_drains(const std::vector<Drain>& all) override { simulation_.set_drains(all); }
  void pour(const Position& at, double radius, double temperature) override {
    simulation_.pour(at, radius, temperature);
  }
  void carve(const Position& at, double radius) override { simulation_.carve(at, radius); }

 private:
  Simulation& simulation_;
};

}  // namespace voxmelt::journal
