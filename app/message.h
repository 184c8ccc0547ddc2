// The program reports a problem in one line, whatever characters are in it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace voxmelt::app {

// Turns line breaks into blanks, and writes other control characters as \x1b.
std::string one_line(std::string_view text);

// Names a place that cannot be used, and says why.
std::string place_message(const std::filesystem::filesystem_error& error);

// Writes a path as a reader in the current folder would. The path is whole if that folder was removed.
std::string seen_from_here(const std::filesystem::path& place);

// Writes to standard error.
void say(std::string_view text);

// Opens standard streams that are closed, so that no other file takes their places. Output to a closed
// standard output is an error, as on a full device.
void open_standard_streams();

// Is thrown when nobody reads standard output any more, so that a command can end early. main() says why.
struct OutputStopped {
  int error;  // as errno
};

// Returns whether everything written to standard output arrived, and says so if not. `error` is known from
// before.
bool standard_output_is_well(int error = 0);

}  // namespace voxmelt::app
