#include "kernel/scene/text/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/error.h"
#include "kernel/scene/text/guard.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestDocument = std::size_t{16} << 20;

Place place_of(const toml::source_region& region, const std::shared_ptr<const Origin>& origin) {
  return {origin, region.begin.line, region.begin.column};
}

Value convert(const toml::node& node, const std::shared_ptr<const Origin>& origin) {
  Value value;
  value.place = value.key_place = place_of(node.source(), origin);
  if (const auto* table = node.as_table()) {
    value.kind = Value::Kind::table;
    for (const auto& [key, child] : *table) {
      Value converted = convert(child, origin);
      converted.key_place = place_of(key.source(), origin);
      value.keys.emplace_back(key.str());
      value.items.push_back(std::move(converted));
    }
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const auto& child : *array) value.items.push_back(convert(child, origin));
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Value::Kind::integer;
    value.integer = integer->get();
    value.real = static_cast<double>(value.integer);
  } else if (const auto* real = node.as_floating_point()) {
    value.kind = Value::Kind::real;
    value.real = real->get();
  } else if (const auto* text = node.as_string()) {
    value.kind = Value::Kind::text;
    value.text = text->get();
  } else {
    value.kind = Value::Kind::date;
  }
  return value;
}

bool is_bare_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-' || c == '.' || c == '/';
  });
}

void check(const std::string& text, const std::shared_ptr<const Origin>& origin) {
  const Objection objection = object_to(text);
  if (objection.text.empty()) return;
  fail_at({origin, static_cast<std::uint32_t>(objection.line), static_cast<std::uint32_t>(objection.column)},
          objection.text);
}

}  // namespace

std::string Place::text() const {
  if (!origin) return "scene";
  if (origin->is_override || line == 0) return origin->name;
  return fmt::format("{}:{}:{}", origin->name, line, column);
}

const Value* Value::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i] == key) return &items[i];
  return nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
}

Value& Value::put(std::string key, Value value) {
  if (Value* old = find(key)) return *old = std::move(value);
  keys.push_back(std::move(key));
  return items.emplace_back(std::move(value));
}

void Value::remove(std::string_view key) {
  const auto at = std::find(keys.begin(), keys.end(), key);
  if (at == keys.end()) return;
  items.erase(items.begin() + (at - keys.begin()));
  keys.erase(at);
}

const char* name_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::boolean:
      return "true or false";
    case Value::Kind::integer:
      return "an integer";
    case Value::Kind::real:
      return "a number";
    case Value::Kind::text:
      return "a string";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::table:
      return "a table";
    case Value::Kind::date:
      break;
  }
  return "a date";
}

void fail_at(const Place& place, const std::string& message) {
  throw InputError(place.text() + ": error: " + message);
}

Value parse_file(const std::filesystem::path& file) {
  auto origin = std::make_shared<const Origin>(Origin{file.string(), file.parent_path(), false});
  return parse_text(read_text_file(file, kLargestDocument, origin->name), origin);
}

Value parse_text(const std::string& text, const std::shared_ptr<const Origin>& origin) {
  check(text, origin);
  try {
    return convert(toml::parse(text, origin->name), origin);
  } catch (const toml::parse_error& error) {
    fail_at(place_of(error.source(), origin), std::string(error.description()));
  }
}

Value parse_value(const std::string& text, const std::shared_ptr<const Origin>& origin) {
  const Place place{origin, 0, 0};
  if (const Objection objection = object_to("value = " + text);
      !objection.text.empty() && !is_bare_word(text))
    fail_at(place, objection.text);
  if (text.find_first_of("\r\n") != std::string::npos) fail_at(place, "the value must be one line");
  try {
    const toml::table table = toml::parse("value = " + text);
    return convert(*table.get("value"), origin);
  } catch (const toml::parse_error& error) {
    if (!is_bare_word(text)) fail_at(place, "not a TOML value: " + std::string(error.description()));
  }
  Value value;
  value.kind = Value::Kind::text;
  value.text = text;
  value.place = value.key_place = place;
  return value;
}

}  // namespace voxmelt::scene
