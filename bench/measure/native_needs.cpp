#include "bench/measure/native_needs.h"

namespace voxmelt::measure {

#if defined(__AVX512F__)
constinit const int kNativeNeeds = 2;
#elif defined(__AVX__)
constinit const int kNativeNeeds = 1;
#elif defined(__SSE4_1__)
constinit const int kNativeNeeds = 0;
#else
constinit const int kNativeNeeds = -1;
#endif

}  // namespace voxmelt::measure
