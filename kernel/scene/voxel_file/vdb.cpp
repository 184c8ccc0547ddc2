// OpenVDB's files are read by the program voxmelt-vdb (kernel/vdb/helper.h): level sets and fog volumes.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "kernel/scene/text/text_file.h"
#include "kernel/scene/voxel_file/formats.h"
#include "kernel/scene/voxel_file/header.h"
#include "kernel/vdb/helper.h"

namespace voxmelt::scene {
namespace {

constexpr std::string_view kMagic("\x20\x42\x44\x56\0\0\0\0", 8);

Voxels voxels_from(vdb::Helper& helper, const VoxelSource& source) {
  NumberBlock block;  // its numbers tell what is filled
  Voxels voxels;
  std::istringstream head(helper.answer());
  head.imbue(std::locale::classic());
  for (std::uint64_t& side : block.size) head >> side;
  for (double& side : voxels.spacing) head >> side;
  if (!head) source.fail("voxmelt-vdb is of another version than this program");
  for (const double side : voxels.spacing) check_spacing(side, source);
  const std::string name = helper.line(), others = helper.line();
  voxels.filled.resize(checked_bytes(block, source));
  for (std::size_t axis = 0; axis < 3; ++axis) voxels.size[axis] = static_cast<int>(block.size[axis]);
  helper.receive(reinterpret_cast<char*>(voxels.filled.data()), voxels.filled.size());
  helper.finish();
  for (std::uint8_t& voxel : voxels.filled) voxel &= 1;
  if (!others.empty())
    voxels.note = fmt::format("{}: the grid '{}' is read, the first of {}; `part` names one",
                              source.file.string(), name, others);
  return voxels;
}

}  // namespace

Voxels read_vdb_voxels(std::string_view bytes, const VoxelSource& source) {
  std::error_code error;
  if (!bytes.starts_with(kMagic)) source.fail("no file of OpenVDB");
  if (!std::filesystem::is_regular_file(source.file, error)) source.fail("OpenVDB reads plain files alone");
  const Filled& filled = source.is_filled;
  const auto text = [&](double value) { return filled.is_default ? "" : fmt::format("{}", value); };
  try {
    vdb::Helper helper({"read", source.file.string(), source.array, text(filled.low), text(filled.high)});
    return voxels_from(helper, source);
  } catch (const vdb::HelperError& failed) {
    source.fail(failed.what());
  }
}

}  // namespace voxmelt::scene
