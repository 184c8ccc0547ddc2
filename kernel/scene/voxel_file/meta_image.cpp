// The reader of MetaImage, with its numbers behind the header (.mha) or in a file of their own (.mhd).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "kernel/scene/text/text_file.h"
#include "kernel/scene/voxel_file/formats.h"
#include "kernel/scene/voxel_file/header.h"

namespace voxmelt::scene {
namespace {

struct TypeName {
  std::string_view name;
  NumberBlock::Type type;
};
using Type = NumberBlock::Type;
constexpr std::array kTypes{TypeName{"MET_CHAR", Type::int8},       TypeName{"MET_UCHAR", Type::uint8},
                            TypeName{"MET_SHORT", Type::int16},     TypeName{"MET_USHORT", Type::uint16},
                            TypeName{"MET_INT", Type::int32},       TypeName{"MET_UINT", Type::uint32},
                            TypeName{"MET_LONG_LONG", Type::int64}, TypeName{"MET_ULONG_LONG", Type::uint64},
                            TypeName{"MET_FLOAT", Type::float32},   TypeName{"MET_DOUBLE", Type::float64}};

// The header ends with the line that names the numbers.
struct Header {
  std::map<std::string, std::string> fields;
  std::size_t bytes = 0;
};

Header header_of(std::string_view bytes, const VoxelSource& source) {
  Header header;
  for (std::size_t line = 1; header.bytes < bytes.size(); ++line) {
    const std::string_view left = bytes.substr(header.bytes), text = left.substr(0, left.find('\n'));
    const std::size_t sign = text.find('=');
    if (sign == std::string_view::npos) source.fail(fmt::format("line {} of its header is no field", line));
    header.bytes += std::min(text.size() + 1, left.size());
    const std::string name = trimmed(text.substr(0, sign));
    header.fields[name] = trimmed(text.substr(sign + 1));
    if (name == "ElementDataFile") return header;
  }
  source.fail("its header has no field `ElementDataFile`");
}

}  // namespace

Voxels read_meta_image_voxels(std::string_view bytes, const VoxelSource& source) {
  const Header header = header_of(bytes, source);
  const auto field = [&](const char* name, const char* fallback = nullptr) {
    const auto found = header.fields.find(name);
    if (found == header.fields.end() && fallback == nullptr)
      source.fail(fmt::format("its header has no field `{}`", name));
    return found == header.fields.end() ? std::string(fallback) : found->second;
  };
  const auto flag = [&](const char* name) {
    return field(name, "False") == "True" || field(name, "False") == "true";
  };
  NumberBlock block;
  if (field("NDims") != "3") source.fail(fmt::format("NDims = {}: 3 is read", in_quotes(field("NDims"))));
  block.size = three_sides(field("DimSize"), "DimSize", source);
  pack_steps(block);
  const std::string type = field("ElementType");
  const auto known =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& one) { return one.name == type; });
  if (known == kTypes.end()) source.fail(fmt::format("ElementType = {} is not read", in_quotes(type)));
  block.type = known->type;
  if (field("ElementNumberOfChannels", "1") != "1") source.fail("ElementNumberOfChannels: 1 is read");
  if (field("HeaderSize", "0") != "0") source.fail("HeaderSize is not read");
  block.is_big_endian = flag("BinaryDataByteOrderMSB") || flag("ElementByteOrderMSB");

  const std::string apart = field("ElementDataFile");
  const std::string other = apart == "LOCAL" ? std::string() : read_beside(source, apart);
  const std::string_view data = apart == "LOCAL" ? bytes.substr(header.bytes) : std::string_view(other);
  const std::string unpacked =
      flag("CompressedData") ? unpack(data, Packing::zlib, checked_bytes(block, source), source) : "";
  block.bytes = flag("CompressedData") ? std::string_view(unpacked) : data;
  Voxels voxels = voxels_of(block, source);
  voxels.spacing = three_lengths(field("ElementSpacing", "1 1 1"), "ElementSpacing", source);
  for (const double side : voxels.spacing) check_spacing(side, source);
  return voxels;
}

}  // namespace voxmelt::scene
