#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace voxmelt::fuzz {
namespace {

constexpr std::array kNumbers{"0",
                              "-1",
                              "1",
                              "1e308",
                              "-1e308",
                              "1e-320",
                              "nan",
                              "inf",
                              "-inf",
                              "0.1",
                              "65535",
                              "65536",
                              "2147483647",
                              "-2147483648",
                              "4294967295",
                              "4294967296",
                              "9223372036854775807",
                              "-9223372036854775808",
                              "18446744073709551616",
                              "1e19",
                              "0x10",
                              "1_0",
                              "00",
                              "+",
                              "."};

}  // namespace

std::vector<std::string> dictionary(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find('"'), last = line.rfind('"');
    if (line.empty() || line[0] == '#' || first == std::string::npos || last <= first) continue;
    std::string word;
    for (std::size_t i = first + 1; i < last; ++i) {
      if (line[i] != '\\' || i + 1 >= last)
        word += line[i];
      else if (line[i + 1] == 'x' && i + 3 < last) {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else
        word += line[++i];
    }
    words.push_back(word);
  }
  return words;
}

const std::string& Mutator::next() {
  input_ = any();
  for (std::size_t i = 0, changes = 1 + below(6); i < changes; ++i) change();
  if (input_.size() > kMostBytes) input_.resize(kMostBytes);
  return input_;
}

void Mutator::put(const std::string& piece) {
  const std::size_t at = below(input_.size() + 1);
  const std::size_t over = below(2) == 0 ? 0 : std::min(piece.size(), input_.size() - at);
  input_.replace(at, over, piece);
}

void Mutator::change_number() {
  std::vector<std::size_t> at;
  const auto digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(input_[i])) != 0; };
  for (std::size_t i = 0; i < input_.size(); ++i)
    if (digit(i) && (i == 0 || !digit(i - 1))) at.push_back(i);
  if (at.empty()) return put(kNumbers[below(kNumbers.size())]);
  const std::size_t from = at[below(at.size())];
  std::size_t end = from;
  while (end < input_.size() && digit(end)) ++end;
  input_.replace(from, end - from, kNumbers[below(kNumbers.size())]);
}

void Mutator::change() {
  const std::size_t at = below(input_.size());
  const std::size_t length = 1 + below(below(8) == 0 ? 4000 : 40);
  switch (below(9)) {
    case 0:
      if (!input_.empty()) input_[at] = static_cast<char>(input_[at] ^ 1 << below(8));
      break;
    case 1:
      if (!input_.empty()) input_[at] = static_cast<char>(below(256));
      break;
    case 2:
      input_.erase(at, length);
      break;
    case 3:
      put(input_.substr(at, length));
      break;
    case 4: {
      const std::string& other = any();
      put(other.substr(below(other.size()), length));
      break;
    }
    case 5:
      change_number();
      break;
    case 6:
      if (!words_.empty()) put(words_[below(words_.size())]);
      break;
    case 7: {  // repeats a piece at its place, so that nesting becomes deep
      const std::string piece = input_.substr(at, 1 + below(6));
      if (piece.empty()) break;
      const std::size_t times = below((below(4) == 0 ? kMostBytes : 600) / piece.size());
      std::string many;
      for (std::size_t i = 0; i < times; ++i) many += piece;
      input_.insert(at, many);
      break;
    }
    default:
      input_.resize(at);
  }
}

}  // namespace voxmelt::fuzz
