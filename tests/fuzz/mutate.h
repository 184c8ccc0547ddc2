// Inputs are made from a corpus. Bits are flipped, and pieces are taken out, doubled, or moved from one file
// to another. Numbers become extreme, and words of a dictionary are put in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace voxmelt::fuzz {

// Reads the words of a dictionary in libFuzzer's form: one in double quotes a line, with \\, \" and \xAB.
std::vector<std::string> dictionary(const std::string& text);

class Mutator {
 public:
  static constexpr std::size_t kMostBytes = 1 << 16;

  Mutator(const std::vector<std::string>& corpus, const std::vector<std::string>& words, std::uint64_t seed)
      : corpus_(corpus), words_(words), random_(seed) {}
  const std::string& next();

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }
  const std::string& any() { return corpus_[below(corpus_.size())]; }
  void change();
  void put(const std::string& piece);
  void change_number();

  const std::vector<std::string>& corpus_;
  const std::vector<std::string>& words_;
  std::mt19937_64 random_;
  std::string input_;
};

}  // namespace voxmelt::fuzz
