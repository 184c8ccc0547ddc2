// A run of `voxmelt verify` is reported as JSON for --report, and for --html as the page that is drawn from
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/options.h"
#include "app/verify_energy.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/machine/machine.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"
#include "hwmodel/pipeline/check/verify.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

// Names the places of a report. If neither is given, nothing is written.
struct ReportPlaces {
  const Common& common;     // has --report
  const std::string& html;  // --html; empty for none
};

// Tells what a DRAM did in all trains of a pipeline.
struct DramAccount {
  hwmodel::memory::Parameters parameters;
  hwmodel::memory::Counts counts;
};
// A run that was verified, and what it took. There is no cost of a run that ended early.
struct Verified {
  const hwmodel::VerifyReport& report;
  const hwmodel::Design& design;
  const hwmodel::Configuration& configuration;
  int clock_mhz = 0;  // of the machine
  std::optional<DramAccount> dram{};
  std::optional<RunCost> cost{};
};
// Writes the report of a pipeline. `name` is the scene's.
void write_pipeline_report(const ReportPlaces& places, const std::string& name, const Verified& run);

struct Drawn {
  std::string scene;
  int width = 0, height = 0;
};
// Says how a difference is seen again: --pixel, and if it fails alone.
struct SeenAgain {
  std::string pixel;
  bool fails_alone = false;
};
void write_picture_report(const ReportPlaces& places, const Drawn& drawn, std::uint32_t step,
                          const hwmodel::raycast::PictureReport& report,
                          const hwmodel::raycast::Configuration& configuration,
                          const std::optional<SeenAgain>& again);

// Holds the software's rates beside the machine's, on one thread of this processor.
struct SoftwareRates {
  std::string implementation;
  double steps = 0, updates = 0, pictures = 0, frames = 0;  // a second
};
void write_machine_report(const ReportPlaces& places, const Drawn& drawn,
                          const hwmodel::MachineReport& report, const hwmodel::MachineOptions& options,
                          const std::optional<SoftwareRates>& software);

}  // namespace voxmelt::app
