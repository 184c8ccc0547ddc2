// ESRI ASCII grids are read as programs write them (GDAL, GRASS, QGIS, ArcGIS), and people by hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "kernel/scene/shape/heightfield.h"
#include "kernel/scene/text/ascii.h"
#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestGridFile = std::size_t{1} << 30;
constexpr int kLargestSide = kLargestElevationSide;
constexpr double kHighest = kHighestElevation, kMissing = kNoElevation;
constexpr double kUsualNoData = -9999;  // if no header names another

// Files of DOS end with the last but one, and padded ones with the last.
constexpr std::string_view kBlanks(" \t\r\v\f\x1a\0", 7);
constexpr std::array<std::string_view, 7> kOtherKeys{"xllcorner", "yllcorner", "xllcenter", "yllcenter",
                                                     "cellsize",  "dx",        "dy"};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_case(c);
  return result;
}

// Tells if a word says that there is no number.
bool says_nothing(std::string_view word) {
  std::string text = lower(word);
  if (text.starts_with('-') || text.starts_with('+')) text.erase(0, 1);
  return text == "nan" || text == "null" || text == "na" || text == "nan(ind)" || text == "nan(snan)" ||
         text.starts_with("1.#ind") || text.starts_with("1.#qnan") || text.starts_with("1.#snan");
}

class EsriParser {
 public:
  EsriParser(std::string_view text, const std::string& file, const Place& place)
      : text_(text), file_(file), place_(place) {}

  Elevation parse() {
    header();
    if (elevation_.columns == 0 || elevation_.rows == 0) fail(what_stands_first());
    const std::size_t wanted = static_cast<std::size_t>(elevation_.columns) * elevation_.rows;
    // `line_` already holds the first line of elevations.
    do {
      for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
        // Notes may follow.
        if (elevation_.value.size() == wanted && is_letter(word[0])) return finished();
        if (elevation_.value.size() == wanted)
          fail(fmt::format("more than {} x {} elevations", elevation_.columns, elevation_.rows));
        add(word);
      }
    } while (next_line());
    if (elevation_.value.size() != wanted)
      fail(fmt::format("the file ends after {} of {} elevations", elevation_.value.size(), wanted));
    return finished();
  }

 private:
  Elevation finished() {
    if (!fill_missing(elevation_)) fail("every cell is without data");
    return std::move(elevation_);
  }

  // Describes a line of numbers that came before the two sizes.
  std::string what_stands_first() {
    const std::string_view number = next_word(), key = next_word();
    if (key.empty() || !is_letter(key[0]) || says_nothing(key))
      return "ncols and nrows must come before the elevations";
    return fmt::format("{} stands before {}, which it belongs to: a key comes first, and then its value",
                       in_quotes(number), in_quotes(key));
  }

  bool next_line() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find(line_end_), text_.size());
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_number_;
    const std::size_t first = line_.find_first_not_of(kBlanks);
    if (first != std::string_view::npos && line_[first] == '#') line_ = {};  // a comment
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

  // It may be infinite.
  double number(std::string_view word) const {
    const std::optional<double> value = real_number_in(word);
    if (value && !std::isnan(*value)) return *value;
    const std::size_t digits = word.find_first_not_of("+-0123456789.");
    const bool comma = digits != std::string_view::npos && digits > 0 && word[digits] == ',';
    fail(fmt::format("{} is not a number{}", in_quotes(word), comma ? ": decimals begin with a point" : ""));
  }

  double finite_number(std::string_view word) const {
    const double value = number(word);
    if (!std::isfinite(value)) fail(fmt::format("{} is not a number", in_quotes(word)));
    return value;
  }

  void add(std::string_view word) {
    if (says_nothing(word)) return elevation_.value.push_back(kMissing);
    const double value = number(word);
    if (is_missing(value)) {
      elevation_.unnamed += elevation_.names_missing ? 0 : 1;
      return elevation_.value.push_back(kMissing);
    }
    if (std::abs(value) > kHighest)
      fail(fmt::format("{} is no elevation; where it means that there is none, NODATA_value must name it",
                       in_quotes(word)));
    elevation_.value.push_back(value);
  }

  // Many programs hold elevations in 32 bits, and write the header's number with other digits.
  bool is_missing(double value) const {
    if (!elevation_.names_missing) return value == kUsualNoData;
    if (!no_data_) return false;
    constexpr double kLargest = std::numeric_limits<float>::max();
    const bool are_floats = std::abs(value) <= kLargest && std::abs(*no_data_) <= kLargest;
    return value == *no_data_ || (are_floats && static_cast<float>(value) == static_cast<float>(*no_data_));
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
      if (const std::string other = lower(key); other == "dsaa" || other == "dsbb" || other == "north:")
        fail(fmt::format("this is a grid of {}; `gdal_translate -of AAIGrid` converts it",
                         other == "north:" ? "GRASS" : "Surfer"));
      const std::string_view word = next_word();
      if (word.empty()) fail(in_quotes(key) + " has no value");
      read_key(lower(key), word);
      if (const std::string_view more = next_word(); !more.empty())
        fail(fmt::format("{} has one value, and not {} as well", key, in_quotes(more)));
    }
    fail("the file ends before its elevations");
  }

  void read_key(const std::string& key, std::string_view word) {
    if (key == "ncols" || key == "nrows") {
      const double value = finite_number(word);
      if (value != std::floor(value) || value < 2 || value > kLargestSide)
        fail(fmt::format("{} = {} is outside 2..{}", key, word, kLargestSide));
      (key == "ncols" ? elevation_.columns : elevation_.rows) = static_cast<int>(value);
    } else if (key == "nodata_value" || key == "nodata") {
      if (!says_nothing(word)) no_data_ = number(word);
      elevation_.names_missing = true;
    } else if (std::find(kOtherKeys.begin(), kOtherKeys.end(), key) == kOtherKeys.end()) {
      fail("unknown header " + in_quotes(key));
    } else {
      const double value = finite_number(word);
      const bool is_size = key == "cellsize" || key == "dx" || key == "dy";
      if (is_size && value <= 0) fail(fmt::format("{} = {} is no size", key, word));
      if (key == "dx" || key == "cellsize") elevation_.cell_x = value;
      if (key == "dy" || key == "cellsize") elevation_.cell_y = value;
    }
  }

  std::string_view text_, line_;
  char line_end_ = line_end_of(text_);
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
  for (const std::string_view tiff :
       {std::string_view("II*\0", 4), std::string_view("MM\0*", 4), std::string_view("II+\0", 4)})
    if (text.starts_with(tiff)) fail_at(place, name + ": this is a TIFF; call it .tif");
  if (text.starts_with("\x89PNG")) fail_at(place, name + ": this is a PNG; call it .png");
  return EsriParser(without_mark(text, place, name), name, place).parse();
}

}  // namespace voxmelt::scene
