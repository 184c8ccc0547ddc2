// A ratio of two counts, for reports and for models of time.
#pragma once

namespace voxmelt::hwmodel {

// Returns a / b, or 0 if b is 0.
template <class A, class B>
double ratio(A a, B b) {
  return b == 0 ? 0 : static_cast<double>(a) / static_cast<double>(b);
}

}  // namespace voxmelt::hwmodel
