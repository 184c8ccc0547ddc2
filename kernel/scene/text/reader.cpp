#include "kernel/scene/text/reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernel/scene/text/suggestion.h"

namespace voxmelt::scene {
namespace {

[[noreturn]] void fail_kind(const Value& value, const std::string& name, const std::string& expected) {
  fail_at(value.place, fmt::format("{} must be {}, not {}", name, expected, name_of(value.kind)));
}

}  // namespace

double checked_number(const Value& value, const std::string& name, const Range& range) {
  if (value.kind != Value::Kind::real && value.kind != Value::Kind::integer)
    fail_kind(value, name, "a number");
  const double number = value.real;
  if (!std::isfinite(number))
    fail_at(value.place, fmt::format("{} = {} is not a finite number", name, number));
  if (number < range.lowest)
    fail_at(value.place, fmt::format("{} = {} is below {}", name, number, range.lowest));
  if (range.above && number == range.lowest)
    fail_at(value.place, fmt::format("{} = {} must be more than {}", name, number, range.lowest));
  if (number > range.highest)
    fail_at(value.place, fmt::format("{} = {} exceeds {}{}", name, number, range.highest,
                                     range.why.empty() ? "" : ", " + range.why));
  return number;
}

Reader::Reader(const Value& table, std::string path) : table_(&table), path_(std::move(path)) {
  if (table.kind != Value::Kind::table) fail_kind(table, path_, "a table");
}

std::string Reader::name(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const Place& Reader::place(std::string_view key) const {
  const Value* value = table_->find(key);
  return value ? value->place : table_->place;
}

bool Reader::has(std::string_view key) { return find(key) != nullptr; }

const Value* Reader::find(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return table_->find(key);
}

const Value* Reader::find_or_fail(std::string_view key, bool required) {
  const Value* value = find(key);
  if (value || !required) return value;
  // If a key is missing, a misspelt one is the better message.
  for (std::size_t i = 0; i < table_->keys.size(); ++i) {
    const std::string& present = table_->keys[i];
    if (std::find(asked_.begin(), asked_.end(), present) == asked_.end() &&
        std::find(known_.begin(), known_.end(), present) == known_.end() && edit_distance(present, key) <= 2)
      fail_unknown(i);
  }
  fail_at(table_->place, name(key) + " is missing");
}

void Reader::fail(std::string_view key, const std::string& rest) const {
  fail_at(place(key), name(key) + rest);
}

void Reader::fail_unknown(std::size_t index) const {
  const std::string near = nearest_name(table_->keys[index], asked_);
  fail_at(table_->items[index].key_place, "unknown key " + name(table_->keys[index]) +
                                              (near.empty() ? "" : "; did you mean " + name(near) + "?"));
}

void Reader::finish() const {
  // The order is that of the file, not of the keys.
  std::optional<std::size_t> first;
  for (std::size_t i = 0; i < table_->keys.size(); ++i) {
    if (std::find(asked_.begin(), asked_.end(), table_->keys[i]) != asked_.end()) continue;
    const auto order = [&](std::size_t k) {
      const Place& place = table_->items[k].key_place;
      return std::pair(place.line, place.column);
    };
    if (!first || order(i) < order(*first)) first = i;
  }
  if (first) fail_unknown(*first);
}

double Reader::number(std::string_view key, const Range& range, std::optional<double> fallback) {
  const Value* value = find_or_fail(key, !fallback);
  return value ? checked_number(*value, name(key), range) : *fallback;
}

std::int64_t Reader::checked_integer(std::string_view key, std::int64_t lowest, std::int64_t highest,
                                     std::optional<std::int64_t> fallback) {
  const Value* value = find_or_fail(key, !fallback);
  if (!value) return *fallback;
  if (value->kind != Value::Kind::integer) fail_kind(*value, name(key), "an integer");
  if (value->integer < lowest || value->integer > highest)
    fail_at(value->place,
            fmt::format("{} = {} is outside {}..{}", name(key), value->integer, lowest, highest));
  return value->integer;
}

bool Reader::flag(std::string_view key, bool fallback) {
  const Value* value = find(key);
  if (!value) return fallback;
  if (value->kind != Value::Kind::boolean) fail_kind(*value, name(key), "true or false");
  return value->boolean;
}

std::string Reader::text(std::string_view key, std::optional<std::string> fallback) {
  const Value* value = find_or_fail(key, !fallback);
  if (!value) return *fallback;
  if (value->kind != Value::Kind::text) fail_kind(*value, name(key), "a string");
  return value->text;
}

std::size_t Reader::choice(std::string_view key, const std::vector<std::string>& names,
                           std::optional<std::size_t> fallback) {
  const Value* value = find_or_fail(key, !fallback);
  if (!value) return *fallback;
  if (value->kind != Value::Kind::text) fail_kind(*value, name(key), "a string");
  const auto at = std::find(names.begin(), names.end(), value->text);
  if (at == names.end())
    fail_at(value->place,
            fmt::format("{} = \"{}\" is not one of {}", name(key), value->text, fmt::join(names, ", ")));
  return at - names.begin();
}

std::filesystem::path Reader::file(std::string_view key) {
  const std::string named = text(key);
  if (named.empty()) fail(key, " is empty");
  return (table_->find(key)->place.origin->folder / named).lexically_normal();
}

std::optional<std::vector<double>> Reader::numbers(std::string_view key, std::size_t count,
                                                   const Range& range, bool required) {
  const Value* value = find_or_fail(key, required);
  if (!value) return {};
  if (value->kind != Value::Kind::array)
    fail_kind(*value, name(key), fmt::format("an array of {} numbers", count));
  if (value->items.size() != count)
    fail_at(value->place,
            fmt::format("{} must have {} numbers, not {}", name(key), count, value->items.size()));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(checked_number(value->items[i], fmt::format("{}.{}", name(key), i), range));
  return result;
}

std::vector<double> Reader::rows(std::string_view key, std::size_t width, std::size_t lowest,
                                 std::size_t highest, const Range& range) {
  const Value& value = *find_or_fail(key, true);
  if (value.kind != Value::Kind::array) fail_kind(value, name(key), "an array of arrays");
  if (value.items.size() < lowest || value.items.size() > highest)
    fail_at(value.place,
            fmt::format("{} must have {}..{} rows, not {}", name(key), lowest, highest, value.items.size()));
  std::vector<double> result;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const Value& row = value.items[i];
    const std::string row_name = fmt::format("{}.{}", name(key), i);
    if (row.kind != Value::Kind::array || row.items.size() != width)
      fail_at(row.place, fmt::format("{} must be an array of {} numbers", row_name, width));
    for (std::size_t k = 0; k < width; ++k)
      result.push_back(checked_number(row.items[k], fmt::format("{}.{}", row_name, k), range));
  }
  return result;
}

std::vector<const Value*> Reader::texts(std::string_view key) {
  const Value& value = *find_or_fail(key, true);
  if (value.kind != Value::Kind::array) fail_kind(value, name(key), "an array of strings");
  if (value.items.empty()) fail(key, " is empty");
  std::vector<const Value*> result;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (value.items[i].kind != Value::Kind::text)
      fail_kind(value.items[i], fmt::format("{}.{}", name(key), i), "a string");
    result.push_back(&value.items[i]);
  }
  return result;
}

std::optional<Reader> Reader::table(std::string_view key) {
  const Value* value = find(key);
  if (!value) return {};
  return Reader(*value, name(key));
}

std::vector<Reader> Reader::tables(std::string_view key) {
  std::vector<Reader> result;
  const Value* value = find(key);
  if (!value) return result;
  if (value->kind != Value::Kind::array)
    fail_kind(*value, name(key), "an array of tables ([[" + name(key) + "]])");
  for (std::size_t i = 0; i < value->items.size(); ++i)
    result.emplace_back(value->items[i], fmt::format("{}.{}", name(key), i));
  return result;
}

}  // namespace voxmelt::scene
