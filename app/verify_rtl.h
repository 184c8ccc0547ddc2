// The option `voxmelt verify --rtl` lets stages in SystemVerilog stand in for their models.
#pragma once

#include <memory>
#include <string>

#include "app/verify_command.h"
#include "app/verify_sizes.h"
#include "hwmodel/check/channel_trace.h"

namespace voxmelt::app {

// Lets stages in SystemVerilog stand in for their models, and compares what becomes of that.
class RtlChoice {
 public:
  // Does nothing without --rtl. Throws UsageError if the stages that it asks for cannot be of this scene.
  RtlChoice(const VerifyCommand& command, const rule::Parameters& parameters, state::Grid grid,
            hwmodel::VerifyOptions& options);

  bool asked() const { return asked_; }

  // Runs the models again, or after a fault that was planted in them the circuits. After a difference, says
  // which of software, model and SystemVerilog stands alone. Otherwise compares both sides of every channel
  // in every cycle, unless there is a DRAM. Returns false if they differ.
  bool agrees_with_models(const VerifiedStream& stream, const step::Implementation& fast,
                          const step::Tuning& tuning, const hwmodel::VerifyOptions& options,
                          const hwmodel::VerifyReport& report, bool quiet) const;

 private:
  bool compare(const VerifiedStream& stream, const step::Implementation& fast, const step::Tuning& tuning,
               hwmodel::VerifyOptions options, const hwmodel::VerifyReport& report, std::string& said) const;

  // Says who stands alone after a difference in models that have a fault.
  std::string beside_a_fault(const VerifiedStream& stream, const step::Implementation& fast,
                             const step::Tuning& tuning, hwmodel::VerifyOptions options,
                             const hwmodel::Mismatch& mismatch) const;

  bool asked_;
  hwmodel::StageMaker circuits_;
  std::shared_ptr<hwmodel::ChannelTrace> trace_;
};

}  // namespace voxmelt::app
