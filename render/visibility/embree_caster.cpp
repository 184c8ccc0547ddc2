#include "render/visibility/embree_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "kernel/engine/visibility/two_level.h"

namespace voxmelt::visibility {
namespace {

// The margin is in cells. Floats of a grid of 4096 cells, and the tree's results from them, err by less than
// 0.001.
constexpr float kMargin = 0.02f;

// Flushes denormal numbers, which make Embree slow. Every thread that casts sets this, and later restores the
// former state.
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

// Many rays end close to their start. So each walks through a few bricks or gaps, before the tree looks for
// the next ones.
constexpr int kOnFoot = 6;

// Holds a ray that has met nothing on foot.
struct Traveller {
  Traveller(const Cell& cell, const Course& course) : walk(cell, course) {}
  BrickWalk<std::int64_t> walk;
  std::size_t ray = 0;
};

// Holds what the callback needs of the rays of a packet. Embree hands the context on, so it comes first.
struct Errand {
  RTCIntersectContext context;
  const Opaque* opaque;
  const Traveller* travellers;  // indexed by the ids of rays
  std::span<Fate> fates;
};

struct Prepared {
  std::array<float, 3> from, way;
  float begin, end;
};

// Prepares a ray in cells. It is scaled so that the longest component of the direction is 1. The ray goes on
// from `cell`.
Prepared prepare_ray(const Ray& ray, const Course& course, const Cell& cell) {
  const std::size_t main = course.length[0] >= course.length[1]
                               ? (course.length[0] >= course.length[2] ? 0 : 2)
                               : (course.length[1] >= course.length[2] ? 1 : 2);
  const auto longest = static_cast<float>(course.length[main]);
  const std::array<std::int64_t, 3> from{ray.start.x, ray.start.y, ray.start.z};
  Prepared prepared{};
  for (std::size_t a = 0; a < 3; ++a) {
    prepared.from[a] = static_cast<float>(from[a]) / rule::kPositionUnit;
    prepared.way[a] = static_cast<float>(course.way[a]) * (static_cast<float>(course.length[a]) / longest);
  }
  // The walk knows exactly where the ray goes on, and where it ends. Here it may be a cell or two longer.
  prepared.begin = std::max(0.0f, static_cast<float>(std::abs(cell[main] - ray.cell[main])) - 1.5f);
  prepared.end = longest / rule::kPositionUnit * 1.0001f + 1;
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
  static std::vector<std::uint32_t> shell(const Opaque& opaque);
  void build(const Opaque& now, std::vector<std::uint32_t> boxes);
  void refit() const;

  static void bounds(const RTCBoundsFunctionArguments* call);
  static void occluded(const RTCOccludedFunctionNArguments* call);

  RTCDevice device;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;
  const Opaque* opaque = nullptr;
  Gaps gaps;
  std::vector<std::uint32_t> bricks;  // brick of each box, ascending
};

namespace {

Cell first_cell(const Opaque& opaque, std::size_t brick) {
  const std::size_t bx = opaque.bricks().x, by = opaque.bricks().y;
  return {8 * static_cast<int>(brick % bx), 8 * static_cast<int>(brick / bx % by),
          8 * static_cast<int>(brick / bx / by)};
}

}  // namespace

// Gives Embree the box around the opaque cells of a brick. A box that is empty by now is a point.
void EmbreeCaster::Scene::bounds(const RTCBoundsFunctionArguments* call) {
  const auto& self = *static_cast<const Scene*>(call->geometryUserPtr);
  const std::size_t brick = self.bricks[call->primID];
  const Cell first = first_cell(*self.opaque, brick);
  const std::uint8_t* rows = self.opaque->rows(brick);
  // `slice` collects the bits of all slices, a byte for each row. `slices` has a bit for each slice that
  // holds something.
  std::uint64_t slice = 0, slices = 0;
  for (unsigned z = 0; z < 8; ++z) {
    std::uint64_t word = 0;
    std::memcpy(&word, rows + 8 * z, 8);
    slice |= word;
    slices |= std::uint64_t{word != 0} << z;
  }
  std::uint64_t row = 0, in_slice = 0;
  for (unsigned y = 0; y < 8; ++y) {
    std::uint8_t byte = 0;
    std::memcpy(&byte, reinterpret_cast<const std::uint8_t*>(&slice) + y, 1);
    row |= byte;
    in_slice |= std::uint64_t{byte != 0} << y;
  }
  std::array<int, 3> low{4, 4, 4}, high{4, 4, 4};
  const std::array<std::uint64_t, 3> taken{row, in_slice, slices};
  for (std::size_t a = 0; a < 3 && row != 0; ++a) {
    low[a] = std::countr_zero(taken[a]);
    high[a] = 64 - std::countl_zero(taken[a]);
  }
  const float margin = high[0] == low[0] ? 0 : kMargin;
  const auto lower = [&](std::size_t a) { return static_cast<float>(first[a] + low[a]) - margin; };
  const auto upper = [&](std::size_t a) { return static_cast<float>(first[a] + high[a]) + margin; };
  RTCBounds& box = *call->bounds_o;
  box.lower_x = lower(0);
  box.lower_y = lower(1);
  box.lower_z = lower(2);
  box.upper_x = upper(0);
  box.upper_y = upper(1);
  box.upper_z = upper(2);
}

void EmbreeCaster::Scene::occluded(const RTCOccludedFunctionNArguments* call) {
  const auto& self = *static_cast<const Scene*>(call->geometryUserPtr);
  const auto& errand = *reinterpret_cast<const Errand*>(call->context);
  const std::size_t brick = self.bricks[call->primID];
  const Cell first = first_cell(*errand.opaque, brick);
  for (unsigned lane = 0; lane < call->N; ++lane) {
    if (call->valid[lane] == 0) continue;
    const Traveller& traveller = errand.travellers[RTCRayN_id(call->ray, call->N, lane)];
    BrickWalk<std::int64_t> walk = traveller.walk;
    bool ends = false;
    if (!walk.enter(first)) continue;
    const Fate fate = meet_in_brick(*errand.opaque, brick, walk, ends);
    if (fate == kSees) continue;
    errand.fates[traveller.ray] = fate;
    RTCRayN_tfar(call->ray, call->N, lane) = -std::numeric_limits<float>::infinity();
  }
}

// Returns the bricks that need a box. A full brick with 26 full neighbours needs none, because a ray meets an
// opaque cell before it gets there.
std::vector<std::uint32_t> EmbreeCaster::Scene::shell(const Opaque& opaque) {
  const state::Grid& g = opaque.bricks();
  std::vector<std::uint8_t> buried(g.cells()), before;
  for (std::size_t brick = 0; brick < buried.size(); ++brick) buried[brick] = opaque.full(brick);
  for (const std::size_t stride : {std::size_t{1}, g.index(0, 1, 0), g.index(0, 0, 1)}) {
    before = buried;
    for (std::size_t brick = stride; brick + stride < buried.size(); ++brick)
      buried[brick] = before[brick] & before[brick - stride] & before[brick + stride];
  }
  const auto last = [](int at, int size) { return at == 0 || at == size - 1; };
  std::vector<std::uint32_t> bricks;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        const std::size_t brick = g.index(x, y, z);
        const bool border = last(x, g.x) || last(y, g.y) || last(z, g.z);
        if (!opaque.empty(brick) && (border || buried[brick] == 0))
          bricks.push_back(static_cast<std::uint32_t>(brick));
      }
  return bricks;
}

void EmbreeCaster::Scene::build(const Opaque& now, std::vector<std::uint32_t> boxes) {
  drop();
  opaque = &now;
  bricks = std::move(boxes);
  scene = rtcNewScene(device);
  // A refit takes as long as a build of good quality. A tree of low quality is built in less than half of the
  // time, and the rays are as fast in it.
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bricks.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, occluded);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcCommitScene(scene);
}

void EmbreeCaster::Scene::refit() const {
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene);
}

EmbreeCaster::EmbreeCaster(Packet packet) : scene_(std::make_unique<Scene>()), packet_(packet) {}
EmbreeCaster::~EmbreeCaster() = default;

bool EmbreeCaster::built_in() { return true; }

void EmbreeCaster::prepare(const Opaque& opaque, const Opaque::News& news) {
  const bool other = scene_->scene == nullptr || scene_->opaque != &opaque;
  if (!other && !news.appeared && !news.vanished) return;
  scene_->gaps.update(opaque, news);
  std::vector<std::uint32_t> boxes = Scene::shell(opaque);
  // Boxes that are no longer needed shrink to points. New boxes ask for another tree.
  if (other || news.appeared ||
      !std::includes(scene_->bricks.begin(), scene_->bricks.end(), boxes.begin(), boxes.end()))
    scene_->build(opaque, std::move(boxes));
  else
    scene_->refit();
}

EmbreeCaster::Box EmbreeCaster::box() const {
  RTCBounds bounds{};
  rtcGetSceneBounds(scene_->scene, &bounds);
  return {{bounds.lower_x, bounds.lower_y, bounds.lower_z}, {bounds.upper_x, bounds.upper_y, bounds.upper_z}};
}

namespace {

void set_ray(RTCRayN* packet, unsigned n, unsigned lane, const Prepared& ray, unsigned id) {
  RTCRayN_org_x(packet, n, lane) = ray.from[0];
  RTCRayN_org_y(packet, n, lane) = ray.from[1];
  RTCRayN_org_z(packet, n, lane) = ray.from[2];
  RTCRayN_tnear(packet, n, lane) = ray.begin;
  RTCRayN_dir_x(packet, n, lane) = ray.way[0];
  RTCRayN_dir_y(packet, n, lane) = ray.way[1];
  RTCRayN_dir_z(packet, n, lane) = ray.way[2];
  RTCRayN_time(packet, n, lane) = 0;
  RTCRayN_tfar(packet, n, lane) = ray.end;
  RTCRayN_mask(packet, n, lane) = ~0u;  // with 0, nothing is ever hit
  RTCRayN_id(packet, n, lane) = id;
  RTCRayN_flags(packet, n, lane) = 0;
}

// Collects rays, and hands them to Embree once it is full. Lanes that are not filled are not valid.
template <unsigned kLanes, class Rays, class Occluded>
class Travel {
 public:
  Travel(const Opaque& opaque, std::span<Fate> fates, const Occluded& occluded)
      : errand_{{}, &opaque, nullptr, fates}, occluded_(occluded) {
    rtcInitIntersectContext(&errand_.context);
    if (kLanes > 1) errand_.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    travellers_.reserve(kLanes);
  }

  void add(const Traveller& traveller, const Prepared& ray) {
    const auto lane = static_cast<unsigned>(travellers_.size());
    valid_[lane] = -1;
    set_ray(reinterpret_cast<RTCRayN*>(&rays_), kLanes, lane, ray, lane);
    travellers_.push_back(traveller);
    if (travellers_.size() == kLanes) cast();
  }

  void cast() {
    errand_.travellers = travellers_.data();
    occluded_(valid_.data(), &errand_.context, &rays_);
    travellers_.clear();
    valid_.fill(0);
  }

 private:
  alignas(64) Rays rays_{};
  alignas(64) std::array<int, kLanes> valid_{};
  Errand errand_;
  Occluded occluded_;
  std::vector<Traveller> travellers_;
};

template <unsigned kLanes, class Rays, class Occluded>
void cast_by(const Opaque& opaque, const Gaps& gaps, std::span<const Ray> rays, std::span<Fate> fates,
             const Occluded& occluded) {
  Travel<kLanes, Rays, Occluded> travel(opaque, fates, occluded);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& ray = rays[i];
    fates[i] = kSees;
    if (!opaque.contains(ray.cell)) continue;
    const Course course(ray);
    if (!course.narrow()) {  // so distant a source is rare
      fates[i] = two_level_fate(opaque, gaps, ray);
      continue;
    }
    Traveller traveller(ray.cell, course);
    traveller.ray = i;
    bool ends = false;
    fates[i] = follow(opaque, gaps, traveller.walk, kOnFoot, ends);
    if (fates[i] != kSees || ends) continue;
    travel.add(traveller, prepare_ray(ray, course, traveller.walk.cell()));
  }
  travel.cast();
}

}  // namespace

void EmbreeCaster::cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const {
  const FlushDenormals flush;
  RTCScene scene = scene_->scene;
  switch (packet_) {
    case Packet::one:
      return cast_by<1, RTCRay>(opaque, scene_->gaps, rays, fates,
                                [scene](const int* valid, RTCIntersectContext* context, RTCRay* ray) {
                                  if (*valid != 0) rtcOccluded1(scene, context, ray);
                                });
    case Packet::eight:
      return cast_by<8, RTCRay8>(opaque, scene_->gaps, rays, fates,
                                 [scene](const int* valid, RTCIntersectContext* context, RTCRay8* ray) {
                                   rtcOccluded8(valid, scene, context, ray);
                                 });
    case Packet::sixteen:
      return cast_by<16, RTCRay16>(opaque, scene_->gaps, rays, fates,
                                   [scene](const int* valid, RTCIntersectContext* context, RTCRay16* ray) {
                                     rtcOccluded16(valid, scene, context, ray);
                                   });
  }
}

}  // namespace voxmelt::visibility
