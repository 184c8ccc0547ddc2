#include "hwmodel/pipeline/check/timeline.h"

#include <utility>

namespace voxmelt::hwmodel {

void Timeline::add(std::vector<StageCycles> accounts) {
  ends_.push_back(std::move(accounts));
  if (ends_.size() < 2 * kMost) return;
  for (std::size_t i = 0; i < kMost; ++i) ends_[i] = std::move(ends_[2 * i + 1]);
  ends_.resize(kMost);
  width_ *= 2;
}

void Timeline::end(std::vector<StageCycles> accounts) {
  if (accounts.front().total() > cycles()) ends_.push_back(std::move(accounts));
}

StageCycles Timeline::within(std::size_t stretch, std::size_t stage) const {
  StageCycles did = ends_[stretch][stage];
  if (stretch == 0) return did;
  return did -= ends_[stretch - 1][stage];
}

}  // namespace voxmelt::hwmodel
