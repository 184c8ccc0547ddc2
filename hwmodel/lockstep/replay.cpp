#include "hwmodel/lockstep/replay.h"

#include <fmt/format.h>

#include <cstdint>

#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::hwmodel {
namespace {

// Quotes a text as a TOML basic string.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

}  // namespace

void write_replay(const std::filesystem::path& folder, const std::filesystem::path& scene,
                  const state::Volume& volume, std::uint32_t step, const std::string& command) {
  std::string comment = command;  // one line, whatever was typed
  for (char& c : comment)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  io::export_npy(volume, folder);
  io::write_file(
      folder / "scene.toml",
      fmt::format("# The state before step {} of a run whose hardware model differed from the software.\n"
                  "#   {}\nextends = {}\n[start]\nfields = \".\"\nstep = {}\n",
                  step, comment, quoted(std::filesystem::absolute(scene).string()), step));
}

}  // namespace voxmelt::hwmodel
