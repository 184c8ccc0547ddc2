// What the program says when something is wrong: one line, whatever stands in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace voxmelt::app {

// Line breaks become blanks; other control characters are written as \x1b.
std::string one_line(std::string_view text);

// A place that cannot be used: its name, and why.
std::string place_message(const std::filesystem::filesystem_error& error);

// A path as a reader in the current folder would write it; whole where that folder was removed.
std::string seen_from_here(const std::filesystem::path& place);

// To standard error.
void say(std::string_view text);

// Standard streams that are closed are opened, so that no file of ours takes their places. What is written to
// a closed standard output is an error, as on a full device.
void open_standard_streams();

// Nobody reads standard output any more, so that a command can end early. main() says why.
struct OutputStopped {
  int error;  // as errno
};

// Everything written to standard output arrived; else says so and returns false. `error` is known from
// before.
bool standard_output_is_well(int error = 0);

}  // namespace voxmelt::app
