#include "app/print.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace voxmelt::app {
namespace {

int g_output_error = 0;

}  // namespace

void put(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && g_output_error == 0)
    g_output_error = errno;
}

void put_error(std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) text.remove_prefix(written);
  }
}

int output_error() { return g_output_error; }

}  // namespace voxmelt::app
