#include "app/link_or_copy.h"

#include <system_error>

#include "kernel/run/io/file_writer.h"

namespace voxmelt::app {

void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::create_hard_link(from, to, error);
  if (error) std::filesystem::copy_file(from, to, error);
  if (error)
    throw io::OutputError(to.string() + ": error: cannot write: " + error.message(),
                          error == std::errc::no_space_on_device);
}

}  // namespace voxmelt::app
