#include "kernel/scene/shape/mesh_layers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace voxmelt::scene {
namespace {

constexpr int kSlabs = 64;
constexpr std::size_t kChunk = 64;  // samples
constexpr int kBand = 64;           // samples, whole cells: the data of a band fits the processor's caches
constexpr int kHalfOfSixRays = 3;

template <class T>
void add_saturated(T& sum, int what) {
  sum = static_cast<T>(
      std::clamp<int>(sum + what, std::numeric_limits<T>::min(), std::numeric_limits<T>::max()));
}

std::int16_t short_of(int sum) { return static_cast<std::int16_t>(sum); }

std::size_t at(int axis) { return axis; }

// Returns what the two rays from a place along an axis tell at the low end. With w crossings towards the low
// end and the other ones of all `total` towards the high end, it is 2 w - total. For parities it is the count
// of odd ones. Here w is 0.
template <Inside inside>
std::int16_t at_low_end(int total) {
  return short_of(inside == Inside::winding ? -total : total & 1);
}

// Returns the same some crossings farther.
template <Inside inside>
std::int16_t behind(std::int16_t told, int crossings) {
  if (inside == Inside::winding) return short_of(told + 2 * crossings);
  return short_of((crossings & 1) != 0 ? 2 - told : told);
}

// Holds what the rays of three axes tell of a row of samples.
struct OpenRow {
  const std::int16_t* told_p;
  std::int16_t *told_q, *told_s;
};

// Decides a row. The compiler makes vectors of this loop, because no array overlaps another one.
template <Inside inside>
void decide(std::size_t width, const OpenRow& row, const std::int16_t* __restrict across,
            const std::int8_t* __restrict steps, std::uint16_t* __restrict result) {
  const std::int16_t* __restrict told_p = row.told_p;
  std::int16_t* __restrict told_q = row.told_q;
  std::int16_t* __restrict told_s = row.told_s;
  for (std::size_t i = 0; i < width; ++i) {
    told_q[i] = behind<inside>(told_q[i], across[i]);
    told_s[i] = behind<inside>(told_s[i], steps[i]);
    const std::int16_t sum = short_of(told_p[i] + told_q[i] + told_s[i]);
    result[i] = sum >= kHalfOfSixRays || sum <= -kHalfOfSixRays ? 1 : 0;
  }
}

// Adds up the crossings of a cell's samples, and clears them. Most cells have none.
template <Inside inside>
void sum_up(std::int16_t* crossings, std::int16_t& now, std::int16_t* told) {
  std::uint64_t any = 0;
  std::memcpy(&any, crossings, sizeof any);
  if (any == 0) {
    for (int i = 0; i < kSamplesPerAxis; ++i) told[i] = now;
    return;
  }
  for (int i = 0; i < kSamplesPerAxis; ++i) told[i] = now = behind<inside>(now, crossings[i]);
  std::memset(crossings, 0, sizeof any);
}

}  // namespace

MeshLayers::MeshLayers(const Surface& surface, Inside inside, Coverage& coverage)
    : surface_(surface), inside_(inside), coverage_(coverage) {
  const Window& window = coverage.window;
  const std::array<int, 3> low{window.x, window.y, window.z},
      size{window.size.x, window.size.y, window.size.z};
  for (std::size_t i = 0; i < 3; ++i) {
    low_[i] = low[i] * kMeshUnit + kSampleOffset[i];
    count_[i] = size[i] * kSamplesPerAxis;
  }
  s_ = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  p_ = (s_ + 1) % 3;
  q_ = (s_ + 2) % 3;
  width_ = count_[at(p_)];
  height_ = count_[at(q_)];
  thickness_ = std::max(1, count_[at(s_)] / kSlabs);
  static_assert(kBand % kSamplesPerAxis == 0);
  band_ = std::min(kBand, std::max(count_[at(q_)], kSamplesPerAxis));
  const std::size_t in_band = band_;
  along_p_.resize(width_ * in_band);
  chunks_ = (width_ + kChunk - 1) / kChunk;
  touched_.resize(in_band * chunks_);
  total_p_.resize(in_band);
  plane_.resize(width_ / kSamplesPerAxis * (height_ / kSamplesPerAxis));
  inside_row_.resize(width_);
  if (surface.closed) return;
  along_q_.resize(width_ * in_band);
  along_s_.resize(width_ * in_band * thickness_);
  told_s_.resize(width_ * height_);
  told_q_.resize(width_ * thickness_);
  told_p_.resize(width_);
}

MeshLayers::Range MeshLayers::samples(int axis, std::int64_t first, std::int64_t last) const {
  if (first > last) return {0, 0};
  const std::int64_t from = (first - low_[at(axis)] + kSampleSpacing - 1) >> 13,
                     to = ((last - low_[at(axis)]) >> 13) + 1;
  static_assert(kSampleSpacing == 1 << 13);
  return {static_cast<int>(std::clamp<std::int64_t>(from, 0, count_[at(axis)])),
          static_cast<int>(std::clamp<std::int64_t>(to, 0, count_[at(axis)]))};
}

MeshLayers::Range MeshLayers::common(Range a, Range b) {
  const int first = std::max(a.first, b.first);
  return {first, std::max(first, std::min(a.end, b.end))};
}

// Returns the number of the sample at this depth. It has a fraction.
double MeshLayers::sample_of(int axis, double depth) const {
  constexpr double spacing = kSampleSpacing;
  return (depth - static_cast<double>(low_[at(axis)])) / spacing;
}

// Returns the first sample at or behind a crossing.
int MeshLayers::sample_at(int axis, double depth) const {
  const double sample = sample_of(axis, depth);
  if (!(sample > 0)) return 0;
  if (sample >= count_[at(axis)]) return count_[at(axis)];
  const int below = static_cast<int>(sample);
  return below < sample ? below + 1 : below;
}

void MeshLayers::run() {
  // Triangles are in the order in which layers reach them.
  std::vector<std::pair<int, std::uint32_t>> order;
  const auto layers_of = [&](std::size_t i) {
    const Triangle t = surface_.triangle(i);
    const auto [low, high] = std::minmax({t[0][at(s_)], t[1][at(s_)], t[2][at(s_)]});
    return samples(s_, low, high);
  };
  for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i) order.emplace_back(layers_of(i).first, i);
  std::sort(order.begin(), order.end());
  const auto begin_rays = [this](std::vector<std::int16_t>& totals) {
    for (std::int16_t& int16_t : totals)
      int16_t = inside_ == Inside::winding ? at_low_end<Inside::winding>(int16_t)
                                           : at_low_end<Inside::parity>(int16_t);
  };
  if (!surface_.closed) total_through_layers();
  begin_rays(told_s_);

  std::vector<std::uint32_t> active;
  std::size_t next = 0;
  for (Slab slab{0, 0}; slab.first < count_[at(s_)]; slab.first = slab.end) {
    slab.end = std::min(slab.first + thickness_, count_[at(s_)]);
    for (; next < order.size() && order[next].first < slab.end; ++next) active.push_back(order[next].second);
    if (!surface_.closed) {
      std::fill(told_q_.begin(), told_q_.end(), std::int16_t{0});
      for (const std::uint32_t i : active) total_in_layers(surface_.triangle(i), slab);
      begin_rays(told_q_);
    }
    for (Range band{0, 0}; band.first < count_[at(q_)]; band.first = band.end) {
      band.end = std::min(band.first + band_, count_[at(q_)]);
      decide_band(active, slab, band);
    }
    // A crossing may belong to the layer behind the last one that the triangle has samples in.
    std::erase_if(active, [&](std::uint32_t i) { return layers_of(i).end < slab.end; });
  }
}

void MeshLayers::decide_band(const std::vector<std::uint32_t>& active, Slab slab, Range band) {
  std::vector<Triangle> triangles;
  for (const std::uint32_t i : active) {
    const Triangle t = surface_.triangle(i);
    const auto [low, high] = std::minmax({t[0][at(q_)], t[1][at(q_)], t[2][at(q_)]});
    const Range rows = samples(q_, low, high);  // and a crossing may belong to the row behind them
    if (rows.first < band.end && rows.end >= band.first) triangles.push_back(t);
  }
  if (!surface_.closed) {
    std::fill(along_s_.begin(), along_s_.end(), std::int8_t{0});
    for (const Triangle& triangle : triangles) step_through_layers(triangle, slab, band);
  }
  for (int layer = slab.first; layer < slab.end; ++layer) {
    for (const Triangle& triangle : triangles) {
      cross_p(triangle, layer, band);
      if (!surface_.closed) cross_q(triangle, layer, band);
    }
    for (int q = band.first; q < band.end; ++q) add_row(q, q - band.first, layer - slab.first);
    if (layer % kSamplesPerAxis == kSamplesPerAxis - 1) store(layer, band);
  }
}

void MeshLayers::cross_p(const Triangle& triangle, int layer, Range band) {
  const std::int64_t v = place(s_, layer);
  const auto [low, high] = std::minmax({triangle[0][at(s_)], triangle[1][at(s_)], triangle[2][at(s_)]});
  if (v < low || v > high) return;
  const RayCrossings crossings(triangle, p_, s_);
  if (crossings.sign() == 0) return;
  const auto [first, last] = crossings.range_u(v);
  const Range rows = common(samples(q_, first, last), band);
  RayCrossings::Walk walk(crossings, place(q_, rows.first), v);
  for (int q = rows.first; q < rows.end; ++q, walk.next()) {
    const std::size_t to = sample_at(p_, walk.depth()), row = q - band.first;
    add_saturated(total_p_[row], -crossings.sign());
    if (to >= width_) continue;
    add_saturated(along_p_[row * width_ + to], -crossings.sign());
    touched_[row * chunks_ + to / kChunk] = 1;
  }
}

void MeshLayers::cross_q(const Triangle& triangle, int layer, Range band) {
  const std::int64_t v = place(s_, layer);
  const auto [low, high] = std::minmax({triangle[0][at(s_)], triangle[1][at(s_)], triangle[2][at(s_)]});
  if (v < low || v > high) return;
  const RayCrossings crossings(triangle, q_, s_);
  if (crossings.sign() == 0) return;
  const auto [first, last] = crossings.range_u(v);
  const Range rays = within(crossings, samples(p_, first, last), v, q_, band);
  RayCrossings::Walk walk(crossings, place(p_, rays.first), v);
  for (int p = rays.first; p < rays.end; ++p, walk.next()) {
    const int to = sample_at(q_, walk.depth());
    if (to < band.first || to >= band.end) continue;
    add_saturated(along_q_[(to - band.first) * width_ + p], -crossings.sign());
  }
}

// Sums the crossings of whole rays along q, in each layer of the slab.
void MeshLayers::total_in_layers(const Triangle& triangle, Slab slab) {
  const RayCrossings crossings(triangle, q_, s_);
  if (crossings.sign() == 0) return;
  const auto [low, high] = crossings.range_v();
  const Range layers = common(samples(s_, low, high), {slab.first, slab.end});
  for (int layer = layers.first; layer < layers.end; ++layer) {
    const auto [first, last] = crossings.range_u(place(s_, layer));
    const Range rays = samples(p_, first, last);
    std::int16_t* totals = told_q_.data() + (layer - slab.first) * width_;
    for (int p = rays.first; p < rays.end; ++p) add_saturated(totals[p], -crossings.sign());
  }
}

// Sums the crossings of whole rays across the layers. These rays meet all triangles, and their sums are
// needed from the first layer on.
void MeshLayers::total_through_layers() {
  for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
    const RayCrossings crossings(surface_.triangle(i), s_, q_);
    if (crossings.sign() == 0) continue;
    const auto [low, high] = crossings.range_v();
    const Range rows = samples(q_, low, high);
    for (int q = rows.first; q < rows.end; ++q) {
      const auto [first, last] = crossings.range_u(place(q_, q));
      const Range rays = samples(p_, first, last);
      std::int16_t* row = told_s_.data() + q * width_;
      for (int p = rays.first; p < rays.end; ++p) add_saturated(row[p], -crossings.sign());
    }
  }
}

void MeshLayers::step_through_layers(const Triangle& triangle, Slab slab, Range band) {
  const RayCrossings crossings(triangle, s_, q_);
  if (crossings.sign() == 0) return;
  const auto [low, high] = crossings.range_v();
  const Range rows = common(samples(q_, low, high), band);
  for (int q = rows.first; q < rows.end; ++q) {
    const std::int64_t v = place(q_, q);
    const auto [first, last] = crossings.range_u(v);
    const Range rays = within(crossings, samples(p_, first, last), v, s_, {slab.first, slab.end});
    RayCrossings::Walk walk(crossings, place(p_, rays.first), v);
    for (int p = rays.first; p < rays.end; ++p, walk.next()) {
      const int to = sample_at(s_, walk.depth());
      if (to < slab.first || to >= slab.end) continue;
      const std::size_t row = (to - slab.first) * band_ + q - band.first;
      add_saturated(along_s_[row * width_ + p], -crossings.sign());
    }
  }
}

// Returns the rays whose crossings lie in a part of the axis. Depth grows evenly along a row, so they are
// known but for rounding.
MeshLayers::Range MeshLayers::within(const RayCrossings& crossings, Range rays, std::int64_t v, int axis,
                                     Range part) const {
  constexpr int slack = 2;  // samples
  if (rays.end - rays.first < 8) return rays;
  const auto at_ray = [&](int p) { return sample_of(axis, crossings.depth(place(p_, p), v)); };
  const double from = at_ray(rays.first), to = at_ray(rays.end - 1);
  const double slope = (to - from) / (rays.end - 1 - rays.first);
  // The first part has all that lies before the window, too.
  const double least = part.first == 0 ? -1e18 : part.first - slack, most = part.end + slack;
  if (std::abs(slope) < 1e-6)
    return std::max(from, to) < least || std::min(from, to) > most ? Range{0, 0} : rays;
  const auto [near, far] = std::minmax({(least - from) / slope, (most - from) / slope});
  const double length = rays.end - rays.first;
  return {rays.first + static_cast<int>(std::clamp(std::floor(near), 0.0, length)),
          rays.first + static_cast<int>(std::clamp(std::ceil(far) + 1, 0.0, length))};
}

void MeshLayers::add_row(int q, int row, int layer) {
  if (surface_.closed)
    add_closed_row(q, row);
  else if (inside_ == Inside::winding)
    add_open_row<Inside::winding>(q, row, layer);
  else
    add_open_row<Inside::parity>(q, row, layer);
}

void MeshLayers::add_closed_row(int q, std::size_t row) {
  std::int16_t* crossings = along_p_.data() + row * width_;
  std::uint8_t* plane = plane_.data() + at(q) / kSamplesPerAxis * (width_ / kSamplesPerAxis);
  const bool winding = inside_ == Inside::winding;
  int w = 0;
  for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
    const std::size_t first = chunk * kChunk, end = std::min(first + kChunk, width_);
    std::uint8_t& touched = touched_[row * chunks_ + chunk];
    if (touched == 0) {
      if (winding ? w == 0 : w % 2 == 0) continue;
      for (std::size_t cell = first / kSamplesPerAxis; cell < end / kSamplesPerAxis; ++cell)
        plane[cell] = static_cast<std::uint8_t>(plane[cell] + kSamplesPerAxis);
      continue;
    }
    touched = 0;
    for (std::size_t i = first; i < end; ++i) {
      w += std::exchange(crossings[i], std::int16_t{0});
      most_ = std::max(most_, std::abs(w));
      plane[i / kSamplesPerAxis] =
          static_cast<std::uint8_t>(plane[i / kSamplesPerAxis] + ((winding ? w != 0 : w % 2 != 0) ? 1 : 0));
    }
  }
}

template <Inside inside>
void MeshLayers::add_open_row(int q, std::size_t row, int layer) {
  std::int16_t now = at_low_end<inside>(std::exchange(total_p_[row], std::int16_t{0}));
  for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
    const std::size_t first = chunk * kChunk, end = std::min(first + kChunk, width_);
    if (std::exchange(touched_[row * chunks_ + chunk], std::uint8_t{0}) != 0) {
      std::int16_t* crossings = along_p_.data() + row * width_;
      for (std::size_t i = first; i < end; i += kSamplesPerAxis)
        sum_up<inside>(crossings + i, now, told_p_.data() + i);
    } else {
      std::fill(told_p_.data() + first, told_p_.data() + end, now);
    }
  }

  std::int16_t* across = along_q_.data() + row * width_;
  const OpenRow open{told_p_.data(), told_q_.data() + at(layer) * width_, told_s_.data() + at(q) * width_};
  const std::int8_t* steps = along_s_.data() + (at(layer) * at(band_) + row) * width_;
  decide<inside>(width_, open, across, steps, inside_row_.data());
  std::fill(across, across + width_, std::int16_t{0});
  std::uint8_t* plane = plane_.data() + at(q) / kSamplesPerAxis * (width_ / kSamplesPerAxis);
  for (std::size_t i = 0; i < width_; i += kSamplesPerAxis) {
    const std::uint16_t* in = inside_row_.data() + i;
    plane[i / kSamplesPerAxis] =
        static_cast<std::uint8_t>(plane[i / kSamplesPerAxis] + in[0] + in[1] + in[2] + in[3]);
  }
}

// Stores a complete band of a layer of cells.
void MeshLayers::store(int layer, Range band) {
  const state::Grid size = coverage_.window.size;
  const std::array<std::size_t, 3> stride{1, size.index(0, 1, 0), size.index(0, 0, 1)};
  const std::size_t first = (layer / kSamplesPerAxis) * stride[at(s_)];
  const std::size_t width = width_ / kSamplesPerAxis, end = at(band.end) / kSamplesPerAxis;
  for (std::size_t q = at(band.first) / kSamplesPerAxis; q < end; ++q)
    for (std::size_t p = 0; p < width; ++p)
      coverage_.samples[first + p * stride[at(p_)] + q * stride[at(q_)]] =
          std::exchange(plane_[q * width + p], std::uint8_t{0});
}

}  // namespace voxmelt::scene
