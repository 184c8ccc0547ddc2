#include "kernel/scene/npy.h"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>
#include <string>

#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kPreamble = 10;  // magic, version, 16-bit header length
constexpr std::size_t kLargestHeader = 65536;

// Returns the text after "'key':" in the header's dictionary, without blanks.
std::string entry(const std::string& header, const std::string& key) {
  std::string packed;
  for (const char c : header)
    if (std::isspace(static_cast<unsigned char>(c)) == 0) packed += c;
  const std::size_t at = packed.find("'" + key + "':");
  if (at == std::string::npos) return {};
  const std::size_t from = at + key.size() + 3;
  const std::size_t to = packed[from] == '(' ? packed.find(')', from) + 1 : packed.find_first_of(",}", from);
  return packed.substr(from, to == 0 ? 0 : to - from);
}

}  // namespace

std::vector<std::uint16_t> read_npy(const std::filesystem::path& file, int bytes, state::Grid grid,
                                    const Place& place) {
  const auto fail = [&](const std::string& message) { fail_at(place, file.string() + ": " + message); };
  const std::size_t size = grid.cells() * bytes;
  const std::string data = read_text_file(file, size + kPreamble + kLargestHeader, place.text());

  if (data.size() < kPreamble || data.compare(0, 6, "\x93NUMPY") != 0) fail("not an npy file");
  if (data[6] != 1) fail("only npy format 1.0 is read");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(data[i])); };
  const std::size_t header_size = byte(8) | byte(9) << 8;
  if (data.size() < kPreamble + header_size) fail("truncated in its header");
  const std::string header = data.substr(kPreamble, header_size);

  const std::string type = entry(header, "descr");
  const bool type_fits = bytes == 1 ? type == "'|u1'" || type == "'u1'" || type == "'<u1'" : type == "'<u2'";
  if (!type_fits) fail(fmt::format("type {} instead of '{}'", type, bytes == 1 ? "|u1" : "<u2"));
  if (entry(header, "fortran_order") != "False") fail("not in C order");
  const std::string wanted = fmt::format("({},{},{})", grid.z, grid.y, grid.x);
  const std::string shape = entry(header, "shape");
  if (shape != wanted) fail(fmt::format("shape {} instead of {} (z, y, x of grid.size)", shape, wanted));
  if (data.size() != kPreamble + header_size + size)
    fail(fmt::format("{} bytes of data instead of {}", data.size() - kPreamble - header_size, size));

  std::vector<std::uint16_t> result(grid.cells());
  for (std::size_t i = 0, at = kPreamble + header_size; i < result.size(); ++i, at += bytes)
    result[i] = static_cast<std::uint16_t>(bytes == 1 ? byte(at) : byte(at) | byte(at + 1) << 8);
  return result;
}

}  // namespace voxmelt::scene
