// The reader of NumPy's arrays, alone (.npy) or in an archive (.npz). They have the axes (z, y, x).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "kernel/scene/text/bytes.h"
#include "kernel/scene/text/npy_header.h"
#include "kernel/scene/text/text_file.h"
#include "kernel/scene/voxel_file/formats.h"

namespace voxmelt::scene {
namespace {

// Returns the sides z, y, x of a shape "(z,y,x)", or nothing.
std::optional<std::array<std::uint64_t, 3>> sides_of(std::string_view shape) {
  std::array<std::uint64_t, 3> sides{};
  if (!shape.starts_with('(')) return std::nullopt;
  const char *at = shape.data() + 1, *const end = shape.data() + shape.size();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, sides[i]);
    if (error != std::errc() || next == end || *next != (i < 2 ? ',' : ')')) return std::nullopt;
    at = next + 1;
  }
  return at == end ? std::optional(sides) : std::nullopt;
}

// An entry of an archive. Sizes come from its directory, since an entry need not know its own at its head.
struct Entry {
  std::string name;
  std::uint16_t method = 0;  // 0: as it is, 8: deflate
  std::size_t packed = 0, size = 0, at = 0;
};

std::vector<Entry> entries_of(std::string_view bytes, const VoxelSource& source) {
  constexpr std::size_t tail = 22, head = 46;
  constexpr std::string_view end_mark("PK\5\6", 4), entry_mark("PK\1\2", 4);
  const std::size_t end = bytes.rfind(end_mark);
  if (end == std::string_view::npos || bytes.size() - end < tail)
    source.fail("no archive of NumPy: is it truncated?");
  const auto count = number_at<std::uint16_t>(bytes.substr(end + 10));
  std::size_t at = number_at<std::uint32_t>(bytes.substr(end + 16));
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    if (at > end || end - at < head || bytes.substr(at, 4) != entry_mark)
      source.fail("its directory is damaged");
    const std::string_view entry = bytes.substr(at);
    const std::size_t name = number_at<std::uint16_t>(entry.substr(28));
    const std::size_t more =
        number_at<std::uint16_t>(entry.substr(30)) + std::size_t{number_at<std::uint16_t>(entry.substr(32))};
    if (entry.size() < head + name + more) source.fail("its directory is damaged");
    entries.push_back({std::string(entry.substr(head, name)), number_at<std::uint16_t>(entry.substr(10)),
                       number_at<std::uint32_t>(entry.substr(20)), number_at<std::uint32_t>(entry.substr(24)),
                       number_at<std::uint32_t>(entry.substr(42))});
    at += head + name + more;
  }
  return entries;
}

std::string content_of(const Entry& entry, std::string_view bytes, const VoxelSource& source) {
  constexpr std::size_t head = 30;
  if (entry.at > bytes.size() || bytes.size() - entry.at < head)
    source.fail(in_quotes(entry.name) + " is not within it");
  const std::string_view local = bytes.substr(entry.at);
  const std::size_t from =
      head + number_at<std::uint16_t>(local.substr(26)) + number_at<std::uint16_t>(local.substr(28));
  if (from > local.size() || entry.packed > local.size() - from)
    source.fail(in_quotes(entry.name) + " is not within it");
  if (entry.size > kLargestVoxelFile) source.fail(in_quotes(entry.name) + " is too large");
  const std::string_view packed = local.substr(from, entry.packed);
  if (entry.method == 8) return unpack(packed, Packing::deflate, entry.size, source);
  if (entry.method != 0)
    source.fail(fmt::format("{} is packed in a way that is not read", in_quotes(entry.name)));
  return std::string(packed);
}

}  // namespace

Voxels read_npy_voxels(std::string_view bytes, const VoxelSource& source) {
  const NpyHeader header = read_npy_header(bytes, [&](const std::string& message) { source.fail(message); });
  const std::string& type = header.type;
  const bool has_order = type.size() >= 3 && std::string_view("<>|=").find(type[0]) != std::string_view::npos;
  const auto number = has_order && type.size() == 3
                          ? number_type(type[1], static_cast<std::size_t>(type[2] - '0'))
                          : std::nullopt;
  if (!number) source.fail(fmt::format("type {}: bool, whole numbers and floats are read", in_quotes(type)));
  const auto sides = sides_of(header.shape);
  if (!sides) source.fail(fmt::format("shape {}: three axes (z, y, x) are read", header.shape));
  NumberBlock block;
  block.type = *number;
  block.is_big_endian = type[0] == '>';
  block.size = {(*sides)[2], (*sides)[1], (*sides)[0]};
  pack_steps(block);
  if (header.fortran_order) block.step = {(*sides)[0] * (*sides)[1], (*sides)[0], 1};
  block.bytes = bytes.substr(header.bytes);
  return voxels_of(block, source);
}

Voxels read_npz_voxels(std::string_view bytes, const VoxelSource& source) {
  std::vector<Entry> entries = entries_of(bytes, source);
  std::string names;
  for (const Entry& entry : entries)
    names += (names.empty() ? "" : ", ") + in_quotes(entry.name.substr(0, entry.name.rfind(".npy")));
  const auto wanted = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
    return source.array.empty() || entry.name == source.array + ".npy";
  });
  if (wanted == entries.end())
    source.fail(source.array.empty()
                    ? "it has no arrays"
                    : fmt::format("it has no array {}; its arrays are {}", in_quotes(source.array), names));
  if (source.array.empty() && entries.size() > 1)
    source.fail(fmt::format("it has several arrays, {}; `array` names one", names));
  return read_npy_voxels(content_of(*wanted, bytes, source), source);
}

}  // namespace voxmelt::scene
