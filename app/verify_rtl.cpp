#include "app/verify_rtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/print.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/rtl/host/rtl_stage.h"

namespace voxmelt::app {
namespace {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Returns the names of the stages of a scene that are written in SystemVerilog.
std::vector<std::string> stages_in_rtl(const hwmodel::Design& design) {
  std::vector<std::string> names;
  for (const hwmodel::StageKind kind : hwmodel::stages_of_step(design)) {
    std::string name(name_of(kind));
    if (hwmodel::rtl_has(kind) && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  }
  return names;
}

// Returns what makes a pipeline with these stages, whose channels are watched.
std::function<std::unique_ptr<hwmodel::StreamMachine>()> watched(const rule::Parameters& parameters,
                                                                 state::Grid grid,
                                                                 const hwmodel::Configuration& configuration,
                                                                 hwmodel::StageMaker make,
                                                                 hwmodel::ChannelTrace* trace) {
  return [&parameters, grid, configuration, make = std::move(make), trace] {
    auto pipeline = std::make_unique<hwmodel::Pipeline>(parameters, grid, configuration, make);
    pipeline->probe(trace);
    return pipeline;
  };
}

}  // namespace

RtlChoice::RtlChoice(const VerifyCommand& command, const rule::Parameters& parameters, state::Grid grid,
                     hwmodel::VerifyOptions& options)
    : asked_(!command.rtl.empty()) {
  if (!asked_) return;
  const hwmodel::Design design = hwmodel::design_of(parameters, grid, options.configuration);
  std::vector<std::string> only;
  if (command.rtl != "all") only = split(command.rtl);
  const std::vector<std::string> there = stages_in_rtl(design);
  if (const std::string refusal = hwmodel::rtl_refusal(design, only); !refusal.empty())
    throw UsageError(fmt::format("error: --rtl: {}", refusal));
  for (const std::string& name : only)
    if (std::find(there.begin(), there.end(), name) == there.end())
      throw UsageError(
          fmt::format("error: --rtl {}: of the stages of this scene, these are written in "
                      "SystemVerilog: {}",
                      name, fmt::join(there, ", ")));
  circuits_ = hwmodel::rtl_stages(std::move(only));
  // A fault is planted in the models. So they are verified first, and the circuits after them.
  if (options.fault != hwmodel::Fault::none) return;
  options.make = circuits_;
  if (options.memory != nullptr || options.waves) return;
  trace_ = std::make_shared<hwmodel::ChannelTrace>();
  options.machine = watched(parameters, grid, options.configuration, options.make, trace_.get());
}

bool RtlChoice::agrees_with_models(const VerifiedStream& stream, const step::Implementation& fast,
                                   const step::Tuning& tuning, const hwmodel::VerifyOptions& options,
                                   const hwmodel::VerifyReport& report, bool quiet) const {
  if (!asked_) return true;
  std::string said;
  const bool agrees = compare(stream, fast, tuning, options, report, said);
  if (!quiet || !agrees) print("{}", said);
  return agrees;
}

bool RtlChoice::compare(const VerifiedStream& stream, const step::Implementation& fast,
                        const step::Tuning& tuning, hwmodel::VerifyOptions options,
                        const hwmodel::VerifyReport& report, std::string& said) const {
  using Kind = hwmodel::Mismatch::Kind;
  const hwmodel::Mismatch* mismatch = report.mismatch.get();
  if (mismatch != nullptr && mismatch->kind == Kind::software) {
    said = "the software stands alone\n";
    return true;
  }
  if (options.fault != hwmodel::Fault::none) {
    if (mismatch != nullptr) said = beside_a_fault(stream, fast, tuning, std::move(options), *mismatch);
    return true;
  }
  if (mismatch == nullptr && trace_ == nullptr) return true;
  options.make = {};
  options.waves = options.timeline = false;
  options.memory = nullptr;
  hwmodel::ChannelTrace models_trace;
  options.machine = watched(stream.parameters, stream.volume.grid, options.configuration, hwmodel::make_stage,
                            &models_trace);
  if (mismatch != nullptr) options.steps = mismatch->step - stream.first_step + 1;
  const hwmodel::VerifyReport models =
      hwmodel::verify(stream.parameters, stream.volume, stream.first_step, fast, tuning, options);
  if (models.mismatch != nullptr) {
    said = fmt::format("the model differs from the software, too: {}, step {}\n", models.mismatch->where,
                       models.mismatch->step);
    return false;
  }
  if (mismatch != nullptr) {
    said = fmt::format("the model agrees with the software: {} in SystemVerilog stands alone\n",
                       mismatch->where);
    return true;
  }
  if (const auto difference = trace_->difference(models_trace)) {
    said = fmt::format("SystemVerilog and models differ first in cycle {}, at channel {}\n",
                       difference->cycle, difference->channel);
    return false;
  }
  said = fmt::format("{} cycles beside the models: both sides of every channel did the same in each\n",
                     trace_->cycles());
  return true;
}

std::string RtlChoice::beside_a_fault(const VerifiedStream& stream, const step::Implementation& fast,
                                      const step::Tuning& tuning, hwmodel::VerifyOptions options,
                                      const hwmodel::Mismatch& mismatch) const {
  options.fault = hwmodel::Fault::none;
  options.make = circuits_;
  options.waves = options.timeline = false;
  options.memory = nullptr;
  options.steps = mismatch.step - stream.first_step + 1;
  const hwmodel::VerifyReport circuits =
      hwmodel::verify(stream.parameters, stream.volume, stream.first_step, fast, tuning, options);
  if (circuits.mismatch != nullptr)
    return fmt::format("SystemVerilog differs from the software, too: {}, step {}\n",
                       circuits.mismatch->where, circuits.mismatch->step);
  return fmt::format("SystemVerilog agrees with the software: the model of {} stands alone\n",
                     mismatch.where);
}

}  // namespace voxmelt::app
