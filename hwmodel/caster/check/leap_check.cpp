#include "hwmodel/caster/check/leap_check.h"

#include <algorithm>

#include "hwmodel/caster/check/checker.h"
#include "hwmodel/caster/check/compare.h"
#include "hwmodel/caster/host/keep.h"
#include "render/rule/ground.h"

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

// Counts samples until one is not in the block of so many bits, along x or z.
std::int64_t until_beside(const PlaceOverGround& place, int bits) {
  const auto axis = [&](std::int64_t q, std::int64_t sample, std::int64_t step) {
    const std::int64_t begin = (q >> bits) << bits;
    return until_out(sample, step, begin, begin + (std::int64_t{1} << bits));
  };
  return std::min(axis(place.at.x, place.sample.x, place.step.x),
                  axis(place.at.z, place.sample.z, place.step.z));
}

// Counts samples until one is not above all that a block holds, or not in it.
std::int64_t until_below(const PlaceOverGround& place, std::int64_t highest, int bits) {
  const std::int64_t height = highest << (kCellBits - 12 + kBoundShift);
  if (place.at.y < height) return 0;
  const std::int64_t falls = place.step.y < 0 ? (place.sample.y - height) / -place.step.y + 1 : kForever;
  return std::min(falls, until_beside(place, bits));
}

// Counts samples until one may lie in the ground, in units of 2^-32 cells. Heights are blended twice from
// places that are the nearest 1/256 of a cell, and rounded to 2^-12 cells, as the ray's own height is.
std::int64_t until_reached(const GroundBlock& block, const PlaceOverGround& place) {
  const std::int64_t slope_x = std::int64_t{block.slope_x} << kBoundShift,
                     slope_z = std::int64_t{block.slope_z} << kBoundShift;
  const std::int64_t nearer =
      magnitude(place.step.x) * slope_x + magnitude(place.step.z) * slope_z - 4096 * place.step.y;
  const std::int64_t blends = 2 * (1 + 1), weights = 2 * (slope_x + slope_z);  // 2^-12 cells; 2^-21 cells
  const std::int64_t room = ((place.above - blends) << 20) - (weights << 11);
  if (place.above < 0) return 0;
  if (nearer <= 0) return kForever;
  return room <= 0 ? 1 : room / nearer + 1;
}

// A leap of no sample would be right for ever: the ray would stand, and the stage be busy with it.
std::int64_t bounded(std::int64_t steps, std::int64_t most) {
  return std::max<std::int64_t>(std::min(most, steps), 1);
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

std::int64_t longest_leap(const GroundBlocks& blocks, Leap why, const PlaceOverGround& place) {
  const GroundBlock& fine = blocks.fine_at(place.at);
  if (why == Leap::over_slopes) return std::min(until_beside(place, kFineBits), until_reached(fine, place));
  return std::max(until_below(place, fine.highest, kFineBits),
                  until_below(place, blocks.coarse_at(place.at), kCoarseBits));
}

void Checker::leapt(const LeapTaken& leap) {
  if (difference_ || places_[index_of(leap.id)] < 0) return;  // the ray came to its end before
  const ExpectedRay& expected_ray = ray(leap.id);
  const Vec step = vec_of(expected_ray.ray.step);
  if (leap.why == Leap::over_blocks || leap.why == Leap::over_slopes) {
    const picture::Vector position = picture::position_at(expected_ray.ray, leap.k);
    const Vec at = vec_of(position);
    const std::int64_t above = leap.why == Leap::over_slopes ? expectation_.above_ground(position) : 0;
    const Vec sample = vec_of(expectation_.at(expected_ray, leap.k >> 8));
    const std::int64_t most = longest_leap(registers_.ground.blocks, leap.why, {at, sample, step, above});
    return compare("ground", leap.id, "samples to the next one that may be in it", bounded(leap.steps, most),
                   leap.steps, &at);
  }
  const picture::Vector position = expectation_.at(expected_ray, leap.k);
  const std::int64_t level = leap.why == Leap::through_air ? expectation_.sample(position) : 0;
  const Vec at = vec_of(position);
  const std::int64_t most =
      longest_leap(registers_.skip, registers_.camera.spacing, leap.why, {to_lattice(at), step, level});
  compare("walk", leap.id, "samples to the next one that may be matter", bounded(leap.steps, most),
          leap.steps, &at);
}

}  // namespace voxmelt::hwmodel::raycast
