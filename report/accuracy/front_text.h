// The page and docs/results/front.md share these tables and texts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/accuracy/front.h"

namespace voxmelt::accuracy {

struct FrontTable {
  std::vector<std::string> head;
  std::size_t texts = 1;  // so many columns are texts, and the others numbers
  std::vector<std::vector<std::string>> rows{};
};
FrontTable picks_table(const FrontReport& report);
FrontTable points_table(const front::Swept& swept);
FrontTable formats_table(const FrontReport& report);  // without rows if no scene has formats

std::string seconds_text(double seconds);                               // "0.13 s"
std::string title_of(const front::Swept& swept);                        // "cello" or "cello, viscous law"
std::string noise_text(const front::Swept& swept);                      // says what other random bits change
std::string about_text(const FrontReport& report);                      // says what was run
std::vector<std::string> texts_below_picks(const FrontReport& report);  // paragraphs
extern const char* const kFormatsText;

}  // namespace voxmelt::accuracy
