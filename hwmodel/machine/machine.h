// One machine, whole: the pipeline computes steps, the host sends what changed, the ray caster draws, and all
// lie on one memory. Both machines run in one simulation, each in lock-step with the software: the pipeline
// computes the next steps while the ray caster draws the present state. Beside it each repeats its work alone
// on a memory of its own: this tells what they cost each other, and what they would take in turn.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/pipeline/check/verify.h"
#include "hwmodel/pipeline/time/stream_work.h"

namespace voxmelt::hwmodel {

struct MachineInput {
  const rule::Parameters& parameters;
  std::uint32_t first_step;
  const step::Implementation& fast;
  step::Tuning tuning;
  raycast::PictureInput picture;  // of the state before the first step
};
struct MachineOptions {
  VerifyOptions steps;              // their number is a multiple of the frames
  raycast::PictureOptions picture;  // with the memory of both machines, and the clock
  int clock_mhz() const { return picture.configuration.clock_mhz; }
};

// From one picture to the next, in cycles.
struct Period {
  std::uint32_t step = 0;  // that it ends with
  StreamWork work;
  std::int64_t stream =
      0;  // of the pipeline, on the memory alone; `work` has those on one that always answers
  raycast::UploadReport upload;
  std::int64_t frame = 0;  // of the ray caster, on the memory alone: the state that these steps gave
  std::int64_t frame_read = 0, frame_written = 0, frame_bus = 0;
  std::int64_t together = 0;                         // of both: these steps, and the picture before them
  std::int64_t stream_beside = 0, frame_beside = 0;  // how long each of them took then
  double host_seconds = 0;                           // field, light and comparing lines, by this processor

  std::int64_t in_turn() const { return stream + upload.cycles + frame; }
  std::int64_t overlapped() const { return together + upload.cycles; }
};

struct MachineReport {
  VerifyReport steps;
  raycast::PictureReport pictures;     // that were drawn while the pipeline worked, and the last one
  raycast::UploadReport first_upload;  // of everything
  std::int64_t first_frame = 0;        // its cycles, alone: caches are cold
  std::vector<Period> periods;
  std::int64_t cells = 0;                              // of the grid
  std::int64_t state_bytes = 0, irradiance_bytes = 0;  // in memory, beside what the ray caster has there

  bool good() const { return steps.mismatch == nullptr && pictures.good(); }
  Period sum() const;  // of all periods
};

MachineReport verify_machine(const MachineInput& input, const MachineOptions& options);

}  // namespace voxmelt::hwmodel
