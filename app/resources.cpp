#include "app/resources.h"

#include <system_error>

namespace voxmelt::app {

namespace fs = std::filesystem;

fs::path resource_folder(const fs::path& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path folder = program.parent_path() / VOXMELT_RESOURCES_FROM_PROGRAM / name;
  return fs::weakly_canonical(folder, error);
}

}  // namespace voxmelt::app
