// Lock-step: the ray caster beside the software's reference, compared behind every stage, and its bytes with
// those of the software's packets.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/caster_faults/faults.h"
#include "hwmodel/picture/checker.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/image/image.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::hwmodel::raycast {

// All that is drawn.
struct PictureInput {
  const state::Volume& volume;
  const scene::Look& look;
  const scene::Light& light;
  const scene::Terrain& terrain;
  const scene::Camera& camera;
  render::Setting setting;
};

// A pass of a frame.
struct PassCycles {
  bool second = false;
  std::int64_t cycles = 0, predicted = -1;  // -1: it stalled at random
  double error() const {                    // of the prediction, in parts of the cycles
    return static_cast<double>(predicted - cycles) / static_cast<double>(cycles);
  }
};

struct PictureOptions {
  Configuration configuration;
  Fault fault = Fault::none;
  bool compare = true;  // behind every stage; the bytes are always compared
  bool predict = true;  // forecast the cycles of each pass
  int frames = 1;       // the same one again and again: later ones find the caches warm
  std::function<void()> poll;
};

struct StageAccount {
  std::string name;
  Account account;
};
struct CacheAccount {
  std::string name;
  CacheCounts counts;
  int line_bytes = 0;
};

struct PictureReport {
  std::optional<Difference> difference;
  std::string hang;                               // what is full and what is empty, if nothing moved any more
  std::vector<std::string> waiting;               // then: stages that wait for the memory
  std::optional<FaultPlan::Strike> strike;        // of the planted fault
  std::int64_t different_bytes = 0;               // of the pictures
  std::int64_t compared = 0;                      // numbers
  FrameEnd end;                                   // of the last frame
  double seconds = 0;                             // of the simulation, comparing included
  std::int64_t rays = 0, samples = 0, leaps = 0;  // of the walk
  std::int64_t sampled = 0;                       // by the sampler, those of crossings, too
  MemoryCounts memory;
  std::vector<StageAccount> stages;  // all pipes together
  std::vector<CacheAccount> caches;
  std::int64_t memory_bytes = 0;
  std::int64_t all_cycles = 0;  // of all frames
  std::vector<PassCycles> passes;
  render::Image image;
  // At the stage, pixel and sample that the fault left wrong; what got lost there is found as a hang.
  bool found_where_planted() const;
  bool good() const { return !difference && hang.empty() && different_bytes == 0 && end.complete; }
};

PictureReport verify_picture(const PictureInput& input, const PictureOptions& options);

}  // namespace voxmelt::hwmodel::raycast
