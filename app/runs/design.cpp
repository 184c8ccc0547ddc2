#include "app/runs/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "kernel/scene/text/ascii.h"

namespace voxmelt::app {
namespace {

constexpr std::size_t kLongestName = 100;

// Gives a sequence of 64 random bits each (SplitMix64), the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double share() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // 0 up to, but without, 1
  std::size_t below(std::size_t bound) { return next() % bound; }

 private:
  std::uint64_t state_;
};

// Takes one value from each of `count` equal parts of the axis, in an order of chance.
std::vector<AxisValue> sampled(const Axis& axis, std::size_t count, Random& random) {
  std::vector<std::size_t> parts(count);
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(parts[i - 1], parts[random.below(i)]);
  std::vector<AxisValue> values;
  for (const std::size_t part : parts) {
    if (!axis.range) {
      values.push_back(axis.values[part * axis.values.size() / count]);
      continue;
    }
    const AxisRange& range = *axis.range;
    const double share = (static_cast<double>(part) + random.share()) / static_cast<double>(count);
    if (range.whole && !range.logarithmic) {
      const double value = range.from + std::floor((range.to - range.from + 1) * share);
      values.push_back(number_value(value, true, axis.place));
    } else {
      const double value = range.logarithmic ? range.from * std::pow(range.to / range.from, share)
                                             : range.from + (range.to - range.from) * share;
      values.push_back(number_value(value, false, axis.place));
    }
  }
  return values;
}

using Rows = std::vector<std::vector<AxisValue>>;

Rows latin_hypercube(const Plan& plan) {
  Random random(plan.seed);
  Rows rows(plan.runs);
  for (const Axis& axis : plan.axes) {
    const std::vector<AxisValue> column = sampled(axis, plan.runs, random);
    for (std::size_t i = 0; i < plan.runs; ++i) rows[i].push_back(column[i]);
  }
  return rows;
}

Rows list(const Plan& plan) {
  const Axis& first = plan.axes.front();
  for (const Axis& axis : plan.axes)
    if (axis.values.size() != first.values.size())
      fail_axis(axis.place, axis.key,
                fmt::format(" has {} values and axes.{} has {}; with design = \"list\" all have equally many",
                            axis.values.size(), first.key, first.values.size()));
  Rows rows(first.values.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Axis& axis : plan.axes) rows[i].push_back(axis.values[i]);
  return rows;
}

Rows grid(const Plan& plan) {
  Rows rows(1);
  for (const Axis& axis : plan.axes) {
    if (rows.size() * axis.values.size() > kMostRuns)
      fail_axis(axis.place, axis.key,
                fmt::format(" makes {} runs or more; a sweep has {} at most",
                            rows.size() * axis.values.size(), kMostRuns));
    Rows longer;
    for (const std::vector<AxisValue>& row : rows)
      for (const AxisValue& value : axis.values) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    rows = std::move(longer);
  }
  return rows;
}

// Returns the ends of the keys, as short as they differ: "power", or "0.power" and "1.power".
std::vector<std::string> short_keys(const Plan& plan) {
  std::vector<std::string> names;
  for (const Axis& axis : plan.axes) {
    std::size_t begin = axis.key.size();
    const auto is_shared = [&] {
      const std::string end = begin == 0 ? axis.key : axis.key.substr(begin - 1);
      return std::ranges::any_of(plan.axes, [&](const Axis& other) {
        return &other != &axis && (other.key.ends_with(end) || "." + other.key == end);
      });
    };
    do begin = begin < 2 ? 0 : axis.key.rfind('.', begin - 2) + 1;
    while (begin > 0 && is_shared());
    names.push_back(axis.key.substr(begin));
  }
  return names;
}

bool is_plain(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return scene::is_letter(c) || scene::is_digit(c) || c == '.' || c == '-' || c == '_' || c == '+';
  });
}

// Returns 32 bits of FNV-1a: a name for what does not fit into one.
std::uint32_t digest_of(const std::string& text) {
  std::uint32_t digest = 0x811c9dc5;
  for (const char c : text) digest = (digest ^ static_cast<unsigned char>(c)) * 0x01000193;
  return digest;
}

// Returns "gamma_0.1__power_20". A value that is no plain word is named by a digest.
std::string name_of(const std::vector<std::string>& keys, const std::vector<AxisValue>& values) {
  std::string name, all;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::string word = values[i].text;
    if (word.size() > 2 && word.front() == '"') word = word.substr(1, word.size() - 2);
    if (!is_plain(word) || word.size() > 24) word = fmt::format("{:08x}", digest_of(word));
    if (!name.empty()) name += "__";
    name.append(keys[i]).append(1, '_').append(word);
    all += keys[i] + '=' + values[i].text + '\n';
  }
  if (name.size() <= kLongestName && is_plain(name)) return name;
  return fmt::format("run_{:08x}", digest_of(all));
}

}  // namespace

std::string set_of(const Axis& axis, const AxisValue& value) { return axis.key + '=' + value.text; }

std::vector<PlannedRun> runs_of(const Plan& plan) {
  Rows rows = plan.design == Design::grid   ? grid(plan)
              : plan.design == Design::list ? list(plan)
                                            : latin_hypercube(plan);
  const std::vector<std::string> keys = short_keys(plan);
  std::vector<PlannedRun> runs;
  std::map<std::string, std::size_t> named;
  for (std::vector<AxisValue>& row : rows) {
    PlannedRun run{name_of(keys, row), std::move(row)};
    const auto [same, is_new] = named.emplace(run.name, runs.size());
    if (!is_new)
      fail_axis(
          run.values.back().place, plan.axes.back().key,
          fmt::format(": runs {} and {} are the same ({})", same->second + 1, runs.size() + 1, run.name));
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace voxmelt::app
