#include "kernel/scene/text/print.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace voxmelt::scene {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04x}", code);
    else
      result += c;
  }
  return result + '"';
}

// The shortest text that gives the same bits again, and is no integer.
std::string number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string print(const Value& value) {
  std::string inside;
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::integer:
      return fmt::format("{}", value.integer);
    case Value::Kind::real:
      return number(value.real);
    case Value::Kind::text:
      return quoted(value.text);
    case Value::Kind::array:
      for (const Value& item : value.items) inside += (inside.empty() ? "" : ", ") + print(item);
      return "[" + inside + "]";
    case Value::Kind::table:
      for (std::size_t i = 0; i < value.keys.size(); ++i)
        inside += (i == 0 ? "" : ", ") + quoted(value.keys[i]) + " = " + print(value.items[i]);
      return "{" + inside + "}";
    case Value::Kind::date:
      break;
  }
  return "1970-01-01";
}

}  // namespace

std::string print_document(const Value& document) {
  std::string text;
  for (std::size_t i = 0; i < document.keys.size(); ++i)
    text += quoted(document.keys[i]) + " = " + print(document.items[i]) + "\n";
  return text;
}

}  // namespace voxmelt::scene
