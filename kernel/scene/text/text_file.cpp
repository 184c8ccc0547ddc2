#include "kernel/scene/text/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "kernel/scene/text/error.h"

namespace voxmelt::scene {

std::string read_text_file(const std::filesystem::path& file, std::size_t limit, const std::string& where) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: error: cannot read {}: {}", where, file.string(), why));
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("it is a folder");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(errno != 0 ? std::strerror(errno) : "unknown reason");

  // The file is read in pieces, so that reading an endless device stops at the limit.
  std::string text;
  char piece[65536];
  while (stream.read(piece, sizeof piece) || stream.gcount() > 0) {
    text.append(piece, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > limit) fail(fmt::format("larger than {} bytes", limit));
  }
  if (stream.bad()) fail("reading stopped half-way");
  return text;
}

}  // namespace voxmelt::scene
