#include "render/light/light_volume.h"

#include <algorithm>
#include <cstring>

namespace voxmelt::render {
namespace {

using picture::Vector;

constexpr int kReach = 2;  // reach of the spread, in rows

}  // namespace

void LightVolume::Span::add(int v) { add(Span{v, v + 1}); }
void LightVolume::Span::add(const Span& other) {
  if (!other.any()) return;
  if (!any()) {
    *this = other;
    return;
  }
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

LightVolume::LightVolume(const LightMatter& matter, Vector to_light, int shift) {
  cpu::Workers alone(1);
  update(matter, to_light, shift, alone);
}

bool LightVolume::update(const LightMatter& matter, Vector to_light, int shift, cpu::Workers& workers,
                         const LightLoops& loops) {
  const bool glows = !matter.emission.cells.empty();
  const bool other =
      !(matter.density.count == count_) || shift != shift_ || glows != !emission_.natural.empty();
  if (other) resize(matter, shift);
  const bool other_lamp = other || !(to_light == to_light_);
  to_light_ = to_light;
  const bool changed = take_over(matter, loops);
  if (!changed && !other_lamp) return false;

  workers.run(static_cast<int>(kSides) + 1, [&](int task) {
    Sweep& sweep = sweeps_[task];
    const auto rows = static_cast<std::size_t>(y_) * z_;
    sweep.open.assign(rows, 0);
    sweep.glow.assign(rows, 0);
    if (task == kSides) return sweep_lamp(sweep, other_lamp, loops);
    const std::size_t side = task;
    sweep_side(side, open_[side], nullptr, sweep.open, sweep.turned_open, sweep, loops);
    if (glows) sweep_side(side, glow_[side], &emission_, sweep.glow, sweep.turned_glow, sweep, loops);
  });
  interleave(workers, loops);
  return true;
}

void LightVolume::resize(const LightMatter& matter, int shift) {
  count_ = matter.density.count;
  shift_ = shift;
  x_ = static_cast<int>(count_.x);
  y_ = static_cast<int>(count_.y);
  z_ = static_cast<int>(count_.z);
  row_ = light_row(x_);
  turned_row_ = light_row(y_);
  const auto slices = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t natural = row_ * slices(y_) * slices(z_), turned = turned_row_ * slices(x_) * slices(z_);
  const bool glows = !matter.emission.cells.empty();
  density_ = {Bytes(natural, 0), Bytes(turned, 0)};
  emission_ = glows ? density_ : Plane{};
  lamp_ = {Bytes(natural, 255), Bytes(turned, 255)};
  for (std::size_t side = 0; side < kSides; ++side) {
    const bool turns = side < 2;
    open_[side] = {Bytes(natural, 255), Bytes(turns ? turned : 0, 255)};
    glow_[side] = {Bytes(glows ? natural : 0, 0), Bytes(glows && turns ? turned : 0, 0)};
  }
  cells_.assign(slices(x_) * slices(y_) * slices(z_), LightBytes{});
  nothing_.assign(row_, 0);
  dirty_ = {std::vector<Span>(slices(x_)), std::vector<Span>(slices(y_)), std::vector<Span>(slices(z_))};
}

// Takes over the matter. The planes begin with the light of an empty volume, so a fresh volume needs only the
// differences.
bool LightVolume::take_over(const LightMatter& matter, const LightLoops& loops) {
  for (auto& spans : dirty_) std::fill(spans.begin(), spans.end(), Span{});
  const bool density = take_over(matter.density, density_, loops);
  const bool emission = !matter.emission.cells.empty() && take_over(matter.emission, emission_, loops);
  return density || emission;
}

bool LightVolume::take_over(const LightPlane& from, Plane& to, const LightLoops& loops) {
  bool any = false;
  const std::size_t x = x_;
  Bytes changed(x);
  for (int z = 0; z < z_; ++z) {
    bool here = false;
    for (int y = 0; y < y_; ++y) {
      const auto row = static_cast<std::size_t>(z) * y_ + y;
      std::uint8_t* const own = to.natural.data() + row * row_;
      const std::uint8_t* const fresh = from.cells.data() + row * x;
      if (std::memcmp(own, fresh, x) == 0) continue;
      std::memcpy(own, fresh, x);
      dirty_[1][y].add(z);
      dirty_[2][z].add(y);
      here = true;
    }
    if (!here) continue;
    any = true;
    std::fill(changed.begin(), changed.end(), 0);
    loops.transpose(to.natural.data() + static_cast<std::size_t>(z) * y_ * row_, row_, y_, x_,
                    to.turned.data() + z * turned_row_, turned_row_ * z_, changed.data());
    for (std::size_t i = 0; i < x; ++i)
      if (changed[i] != 0) dirty_[0][i].add(z);
  }
  return any;
}

LightVolume::Way LightVolume::way(int axis, bool from_high) const {
  const auto y = static_cast<std::size_t>(y_), z = static_cast<std::size_t>(z_);
  if (axis == 0) return {true, x_, y_, z_, turned_row_, turned_row_ * z, turned_row_, from_high};
  if (axis == 1) return {false, y_, x_, z_, row_, row_, row_ * y, from_high};
  return {false, z_, x_, y_, row_, row_ * y, row_, from_high};
}

// Sweeps from one side. A slice depends on the one before it alone. So only rows near changed rows of that
// slice are computed.
void LightVolume::sweep_side(std::size_t side, Plane& plane, const Plane* emission, Bytes& changed,
                             Bytes& turned_changed, Sweep& sweep, const LightLoops& loops) const {
  const int axis = static_cast<int>(side / 2);
  const Way way = this->way(axis, side % 2 == 0);
  const auto& dirty = dirty_[axis];
  std::uint8_t* const light = (way.turned ? plane.turned : plane.natural).data();
  const std::uint8_t* const density = (way.turned ? density_.turned : density_.natural).data();
  const std::uint8_t* const sent =
      emission == nullptr ? nullptr : (way.turned ? emission->turned : emission->natural).data();
  sweep.rows.assign(way.v, 0);
  sweep.room.resize((way.v + 5) * (way.row + kLightLanes));
  turned_changed.assign(z_, 0);
  Span last;
  for (int s = 1; s < way.slices; ++s) {
    last.add(dirty[way.at(s - 1)]);
    if (!last.any()) continue;
    const std::size_t before = way.byte(s - 1);
    const Span rows{std::max(last.low - kReach, 0), std::min(last.high + kReach, way.v)};
    loops.side({way.u, way.v, rows.low, rows.high, way.row, way.row_step, light + before, density + before,
                sent == nullptr ? nullptr : sent + before, light + way.byte(s), sweep.rows.data(),
                sweep.room.data()});
    last = {};
    for (int v = rows.low; v < rows.high; ++v) {
      if (sweep.rows[v] == 0) continue;
      last.add(v);
      if (way.turned)
        turned_changed[v] = 1;
      else if (axis == 1)
        changed[static_cast<std::size_t>(v) * y_ + way.at(s)] = 1;
      else
        changed[static_cast<std::size_t>(way.at(s)) * y_ + v] = 1;
    }
  }
  if (way.turned) turn_back(plane, turned_changed, changed, loops);
}

void LightVolume::turn_back(Plane& plane, const Bytes& slices, Bytes& changed,
                            const LightLoops& loops) const {
  const auto y = static_cast<std::size_t>(y_), z = static_cast<std::size_t>(z_);
  for (std::size_t k = 0; k < z; ++k)
    if (slices[k] != 0)
      loops.transpose(plane.turned.data() + k * turned_row_, turned_row_ * z, x_, y_,
                      plane.natural.data() + k * y * row_, row_, changed.data() + k * y);
}

// Lays out the rays along the axis of the direction's largest component. Among equals y comes before x, and x
// before z. A cell at (u, v) of a slice lies between the rays around (u, v) plus the shift. A ray lies
// between the cells around it less the shift.
LightVolume::LampRays LightVolume::lamp_rays() const {
  const std::int64_t component[3] = {to_light_.x, to_light_.y, to_light_.z};
  int axis = 1;
  for (const int other : {0, 2})
    if (picture::magnitude(component[other]) > picture::magnitude(component[axis])) axis = other;
  const auto slope = [&](int other) {
    return static_cast<std::int32_t>(
        picture::floor_divided(component[other] * picture::kLength, picture::magnitude(component[axis])));
  };
  LampRays rays{axis, way(axis, component[axis] > 0), slope(axis == 0 ? 1 : 0), slope(axis == 2 ? 1 : 2)};

  // Rays from `low` on pass through the grid, at the first slice or at the last.
  const auto low = [&](std::int32_t s) {
    return std::min(picture::shift_at(rays.way.slices, s).cells, 0) - 1;
  };
  const auto more = [&](std::int32_t s) {
    return static_cast<int>(picture::magnitude(picture::shift_at(rays.way.slices, s).cells)) + 4;
  };
  rays.low_u = low(rays.slope_u);
  rays.low_v = low(rays.slope_v);
  rays.count_u = rays.way.u + more(rays.slope_u);
  rays.count_v = rays.way.v + more(rays.slope_v);
  rays.row = light_row(rays.count_u) + 3 * kLightLanes;
  return rays;
}

// Returns the slice at which an update begins, and restores the rays before it. The rays are kept every
// kKeptEvery slices. So an update begins near the first slice in which something changed.
int LightVolume::begin_lamp(const LampRays& lamp, bool other_lamp, Sweep& sweep, Span& dark) const {
  const std::size_t size = (lamp.count_v + 2) * lamp.row;
  sweep.room.resize(size);
  sweep.losses.resize(static_cast<std::size_t>(lamp.way.v + 2) * lamp.row);
  sweep.rows.assign(static_cast<std::size_t>(lamp.way.v), 0);
  // The content of the turned plane may come from an earlier lamp.
  sweep.turned_open.assign(static_cast<std::size_t>(z_), other_lamp ? 1 : 0);
  if (other_lamp) {
    sweep.kept.clear();
    sweep.rays.assign(size, 255);
    return 0;
  }
  const auto& dirty = dirty_[lamp.axis];
  int begin = 0;
  while (begin < lamp.way.slices && !dirty[lamp.way.at(begin)].any()) ++begin;
  begin = std::min(begin / kKeptEvery, static_cast<int>(sweep.kept.size()) - 1) * kKeptEvery;
  const Kept& kept = sweep.kept[begin / kKeptEvery];
  sweep.rays = kept.rays;
  dark = kept.dark;
  return begin;
}

// Notes the rows of a slice that the sweep has changed.
void LightVolume::note_lamp_rows(const LampRays& lamp, int slice, Sweep& sweep) const {
  const auto at = static_cast<std::size_t>(lamp.way.at(slice)), rows = static_cast<std::size_t>(y_);
  for (std::size_t i = 0; i < static_cast<std::size_t>(lamp.way.v); ++i) {
    if (sweep.rows[i] == 0) continue;
    if (lamp.way.turned)
      sweep.turned_open[i] = 1;
    else if (lamp.axis == 1)
      sweep.open[i * rows + at] = 1;
    else
      sweep.open[at * rows + i] = 1;
  }
}

void LightVolume::sweep_lamp(Sweep& sweep, bool other_lamp, const LightLoops& loops) {
  const LampRays lamp = lamp_rays();
  const Way& way = lamp.way;
  Span dark;
  const int begin = begin_lamp(lamp, other_lamp, sweep, dark);
  std::uint8_t* const light = (way.turned ? lamp_.turned : lamp_.natural).data();
  const std::uint8_t* const density = (way.turned ? density_.turned : density_.natural).data();
  for (int s = begin; s < way.slices; ++s) {
    if (s % kKeptEvery == 0) {
      const std::size_t at = s / kKeptEvery;
      if (sweep.kept.size() <= at) sweep.kept.resize(at + 1);
      if (s != begin || other_lamp) sweep.kept[at] = {sweep.rays, dark};
    }
    const picture::Shift u = picture::shift_at(s, lamp.slope_u), v = picture::shift_at(s, lamp.slope_v);
    const int at_u = u.cells - lamp.low_u, at_v = v.cells - lamp.low_v;
    dark.add({at_v, at_v + way.v + 1});
    dark = {std::max(dark.low - 1, 0), std::min(dark.high + 1, lamp.count_v)};
    loops.lamp({way.u, way.v, way.row, way.row_step, density + way.byte(s), light + way.byte(s),
                sweep.rows.data(), u.part, v.part, sweep.rays.data(), sweep.room.data(), sweep.losses.data(),
                lamp.row, lamp.count_u, lamp.count_v, at_u, at_v, dark.low, dark.high});
    note_lamp_rows(lamp, s, sweep);
  }
  if (way.turned) turn_back(lamp_, sweep.turned_open, sweep.open, loops);
}

// Interleaves the rows that some sweep has changed.
void LightVolume::interleave(cpu::Workers& workers, const LightLoops& loops) {
  const std::size_t rows = y_;
  workers.run(z_, [&](int z) {
    for (std::size_t row = z * rows; row < (static_cast<std::size_t>(z) + 1) * rows; ++row) {
      std::uint8_t open = 0, glow = 0;
      for (const Sweep& sweep : sweeps_) {
        open = static_cast<std::uint8_t>(open | sweep.open[row]);
        glow = static_cast<std::uint8_t>(glow | sweep.glow[row]);
      }
      const auto one = [&](const Plane& plane) { return plane.natural.data() + row * row_; };
      auto* const to = reinterpret_cast<std::uint8_t*>(cells_.data() + row * x_);
      const std::uint8_t* const none = nothing_.data();
      if (open != 0)
        loops.interleave({one(lamp_), one(open_[0]), one(open_[1]), one(open_[2]), one(open_[3]),
                          one(open_[4]), one(open_[5]), none},
                         x_, to);
      if (glow != 0)
        loops.interleave({one(glow_[0]), one(glow_[1]), one(glow_[2]), one(glow_[3]), one(glow_[4]),
                          one(glow_[5]), none, none},
                         x_, to + 8);
    }
  });
}

picture::Light LightVolume::operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const LightBytes& cell = cells_[(z * count_.y + y) * count_.x + x];
  picture::Light light;
  light.lamp = cell.lamp;
  for (std::size_t side = 0; side < picture::kSides; ++side) {
    light.open[side] = cell.open[side];
    light.glow[side] = cell.glow[side];
  }
  return light;
}

}  // namespace voxmelt::render
