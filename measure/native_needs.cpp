#include "measure/native_needs.h"

namespace voxmelt::measure {

#if defined(__AVX512F__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::avx512;
#elif defined(__AVX__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::avx2;
#elif defined(__SSE4_1__)
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = cpu::InstructionSet::sse42;
#else
constinit const std::optional<cpu::InstructionSet> kNativeNeeds = std::nullopt;
#endif

}  // namespace voxmelt::measure
