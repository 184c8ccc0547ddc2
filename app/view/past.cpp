#include "app/view/past.h"

#include <algorithm>
#include <utility>

#include "app/view/scratch.h"

namespace voxmelt::view {

void Past::offer(const Simulation& simulation) {
  const std::uint32_t step = simulation.steps_done();
  const std::uint32_t last = kept_.empty() ? 0 : kept_.back().step;
  const Clock::time_point begin = Clock::now();
  if (step < last + distance_ || begin - last_ < 20 * cost_) return;
  try {
    const Scratch scratch;
    simulation.save(scratch.file());
    kept_.push_back({step, scratch.bytes()});
  } catch (const Error&) {
    // Without room for it, a way back is longer, and nothing else is lost.
  }
  last_ = Clock::now();
  cost_ = last_ - begin;
  while (kept_.size() > 1 && bytes() > most_bytes_) thin_out();
}

void Past::thin_out() {
  std::vector<Kept> rest;
  for (std::size_t i = 1; i < kept_.size(); i += 2) rest.push_back(std::move(kept_[i]));
  kept_ = std::move(rest);
  distance_ = std::min(2 * distance_, 1u << 20);
}

const Past::Kept* Past::before(std::uint32_t step) const {
  const auto after = std::upper_bound(kept_.begin(), kept_.end(), step,
                                      [](std::uint32_t value, const Kept& one) { return value < one.step; });
  return after == kept_.begin() ? nullptr : &*(after - 1);
}

void Past::cut(std::uint32_t step) {
  std::erase_if(kept_, [&](const Kept& one) { return one.step > step; });
}

std::size_t Past::bytes() const {
  std::size_t sum = 0;
  for (const Kept& one : kept_) sum += one.bytes.size();
  return sum;
}

}  // namespace voxmelt::view
