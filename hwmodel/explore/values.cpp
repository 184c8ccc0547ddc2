#include "hwmodel/explore/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <system_error>

namespace voxmelt::hwmodel::explore {
namespace {

double number_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw std::invalid_argument(fmt::format("\"{}\" is not a number", text));
  return value;
}

std::vector<std::string> range_of(const std::string& text, std::size_t dots) {
  const std::size_t plus = text.find('+', dots + 2);
  const double first = number_of(text.substr(0, dots)),
               last = number_of(text.substr(dots + 2, plus - dots - 2));
  const double step = plus == std::string::npos ? 0 : number_of(text.substr(plus + 1));
  if (!(first <= last)) throw std::invalid_argument(fmt::format("{}: the range ends before it begins", text));
  if (plus == std::string::npos ? !(first > 0) : !(step > 0))
    throw std::invalid_argument(fmt::format("{}: the values do not grow", text));
  std::vector<std::string> values;
  double value = first;
  for (std::size_t i = 1; value <= last * (1 + 1e-12); ++i) {  // sums of decimals are rounded
    if (i > kMostValues)
      throw std::invalid_argument(fmt::format("{}: more than {} values", text, kMostValues));
    values.push_back(fmt::format("{:.12g}", value));
    value = step > 0 ? first + static_cast<double>(i) * step : 2 * value;
  }
  return values;
}

}  // namespace

Values values_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw std::invalid_argument("expected KEY=VALUES, for example memory.channels=1..32");
  Values result{text.substr(0, equals), {}};
  const std::string values = text.substr(equals + 1);
  if (const std::size_t dots = values.find(".."); dots != std::string::npos) {
    result.values = range_of(values, dots);
    return result;
  }
  for (std::size_t from = 0; from <= values.size();) {
    const std::size_t comma = std::min(values.find(',', from), values.size());
    result.values.push_back(fmt::format("{:.12g}", number_of(values.substr(from, comma - from))));
    from = comma + 1;
  }
  if (result.values.size() > kMostValues)
    throw std::invalid_argument(fmt::format("{}: more than {} values", text, kMostValues));
  return result;
}

}  // namespace voxmelt::hwmodel::explore
