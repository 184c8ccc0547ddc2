#include "measure/native_needs.h"

namespace voxmelt::measure {

#if defined(VOXMELT_ONLY_avx2) || defined(VOXMELT_ONLY_sse42)  // a build for the machine at hand
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet{};
#elif defined(__AVX512F__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::avx512;
#elif defined(__AVX__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::avx2;
#elif defined(__SSE4_1__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::sse42;
#else
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = std::nullopt;
#endif

}  // namespace voxmelt::measure
