#include "app/view/cells_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>

#include "voxmelt/errors.h"

namespace voxmelt::view {
namespace {

constexpr std::array<std::string_view, 3> kColours{"phase", "temperature", "sleep"};
constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

// Takes the first word off the text.
std::string_view next_word(std::string_view& text) {
  const std::size_t space = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, space);
  text.remove_prefix(std::min(space + 1, text.size()));
  return word;
}

template <class Name, std::size_t kCount>
Name named(std::string_view word, const std::array<std::string_view, kCount>& names, const char* what) {
  for (std::size_t i = 0; i < kCount; ++i)
    if (names[i] == word) return static_cast<Name>(i);
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  throw InputError("error: wants " + std::string(what) + ": one of " + all);
}

}  // namespace

std::optional<CellView> read_cells(std::string_view text) {
  if (text == "none") return std::nullopt;
  CellView view{named<CellColours>(next_word(text), kColours, "colours"), {}};
  if (text.empty()) return view;
  const Axis axis = named<Axis>(next_word(text), kAxes, "an axis");
  int at = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), at);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError("error: wants a whole number for the cut");
  view.cut = CellCut{axis, at};
  return view;
}

nlohmann::ordered_json json_of(const CellView& view) {
  nlohmann::ordered_json marks = nlohmann::ordered_json::array();
  for (const LegendMark& mark : legend(view.colours))
    marks.push_back({{"name", mark.name}, {"rgb", mark.rgb}});
  nlohmann::ordered_json json{{"colours", kColours[static_cast<std::size_t>(view.colours)]},
                              {"legend", marks}};
  if (view.cut)
    json["cut"] = {{"axis", kAxes[static_cast<std::size_t>(view.cut->axis)]}, {"at", view.cut->at}};
  return json;
}

}  // namespace voxmelt::view
