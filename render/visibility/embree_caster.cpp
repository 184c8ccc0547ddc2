#include "render/visibility/embree_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/engine/visibility/brick_walk.h"

namespace voxmelt::visibility {
namespace {

// In cells. Floats of a grid of 4096 cells, and what the tree makes of them, err by less than 0.001.
constexpr float kMargin = 0.02f;

// Denormal numbers make Embree slow. Every thread that casts sets this, and gives back what was.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040); }  // FTZ and DAZ
  ~FlushDenormals() { _mm_setcsr(before_); }
#else
  FlushDenormals() {}
  ~FlushDenormals() {}
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_ = 0;
};

// What the callback needs of the rays that are on their way. Embree hands the context on, so it comes first.
struct Errand {
  RTCIntersectContext context;
  const Opaque* opaque;
  const rule::Position* source;
  std::span<const Ray> rays;
  std::span<Fate> fates;
};

struct Prepared {
  std::array<float, 3> from, way;
  float end;
};

// In cells, and scaled so that no component of the direction is above 1.
Prepared prepare_ray(const Ray& ray, const rule::Position& source) {
  const std::array<std::int64_t, 3> from{ray.start.x, ray.start.y, ray.start.z},
      to{source.x, source.y, source.z};
  std::int64_t longest = 1;
  for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, std::abs(to[a] - from[a]));
  Prepared prepared{};
  for (std::size_t a = 0; a < 3; ++a) {
    prepared.from[a] = static_cast<float>(from[a]) / rule::kPositionUnit;
    prepared.way[a] = static_cast<float>(static_cast<double>(to[a] - from[a]) / static_cast<double>(longest));
  }
  // The walk knows exactly where the segment ends; here it may end a cell later.
  prepared.end = static_cast<float>(longest) / rule::kPositionUnit * 1.0001f + 1;
  return prepared;
}

}  // namespace

struct EmbreeCaster::Scene {
  Scene() : device(rtcNewDevice("threads=1")) {
    if (device == nullptr) throw std::runtime_error("Embree does not start");
  }
  ~Scene() {
    drop();
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void drop() {
    if (geometry != nullptr) rtcReleaseGeometry(geometry);
    if (scene != nullptr) rtcReleaseScene(scene);
    geometry = nullptr;
    scene = nullptr;
  }
  void build(const Opaque& opaque);
  void refit() const;

  static void bounds(const RTCBoundsFunctionArguments* call);
  static void occluded(const RTCOccludedFunctionNArguments* call);
  bool stops(const Errand& errand, unsigned ray, const Cell& first, std::size_t brick) const;

  RTCDevice device;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  const Opaque* opaque = nullptr;
  std::vector<std::uint32_t> bricks;  // of each box
};

namespace {

Cell first_cell(const Opaque& opaque, std::size_t brick) {
  const auto bx = static_cast<std::size_t>(opaque.bricks().x),
             by = static_cast<std::size_t>(opaque.bricks().y);
  return {8 * static_cast<int>(brick % bx), 8 * static_cast<int>(brick / bx % by),
          8 * static_cast<int>(brick / bx / by)};
}

}  // namespace

// Around the opaque cells of a brick. One that holds nothing any more is a point.
void EmbreeCaster::Scene::bounds(const RTCBoundsFunctionArguments* call) {
  const auto& self = *static_cast<const Scene*>(call->geometryUserPtr);
  const std::size_t brick = self.bricks[call->primID];
  const Cell first = first_cell(*self.opaque, brick);
  const std::uint8_t* rows = self.opaque->rows(brick);
  std::array<int, 3> low{8, 8, 8}, high{0, 0, 0};
  for (int row = 0; row < 64; ++row) {
    if (rows[row] == 0) continue;
    const std::array<int, 3> from{std::countr_zero(rows[row]), row & 7, row >> 3},
        to{8 - std::countl_zero(rows[row]), (row & 7) + 1, (row >> 3) + 1};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], from[a]);
      high[a] = std::max(high[a], to[a]);
    }
  }
  if (high[0] == 0) low = high = {4, 4, 4};
  const float margin = high[0] == low[0] ? 0 : kMargin;
  const auto lower = [&](std::size_t a) { return static_cast<float>(first[a] + low[a]) - margin; };
  const auto upper = [&](std::size_t a) { return static_cast<float>(first[a] + high[a]) + margin; };
  RTCBounds& box = *call->bounds_o;
  box.lower_x = lower(0), box.lower_y = lower(1), box.lower_z = lower(2);
  box.upper_x = upper(0), box.upper_y = upper(1), box.upper_z = upper(2);
}

bool EmbreeCaster::Scene::stops(const Errand& errand, unsigned ray, const Cell& first,
                                std::size_t brick) const {
  const Fate fate = with_walk(errand.rays[ray], *errand.source, [&](auto& walk) {
    bool ends = false;
    return walk.enter(first) ? meet_in_brick(*opaque, brick, walk, ends) : kSees;
  });
  if (fate == kSees) return false;
  errand.fates[ray] = fate;
  return true;
}

void EmbreeCaster::Scene::occluded(const RTCOccludedFunctionNArguments* call) {
  const auto& self = *static_cast<const Scene*>(call->geometryUserPtr);
  const auto& errand = *reinterpret_cast<const Errand*>(call->context);
  const std::size_t brick = self.bricks[call->primID];
  const Cell first = first_cell(*self.opaque, brick);
  for (unsigned lane = 0; lane < call->N; ++lane) {
    if (call->valid[lane] == 0) continue;
    if (self.stops(errand, RTCRayN_id(call->ray, call->N, lane), first, brick))
      RTCRayN_tfar(call->ray, call->N, lane) = -std::numeric_limits<float>::infinity();
  }
}

void EmbreeCaster::Scene::build(const Opaque& now) {
  drop();
  opaque = &now;
  bricks.clear();
  for (std::size_t brick = 0; brick < now.bricks().cells(); ++brick)
    if (!now.empty(brick)) bricks.push_back(static_cast<std::uint32_t>(brick));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
  geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bricks.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);
}

void EmbreeCaster::Scene::refit() const {
  rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
}

EmbreeCaster::EmbreeCaster(Packet packet) : scene_(std::make_unique<Scene>()), packet_(packet) {}
EmbreeCaster::~EmbreeCaster() = default;

bool EmbreeCaster::built_in() { return true; }

void EmbreeCaster::prepare(const Opaque& opaque, const Opaque::News& news) {
  if (scene_->scene == nullptr || scene_->opaque != &opaque || news.appeared) {
    scene_->build(opaque);
  } else if (news.vanished) {
    scene_->refit();
  }
}

namespace {

void set_ray(RTCRayN* packet, unsigned n, unsigned lane, const Prepared& ray, unsigned id) {
  RTCRayN_org_x(packet, n, lane) = ray.from[0];
  RTCRayN_org_y(packet, n, lane) = ray.from[1];
  RTCRayN_org_z(packet, n, lane) = ray.from[2];
  RTCRayN_tnear(packet, n, lane) = 0;
  RTCRayN_dir_x(packet, n, lane) = ray.way[0];
  RTCRayN_dir_y(packet, n, lane) = ray.way[1];
  RTCRayN_dir_z(packet, n, lane) = ray.way[2];
  RTCRayN_time(packet, n, lane) = 0;
  RTCRayN_tfar(packet, n, lane) = ray.end;
  RTCRayN_mask(packet, n, lane) = ~0u;  // with 0, nothing is ever hit
  RTCRayN_id(packet, n, lane) = id;
  RTCRayN_flags(packet, n, lane) = 0;
}

// Lanes past the last ray are not valid.
template <unsigned kLanes, class Packet, class Occluded>
void cast_packets(Errand& errand, const Occluded& occluded) {
  for (std::size_t first = 0; first < errand.rays.size(); first += kLanes) {
    alignas(64) Packet packet{};
    alignas(64) std::array<int, kLanes> valid{};
    const std::size_t lanes = std::min<std::size_t>(kLanes, errand.rays.size() - first);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      valid[lane] = -1;
      set_ray(reinterpret_cast<RTCRayN*>(&packet), kLanes, static_cast<unsigned>(lane),
              prepare_ray(errand.rays[first + lane], *errand.source), static_cast<unsigned>(first + lane));
    }
    occluded(valid.data(), &packet);
  }
}

}  // namespace

void EmbreeCaster::cast(const Opaque& opaque, const rule::Position& source, std::span<const Ray> rays,
                        std::span<Fate> fates) const {
  const FlushDenormals flush;
  std::fill(fates.begin(), fates.end(), kSees);
  Errand errand{{}, &opaque, &source, rays, fates};
  rtcInitIntersectContext(&errand.context);
  errand.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  switch (packet_) {
    case Packet::one:
      cast_packets<1, RTCRay>(
          errand, [&](const int*, RTCRay* ray) { rtcOccluded1(scene_->scene, &errand.context, ray); });
      return;
    case Packet::eight:
      cast_packets<8, RTCRay8>(errand, [&](const int* valid, RTCRay8* ray) {
        rtcOccluded8(valid, scene_->scene, &errand.context, ray);
      });
      return;
    case Packet::sixteen:
      cast_packets<16, RTCRay16>(errand, [&](const int* valid, RTCRay16* ray) {
        rtcOccluded16(valid, scene_->scene, &errand.context, ray);
      });
      return;
  }
}

}  // namespace voxmelt::visibility
