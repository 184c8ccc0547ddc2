// A reader gives strict access to one table of a document. Every read checks type and range, and remembers
// the key. So finish() can refuse every key that no read has asked for. Paths in messages are those of --set:
// heat_source.0.power.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/scene/text/document.h"
#include "kernel/scene/text/range.h"

namespace voxmelt::scene {

class Reader {
 public:
  Reader(const Value& table, std::string path);

  // Names keys that will be asked for, so that none of them is taken for a misspelling of another one.
  void knows(std::span<const char* const> keys) { known_.insert(known_.end(), keys.begin(), keys.end()); }

  bool has(std::string_view key);
  Value::Kind kind(std::string_view key) const { return table_->find(key)->kind; }  // the key must be there
  std::string name(std::string_view key) const;                                     // full path of a key
  const Place& place() const { return table_->place; }
  // Returns the place of its value, or of the table if the key is missing.
  const Place& place(std::string_view key) const;

  // Each function gives the value of `key`. Without the key it gives the fallback, or throws InputError if
  // there is none.
  double number(std::string_view key, const Range& range, std::optional<double> fallback = {});
  // An integer has the type of its upper bound.
  template <std::integral T>
  T integer(std::string_view key, std::type_identity_t<T> lowest, T highest,
            std::optional<std::type_identity_t<T>> fallback = {}) {
    return static_cast<T>(checked_integer(key, lowest, highest, fallback));
  }
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  // Returns the index of the chosen name.
  std::size_t choice(std::string_view key, const std::vector<std::string>& names,
                     std::optional<std::size_t> fallback = {});
  // Returns a file named in the scene. It is relative to the scene file that names it, or with --set to the
  // current folder.
  std::filesystem::path file(std::string_view key);

  template <std::size_t N>
  std::array<double, N> vector(std::string_view key, const Range& range,
                               std::optional<std::array<double, N>> fallback = {}) {
    const std::optional<std::vector<double>> read = numbers(key, N, range, !fallback);
    std::array<double, N> result = fallback.value_or(std::array<double, N>{});
    for (std::size_t i = 0; read && i < N; ++i) result[i] = (*read)[i];
    return result;
  }
  // Reads a list of one string or more.
  std::vector<const Value*> texts(std::string_view key);
  // Reads a list of `lowest`..`highest` rows of `width` numbers each, row after row.
  std::vector<double> rows(std::string_view key, std::size_t width, std::size_t lowest, std::size_t highest,
                           const Range& range);

  std::optional<Reader> table(std::string_view key);
  std::vector<Reader> tables(std::string_view key);  // none if the key is missing

  // Complains about the value of `key`: "<place>: error: <path of key><rest>".
  [[noreturn]] void fail(std::string_view key, const std::string& rest) const;
  void finish() const;  // throws InputError for the first key that was never asked for

 private:
  const Value* find(std::string_view key);
  const Value* find_or_fail(std::string_view key, bool required);
  [[noreturn]] void fail_unknown(std::size_t index) const;
  std::int64_t checked_integer(std::string_view key, std::int64_t lowest, std::int64_t highest,
                               std::optional<std::int64_t> fallback);
  std::optional<std::vector<double>> numbers(std::string_view key, std::size_t count, const Range& range,
                                             bool required);

  const Value* table_;
  std::string path_;
  std::vector<std::string> asked_;
  std::vector<std::string_view> known_;  // keys that will be asked for
};

// Checks one number: its type, that it is finite, and its range. `name` is its full path.
double checked_number(const Value& value, const std::string& name, const Range& range);

}  // namespace voxmelt::scene
