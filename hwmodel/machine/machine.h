// The whole machine runs on one memory: the pipeline computes steps, the host sends what changed, and the ray
// caster draws. Both machines run in one simulation, each in lock-step with the software. The pipeline
// computes the next steps while the ray caster draws the present state. Each also repeats its work alone on a
// memory of its own. This tells what they cost each other, and what they would take in turn.
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
  raycast::PictureInput picture;  // state before the first step
};
struct MachineOptions {
  VerifyOptions steps;              // their number is a multiple of the frames
  raycast::PictureOptions picture;  // with the memory of both machines, and the clock
  int clock_mhz() const { return picture.configuration.clock_mhz; }
};

// A period goes from one picture to the next. Its times are in cycles.
struct Period {
  std::uint32_t step = 0;  // step that it ends with
  StreamWork work;
  // Counts the pipeline's cycles with the memory to itself. Those in `work` hold for a memory that always
  // answers.
  std::int64_t stream = 0;
  raycast::UploadReport upload;
  std::int64_t frame = 0;  // ray caster alone on the memory, for the state after these steps
  std::int64_t frame_read = 0, frame_written = 0, frame_bus = 0;
  std::int64_t together = 0;  // these steps beside the picture of the state before them
  std::int64_t stream_beside = 0, frame_beside = 0;  // time of each of the two meanwhile
  double host_seconds = 0;                           // field, light and comparing lines, on this processor

  std::int64_t in_turn() const { return stream + upload.cycles + frame; }
  std::int64_t overlapped() const { return together + upload.cycles; }
};

struct MachineReport {
  VerifyReport steps;
  raycast::PictureReport pictures;     // those drawn while the pipeline worked, and the last one
  raycast::UploadReport first_upload;  // everything is sent
  std::int64_t first_frame = 0;        // cycles, alone and with cold caches
  std::vector<Period> periods;
  std::int64_t cells = 0;                              // cells of the grid
  std::int64_t state_bytes = 0, irradiance_bytes = 0;  // in memory, without the ray caster's data

  bool good() const { return steps.mismatch == nullptr && pictures.good(); }
  Period sum() const;  // sum over all periods
};

MachineReport verify_machine(const MachineInput& input, const MachineOptions& options);

}  // namespace voxmelt::hwmodel
