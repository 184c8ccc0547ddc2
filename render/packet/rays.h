// The rays of a packet turn places of the picture into starts, steps, and the samples in a box.
//
// Directions and starts are whole numbers below 2^53, so doubles hold them exactly.
#pragma once

#include <cstdint>
#include <cstring>

#include "render/packet/packet.h"
#include "render/packet/picture_data.h"
#include "render/rule/ground.h"

namespace voxmelt::render {

template <class Arch>
struct Rays : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::F;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using D = typename L::D;
  using HalfV = typename L::HalfV;
  using HalfF = typename L::HalfF;

  // Holds a double for each lane, in two halves.
  struct Doubles {
    D low, high;
  };
  struct Starts {
    Doubles x, y, z;
  };
  struct Row {
    Triple step;                        // in 2^-20 cells
    Starts start;                       // position of sample 0
    F inverse_x, inverse_y, inverse_z;  // 1 / |step|
  };

  VOXMELT_WORDS Row through(const PictureData& data, V across, V down) {
    const Half low = half_through(data, L::template half<0>(across), L::template half<0>(down));
    const Half high = half_through(data, L::template half<1>(across), L::template half<1>(down));
    Row row;
    row.step = {L::joined(low.step_x, high.step_x), L::joined(low.step_y, high.step_y),
                L::joined(low.step_z, high.step_z)};
    row.start = {{low.start_x, high.start_x}, {low.start_y, high.start_y}, {low.start_z, high.start_z}};
    row.inverse_x = inverse(row.step.x);
    row.inverse_y = inverse(row.step.y);
    row.inverse_z = inverse(row.step.z);
    return row;
  }

  // Returns which samples may lie in a box, and a little around it. The margin is up to four samples, and a
  // cell at most. Floats err by less than 2^-21 of the way, which has 2^22 samples at most (fits_lanes).
  struct Samples {
    V first, last;
  };
  VOXMELT_WORDS Samples in_box(const Row& row, picture::Vector low, picture::Vector high) {
    Span span{L::set_float(0), L::set_float(1e9f)};
    clip(span, row.start.x, row.step.x, row.inverse_x, low.x, high.x);
    clip(span, row.start.y, row.step.y, row.inverse_y, low.y, high.y);
    clip(span, row.start.z, row.step.z, row.inverse_z, low.z, high.z);
    constexpr float kMore = 1.0f / (1 << 21);
    const F first = L::max(span.first - span.first * kMore - 1.0f, L::set_float(0));
    const F last = span.last + span.last * kMore + 1.0f;
    return {L::to_int(L::min(first, L::set_float(1.5e9f))), L::to_int(L::min(last, L::set_float(1e9f)))};
  }

  // Returns the parts of rays in the box low <= position < high (picture::ground_parts). They are exact if
  // fits_lanes holds. A quotient of whole numbers below 2^47 by one below 2^19 does not reach a whole number
  // by its rounding.
  VOXMELT_WORDS Samples parts_in(const Row& row, picture::Vector low, picture::Vector high) {
    const auto half = [&]<int kWhich>(D x, D y, D z) {
      D first = D{}, last = D{} + kMostParts;
      const auto clip = [&](D start, HalfV step, std::int64_t from, std::int64_t to) {
        const D by = to_double(step), before = (static_cast<double>(from) - start) * picture::kParts,
                behind = (static_cast<double>(to) - start) * picture::kParts - 1.0;
        const auto back = by < 0.0;
        const D size = by == 0.0 ? D{} + 1e-30 : positive(by);
        first = larger(first, (back ? -behind : before) / size);
        const D end = (back ? -before : behind) / size;
        last = end < last ? end : last;
      };
      clip(x, L::template half<kWhich>(row.step.x), low.x, high.x);
      clip(y, L::template half<kWhich>(row.step.y), low.y, high.y);
      clip(z, L::template half<kWhich>(row.step.z), low.z, high.z);
      const D most = D{} + kMostParts;
      first = first < most ? first : most;
      return Ends{__builtin_convertvector(-floor_of(-first), HalfV),
                  __builtin_convertvector(floor_of(larger(last, D{} - 1.0)), HalfV)};
    };
    const Ends below = half.template operator()<0>(row.start.x.low, row.start.y.low, row.start.z.low);
    const Ends above = half.template operator()<1>(row.start.x.high, row.start.y.high, row.start.z.high);
    return {L::joined(below.first, above.first), L::joined(below.last, above.last)};
  }

  // Returns the low 32 bits of the starts.
  VOXMELT_WORDS Triple wrapped_start(const Row& row) {
    return {wrapped(row.start.x), wrapped(row.start.y), wrapped(row.start.z)};
  }
  // Returns picture::position_at near the grid. Elsewhere it wraps.
  VOXMELT_WORDS Triple at_part(const Row& row, Triple start, V part) {
    const V whole = part >> picture::kPartBits, rest = part & (picture::kParts - 1);
    const auto axis = [&](V from, V step) {
      return L::as_signed(L::as_unsigned(from) + L::as_unsigned(step) * L::as_unsigned(whole) +
                          L::as_unsigned((step * rest) >> picture::kPartBits));
    };
    return {axis(start.x, row.step.x), axis(start.y, row.step.y), axis(start.z, row.step.z)};
  }

  // Returns the position of a sample near the grid, plus `bias`. Lanes without samples may be anywhere.
  VOXMELT_WORDS Triple at(const Row& row, V sample, std::int32_t bias) {
    return {along(row.start.x, row.step.x, sample, bias), along(row.start.y, row.step.y, sample, bias),
            along(row.start.z, row.step.z, sample, bias)};
  }

 private:
  static constexpr double kMostParts = 1 << 30;
  struct Ends {
    HalfV first, last;
  };
  VOXMELT_WORDS V wrapped(const Doubles& a) {
    const auto part = [](D d) {
      typename L::Q bits;
      d = d + 6755399441055744.0;  // 1.5 2^52
      std::memcpy(&bits, &d, sizeof bits);
      return __builtin_convertvector(bits, HalfV);
    };
    return L::joined(part(a.low), part(a.high));
  }
  struct Half {
    HalfV step_x, step_y, step_z;
    D start_x, start_y, start_z;
  };

  VOXMELT_WORDS D to_double(HalfV a) { return __builtin_convertvector(a, D); }
  VOXMELT_WORDS D larger(D a, D b) { return a < b ? b : a; }
  VOXMELT_WORDS D positive(D a) { return larger(a, -a); }

  // Returns floor(a), where |a| < 2^52.
  VOXMELT_WORDS D floor_of(D a) {
    constexpr double kRound = 6755399441055744.0;  // 1.5 2^52
    const D near = (a + kRound) - kRound;
    return near > a ? near - 1.0 : near;
  }

  VOXMELT_WORDS D direction(const picture::View& view, D u, D v, std::int64_t forward, std::int64_t wide,
                            std::int64_t high) {
    return u * static_cast<double>(wide) +
           (v * static_cast<double>(high) + static_cast<double>(forward * view.half_height));
  }
  VOXMELT_WORDS D start(const picture::View& view, D u, D v, std::int64_t eye, std::int64_t forward,
                        std::int64_t wide, std::int64_t high) {
    const D on_plane = (u * static_cast<double>(wide) + v * static_cast<double>(high)) * (1.0 / 1024);
    return floor_of(on_plane) + static_cast<double>(eye + ((forward * view.near) >> 14));
  }
  VOXMELT_WORDS HalfV rounded(D a) { return __builtin_convertvector(floor_of(a + 0.5), HalfV); }

  VOXMELT_WORDS Half half_through(const PictureData& data, HalfV across, HalfV down) {
    const picture::View& view = data.view;
    const D u = to_double(across) - static_cast<double>(view.half_width);
    const D v = static_cast<double>(view.half_height) - to_double(down);
    const D x = direction(view, u, v, view.forward.x, view.wide.x, view.high.x),
            y = direction(view, u, v, view.forward.y, view.wide.y, view.high.y),
            z = direction(view, u, v, view.forward.z, view.wide.z, view.high.z);

    // The scale is 2^-shift, from the exponent of the largest component less 1.
    using Q = typename L::Q;
    const D most = larger(larger(positive(x), positive(y)), positive(z)) - 1.0;
    Q exponent;
    std::memcpy(&exponent, &most, sizeof exponent);
    exponent = exponent >> 52;  // 1022 more than the bits of `most`, which is positive
    const Q power = (static_cast<std::uint64_t>(1023 + 1022 + 20 - data.spacing) - exponent) << 52;
    D scale;
    std::memcpy(&scale, &power, sizeof scale);
    return {rounded(x * scale),
            rounded(y * scale),
            rounded(z * scale),
            start(view, u, v, view.eye.x, view.forward.x, view.near_wide.x, view.near_high.x),
            start(view, u, v, view.eye.y, view.forward.y, view.near_wide.y, view.near_high.y),
            start(view, u, v, view.eye.z, view.forward.z, view.near_wide.z, view.near_high.z)};
  }
  VOXMELT_WORDS F inverse(V step) { return 1.0f / L::to_float(P::magnitude(step)); }

  VOXMELT_WORDS F to_floats(const Doubles& a) {
    return L::joined(__builtin_convertvector(a.low, HalfF), __builtin_convertvector(a.high, HalfF));
  }
  struct Span {
    F first, last;
  };
  VOXMELT_WORDS void clip(Span& span, const Doubles& start, V step, F inverse, std::int64_t from,
                          std::int64_t to) {
    const F begin = to_floats(start);
    const F before = static_cast<float>(from) - begin, behind = static_cast<float>(to) - begin;
    const V back = step < 0, still = step == 0;
    // A ray that does not move along the axis is in or out. The margin exceeds the samples that in_box adds.
    const F near = still ? (before > 4096.0f ? L::set_float(2e9f) : L::set_float(0))
                         : (back ? -behind : before) * inverse;
    const F far = still ? (behind < -4096.0f ? L::set_float(-1e9f) : L::set_float(1e9f))
                        : (back ? -before : behind) * inverse;
    span.first = L::max(span.first, near);
    span.last = L::min(span.last, far);
  }

  VOXMELT_WORDS V along(const Doubles& start, V step, V sample, std::int32_t bias) {
    const auto part = [&](D begin, HalfV k, HalfV by) {
      const D place = begin + to_double(k) * to_double(by) + static_cast<double>(bias);
      constexpr double kMost = 2147483000;
      const D most = D{} + kMost;
      return __builtin_convertvector(larger(-most, most < place ? most : place), HalfV);
    };
    return L::joined(part(start.low, L::template half<0>(sample), L::template half<0>(step)),
                     part(start.high, L::template half<1>(sample), L::template half<1>(step)));
  }
};

}  // namespace voxmelt::render
