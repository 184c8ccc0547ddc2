// The file stands in for embree_caster.cpp in a build without Embree.
#include <span>
#include <stdexcept>

#include "render/visibility/embree_caster.h"

namespace voxmelt::visibility {

struct EmbreeCaster::Scene {};

EmbreeCaster::EmbreeCaster(Packet packet) : packet_(packet) {
  throw std::logic_error("this build has no Embree");
}
EmbreeCaster::~EmbreeCaster() = default;
bool EmbreeCaster::built_in() { return false; }
EmbreeCaster::Box EmbreeCaster::box() const { return {}; }
void EmbreeCaster::prepare(const Opaque&, const Opaque::News&) {}
void EmbreeCaster::cast(const Opaque&, std::span<const Ray>, std::span<Fate>) const {}

}  // namespace voxmelt::visibility
