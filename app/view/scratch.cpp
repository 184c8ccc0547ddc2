#include "app/view/scratch.h"

#include <stdlib.h>  // mkdtemp

#include <fmt/format.h>

#include <fstream>
#include <ios>
#include <iterator>
#include <ostream>
#include <system_error>

#include "voxmelt/errors.h"

namespace voxmelt::view {

Scratch::Scratch() {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  std::string name = (folder / "voxmelt-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw OutputError(fmt::format("error: cannot write into {}", folder.string()));
  folder_ = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Scratch::bytes() const {
  std::ifstream stream(file(), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void Scratch::write(const std::string& bytes) const {
  std::ofstream stream(file(), std::ios::binary);
  stream << bytes << std::flush;
  if (!stream) throw OutputError(fmt::format("error: cannot write {}", file().string()));
}

}  // namespace voxmelt::view
