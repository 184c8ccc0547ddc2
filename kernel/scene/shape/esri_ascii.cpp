// ESRI ASCII grids are read as programs write them (GDAL, GRASS, QGIS, ArcGIS), and people by hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestGridFile = std::size_t{1} << 30;
constexpr int kLargestSide = 8192;
constexpr double kHighest = 1e9;
constexpr double kMissing = 2 * kHighest;  // no elevation is so high
constexpr double kUsualNoData = -9999;     // if no header names another

constexpr std::string_view kBlanks = " \t\r\v\f\x1a";  // the last one ends files of DOS
constexpr std::array<std::string_view, 7> kOtherKeys{"xllcorner", "yllcorner", "xllcenter", "yllcenter",
                                                     "cellsize",  "dx",        "dy"};

// Both treat ASCII alone, whatever the locale is.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// Tells if a word says that there is no number.
bool says_nothing(std::string_view word) {
  const std::string text = lower(word);
  return text == "nan" || text == "-nan" || text == "null";
}

class EsriParser {
 public:
  EsriParser(std::string_view text, const std::string& file, const Place& place)
      : text_(text), file_(file), place_(place) {}

  Elevation parse() {
    header();
    if (elevation_.columns == 0 || elevation_.rows == 0)
      fail("ncols and nrows must come before the elevations");
    const std::size_t wanted = static_cast<std::size_t>(elevation_.columns) * elevation_.rows;
    // `line_` already holds the first line of elevations.
    do {
      for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
        if (elevation_.value.size() == wanted)
          fail(fmt::format("more than {} x {} elevations", elevation_.columns, elevation_.rows));
        add(word);
      }
    } while (next_line());
    if (elevation_.value.size() != wanted)
      fail(fmt::format("the file ends after {} of {} elevations", elevation_.value.size(), wanted));
    fill_missing();
    return std::move(elevation_);
  }

 private:
  bool next_line() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_number_;
    return true;
  }

  // Returns the next word of the line. It is empty if there is none left.
  std::string_view next_word() {
    const std::size_t begin = line_.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    const std::size_t end = std::min(line_.find_first_of(kBlanks, begin), line_.size());
    const std::string_view word = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return word;
  }

  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, line_number_, message));
  }

  double number(std::string_view word) const {
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value)) return value;
    const bool comma = end != digits.data() + digits.size() && *end == ',';
    fail(fmt::format("'{}' is not a number{}", word.substr(0, 40),
                     comma ? ": decimals begin with a point" : ""));
  }

  void add(std::string_view word) {
    if (says_nothing(word)) return elevation_.value.push_back(kMissing);
    const double value = number(word);
    if (is_missing(value)) return elevation_.value.push_back(kMissing);
    if (std::abs(value) > kHighest)
      fail(fmt::format("'{}' is no elevation; where it means that there is none, NODATA_value must name it",
                       word.substr(0, 40)));
    elevation_.value.push_back(value);
  }

  bool is_missing(double value) const {
    return elevation_.names_missing ? value == no_data_ : value == kUsualNoData;
  }

  void header() {
    while (next_line()) {
      const std::string_view line = line_;
      const std::string_view key = next_word();
      if (key.empty()) continue;
      if (!is_letter(key[0]) || says_nothing(key)) {
        line_ = line;
        return;
      }
      const std::string_view word = next_word();
      if (word.empty()) fail(std::string(key) + " has no value");
      read_key(lower(key), word);
      if (const std::string_view more = next_word(); !more.empty())
        fail(fmt::format("{} has one value, and not '{}' as well", key, more.substr(0, 40)));
    }
    fail("the file ends before its elevations");
  }

  void read_key(const std::string& key, std::string_view word) {
    if (key == "ncols" || key == "nrows") {
      const double value = number(word);
      if (value != std::floor(value) || value < 2 || value > kLargestSide)
        fail(fmt::format("{} = {} is outside 2..{}", key, word, kLargestSide));
      (key == "ncols" ? elevation_.columns : elevation_.rows) = static_cast<int>(value);
    } else if (key == "nodata_value" || key == "nodata") {
      if (!says_nothing(word)) no_data_ = number(word);
      elevation_.names_missing = true;
    } else if (std::find(kOtherKeys.begin(), kOtherKeys.end(), key) == kOtherKeys.end()) {
      fail(fmt::format("unknown header '{}'", key.substr(0, 40)));
    } else {
      const double value = number(word);
      const bool is_size = key == "cellsize" || key == "dx" || key == "dy";
      if (is_size && value <= 0) fail(fmt::format("{} = {} is no size", key, word));
      if (key == "dx" || key == "cellsize") elevation_.cell_x = value;
      if (key == "dy" || key == "cellsize") elevation_.cell_y = value;
    }
  }

  void fill_missing() {
    double lowest = kMissing;
    for (const double value : elevation_.value) lowest = std::min(lowest, value);
    if (lowest == kMissing) fail("every cell is without data");
    for (double& value : elevation_.value)
      if (value == kMissing) {
        value = lowest;
        ++elevation_.missing;
      }
  }

  std::string_view text_, line_;
  const std::string& file_;
  const Place& place_;
  long long line_number_ = 0;
  Elevation elevation_;
  std::optional<double> no_data_;
};

}  // namespace

Elevation read_esri_ascii(const std::filesystem::path& file, const Place& place) {
  const std::string name = file.string();
  const std::string text = read_text_file(file, kLargestGridFile, place.text());
  return EsriParser(without_mark(text, place, name), name, place).parse();
}

}  // namespace voxmelt::scene
