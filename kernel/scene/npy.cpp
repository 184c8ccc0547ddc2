#include "kernel/scene/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/scene/text/npy_header.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestHeader = 65536;

// Says what an element is: "<u2", "|b1", ">i8".
struct Element {
  bool is_signed = false, is_big = false;
  std::size_t bytes = 0;  // 0: it is no whole number
};

Element element_of(const std::string& type) {
  if (type.size() != 3 || std::string_view("<>|=").find(type[0]) == std::string_view::npos) return {};
  const std::size_t bytes = type[2] - '0';
  const bool fits = type[1] == 'b' ? bytes == 1 : bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8;
  if (!fits || std::string_view("bui").find(type[1]) == std::string_view::npos) return {};
  return {type[1] == 'i', type[0] == '>', bytes};
}

}  // namespace

std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, std::uint32_t largest,
                                    state::Grid grid, const Place& place) {
  const auto fail = [&](const std::string& message) { fail_at(place, file.string() + ": " + message); };
  constexpr std::size_t kPreamble = 12, kWidest = 8;  // bytes
  const std::string data =
      read_text_file(file, grid.cells() * kWidest + kPreamble + kLargestHeader, place.text());
  const auto byte = [&](std::size_t i) { return std::uint64_t{static_cast<unsigned char>(data[i])}; };
  const NpyHeader header = read_npy_header(data, fail);
  const std::string& type = header.type;
  const Element element = element_of(type);
  if (element.bytes == 0)
    fail(fmt::format("type {}: the numbers must be whole, as in array.astype(numpy.uint{})", type,
                     largest > 255 ? 16 : 8));
  const std::string wanted = fmt::format("({},{},{})", grid.z, grid.y, grid.x);
  if (header.shape != wanted)
    fail(fmt::format("shape {} instead of {} (z, y, x of grid.size)", header.shape, wanted));
  const std::size_t size = grid.cells() * element.bytes;
  if (data.size() != header.bytes + size)
    fail(fmt::format("{} bytes of data instead of {}", data.size() - header.bytes, size));

  const auto number_at = [&](std::size_t at) {
    std::uint64_t number = 0;
    for (std::size_t k = 0; k < element.bytes; ++k)
      number |= byte(at + (element.is_big ? element.bytes - 1 - k : k)) << (8 * k);
    const bool below = element.is_signed && number >> (8 * element.bytes - 1) != 0;
    return below ? static_cast<std::int64_t>(number | ~std::uint64_t{0} << (8 * element.bytes - 1))
                 : static_cast<std::int64_t>(std::min<std::uint64_t>(number, INT64_MAX));
  };
  std::vector<std::uint16_t> result(grid.cells());
  const std::array<std::size_t, 3> step =
      header.fortran_order
          ? std::array<std::size_t, 3>{std::size_t{1} * grid.y * grid.z, std::size_t{1} * grid.z, 1}
          : std::array<std::size_t, 3>{1, std::size_t{1} * grid.x, std::size_t{1} * grid.x * grid.y};
  std::size_t i = 0;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x, ++i) {
        const std::int64_t number =
            number_at(header.bytes + (x * step[0] + y * step[1] + z * step[2]) * element.bytes);
        if (number < 0 || number > largest)
          fail(fmt::format("[{}][{}][{}] = {} is outside 0..{}", z, y, x, number, largest));
        result[i] = static_cast<std::uint16_t>(number);
      }
  return result;
}

}  // namespace voxmelt::scene
