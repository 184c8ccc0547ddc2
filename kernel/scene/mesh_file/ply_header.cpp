#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/scene/mesh_file/ply.h"
#include "kernel/scene/mesh_file/words.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestHeader = std::size_t{1} << 16;  // bytes

// Each type has two names, in the order of PlyType.
constexpr std::array<std::array<std::string_view, 2>, 8> kTypeNames{{{"char", "int8"},
                                                                     {"uchar", "uint8"},
                                                                     {"short", "int16"},
                                                                     {"ushort", "uint16"},
                                                                     {"int", "int32"},
                                                                     {"uint", "uint32"},
                                                                     {"float", "float32"},
                                                                     {"double", "float64"}}};

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& file, const Place& place)
      : text_(text.substr(0, kLargestHeader)), lines_(text_), file_(file), place_(place) {}

  PlyHeader read() {
    std::optional<std::string_view> line = lines_.next();
    if (!line || rest_of(*line) != "ply") fail("a PLY file begins with the line `ply`");
    bool has_format = false;
    while ((line = lines_.next())) {
      const std::string_view word = take_word(*line);
      if (word == "end_header") {
        if (!has_format) fail("the header has no line `format`");
        header_.bytes = text_.size() - lines_.left().size();
        header_.lines = lines_.number();
        return std::move(header_);
      }
      if (word == "format") {
        format(*line);
        has_format = true;
      } else if (word == "element") {
        element(*line);
      } else if (word == "property") {
        property(*line);
      } else if (word != "comment" && word != "obj_info") {
        fail(in_quotes(word) + " begins no line of a PLY header");
      }
    }
    fail("the header has no line `end_header`: is the file truncated?");
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, lines_.number(), message));
  }

  void format(std::string_view line) {
    constexpr std::array<std::string_view, 3> names{"ascii", "binary_little_endian", "binary_big_endian"};
    const std::string_view word = take_word(line);
    const auto* const found = std::find(names.begin(), names.end(), word);
    if (found == names.end() || take_word(line) != "1.0")
      fail("the format must be ascii, binary_little_endian or binary_big_endian, and 1.0");
    header_.coding = static_cast<PlyCoding>(found - names.begin());
  }

  void element(std::string_view line) {
    const std::string_view name = take_word(line), count = take_word(line);
    const std::optional<std::int64_t> number = whole_number_in(count);
    if (name.empty() || !number || *number < 0)
      fail("an element needs a name, and a number of them from 0 on");
    header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*number), {}});
  }

  PlyType type(std::string_view word) const {
    for (std::size_t i = 0; i < kTypeNames.size(); ++i)
      if (word == kTypeNames[i][0] || word == kTypeNames[i][1]) return static_cast<PlyType>(i);
    fail(in_quotes(word) + " is no type of a property");
  }

  void property(std::string_view line) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view word = take_word(line);
    property.is_list = word == "list";
    if (property.is_list) {
      property.count = type(take_word(line));
      if (!is_whole(property.count)) fail("the length of a list must have a whole type");
      word = take_word(line);
    }
    property.type = type(word);
    property.name = take_word(line);
    if (property.name.empty()) fail("a property needs a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  std::string_view text_;
  Lines lines_;
  const std::string& file_;
  const Place& place_;
  PlyHeader header_;
};

}  // namespace

std::size_t PlyElement::find(std::string_view property) const {
  return std::find_if(properties.begin(), properties.end(),
                      [&](const PlyProperty& one) { return one.name == property; }) -
         properties.begin();
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& file, const Place& place) {
  return HeaderReader(bytes, file, place).read();
}

}  // namespace voxmelt::scene
