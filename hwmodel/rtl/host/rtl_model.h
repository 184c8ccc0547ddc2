// A stage in SystemVerilog, as Verilator compiles it.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "hwmodel/pipeline/model/stage_kind.h"

namespace voxmelt::hwmodel {

class RtlModel {
 public:
  struct Inputs {
    bool in_valid = false, out_ready = false, follows = false;
    std::uint32_t step = 0;
  };
  struct Outputs {
    bool in_ready, out_valid;
    bool holds;  // a serial divider works
  };

  virtual ~RtlModel() = default;
  RtlModel() = default;
  RtlModel(const RtlModel&) = delete;
  RtlModel& operator=(const RtlModel&) = delete;

  // Sets an input that holds one number. Returns false if the stage has no port of this name.
  virtual bool set(std::string_view port, std::uint64_t value) = 0;
  // Returns the words of a wide input, 32 bits each, the lowest first. Null: there is no such port.
  virtual std::uint32_t* wide(std::string_view port) = 0;
  virtual const std::uint32_t* out_cells() const = 0;
  // Returns the port that takes what cells in a run show. Null: the stage does not ask.
  virtual std::uint32_t* in_shows() = 0;
  // Return what cells in a run show, and which cells these are. Null: the stage tells no such thing.
  virtual const std::uint32_t* out_shows() const = 0;
  virtual std::uint64_t out_runs() const = 0;
  virtual Outputs settle(const Inputs& inputs) = 0;  // outputs follow inputs
  virtual void clock() = 0;                          // one rising edge
};

// Returns null where the stage is not there for so many lanes, or Verilator was not found. Registers
// without a reset hold random bits of this seed at first.
std::unique_ptr<RtlModel> make_rtl_model(StageKind kind, int lanes, int seed);
// Returns the numbers of lanes that stages are compiled for. Empty: this program was built without Verilator.
std::vector<int> rtl_lanes();
bool rtl_has(StageKind kind);

}  // namespace voxmelt::hwmodel
