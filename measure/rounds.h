// A measurement is repeated long enough for one undisturbed round.
#pragma once

#include <chrono>

namespace voxmelt::measure {

// Asks for at least `fewest` rounds, and for more, up to kMostRounds, while `seconds` are not over.
struct Rounds {
  int fewest = 5;
  double seconds = 15;
};
inline constexpr int kMostRounds = 40;

class RoundClock {  // starts when it is made
 public:
  explicit RoundClock(const Rounds& rounds) : rounds_(rounds) {}

  bool more(int done) const {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    return done < rounds_.fewest || (done < kMostRounds && spent.count() < rounds_.seconds);
  }

 private:
  Rounds rounds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace voxmelt::measure
