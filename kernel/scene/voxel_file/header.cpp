#include "kernel/scene/voxel_file/header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "kernel/scene/text/text_file.h"

namespace voxmelt::scene {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr double kLargestSpacing = 1e9;

}  // namespace

std::string trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return std::string(text.substr(0, text.find_last_not_of(kBlanks) + 1));
}

std::vector<double> numbers_in(std::string_view text, const char* field, const VoxelSource& source) {
  std::vector<double> numbers;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return numbers;
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    const std::optional<double> number = real_number_in(word);
    if (!number) source.fail(fmt::format("{}: {} is no number", field, in_quotes(word)));
    numbers.push_back(*number);
    text.remove_prefix(word.size());
  }
}

std::array<double, 3> three_lengths(std::string_view text, const char* field, const VoxelSource& source) {
  const std::vector<double> numbers = numbers_in(text, field, source);
  if (numbers.size() != 3) source.fail(fmt::format("{}: {} numbers, not 3", field, numbers.size()));
  return {numbers[0], numbers[1], numbers[2]};
}

std::array<std::uint64_t, 3> three_sides(std::string_view text, const char* field,
                                         const VoxelSource& source) {
  std::array<std::uint64_t, 3> sides{};
  const std::array<double, 3> lengths = three_lengths(text, field, source);
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = lengths[i] >= 1 && lengths[i] <= 1e6 ? static_cast<std::uint64_t>(lengths[i]) : 0;
    if (static_cast<double>(sides[i]) != lengths[i])
      source.fail(fmt::format("{}: {} is no number of voxels", field, lengths[i]));
  }
  return sides;
}

void check_spacing(double side, const VoxelSource& source) {
  if (!(side > 0 && side <= kLargestSpacing)) source.fail(fmt::format("a voxel has a side of {}", side));
}

}  // namespace voxmelt::scene
