#include "hwmodel/explore/read_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace voxmelt::hwmodel::explore {
namespace {

const Source* source_of(const std::string& text) {
  const auto* at = std::find_if(kSources.begin(), kSources.end(),
                                [&](const Source& source) { return text.starts_with(source.name); });
  return at == kSources.end() ? nullptr : at;
}

// Returns the range that --set, the file, or the source tells.
std::array<double, 2> range_of(scene::Reader& from, const std::string& name, double value,
                               const scene::Range& allowed, double factor, const Given& given) {
  const std::string key = name + "_range";
  const std::array by_source{std::max(allowed.lowest, value / factor),
                             std::min(allowed.highest, value * factor)};
  const std::array<double, 2> range = from.vector<2>(key, allowed, by_source);
  if (given.contains(from.name(name)) && !given.contains(from.name(key))) return {value, value};
  if (range[0] > value || value > range[1])
    from.fail(key, fmt::format(" = [{}, {}] does not hold {} = {}", range[0], range[1], name, value));
  return range;
}

}  // namespace

std::string read_source(scene::Reader& from, const std::string& key,
                        const std::optional<std::string>& missing) {
  const std::string text = from.text(key, missing);
  if (source_of(text) == nullptr) from.fail(key, ": it must begin with synthesised, counted or assumed");
  return text;
}

Ranged<std::int64_t> read_logic(scene::Reader& from, const std::string& name, const std::string& source,
                                const Given& given) {
  Ranged<std::int64_t> number;
  number.value = from.integer(name, 0, kMostUnits);
  number.source = read_source(from, name + "_source", source);
  const auto [low, high] = range_of(from, name, static_cast<double>(number.value), scene::at_most(kMostUnits),
                                    source_of(number.source)->of_logic, given);
  number.low = std::llround(low);
  number.high = std::llround(high);
  return number;
}

Ranged<double> read_of_device(scene::Reader& from, const std::string& name, double lowest, double highest,
                              const Given& given) {
  Ranged<double> number;
  const scene::Range allowed = scene::at_least(lowest).at_most(highest);
  number.value = from.number(name, allowed);
  number.source = read_source(from, name + "_source", "assumed");
  const auto [low, high] =
      range_of(from, name, number.value, allowed, source_of(number.source)->of_device, given);
  number.low = low;
  number.high = high;
  return number;
}

}  // namespace voxmelt::hwmodel::explore
