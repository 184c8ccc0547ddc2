// Writes the pipeline of a design in SystemVerilog: the stages of hwmodel/rtl with the numbers of the scene,
// and channels between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/configuration.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// Returns why there is no such text, or "" if there is one.
std::string unwritten(const Design& design, const Configuration& configuration);

// Returns the module `pipeline`. It wants the file air.hex if the scene has air.
std::string pipeline_text(const Design& design, const Configuration& configuration);

// Describes a stream beside the cells: its name in `pipeline`, its file of vectors, and the bits of its
// words.
struct SideStream {
  std::string name, file;
  int width = 0;
};
std::vector<SideStream> side_streams(const Design& design, const Configuration& configuration);

// Returns the module `axi_pipeline`, which puts the pipeline behind AXI4-Stream.
std::string axi_text(const Design& design, const Configuration& configuration);

// Returns the bits of an AXI4-Stream's data: those of the words, filled up to bytes.
int axi_bits(int width);

// Returns a test bench that streams `passes` passes through the pipeline, from the files in.hex, out.hex and,
// if the design has feeds, feed_T.hex of each time step T and falls.hex. Its first time step is `first_step`.
// With VOXMELT_AXI it streams them through `axi_pipeline`.
std::string bench_text(const Design& design, const Configuration& configuration, std::int64_t passes,
                       std::uint32_t first_step);

// Returns the bits of a cell in in.hex and out.hex.
int stored_bits(const Design& design);
// Returns the words of air.hex.
std::vector<std::uint16_t> air_words(const Design& design);

}  // namespace voxmelt::hwmodel
