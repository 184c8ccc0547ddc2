#include "kernel/scene/text/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxmelt::scene {
namespace {

bool is_bare(const std::string& key) {
  return !key.empty() &&
         key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
             std::string::npos;
}

std::string key_text(const std::string& key) { return is_bare(key) ? key : toml_string(key); }

// Returns the shortest text that gives the same bits again, and is no integer.
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
      return toml_string(value.text);
    case Value::Kind::array:
      for (const Value& item : value.items) inside += (inside.empty() ? "" : ", ") + print(item);
      return "[" + inside + "]";
    case Value::Kind::table:
      for (std::size_t i = 0; i < value.keys.size(); ++i)
        inside += (i == 0 ? "" : ", ") + key_text(value.keys[i]) + " = " + print(value.items[i]);
      return "{" + inside + "}";
    case Value::Kind::date:
      break;
  }
  return "1970-01-01";
}

bool is_tables(const Value& value) {
  return value.kind == Value::Kind::array && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(),
                     [](const Value& item) { return item.kind == Value::Kind::table; });
}

// Returns the keys of a table, then its own tables, and at the top its arrays of tables.
std::string table_text(const Value& table, const std::string& path) {
  std::string text;
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (table.items[i].kind != Value::Kind::table && (!path.empty() || !is_tables(table.items[i])))
      text += fmt::format("{} = {}\n", key_text(table.keys[i]), print(table.items[i]));
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const Value& item = table.items[i];
    const std::string name = (path.empty() ? "" : path + '.') + key_text(table.keys[i]);
    if (item.kind == Value::Kind::table) text += fmt::format("\n[{}]\n", name) + table_text(item, name);
    if (path.empty() && is_tables(item))
      for (const Value& one : item.items) text += fmt::format("\n[[{}]]\n", name) + table_text(one, name);
  }
  return text;
}

}  // namespace

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const unsigned char code = c;
    if (c == '"' || c == '\\')
      result += std::string("\\") + c;
    else if (code < 0x20 || code == 0x7f)
      result += fmt::format("\\u{:04x}", code);
    else
      result += c;
  }
  return result + '"';
}

std::string print_document(const Value& document) { return table_text(document, ""); }

}  // namespace voxmelt::scene
