#include "kernel/scene/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "kernel/scene/text/ascii.h"
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

// Returns the header's dictionary without blanks, and with one kind of quotes.
std::string packed(std::string_view header) {
  std::string text;
  for (const char c : header)
    if (!is_space(c) && c != '\0') text += c == '"' ? '\'' : c;
  return text;
}

// Returns the text after "'key':" in it.
std::string entry(const std::string& dictionary, const std::string& key) {
  const std::size_t at = dictionary.find("'" + key + "':");
  if (at == std::string::npos) return {};
  const std::size_t from = at + key.size() + 3;
  const std::size_t to =
      dictionary[from] == '(' ? dictionary.find(')', from) + 1 : dictionary.find_first_of(",}", from);
  std::string text = dictionary.substr(from, to == 0 ? 0 : to - from);
  if (text.size() > 1 && text.front() == '\'' && text.back() == '\'') text = text.substr(1, text.size() - 2);
  return text;
}

}  // namespace

std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, std::uint32_t largest,
                                    state::Grid grid, const Place& place) {
  const auto fail = [&](const std::string& message) { fail_at(place, file.string() + ": " + message); };
  constexpr std::size_t kShort = 10, kLong = 12, kWidest = 8;  // magic, version, length of the header; bytes
  const std::string data =
      read_text_file(file, grid.cells() * kWidest + kLong + kLargestHeader, place.text());
  const auto byte = [&](std::size_t i) { return std::uint64_t{static_cast<unsigned char>(data[i])}; };

  if (data.size() < kLong || data.compare(0, 6, "\x93NUMPY") != 0) fail("not an npy file");
  if (data[6] < 1 || data[6] > 3) fail(fmt::format("npy format {}.{} is not known", byte(6), byte(7)));
  const std::size_t preamble = data[6] == 1 ? kShort : kLong;
  std::size_t header_size = byte(8) | byte(9) << 8;
  if (data[6] > 1) header_size |= byte(10) << 16 | byte(11) << 24;
  if (data.size() < preamble + header_size) fail("truncated in its header");
  const std::string header = packed(std::string_view(data).substr(preamble, header_size));

  const std::string type = entry(header, "descr");
  const Element element = element_of(type);
  if (element.bytes == 0)
    fail(fmt::format("type {}: the numbers must be whole, as in array.astype(numpy.uint{})", type,
                     largest > 255 ? 16 : 8));
  const std::string order = entry(header, "fortran_order");
  if (order != "False" && order != "True") fail("its header says nothing of fortran_order");
  const std::string wanted = fmt::format("({},{},{})", grid.z, grid.y, grid.x);
  const std::string shape = entry(header, "shape");
  if (shape != wanted) fail(fmt::format("shape {} instead of {} (z, y, x of grid.size)", shape, wanted));
  const std::size_t size = grid.cells() * element.bytes;
  if (data.size() != preamble + header_size + size)
    fail(fmt::format("{} bytes of data instead of {}", data.size() - preamble - header_size, size));

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
      order == "True"
          ? std::array<std::size_t, 3>{std::size_t{1} * grid.y * grid.z, std::size_t{1} * grid.z, 1}
          : std::array<std::size_t, 3>{1, std::size_t{1} * grid.x, std::size_t{1} * grid.x * grid.y};
  std::size_t i = 0;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x, ++i) {
        const std::int64_t number =
            number_at(preamble + header_size + (x * step[0] + y * step[1] + z * step[2]) * element.bytes);
        if (number < 0 || number > largest)
          fail(fmt::format("[{}][{}][{}] = {} is outside 0..{}", z, y, x, number, largest));
        result[i] = static_cast<std::uint16_t>(number);
      }
  return result;
}

}  // namespace voxmelt::scene
