#include "app/resources.h"

#include <sys/auxv.h>

#include <system_error>

namespace voxmelt::app {

namespace fs = std::filesystem;

fs::path resource_folder(const fs::path& name) {
  std::error_code error;
  fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error)  // there is no /proc
    program = fs::absolute(reinterpret_cast<const char*>(::getauxval(AT_EXECFN)), error);
  const fs::path folder = program.parent_path() / VOXMELT_RESOURCES_FROM_PROGRAM / name;
  return fs::weakly_canonical(folder, error);
}

}  // namespace voxmelt::app
