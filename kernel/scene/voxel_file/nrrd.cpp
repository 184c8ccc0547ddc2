// The reader of NRRD, with its numbers behind the header (.nrrd) or in a file of their own (.nhdr).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/text/ascii.h"
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
constexpr std::array kTypes{TypeName{"signed char", Type::int8},
                            TypeName{"int8", Type::int8},
                            TypeName{"int8_t", Type::int8},
                            TypeName{"uchar", Type::uint8},
                            TypeName{"unsigned char", Type::uint8},
                            TypeName{"uint8", Type::uint8},
                            TypeName{"uint8_t", Type::uint8},
                            TypeName{"short", Type::int16},
                            TypeName{"short int", Type::int16},
                            TypeName{"signed short", Type::int16},
                            TypeName{"signed short int", Type::int16},
                            TypeName{"int16", Type::int16},
                            TypeName{"int16_t", Type::int16},
                            TypeName{"ushort", Type::uint16},
                            TypeName{"unsigned short", Type::uint16},
                            TypeName{"unsigned short int", Type::uint16},
                            TypeName{"uint16", Type::uint16},
                            TypeName{"uint16_t", Type::uint16},
                            TypeName{"int", Type::int32},
                            TypeName{"signed int", Type::int32},
                            TypeName{"int32", Type::int32},
                            TypeName{"int32_t", Type::int32},
                            TypeName{"uint", Type::uint32},
                            TypeName{"unsigned int", Type::uint32},
                            TypeName{"uint32", Type::uint32},
                            TypeName{"uint32_t", Type::uint32},
                            TypeName{"longlong", Type::int64},
                            TypeName{"long long", Type::int64},
                            TypeName{"long long int", Type::int64},
                            TypeName{"int64", Type::int64},
                            TypeName{"int64_t", Type::int64},
                            TypeName{"ulonglong", Type::uint64},
                            TypeName{"unsigned long long", Type::uint64},
                            TypeName{"unsigned long long int", Type::uint64},
                            TypeName{"uint64", Type::uint64},
                            TypeName{"uint64_t", Type::uint64},
                            TypeName{"float", Type::float32},
                            TypeName{"double", Type::float64}};

// The header ends at an empty line, or with the file.
struct Header {
  std::map<std::string, std::string> fields;
  std::size_t bytes = 0;
};

Header header_of(std::string_view bytes, const VoxelSource& source) {
  if (!bytes.starts_with("NRRD000")) source.fail("no NRRD file: it does not begin with NRRD000");
  Header header;
  std::size_t at = bytes.find('\n');
  for (std::size_t line = 2; at != std::string_view::npos; ++line) {
    const std::size_t from = at + 1, end = bytes.find('\n', from);
    std::string_view text =
        bytes.substr(std::min(from, bytes.size()), end == std::string_view::npos ? end : end - from);
    if (text.ends_with('\r')) text.remove_suffix(1);
    at = end;
    header.bytes = end == std::string_view::npos ? bytes.size() : end + 1;
    if (text.empty()) return header;
    if (text.starts_with('#') || text.find(":=") != std::string_view::npos) continue;
    const std::size_t colon = text.find(": ");
    if (colon == std::string_view::npos) source.fail(fmt::format("line {} of its header is no field", line));
    std::string name(text.substr(0, colon));
    for (char& c : name) c = lower_case(c);
    std::erase(name, ' ');  // "data file" is datafile, too
    header.fields[name] = trimmed(text.substr(colon + 2));
  }
  return header;
}

std::array<double, 3> spacing_of(const Header& header, const VoxelSource& source) {
  std::array<double, 3> spacing{1, 1, 1};
  if (const auto found = header.fields.find("spacings"); found != header.fields.end())
    spacing = three_lengths(found->second, "spacings", source);
  if (const auto found = header.fields.find("spacedirections"); found != header.fields.end()) {
    std::string text = found->second;  // "(1,0,0) (0,1,0) (0,0,2)"
    for (char& c : text)
      if (c == '(' || c == ')' || c == ',') c = ' ';
    const std::vector<double> numbers = numbers_in(text, "space directions", source);
    if (numbers.size() != 9) source.fail("space directions: three vectors of three numbers are read");
    for (std::size_t i = 0; i < 3; ++i)
      spacing[i] = std::hypot(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
  }
  for (const double side : spacing) check_spacing(side, source);
  return spacing;
}

// Upper and lower case are the same in names of types, encodings and orders.
std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), lower_case);
  return text;
}

bool is_text(const std::string& encoding) {
  return encoding == "ascii" || encoding == "text" || encoding == "txt";
}

// Reads numbers that are written as text, with blanks, ends of lines or commas between them.
Voxels of_text(std::string_view text, const NumberBlock& block, const Header& header,
               const VoxelSource& source) {
  constexpr std::string_view kBetween = " \t\r\n\v\f,";
  checked_bytes(block, source);
  Voxels voxels;
  for (std::size_t axis = 0; axis < 3; ++axis) voxels.size[axis] = static_cast<int>(block.size[axis]);
  const std::size_t wanted = block.size[0] * block.size[1] * block.size[2];
  if (text.size() / 2 + 1 < wanted)
    source.fail(fmt::format("{} numbers are not {} bytes of text", wanted, text.size()));
  voxels.filled.reserve(wanted);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
    if (text.empty()) break;
    const std::string_view word = text.substr(0, text.find_first_of(kBetween));
    const std::optional<double> number = real_number_in(word);
    if (!number) source.fail(fmt::format("number {} is {}", voxels.filled.size(), in_quotes(word)));
    if (voxels.filled.size() == wanted) source.fail(fmt::format("it has more than {} numbers", wanted));
    voxels.filled.push_back(source.is_filled(*number) ? 1 : 0);
    text.remove_prefix(word.size());
  }
  if (voxels.filled.size() < wanted)
    source.fail(fmt::format("it has {} of {} numbers: is it truncated?", voxels.filled.size(), wanted));
  voxels.spacing = spacing_of(header, source);
  return voxels;
}

// A type is named in many ways.
NumberBlock::Type type_named(const std::string& type, const VoxelSource& source) {
  const auto* const known = std::ranges::find(kTypes, type, &TypeName::name);
  if (known == kTypes.end()) source.fail(fmt::format("type {} is not read", in_quotes(type)));
  return known->type;
}

}  // namespace

Voxels read_nrrd_voxels(std::string_view bytes, const VoxelSource& source) {
  const Header header = header_of(bytes, source);
  const auto field = [&](const char* name, const char* fallback = nullptr) {
    const auto found = header.fields.find(name);
    if (found == header.fields.end() && fallback == nullptr)
      source.fail(fmt::format("its header has no field `{}`", name));
    return found == header.fields.end() ? std::string(fallback) : found->second;
  };
  NumberBlock block;
  block.type = type_named(lower(field("type")), source);
  if (field("dimension") != "3")
    source.fail(fmt::format("dimension {}: 3 is read", in_quotes(field("dimension"))));
  block.size = three_sides(field("sizes"), "sizes", source);
  pack_steps(block);
  const std::string encoding = lower(field("encoding"));
  if (bytes_of(block.type) > 1 && !is_text(encoding)) {
    const std::string endian = lower(field("endian"));
    if (endian != "little" && endian != "big")
      source.fail(fmt::format("endian {} is none", in_quotes(endian)));
    block.is_big_endian = endian == "big";
  }
  for (const char* name : {"lineskip", "byteskip"})
    if (field(name, "0") != "0") source.fail(fmt::format("`{}` is not read", name));

  const std::string apart = field("datafile", "");
  const std::string other = apart.empty() ? std::string() : read_beside(source, apart);
  const std::string_view data = apart.empty() ? bytes.substr(header.bytes) : std::string_view(other);
  std::string unpacked;
  if (is_text(encoding)) return of_text(data, block, header, source);
  if (encoding == "gzip" || encoding == "gz") {
    unpacked = unpack(data, Packing::gzip, checked_bytes(block, source), source);
    block.bytes = unpacked;
  } else if (encoding == "raw") {
    block.bytes = data;
  } else {
    const bool is_bzip2 = encoding == "bzip2" || encoding == "bz2";
    source.fail(fmt::format("encoding {} is not read; raw, gzip and ascii are{}", in_quotes(encoding),
                            is_bzip2 ? ": `unu save -f nrrd -e gzip` converts it" : ""));
  }
  Voxels voxels = voxels_of(block, source);
  voxels.spacing = spacing_of(header, source);
  return voxels;
}

}  // namespace voxmelt::scene
