// The ray caster runs in lock-step. It draws one picture after the other, and each is checked behind every
// stage and by its bytes.
#pragma once

#include <cstdint>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/caster/check/checker.h"
#include "hwmodel/caster/check/expectation.h"
#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/caster/model/cost.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/check/waves.h"
#include "render/image/image.h"
#include "render/packet/draw_picture.h"
#include "render/reference/picture_scene.h"

namespace voxmelt::hwmodel::raycast {

// Counts the cycles of one pass of a frame.
struct PassCycles {
  bool second = false;
  std::int64_t cycles = 0;
};

struct PictureOptions {
  Configuration configuration;
  Fault fault = Fault::none;
  std::string fault_channel;  // channel for a fault of channels; empty for a usual one
  Window window;              // only these pixels are drawn and compared
  bool compare = true;        // compares behind every stage; the bytes are always compared
  int frames = 1;             // frames of the same picture: later ones find the caches warm
  std::function<void()> poll;
  bool waves = false;  // keeps the cycles around the first difference, or from `waves_from` on
  std::optional<std::int64_t> waves_from;
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
  std::string hang;                               // describes the hang, if nothing moved any more
  std::vector<std::string> waiting;               // at a hang: stages that wait for the memory
  std::vector<std::string> jammed;                // at a hang: channels that have room and take nothing
  std::optional<RayId> under_way;                 // at a hang: a ray that has not come to its end
  std::optional<FaultPlan::Strike> strike;        // place of the planted fault
  std::int64_t different_bytes = 0;               // pixels whose bytes differ
  std::optional<RayId> different;                 // first pixel among them
  std::int64_t compared = 0;                      // numbers; pixels, if no stage is compared
  FrameEnd end;                                   // end of the last frame
  double seconds = 0;                             // time of the simulation, comparing included
  std::int64_t rays = 0, samples = 0, leaps = 0;  // counts of the walk
  std::int64_t sampled = 0;                       // samples of the sampler, also those of crossings
  MemoryCounts memory;
  std::vector<StageAccount> stages;  // sums over all pipes
  std::vector<CacheAccount> caches;
  PipeCost cost;  // cost of one pipe; empty for clear matter, which is not counted yet
  std::int64_t memory_bytes = 0;
  std::int64_t all_cycles = 0;  // sum over all frames
  std::vector<PassCycles> passes;
  std::vector<UploadReport> uploads;  // before each frame, without their lists
  std::string waves;                  // VCD; empty if there are none
  render::Image image;
  // Says if the difference is at the stage, pixel and sample that the fault left wrong. A token that got lost
  // there is found as a hang.
  bool found_where_planted() const;
  bool good() const {
    return !difference && hang.empty() && different_bytes == 0 && end.complete && compared > 0;
  }
};

class PictureRun {
 public:
  // Registers and memory are the host's, who may change both between two pictures. `shares` tells what is
  // shared with other machines. Without it, the ray caster has a simulation and a memory of its own.
  PictureRun(const Registers& registers, Memory& memory, const PictureOptions& options,
             const std::optional<Shares>& shares = {});

  // Makes the caches forget the lines that were sent.
  void forget(const UploadReport& upload);
  // Draws what registers and memory say. `scene` and `camera` are the same for the software, and `expected`
  // is its picture.
  void draw(const render::PictureScene& scene, const picture::Camera& camera, render::Setting setting,
            const render::Image& expected);
  // These do the same in two parts. Between them other machines of the simulation may run, and the picture is
  // drawn meanwhile. The arguments of `begin` must live until `finish`, which draws the rest of the picture.
  void begin(const render::PictureScene& scene, const picture::Camera& camera, render::Setting setting,
             const render::Image& expected);
  void finish();

  // Says if all that was found so far is good. After a failure nothing more can be drawn.
  bool good() const { return report_.good(); }
  const FrameEnd& last() const { return report_.end; }
  MemoryCounts memory_counts() const { return caster_.memory_counts(); }
  PictureReport report();

 private:
  struct Drawing {
    Drawing(const render::PictureScene& scene, const picture::Camera& camera, render::Setting quality,
            const render::Image& by_software, const Registers& registers, RayCaster& caster)
        : setting(quality),
          expected(by_software),
          expectation(scene, camera, quality),
          checker(expectation, registers, caster, by_software.width, by_software.height) {}
    bool fast() const { return setting == render::Setting::fast; }
    int samples() const { return setting == render::Setting::normal ? 8 : 32; }  // in the second pass
    int most() const { return setting == render::Setting::best ? 8 : 16; }
    std::int64_t second_frame(const Memory& memory) const {
      return memory.frame + frame_bytes(expected.width, expected.height);
    }

    render::Setting setting;
    const render::Image& expected;
    Expectation expectation;
    Checker checker;
    bool second = false;  // the second pass has begun
  };
  void end_pass(const FrameEnd& end);
  void end_cycle();  // called in a run with waves

  const Registers& registers_;
  const Memory& memory_;
  PictureOptions options_;
  FaultPlan plan_;
  RayCaster caster_;
  std::optional<Waves> waves_;
  std::unique_ptr<Drawing> drawing_;
  std::clock_t begun_ = 0;
  PictureReport report_;
};

}  // namespace voxmelt::hwmodel::raycast
