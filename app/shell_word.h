// Some commands are printed for a user to paste into a shell.
#pragma once

#include <string>

namespace voxmelt::app {

// Quotes a text as one word for a shell.
std::string shell_word(std::string text);

}  // namespace voxmelt::app
