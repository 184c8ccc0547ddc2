// The view of a camera and the ray of a place follow docs/picture/definition.md sections 3 and 4.
#pragma once

#include <algorithm>
#include <cstdint>

#include "input.h"

struct View {
  Vec forward, eye, wide, high, near_wide, near_high;
  Int near = 0, width = 0, height = 0, halvings = 0;
};

struct Ray {
  Vec start, step;
  Int halvings = 0;  // halvings of the step: section 10
};

inline Vec times30(Vec a, Int b) {
  return {rounded(a.x * b, 30), rounded(a.y * b, 30), rounded(a.z * b, 30)};
}

// Changes wide, high and eye for parallel rays (section 3, "Parallel rays").
inline void orthographic(View& view, Int near, Int distance, Int tangent, Int H) {
  view.near = near;
  if (near < 1) {
    const Vec back = view.forward * (1 - near);  // to where the plane has depth 1
    view.eye =
        view.eye - Vec{ceil_divided(back.x, 16384), ceil_divided(back.y, 16384), ceil_divided(back.z, 16384)};
    view.near = 1;
  }
  const Int scale = tangent * (distance / 256), limit = 15 * H * power_of_two(25);
  view.halvings = scale >= 2 * limit ? 0 : scale >= limit ? 1 : 2;
  view.near_wide = (view.wide * distance) / (131072 * H);
  view.near_high = (view.high * distance) / (131072 * H);
  view.wide = view.high = Vec{};
}

inline View make_view(const Input& in) {
  const Int degree = 65536;
  const Int W = in.width, H = in.height;
  const Vec target{scaled_number(in.target_x, 20), scaled_number(in.target_y, 20),
                   scaled_number(in.target_z, 20)};
  const Int elevation = clamped(scaled_number(in.elevation, 16), -89 * degree, 89 * degree);
  const auto [Sa, Ca] = sine_cosine(scaled_number(in.azimuth, 16));
  const auto [Se, Ce] = sine_cosine(elevation);
  const auto [Sf, Cf] = sine_cosine(scaled_number(in.field_of_view, 15));  // half of the field

  const Vec horizontal{Sa, 0, Ca};
  Vec back = times30(horizontal, Ce);
  back.y = Se;
  const Vec right{Ca, 0, -Sa};
  const Vec up{-rounded(Sa * Se, 30), Ce, -rounded(Ca * Se, 30)};
  const Int tangent = floor_divided(power_of_two(30) * Sf, Cf);

  View view;
  view.width = W;
  view.height = H;
  view.forward = -back;

  Int distance = scaled_number(in.distance, 12);
  if (distance == 0) {  // the distance that fits
    distance = 1;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec cells{corner & 1 ? in.nx : 0, corner & 2 ? in.ny : 0, corner & 4 ? in.nz : 0};
      const Vec from = ((cells << 20) - target) >> 8;
      const auto along = [&](Vec a) { return dot(from, a) >> 30; };
      const auto reach = [&](Int s) {
        return floor_divided(std::min(magnitude(s) * 1055, power_of_two(42)) * power_of_two(20), tangent);
      };
      const Int before = in.orthographic ? 0 : -along(view.forward);
      distance = std::max(distance, before + reach(floor_divided(along(right) * H, W)));
      distance = std::max(distance, before + reach(along(up)));
    }
    distance = std::min(distance, power_of_two(30));
  }
  view.eye = target + ((back * distance) >> 22);
  view.wide = (right * tangent) >> 30;
  view.high = (up * tangent) >> 30;

  Int least = INT64_MAX;
  const Int half = power_of_two(19);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec place{corner & 1 ? (in.nx << 20) + half : -half, corner & 2 ? (in.ny << 20) + half : -half,
                    corner & 4 ? (in.nz << 20) + half : -half};
    least = std::min(least, dot((place - view.eye) >> 16, view.forward) >> 30);
  }
  if (in.orthographic) {
    orthographic(view, least - 3, distance, tangent, H);
    return view;
  }
  view.near = std::max<Int>(0, least - 3);
  // Section 10 defines e.
  const Int scale = tangent * view.near, limit = 15 * H * power_of_two(25);
  view.halvings = scale >= 2 * limit ? 0 : scale >= limit ? 1 : 2;
  view.near_wide = (view.wide * view.near) / (512 * H);
  view.near_high = (view.high * view.near) / (512 * H);
  return view;
}

// Returns the ray of the place (X, Y), in 64ths of a pixel, with a step of 2^-m cells (section 4).
inline Ray make_ray(const View& view, Int X, Int Y, Int m) {
  const Int u = X - 32 * view.width, v = 32 * view.height - Y;
  const Vec direction = view.forward * (32 * view.height) + view.wide * u + view.high * v;
  Ray ray;
  ray.halvings = view.halvings;
  ray.start =
      view.eye + ((view.forward * view.near) >> 14) + ((view.near_wide * u + view.near_high * v) >> 10);
  const Int largest = largest_magnitude(direction);
  Int b = 0;
  while (largest > power_of_two(b)) ++b;
  const Int shift = b - 20 + m;
  ray.step = {rounded(direction.x, shift), rounded(direction.y, shift), rounded(direction.z, shift)};
  return ray;
}

struct Range {
  Int first, last;
};

// Returns the k from 0 on with low <= start + k step < high on every axis (section 5).
inline Range range_in_box(Vec start, Vec step, Vec low, Vec high) {
  Range range{0, INT64_MAX};
  for (int axis = 0; axis < 3; ++axis) {
    const Int from = low.at(axis) - start.at(axis), to = high.at(axis) - 1 - start.at(axis),
              d = step.at(axis);
    if (d == 0) {
      if (from > 0 || to < 0) return {0, -1};
    } else if (d > 0) {
      range.first = std::max(range.first, ceil_divided(from, d));
      range.last = std::min(range.last, floor_divided(to, d));
    } else {  // mirrored
      range.first = std::max(range.first, ceil_divided(-to, -d));
      range.last = std::min(range.last, floor_divided(-from, -d));
    }
  }
  return range;
}
