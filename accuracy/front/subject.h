// A subject is a scene of the front. On another grid or with another step its keys change so that the same
// bodies melt in the same time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/formats/twin.h"
#include "accuracy/front/curves.h"

namespace voxmelt::accuracy::front {

// A setting makes one choice on every axis of the sweep.
struct Setting {
  double grid = 0.375;  // cells per cell of the scene's file
  double step = 1;      // length of a step, in 1 / grid steps of the scene's file
  int neighbours = 6;
  int rays = 1;          // per face
  int interval = 8;      // steps from one visibility to the next
  int substeps = 0;      // viscous law: sub-steps of a step; 0: as many as the state needs
  int substeps_max = 8;  // if `substeps` is 0: at most this many
  Arithmetic arithmetic = kEngine;
  friend bool operator==(const Setting&, const Setting&) = default;
};

struct Subject {
  std::string name;   // "cello"
  std::string scene;  // file in scenes/, without its suffix
  bool viscous = false;
  bool radiates = false;     // if so, rays and their interval matter
  std::uint32_t sample = 0;  // steps of the scene's file from one sample to the next, a multiple of 16
  std::uint32_t samples = 0;

  // Returns overrides of keys, as of --set. Per step and cell, conduction goes with dt / dx^2, exchange with
  // dt / dx, a vent's rate with dt, and kappa with dt dx. The power of a source goes with dt / dx^3 if its
  // distance is in cells. The parts that fall and spread in a step go with a step's length while it is below
  // 1. In a longer one they stay: a cell cannot give more than it has.
  std::vector<std::string> sets(const Setting& setting) const;
  Scale scale(const Setting& setting) const;
  std::uint32_t steps_to(const Setting& setting, std::uint32_t sample_index) const;  // counts from 1
};

// Lists cello, goblet, lava and bunny, and the same by the viscous law.
const std::vector<Subject>& all_subjects();

}  // namespace voxmelt::accuracy::front
