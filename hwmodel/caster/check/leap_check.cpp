#include "hwmodel/caster/check/leap_check.h"

#include <algorithm>

#include "hwmodel/caster/check/checker.h"
#include "hwmodel/caster/check/compare.h"
#include "hwmodel/caster/host/keep.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::int64_t kForever = std::int64_t{1} << 40;
constexpr std::int64_t kBlock = std::int64_t{4} << kCellBits;  // side of a block, section 12

// Counts samples along one axis until one is at `end` or beyond, or below `begin`.
std::int64_t until_out(std::int64_t q, std::int64_t step, std::int64_t begin, std::int64_t end) {
  if (step > 0) return (end - q + step - 1) / step;
  return step < 0 ? (q - begin) / -step + 1 : kForever;
}

// Counts samples until the ray leaves the blocks that are less than `reach` blocks away from its own.
std::int64_t until_out(const SampleOnRay& s, std::int64_t reach) {
  const auto axis = [&](std::int64_t q, std::int64_t step) {
    const std::int64_t block = q / kBlock;
    return until_out(q, step, (block - reach + 1) * kBlock, (block + reach) * kBlock);
  };
  return std::min({axis(s.at.x, s.step.x), axis(s.at.y, s.step.y), axis(s.at.z, s.step.z)});
}

// Counts samples until the ray is in the box along each axis. A ray that moves away stays out of it.
std::int64_t until_in(const SampleOnRay& s, Vec low, Vec high) {
  const auto axis = [](std::int64_t q, std::int64_t step, std::int64_t begin, std::int64_t end) {
    if (q < begin) return step > 0 ? (begin - q + step - 1) / step : kForever;
    if (q >= end) return step < 0 ? (q - end) / -step + 1 : kForever;
    return std::int64_t{0};
  };
  return std::max({axis(s.at.x, s.step.x, low.x, high.x), axis(s.at.y, s.step.y, low.y, high.y),
                   axis(s.at.z, s.step.z, low.z, high.z)});
}

// Counts samples until the level may be 0, where it rises by 768 `slope` per cell at most. In one step a ray
// goes 2^-spacing cells. The roundings of a sample err by 3/2 (section 6). A weight is the nearest 1/256, so
// the level errs by 768/512 `slope` more. There are two such samples: the one whose level is known, and the
// last one that is left out. That one's level is -1 at most.
std::int64_t until_risen(std::int64_t level, std::int64_t slope, int spacing) {
  const std::int64_t room = -1 - level - 2 * 3 / 2 - 2 * 768 * slope / 512;
  if (room <= 0) return 1;
  return slope == 0 ? kForever : (room << spacing) / (768 * slope) + 1;
}

}  // namespace

std::int64_t longest_leap(const SkipMap& skip, int spacing, Leap why, const SampleOnRay& sample) {
  if (why == Leap::to_box) return until_in(sample, skip.low, skip.high);
  if (until_in(sample, skip.low, skip.high) > 0) return 0;  // there are no blocks
  const std::int64_t word = skip.at(sample.at.x / kBlock, sample.at.y / kBlock, sample.at.z / kBlock);
  if (why == Leap::out_of_block) return word < 256 ? 0 : until_out(sample, word - 256);
  // The slope is that of one block.
  return word >= 256 ? 0 : std::min(until_out(sample, 1), until_risen(sample.level, word, spacing));
}

void Checker::leapt(const LeapTaken& leap) {
  if (difference_ || places_[index_of(leap.id)] < 0) return;  // the ray came to its end before
  const ExpectedRay& expected_ray = ray(leap.id);
  const picture::Vector position = expectation_.at(expected_ray, leap.k);
  const std::int64_t level = leap.why == Leap::through_air ? expectation_.sample(position) : 0;
  const Vec at = vec_of(position);
  const std::int64_t most = longest_leap(registers_.skip, registers_.camera.spacing, leap.why,
                                         {to_lattice(at), vec_of(expected_ray.ray.step), level});
  compare("walk", leap.id, "samples to the next one that may be matter", std::min(most, leap.steps),
          leap.steps, &at);
}

}  // namespace voxmelt::hwmodel::raycast
