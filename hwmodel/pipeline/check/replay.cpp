#include "hwmodel/pipeline/check/replay.h"

#include <fmt/format.h>

#include <cstdint>

#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/text/print.h"

namespace voxmelt::hwmodel {
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
                  step, comment, scene::toml_string(std::filesystem::absolute(scene).string()), step));
}

}  // namespace voxmelt::hwmodel
