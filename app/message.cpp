#include "app/message.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "app/print.h"

namespace voxmelt::app {
namespace {

bool g_output_was_closed = false;

}  // namespace

std::string one_line(std::string_view text) {
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  std::string line;
  for (const char c : text) {
    const unsigned char byte = c;
    if (c == '\n') {
      line += ' ';
    } else if (byte < 0x20 || byte == 0x7f) {
      line += fmt::format("\\x{:02x}", byte);
    } else {
      line += c;
    }
  }
  return line;
}

std::string place_message(const std::filesystem::filesystem_error& error) {
  std::error_code here;
  (void)std::filesystem::current_path(here);
  const std::string name = error.path1().empty() ? "" : error.path1().string() + ": ";
  return name + "error: " + (here ? "the current folder was removed" : error.code().message());
}

std::string seen_from_here(const std::filesystem::path& place) {
  std::error_code error;
  const std::filesystem::path here = std::filesystem::current_path(error);
  return (error ? place : std::filesystem::proximate(place, here)).string();
}

void say(std::string_view text) { put_error(one_line(text) + '\n'); }

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1) continue;
    const bool output = stream == STDOUT_FILENO;
    g_output_was_closed = g_output_was_closed || output;
    (void)::open(output ? "/dev/full" : "/dev/null", O_RDWR);  // takes the lowest free number: `stream`
  }
}

bool standard_output_is_well(int error) {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int first = error != 0 ? error : output_error();
  const int why = first != 0 ? first : errno;
  if (flushed && std::ferror(stdout) == 0) return true;
  say(fmt::format("standard output: error: cannot write: {}", g_output_was_closed ? "it is closed"
                                                              : why != 0          ? std::strerror(why)
                                                                         : "an earlier write failed"));
  return false;
}

}  // namespace voxmelt::app
