// The page and docs/results/front.md share these texts.
#pragma once

#include <string>

#include "accuracy/front/words.h"
#include "report/accuracy/front.h"

namespace voxmelt::accuracy {

std::string seconds_text(double seconds);               // "0.13 s"
std::string pick_text(const front::Pick& pick);         // "step 1/2: whole error 0.9 % (model ...)"
std::string format_pick_text(const front::Pick& pick);  // "u16 nearest: 0.05 %, 50 bits"
std::string title_of(const front::Swept& swept);        // "cello" or "cello, viscous law"
// Says what the usual setting gives, and if none beats it.
std::string usual_text(const front::Swept& swept);
extern const char* const kHowErrorsAreMeasured[4];  // paragraphs

}  // namespace voxmelt::accuracy
