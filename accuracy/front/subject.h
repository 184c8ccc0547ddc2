// A subject is a scene of the front. On another grid or with another step its keys change so that the same
// bodies melt in the same time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accuracy/formats/twin.h"
#include "accuracy/front/curves.h"

namespace voxmelt::accuracy::front {

// A setting makes one choice on every axis of the sweep. As it stands here it is what a scene has whose file
// says nothing, on the grid of that file.
struct Setting {
  double grid = 1;  // cells per cell of the scene's file
  double step = 1;  // length of a step, in 1 / grid steps of the scene's file
  int neighbours = 6;
  int rays = 1;           // per face
  int interval = 1;       // steps from one visibility to the next
  int substeps_max = 64;  // viscous law: sub-steps of a step, at most
  int stages_max = 1;     // viscous law: stages in which heads relax, at most
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
  // 1. In a longer one they stay: a cell cannot give more than it has. Pieces
  // hang, since they fall a cell in a step, however long a cell and a step are.
  std::vector<std::string> sets(const Setting& setting) const;
  // Tells if `heat.gamma` stays within its range, which ends a long step.
  bool allows(const Setting& setting) const;
  Scale scale(const Setting& setting) const;
  std::uint32_t steps_to(const Setting& setting, std::uint32_t sample_index) const;  // counts from 1
};

// Lists cello, goblet, lava and bunny, and the same by the viscous law.
const std::vector<Subject>& all_subjects();

}  // namespace voxmelt::accuracy::front
