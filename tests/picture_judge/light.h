// The grid of light and its sweeps follow docs/picture/light.md sections 4 and 5.
#pragma once

#include <algorithm>

#include "ground.h"
#include "look.h"

// Returns the heat byte of a cell, without the rule for cells of air (section 3).
inline Int heat_byte(const Look& look, Int L, Int H) {
  const Int t = L == 0 || !look.glows ? 0 : 256 * std::min<Int>(256 * H / L, 256);
  return clamped(floor_divided(255 * (t - look.cold), std::max<Int>(look.hot - look.cold, 1)), 0, 255);
}
// Returns the byte of a cell that has the tone of its solid instead.
inline Int tone_byte(Int S, Int H) { return S == 0 ? 0 : std::min<Int>(256 * H / S, 255); }
inline Int passed(Int a, Int loss) { return (a * (256 - loss) + 128) >> 8; }
inline Int whole(Int b) { return b + (b >> 7); }

// Holds the light of a place in front of a surface: bytes, sides in the order +x, -x, +y, -y, +z, -z.
struct LightBytes {
  Int lamp = 0, open[6] = {}, glow[6] = {};
};
inline Int seen(const Int (&sides)[6], Vec r) {
  const auto part = [&](int axis) {
    const Int c = r.at(axis);
    return ((c * c) >> 14) * sides[2 * axis + (c >= 0 ? 0 : 1)];
  };
  return std::min<Int>((part(0) + part(1) + part(2)) >> 14, 255);
}

class LightGrid {
 public:
  LightGrid(const Input& in, const Look& look, const Field& field, const Ground& ground) {
    while (in.nx * in.ny * in.nz > power_of_two(19 + 3 * s)) ++s;
    const Int cells[3] = {in.nx, in.ny, in.nz};
    for (int axis = 0; axis < 3; ++axis) n[axis] = ceil_divided(cells[axis], power_of_two(s));
    fill(in, look, field, ground);
    sweep_lamp(look.to_light);
    for (int side = 0; side < 6; ++side) sweep_side(side, false);
    if (look.glows)
      for (int side = 0; side < 6; ++side) sweep_side(side, true);
    else
      for (Ints& g : glow) g.assign(loss.size(), 0);
  }
  // Returns the light at a surface (section 5).
  LightBytes at_surface(Vec p, Vec normal) const { return at(p + (normal << (6 + s))); }
  LightBytes at(Vec position) const {
    const Vec q = position >> s;
    const auto read = [&](const Ints& values) {
      return blended_eight(q, [&](Int x, Int y, Int z) {
        return values[place(clamped(x, 0, n[0] - 1), clamped(y, 0, n[1] - 1), clamped(z, 0, n[2] - 1))];
      });
    };
    LightBytes bytes;
    bytes.lamp = read(lamp);
    for (int side = 0; side < 6; ++side) {
      bytes.open[side] = read(open[side]);
      bytes.glow[side] = read(glow[side]);
    }
    return bytes;
  }

 private:
  Int place(Int x, Int y, Int z) const { return (z * n[1] + y) * n[0] + x; }
  // Fills the grid (section 4).
  void fill(const Input& in, const Look& look, const Field& field, const Ground& ground) {
    const Int width = power_of_two(s);
    for (Int Z = 0; Z < n[2]; ++Z)
      for (Int Y = 0; Y < n[1]; ++Y)
        for (Int X = 0; X < n[0]; ++X) {
          Int intensity = 0, obstacles = 0, G = 0, glowing = 0;
          for (Int z = Z * width; z < std::min((Z + 1) * width, in.nz); ++z)
            for (Int x = X * width; x < std::min((X + 1) * width, in.nx); ++x) {
              if (ground.exists)
                G += clamped(ground.drawn[in.column(x, z)] - 4096 * Y * width, 0, 4096 * width);
              for (Int y = Y * width; y < std::min((Y + 1) * width, in.ny); ++y) {
                const Int i = in.cell(x, y, z);
                intensity += field.intensity[i];
                obstacles += field.obstacle[i];
                const Int heat = heat_byte(look, field.liquid[i], field.heat[i]);
                glowing += (field.liquid[i] * ((heat * heat) >> 8)) >> 16;
              }
            }
          Int a = intensity >> (3 * s + 8);
          if (look.clear.is_clear) a = thinned(look, a, std::min(obstacles >> (3 * s + 8), a));
          const Int density = std::max(a, (255 * G) >> (3 * s + 12));
          loss.push_back(density < 12 ? 0 : clamped(3 * (density - 12) / 2, 0, 256));
          emission.push_back(glowing >> (3 * s));
        }
  }
  // Thins the loss (docs/picture/translucent.md 8). o is the obstacles' part of a.
  Int thinned(const Look& look, Int a, Int o) const {
    const Int share = (180 * (256 - (look.clear.passes(power_of_two(s + 8), look.clear.loss.y) >> 7))) >> 8;
    const Int d = a - o;
    return o + (d <= 12 ? d : 12 + (((d - 12) * share) >> 8));
  }
  // Sweeps the lamp. Section 5 says which rays are kept; all others hold 255.
  void sweep_lamp(Vec to_light) {
    lamp.assign(loss.size(), 255);
    const Int D = largest_magnitude(to_light);
    int axis = 2;
    if (magnitude(to_light.x) == D) axis = 0;
    if (magnitude(to_light.y) == D) axis = 1;
    const int axis_u = axis == 0 ? 1 : 0, axis_v = axis == 2 ? 1 : 2;
    const bool from_high = to_light.at(axis) >= 0;
    const Int nu = n[axis_u], nv = n[axis_v], slices = n[axis];
    const Int slope_u = D == 0 ? 0 : floor_divided(power_of_two(14) * to_light.at(axis_u), D);
    const Int slope_v = D == 0 ? 0 : floor_divided(power_of_two(14) * to_light.at(axis_v), D);
    const auto way = [](Int slice, Int slope) { return (slice * slope) >> 6; };
    const auto behind = [&](Int slope) { return way(slices, slope) >> 8; };  // c on the page
    const auto lowest = [&](Int slope) { return std::min<Int>(0, behind(slope)) - 1; };
    const auto count = [&](Int slope, Int size) {
      return size + std::max<Int>(0, behind(slope)) + 2 - lowest(slope) + 1;
    };
    const Int a0 = lowest(slope_u), b0 = lowest(slope_v), na = count(slope_u, nu), nb = count(slope_v, nv);
    Ints R(na * nb, 255);
    const auto ray = [&](const Ints& rays, Int a, Int b) -> Int {
      const Int i = a - a0, j = b - b0;
      return i < 0 || i >= na || j < 0 || j >= nb ? 255 : rays[j * na + i];
    };
    for (Int slice = 0; slice < slices; ++slice) {
      const Int way_u = way(slice, slope_u), way_v = way(slice, slope_v);
      const Int cells_u = way_u >> 8, part_u = way_u & 255, cells_v = way_v >> 8, part_v = way_v & 255;
      const auto place_at = [&](Int u, Int v) {
        Vec cell;
        cell.at(axis) = from_high ? slices - 1 - slice : slice;
        cell.at(axis_u) = u;
        cell.at(axis_v) = v;
        return place(cell.x, cell.y, cell.z);
      };
      for (Int v = 0; v < nv; ++v)
        for (Int u = 0; u < nu; ++u) {
          const Int a = u + cells_u, b = v + cells_v;
          lamp[place_at(u, v)] = blended(blended(ray(R, a, b), ray(R, a + 1, b), part_u),
                                         blended(ray(R, a, b + 1), ray(R, a + 1, b + 1), part_u), part_v);
        }
      const auto loss_at = [&](Int u, Int v) -> Int {
        return u < 0 || u >= nu || v < 0 || v >= nv ? 0 : loss[place_at(u, v)];
      };
      for (Int b = b0; b < b0 + nb; ++b)
        for (Int a = a0; a < a0 + na; ++a) {
          const Int u = a - cells_u, v = b - cells_v;
          const Int lost = blended(blended(loss_at(u, v), loss_at(u - 1, v), part_u),
                                   blended(loss_at(u, v - 1), loss_at(u - 1, v - 1), part_u), part_v);
          Int& here = R[(b - b0) * na + a - a0];
          here = passed(here, lost);
        }
      for (int direction = 0; direction < 2; ++direction) {
        const Int da = direction == 0 ? 1 : 0, db = 1 - da;
        const Ints before = R;
        for (Int b = b0; b < b0 + nb; ++b)
          for (Int a = a0; a < a0 + na; ++a)
            R[(b - b0) * na + a - a0] =
                (ray(before, a - da, b - db) + 30 * ray(before, a, b) + ray(before, a + da, b + db) + 16) >>
                5;
      }
    }
  }
  // Sweeps openness and glow from one side (section 5).
  void sweep_side(int side, bool glowing) {
    const int axis = side / 2, axis_u = axis == 0 ? 1 : 0, axis_v = axis == 2 ? 1 : 2;
    const Int nu = n[axis_u], nv = n[axis_v], slices = n[axis], beside = glowing ? 0 : 255;
    Ints& values = glowing ? glow[side] : open[side];
    values.assign(loss.size(), beside);
    Ints arriving(nu * nv, beside);
    for (Int slice = 0; slice < slices; ++slice) {
      Ints leaving(nu * nv);
      for (Int v = 0; v < nv; ++v)
        for (Int u = 0; u < nu; ++u) {
          Vec cell;
          cell.at(axis) = side % 2 == 0 ? slices - 1 - slice : slice;
          cell.at(axis_u) = u;
          cell.at(axis_v) = v;
          const Int i = place(cell.x, cell.y, cell.z);
          values[i] = arriving[v * nu + u];
          leaving[v * nu + u] = passed(values[i], loss[i]);
          if (glowing) leaving[v * nu + u] = std::min<Int>(leaving[v * nu + u] + emission[i], 255);
        }
      arriving = spread(spread(leaving, nu, nv, 1, 0, beside), nu, nv, 0, 1, beside);
      for (Int& value : arriving)
        value = glowing ? value - ((value + 8) >> 4) : value + ((255 - value + 7) >> 3);
    }
  }
  static Ints spread(const Ints& e, Int nu, Int nv, Int du, Int dv, Int beside) {
    const auto at = [&](Int u, Int v) {
      return u < 0 || u >= nu || v < 0 || v >= nv ? beside : e[v * nu + u];
    };
    Ints result(e.size());
    for (Int v = 0; v < nv; ++v)
      for (Int u = 0; u < nu; ++u)
        result[v * nu + u] =
            (at(u - 2 * du, v - 2 * dv) + 2 * (at(u - du, v - dv) + at(u, v) + at(u + du, v + dv)) +
             at(u + 2 * du, v + 2 * dv) + 4) >>
            3;
    return result;
  }

  Int s = 1, n[3] = {0, 0, 0};
  Ints loss, emission, lamp, open[6], glow[6];
};
