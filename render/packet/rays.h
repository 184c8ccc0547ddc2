// A packet's rays: places of the picture to starts, steps, and the samples in the lattice.
//
// Directions and starts are whole numbers below 2^53, so doubles hold them exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "render/packet/packet.h"
#include "render/packet/picture_data.h"

namespace voxmelt::render {

template <class Arch>
struct Rays : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::D;
  using typename P::F;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;

  struct Row {
    Triple step;            // in 2^-20 cells
    D start_x, start_y, start_z;  // of sample 0
    F inverse_x, inverse_y, inverse_z;  // 1 / |step|
  };

  // floor(a), |a| < 2^31.
  VOXMELT_WORDS V floored(D a) {
    const V down = __builtin_convertvector(a, V);
    return down + __builtin_convertvector(__builtin_convertvector(down, D) > a, V);
  }

  VOXMELT_WORDS Row through(const PictureData& data, V across, V down) {
    const picture::View& view = data.view;
    const D u = __builtin_convertvector(across, D) - static_cast<double>(view.half_width);
    const D v = static_cast<double>(view.half_height) - __builtin_convertvector(down, D);
    const auto direction = [&](std::int64_t forward, std::int64_t wide, std::int64_t high) {
      return u * static_cast<double>(wide) + (v * static_cast<double>(high) + static_cast<double>(forward * view.half_height));
    };
    const D x = direction(view.forward.x, view.wide.x, view.high.x),
            y = direction(view.forward.y, view.wide.y, view.high.y),
            z = direction(view.forward.z, view.wide.z, view.high.z);
    const auto positive = [](D a) { return a < 0 ? -a : a; };
    const auto larger = [](D a, D b) { return a < b ? b : a; };
    const D most = larger(larger(positive(x), positive(y)), positive(z)) - 1;

    // 2^-shift, from the exponent of the largest component.
    D scale;
    for (int i = 0; i < P::kCount; ++i) {
      std::uint64_t bits;
      const double one = most[i];
      std::memcpy(&bits, &one, 8);
      const std::uint64_t bits_of = (bits >> 52) - 1022;  // the least n with most < 2^n
      const std::uint64_t shift = bits_of - 20 + static_cast<std::uint64_t>(data.spacing);
      bits = (1023 - shift) << 52;
      double power;
      std::memcpy(&power, &bits, 8);
      scale[i] = power;
    }
    Row row;
    row.step = {floored(x * scale + 0.5), floored(y * scale + 0.5), floored(z * scale + 0.5)};

    const auto start = [&](std::int64_t eye, std::int64_t forward, std::int64_t wide, std::int64_t high) {
      const D on_plane = (u * static_cast<double>(wide) + v * static_cast<double>(high)) * (1.0 / 1024);
      return floor_of(on_plane) + static_cast<double>(eye + ((forward * view.near) >> 14));
    };
    row.start_x = start(view.eye.x, view.forward.x, view.near_wide.x, view.near_high.x);
    row.start_y = start(view.eye.y, view.forward.y, view.near_wide.y, view.near_high.y);
    row.start_z = start(view.eye.z, view.forward.z, view.near_wide.z, view.near_high.z);
    const auto inverse = [](V step) { return 1.0f / L::to_float(P::magnitude(step)); };
    row.inverse_x = inverse(row.step.x);
    row.inverse_y = inverse(row.step.y);
    row.inverse_z = inverse(row.step.z);
    return row;
  }

  // Which samples may lie in a box, and a little around it.
  struct Samples {
    V first, last;
  };
  VOXMELT_WORDS Samples in_box(const Row& row, picture::Vector low, picture::Vector high) {
    F first = L::set_float(0), last = L::set_float(1e9f);
    const auto axis = [&](D start, V step, F inverse, std::int64_t from, std::int64_t to) {
      const F begin = __builtin_convertvector(start, F);
      const F before = static_cast<float>(from) - begin, behind = static_cast<float>(to) - begin;
      const V back = step < 0;
      F near = (back ? -behind : before), far = (back ? -before : behind);
      // A ray that does not move along the axis is in or out.
      const V still = step == 0;
      near = still ? (near > 4096.0f ? L::set_float(2e9f) : L::set_float(0)) : near * inverse;
      far = still ? (far < -4096.0f ? L::set_float(-1) : L::set_float(1e9f)) : far * inverse;
      first = L::max(first, near);
      last = L::min(last, far);
    };
    axis(row.start_x, row.step.x, row.inverse_x, low.x, high.x);
    axis(row.start_y, row.step.y, row.inverse_y, low.y, high.y);
    axis(row.start_z, row.step.z, row.inverse_z, low.z, high.z);
    constexpr float kMore = 1.0f / (1 << 20);
    first = L::max(first - first * kMore - 1.0f, L::set_float(0));
    last = last + last * kMore + 1.0f;
    return {L::to_int(L::min(first, L::set_float(1.5e9f))), L::to_int(L::min(last, L::set_float(1e9f)))};
  }

  // The position of a sample near the grid, plus `bias`.
  VOXMELT_WORDS Triple at(const Row& row, V sample, std::int32_t bias) {
    const D k = __builtin_convertvector(sample, D);
    const auto axis = [&](D start, V step) {
      D place = start + k * __builtin_convertvector(step, D) + static_cast<double>(bias);
      // Lanes without samples may be anywhere.
      place = place < -2147483000.0 ? D{} - 2147483000.0 : place > 2147483000.0 ? D{} + 2147483000.0 : place;
      return __builtin_convertvector(place, V);
    };
    return {axis(row.start_x, row.step.x), axis(row.start_y, row.step.y), axis(row.start_z, row.step.z)};
  }

 private:
  // floor(a), |a| < 2^52.
  VOXMELT_WORDS D floor_of(D a) {
    constexpr double kRound = 6755399441055744.0;  // 1.5 2^52
    const D near = (a + kRound) - kRound;
    return near - (near > a ? D{} + 1.0 : D{});
  }
};

}  // namespace voxmelt::render
