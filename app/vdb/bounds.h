// The program bounds what it may use, and speaks in lines.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace voxmelt::vdb {

// Returns it as one line of ASCII: a hurt file can have names of anything.
inline std::string plain(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

// Is our standard output. OpenVDB prints warnings there: they are moved to standard error.
inline std::FILE* output() {
  static std::FILE* const ours = [] {
    const int descriptor = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    return ::fdopen(descriptor, "wb");
  }();
  return ours;
}

inline void give(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), output()) != text.size()) std::exit(3);
}

// Takes so many bytes of standard input.
template <class Bytes>
void take(Bytes& to) {
  if (std::fread(&to, sizeof to, 1, stdin) != 1) throw std::runtime_error("the input ends too early");
}

// Lets the process use no more of it than that.
inline void bound(__rlimit_resource_t resource, rlim_t most) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = std::min(most, limit.rlim_max);
  ::setrlimit(resource, &limit);
}

// Returns how much memory is mapped, in bytes.
inline std::uint64_t room_in_use() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace voxmelt::vdb
