#include "kernel/scene/voxel_file/voxels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/text_file.h"
#include "kernel/scene/voxel_file/formats.h"

namespace voxmelt::scene {
namespace {

struct VoxelFormat {
  std::string_view ending;
  Voxels (*read)(std::string_view bytes, const VoxelSource& source);
};

constexpr std::array kVoxelFormats{
    VoxelFormat{".npy", read_npy_voxels},        VoxelFormat{".npz", read_npz_voxels},
    VoxelFormat{".nrrd", read_nrrd_voxels},      VoxelFormat{".nhdr", read_nrrd_voxels},
    VoxelFormat{".mha", read_meta_image_voxels}, VoxelFormat{".mhd", read_meta_image_voxels},
    VoxelFormat{".vox", read_magica_voxels},     VoxelFormat{".vdb", read_vdb_voxels}};

// Returns the format, or null.
const VoxelFormat* format_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), lower_case);
  for (const VoxelFormat& format : kVoxelFormats)
    if (format.ending == ending) return &format;
  return nullptr;
}

std::string endings() {
  std::string text;
  for (const VoxelFormat& format : kVoxelFormats)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", format.ending);
  return text;
}

Voxels read_raw(std::string_view bytes, const VoxelSource& source) {
  static_assert(kNumberTypes.size() == static_cast<std::size_t>(NumberBlock::Type::float64) + 1);
  const RawNumbers& raw = *source.raw;
  if (raw.skip > bytes.size())
    source.fail(fmt::format("it has {} bytes, and {} are to be skipped", bytes.size(), raw.skip));
  NumberBlock block;
  block.bytes = bytes.substr(raw.skip);
  block.type = static_cast<NumberBlock::Type>(raw.type);
  block.is_big_endian = raw.is_big_endian;
  block.size = raw.size;
  pack_steps(block);
  Voxels voxels = voxels_of(block, source);
  voxels.spacing = raw.spacing;
  return voxels;
}

}  // namespace

void VoxelSource::fail(const std::string& message) const {
  fail_at(place, fmt::format("{}: {}", file.string(), message));
}

bool is_voxel_file(const std::filesystem::path& file) { return format_of(file) != nullptr; }

Voxels read_voxels(const VoxelSource& source) {
  const VoxelFormat* format = format_of(source.file);
  const std::string bytes = read_text_file(source.file, kLargestVoxelFile, source.place.text());
  if (source.raw) return read_raw(bytes, source);
  if (format == nullptr)
    source.fail(fmt::format("volumes are read from {}, not from {}; numbers without a header want `raw`",
                            endings(), in_quotes(source.file.extension().string())));
  if (bytes.starts_with("version https://git-lfs"))
    source.fail("this is a pointer of Git LFS; `git lfs pull` brings the file");
  return format->read(bytes, source);
}

std::string read_beside(const VoxelSource& source, const std::string& name) {
  if (name.empty() || name.find('\0') != std::string::npos) source.fail("names no file of numbers");
  return read_text_file(source.file.parent_path() / name, kLargestVoxelFile,
                        fmt::format("{}: error: {}", source.place.text(), source.file.string()));
}

}  // namespace voxmelt::scene
