// The report of an exploration is a table and a sentence, CSV, JSON, or a picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hwmodel/explore/answer.h"
#include "hwmodel/explore/check.h"
#include "hwmodel/explore/ranges.h"
#include "hwmodel/explore/software_run.h"

namespace voxmelt::hwmodel::explore {

struct Explored {
  const Question& question;
  const Axes& axes;
  const Swept& swept;
  const Answer& answer;
  const Ranges& ranges;
  const std::vector<Checked>& checked;
  std::string scene, memory;
  std::optional<SoftwareRun> software{};  // none if nobody measured it
};

std::string text_of(const Explored& explored);
std::string design_text(const Point& point);
std::string sentence_of(const Explored& explored);
std::string csv_of(const Explored& explored);  // one row for every configuration
std::string json_of(const Explored& explored);
std::string svg_of(const Explored& explored);

const Checked* checked_at(const Explored& explored, std::size_t point);  // null if only predicted
// Returns "predicted", or of a simulated design: "verified", "outside" the bounds of the closed form, or
// "differs" from the software.
std::string_view state_of(const Checked* checked);
// Returns thousand cell-steps a second: simulated, or else predicted.
std::int64_t believed_speed(const Explored& explored, std::size_t point);

}  // namespace voxmelt::hwmodel::explore
