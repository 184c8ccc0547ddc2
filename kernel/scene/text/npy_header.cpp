#include "kernel/scene/text/npy_header.h"

#include <fmt/format.h>

#include <cstdint>

#include "kernel/scene/text/ascii.h"

namespace voxmelt::scene {
namespace {

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

NpyHeader read_npy_header(std::string_view bytes, const std::function<void(const std::string&)>& fail) {
  constexpr std::size_t kShort = 10, kLong = 12;  // magic, version, length of the header
  const auto byte = [&](std::size_t i) { return std::uint64_t{static_cast<unsigned char>(bytes[i])}; };
  if (bytes.size() < kLong || bytes.compare(0, 6, "\x93NUMPY") != 0) fail("not an npy file");
  if (bytes[6] < 1 || bytes[6] > 3) fail(fmt::format("npy format {}.{} is not known", byte(6), byte(7)));
  const std::size_t preamble = bytes[6] == 1 ? kShort : kLong;
  std::size_t size = byte(8) | byte(9) << 8;
  if (bytes[6] > 1) size |= byte(10) << 16 | byte(11) << 24;
  if (bytes.size() < preamble + size) fail("truncated in its header");
  const std::string text = packed(bytes.substr(preamble, size));

  NpyHeader header;
  header.type = entry(text, "descr");
  header.shape = entry(text, "shape");
  const std::string order = entry(text, "fortran_order");
  if (order != "False" && order != "True") fail("its header says nothing of fortran_order");
  header.fortran_order = order == "True";
  header.bytes = preamble + size;
  return header;
}

}  // namespace voxmelt::scene
