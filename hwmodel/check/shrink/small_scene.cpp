#include "hwmodel/check/shrink/small_scene.h"

#include <system_error>

#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::check {

namespace fs = std::filesystem;

Workplace::Workplace(const fs::path& beside) : folder_(beside.string() + ".partial") {
  const auto held = io::changing_places();
  fs::create_directories(folder_);
  unfinished_.begin([this] { remove(); });
}

Workplace::~Workplace() {
  const auto held = io::changing_places();
  remove();
}

void Workplace::remove() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::unique_ptr<scene::Scene> Workplace::load(const state::Volume& volume, const std::string& text) const {
  try {
    io::export_npy(volume, folder_);
    io::write_file(folder_ / "scene.toml", text);
    return std::make_unique<scene::Scene>(scene::load(folder_ / "scene.toml", {}));
  } catch (const scene::InputError&) {
    return nullptr;
  }
}

int count_matter(const state::Volume& volume) {
  int cells = 0;
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y)
      for (int x = 0; x < volume.grid.x; ++x)
        cells += volume.solid.test(x, y, z) || volume.liquid.test(x, y, z) || volume.inert.test(x, y, z);
  return cells;
}

}  // namespace voxmelt::hwmodel::check
