// Lines of text, and the words of a line.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include "kernel/scene/mesh_file/formats.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {

inline constexpr std::string_view kBlanks = " \t\r\v\f";

// Takes the first word off a line. It is empty at the line's end.
inline std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

// Returns what is left of a line, without the blanks around it.
inline std::string_view rest_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  return line.substr(0, line.find_last_not_of(kBlanks) + 1);
}

// Reads a whole number. from_chars knows no sign +.
inline std::optional<std::int64_t> whole_number_in(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  std::int64_t number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

// Reads a coordinate. Nothing is returned if the word is none.
inline std::optional<double> coordinate_in(std::string_view word) {
  const std::optional<double> value = real_number_in(word);
  return value && is_coordinate(*value) ? value : std::nullopt;
}

// Takes line after line, and counts them from 1.
class Lines {
 public:
  explicit Lines(std::string_view text) : left_(text), end_(line_end_of(text)) {}

  // Gives the next line that is not blank, or nothing at the end.
  std::optional<std::string_view> next() {
    while (!left_.empty()) {
      const std::string_view line = left_.substr(0, left_.find(end_));
      left_.remove_prefix(std::min(line.size() + 1, left_.size()));
      ++number_;
      if (line.find_first_not_of(kBlanks) != std::string_view::npos) return line;
    }
    return std::nullopt;
  }
  std::int64_t number() const { return number_; }
  std::string_view left() const { return left_; }  // what comes behind the last line

 private:
  std::string_view left_;
  char end_;
  std::int64_t number_ = 0;
};

}  // namespace voxmelt::scene
