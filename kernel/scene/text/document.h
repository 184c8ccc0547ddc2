// A TOML document is held as plain values. They remember where they were written, so that every later message
// names its place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace voxmelt::scene {

struct Origin {
  std::string name;              // file as the user named it, or "--set path=value"
  std::filesystem::path folder;  // files named in the document are relative to it; empty: the current one
  bool is_override = false;
};

struct Place {
  std::shared_ptr<const Origin> origin;
  std::uint32_t line = 0, column = 0;  // from 1; 0: unknown

  std::string text() const;  // "file:line:column", or "--set path=value"
};

struct Value {
  enum class Kind : std::uint8_t { boolean, integer, real, text, array, table, date };

  Kind kind = Kind::table;
  Place place;      // place of the value
  Place key_place;  // place of its key; in arrays that of the value
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;
  std::string text;
  std::vector<Value> items;       // elements of an array, or values of a table
  std::vector<std::string> keys;  // keys of a table, beside items

  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  Value& put(std::string key, Value value);  // adds or replaces
  void remove(std::string_view key);
};

const char* name_of(Value::Kind kind);  // "a number", "a string", ...

// Throws InputError "place: error: message".
[[noreturn]] void fail_at(const Place& place, const std::string& message);

// Reads and parses one file (at most 16 MiB). Throws InputError.
Value parse_file(const std::filesystem::path& file);
// Does the same for a text at hand. `origin` names it in messages.
Value parse_text(const std::string& text, const std::shared_ptr<const Origin>& origin);

// Parses one value in TOML syntax. A bare word is a string. It throws InputError with the name of `origin`.
Value parse_value(const std::string& text, const std::shared_ptr<const Origin>& origin);

}  // namespace voxmelt::scene
