#include "app/shell_word.h"

#include <algorithm>
#include <string_view>

#include "kernel/scene/text/ascii.h"

namespace voxmelt::app {

std::string shell_word(std::string text) {
  if (text.starts_with('-')) text = "./" + text;
  const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return scene::is_letter(c) || scene::is_digit(c) ||
           std::string_view("_-./=,:+").find(c) != std::string_view::npos;
  });
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace voxmelt::app
