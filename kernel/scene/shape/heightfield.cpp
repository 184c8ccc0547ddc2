#include "kernel/scene/shape/heightfield.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kLargestGridFile = std::size_t{1} << 30;
constexpr int kLargestSide = 8192;
constexpr double kHighest = 1e9;

class EsriParser {
 public:
  EsriParser(const std::string& text, const std::string& file, const Place& place)
      : lines_(text), file_(file), place_(place) {}

  Elevation parse() {
    header();
    if (elevation_.columns == 0 || elevation_.rows == 0)
      fail("ncols and nrows must come before the elevations");
    const std::size_t wanted =
        static_cast<std::size_t>(elevation_.columns) * static_cast<std::size_t>(elevation_.rows);
    // `line_` already holds the first line of elevations.
    do {
      std::istringstream words(line_);
      std::string word;
      while (words >> word) {
        if (elevation_.value.size() == wanted)
          fail(fmt::format("more than {} x {} elevations", elevation_.columns, elevation_.rows));
        elevation_.value.push_back(number(word));
      }
    } while (next());
    if (elevation_.value.size() != wanted)
      fail(fmt::format("the file ends after {} of {} elevations", elevation_.value.size(), wanted));
    fill_missing();
    return std::move(elevation_);
  }

 private:
  bool next() {
    if (!std::getline(lines_, line_)) return false;
    ++line_number_;
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const {
    fail_at(place_, fmt::format("{}:{}: {}", file_, line_number_, message));
  }

  double number(const std::string& word) const {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value) || std::abs(value) > kHighest)
      fail(fmt::format("'{}' is not an elevation", word.substr(0, 40)));
    return value;
  }

  void header() {
    while (next()) {
      std::istringstream words(line_);
      std::string key, word;
      if (!(words >> key)) continue;
      if (std::isalpha(static_cast<unsigned char>(key[0])) == 0) return;
      if (!(words >> word)) fail(key + " has no value");
      const double value = number(word);
      std::transform(key.begin(), key.end(), key.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      if (key == "ncols" || key == "nrows") {
        if (value != std::floor(value) || value < 2 || value > kLargestSide)
          fail(fmt::format("{} = {} is outside 2..{}", key, word, kLargestSide));
        (key == "ncols" ? elevation_.columns : elevation_.rows) = static_cast<int>(value);
      } else if (key == "nodata_value") {
        no_data_ = value;
      } else if (key != "xllcorner" && key != "yllcorner" && key != "xllcenter" && key != "yllcenter" &&
                 key != "cellsize") {
        fail(fmt::format("unknown header '{}'", key.substr(0, 40)));
      }
    }
    fail("the file ends before its elevations");
  }

  void fill_missing() {
    if (!no_data_) return;
    double lowest = 2 * kHighest;
    for (const double value : elevation_.value)
      if (value != *no_data_) lowest = std::min(lowest, value);
    if (lowest > kHighest) fail("every cell is without data");
    for (double& value : elevation_.value)
      if (value == *no_data_) {
        value = lowest;
        ++elevation_.missing;
      }
  }

  std::istringstream lines_;
  std::string line_;
  const std::string& file_;
  const Place& place_;
  long long line_number_ = 0;
  Elevation elevation_;
  std::optional<double> no_data_;
};

std::array<double, 4> spline_weights(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
          t * t * t / 6};
}

}  // namespace

double Elevation::at(int column, int row) const {
  const int c = std::clamp(column, 0, columns - 1), r = std::clamp(row, 0, rows - 1);
  return value[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
}

Elevation read_esri_ascii(const std::filesystem::path& file, const Place& place) {
  const std::string name = file.string();
  return EsriParser(read_text_file(file, kLargestGridFile, place.text()), name, place).parse();
}

void smooth(Elevation& elevation, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const Elevation before = elevation;
    for (int r = 0; r < before.rows; ++r)
      for (int c = 0; c < before.columns; ++c) {
        const auto row = [&](int k) {
          return before.at(c - 1, k) + 2 * before.at(c, k) + before.at(c + 1, k);
        };
        elevation.value[static_cast<std::size_t>(r) * static_cast<std::size_t>(before.columns) +
                        static_cast<std::size_t>(c)] = (row(r - 1) + 2 * row(r) + row(r + 1)) / 16;
      }
  }
}

std::vector<double> resample(const Elevation& elevation, int nx, int nz) {
  const double lowest = *std::min_element(elevation.value.begin(), elevation.value.end());
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(nz));
  for (int z = 0; z < nz; ++z) {
    const double v = (z + 0.5) / nz * elevation.rows - 0.5;
    const int row = static_cast<int>(std::floor(v));
    const auto row_weights = spline_weights(v - row);
    for (int x = 0; x < nx; ++x) {
      const double u = (x + 0.5) / nx * elevation.columns - 0.5;
      const int column = static_cast<int>(std::floor(u));
      const auto column_weights = spline_weights(u - column);
      double sum = 0;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          sum += row_weights[static_cast<std::size_t>(j)] * column_weights[static_cast<std::size_t>(i)] *
                 elevation.at(column - 1 + i, row - 1 + j);
      result.push_back(sum - lowest);
    }
  }
  return result;
}

}  // namespace voxmelt::scene
