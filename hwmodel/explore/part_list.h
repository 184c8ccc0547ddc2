// A part list tells what one time step of the cascade is made of, for a number of lanes. It has the memories
// of the stages' circuits and the units that the model reports, and their cost in the parts of a family.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/explore/content.h"
#include "hwmodel/explore/device.h"
#include "hwmodel/explore/mapping.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel::explore {

struct StagePart {
  StageKind kind = StageKind::reader;
  std::int64_t lag = 0;
  int output_bits = 0;                    // bits of a lane
  std::vector<BufferCost> buffers;        // of its circuit
  std::vector<BufferCost> model_buffers;  // those whose accesses the simulation counts
  Units units;
  double token_energy = 0;  // picojoules of its operations
};

struct PartList {
  Design design;
  std::vector<StagePart> stages;
  bool fed = false;         // takes irradiance
  bool falls = false;       // has pieces that fall: the first time step takes their bits
  double coder_energy = 0;  // picojoules of a token in reader and writer, with hw.coded
  std::shared_ptr<const Content> content = std::make_shared<Content>();  // contents of the first state

  // These count the parts of a family for one time step, without its channels and ports.
  std::int64_t dsp = 0;
  std::int64_t register_bits = 0;   // buffers of a few words are flip-flops
  std::vector<MemoryUse> memories;  // ways to hold the other ones
};

// Counts the LUTs and flip-flops of one time step, without its memories, channels and ports. Families may
// differ in what their logic takes.
struct Logic {
  std::int64_t lut = 0, ff = 0;
};
Logic logic_of(const PartList& parts, const Family& family);

PartList part_list(const Design& design, const Family& family);

// Counts the DSPs of a product of two signed numbers.
std::int64_t dsps_of(const Widths& product, const Widths& dsp);

}  // namespace voxmelt::hwmodel::explore
