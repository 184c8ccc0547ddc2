#include "accuracy/picture/exact_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "accuracy/picture/exact_walk.h"
#include "render/rule/look.h"
#include "render/rule/rock.h"

namespace voxmelt::accuracy {
namespace {

using picture::Face;

struct Between {
  int low, high;
  double part;
};
// Finds two entries of a table of `count`, continued with its end entries. Entry i is at i + 1/2.
Between between(double p, int count) {
  const double floor = std::floor(p - 0.5);
  const auto within = [&](double i) { return static_cast<int>(std::clamp(i, 0.0, count - 1.0)); };
  return {within(floor), within(floor + 1), p - 0.5 - floor};
}

double linear(const std::vector<double>& table, double p) {
  const Between i = between(p, static_cast<int>(table.size()));
  return blend(table[i.low], table[i.high], i.part);
}

}  // namespace

ExactGround::ExactGround(const render::PictureScene& scene) : texels_(scene.ground.texels()) {
  const picture::Vector n = scene.levels.cells();
  cells_ = {static_cast<int>(n.x), static_cast<int>(n.y), static_cast<int>(n.z)};
  const auto& color = scene.look.ground;
  color_ = exact({color[0], color[1], color[2]}, picture::kLight);
  if (scene.ground.empty()) return;

  highest_ = static_cast<double>(scene.ground.highest()) / picture::kHeight;
  row_ = cells_[0] + 2;
  const auto columns = [&](const render::ColumnHeights& from) {
    Heights to;
    for (int z = -1; z <= cells_[2]; ++z)
      for (int x = -1; x <= cells_[0]; ++x)
        to.push_back(
            static_cast<double>(
                from[std::clamp(z, 0, cells_[2] - 1) * cells_[0] + std::clamp(x, 0, cells_[0] - 1)]) /
            picture::kHeight);
    return to;
  };
  drawn_ = columns(scene.ground.drawn());
  bare_ = columns(scene.ground.bare());
  blocks_x_ = cells_[0] / kBlock + 1;
  block_highest_.assign(blocks_x_ * (cells_[2] / kBlock + 1), 0);
  for (int z = -1; z < cells_[2]; ++z)
    for (int x = -1; x < cells_[0]; ++x) {
      double& highest = block_highest_[((z + 1) / kBlock) * blocks_x_ + ((x + 1) / kBlock)];
      highest = std::max(
          {highest, drawn_[at(x, z)], drawn_[at(x + 1, z)], drawn_[at(x, z + 1)], drawn_[at(x + 1, z + 1)]});
    }

  if (texels_.empty()) return;
  texels_per_cell_ = 1 << scene.ground.fineness();
  for (std::int64_t i = 0; i < n.y << picture::kBandFineness; ++i) bands_.push_back(picture::band(i));
  const auto bend = [](picture::Vector p) { return static_cast<double>(picture::bend(p)) / picture::kCell; };
  for (std::int64_t z = 0; z < n.z; ++z) {
    bends_[0].push_back(bend({0, 0, picture::texel_middle(z, 0)}));
    bends_[1].push_back(bend({n.x * picture::kCell, 0, picture::texel_middle(z, 0)}));
  }
  for (std::int64_t x = 0; x < n.x; ++x) {
    bends_[2].push_back(bend({picture::texel_middle(x, 0), 0, 0}));
    bends_[3].push_back(bend({picture::texel_middle(x, 0), 0, n.z * picture::kCell}));
  }
}

double ExactGround::height(const Heights& heights, double x, double z) const {
  const Between i = between(x, cells_[0]), k = between(z, cells_[2]);
  return blend(blend(heights[at(i.low, k.low)], heights[at(i.high, k.low)], i.part),
               blend(heights[at(i.low, k.high)], heights[at(i.high, k.high)], i.part), k.part);
}

double ExactGround::highest_of_block(int x, int z) const { return block_highest_[z * blocks_x_ + x]; }

// Gives how deep two places and the line between them lie below the drawn heights of a lower column.
Cubic ExactGround::depths_between(const std::array<int, 2>& cell, Exact from, Exact to) const {
  const double* const first = drawn_.data() + at(cell[0], cell[1]);
  const auto height = [&](double x, double z) {
    return blend(blend(first[0], first[1], x), blend(first[row_], first[row_ + 1], x), z);
  };
  const double ax = from.x - 0.5 - cell[0], az = from.z - 0.5 - cell[1];
  const double bx = to.x - 0.5 - cell[0], bz = to.z - 0.5 - cell[1];
  const double a = height(ax, az) - from.y, b = height(bx, bz) - to.y;
  const double middle = (height(ax, bz) + height(bx, az) - from.y - to.y) / 2;
  return {a, (a + 2 * middle) / 3, (2 * middle + b) / 3, b};
}

ExactGround::Crossing ExactGround::first_crossing(const ExactRay& ray) const {
  if (highest_ <= 0) return {};
  const Span span =
      span_in<3>({ray.start.x, ray.start.y, ray.start.z}, {ray.along.x, ray.along.y, ray.along.z}, {0, 0, 0},
                 {static_cast<double>(cells_[0]), highest_, static_cast<double>(cells_[2])});
  if (span.first > span.last) return {};
  const std::array<double, 2> start{ray.start.x - 0.5, ray.start.z - 0.5}, along{ray.along.x, ray.along.z};
  const std::array<int, 2> low{-1, -1}, high{cells_[0] - 1, cells_[2] - 1};
  Walk<2> walk(start, along, low, high, span.first);
  for (bool begin = true;; begin = false) {
    const std::array<int, 2> cell = walk.cell();
    for (std::size_t a = 0; a < 2; ++a)
      if (cell[a] < low[a] || cell[a] > high[a]) return {};
    const std::array<int, 2> block{(cell[0] + 1) / kBlock, (cell[1] + 1) / kBlock};
    std::array<int, 2> from{}, to{};
    for (std::size_t a = 0; a < 2; ++a) {
      from[a] = block[a] * kBlock - 1;
      to[a] = std::min(from[a] + kBlock - 1, high[a]);
    }
    double out = std::min(walk.leaves(from, to), span.last);
    const double below = std::min(ray.at(walk.t()).y, ray.at(out).y);
    if (below <= highest_of_block(block[0], block[1])) {
      from = to = cell;
      out = std::min(walk.leaves(from, to), span.last);
      const double part = first_reached(depths_between(cell, ray.at(walk.t()), ray.at(out)));
      if (part >= 0) {
        // If the ray meets the ground where it enters the box, it meets the face that it enters through.
        Face face = Face::top;
        if (begin && part == 0) {
          if (span.axis < 0) face = Face::none;
          if (span.axis == 0) face = ray.along.x > 0 ? Face::low_x : Face::high_x;
          if (span.axis == 1 && ray.along.y > 0) face = Face::under;
          if (span.axis == 2) face = ray.along.z > 0 ? Face::low_z : Face::high_z;
        }
        return {blend(walk.t(), out, part), face};
      }
    }
    if (out >= span.last) return {};
    walk.leave(from, to, out);
  }
}

Exact ExactGround::cut_color(Exact p, Face face) const {
  double band = 0;
  if (!bands_.empty() && face != Face::under && face != Face::none) {
    const auto side = static_cast<std::size_t>(face) - static_cast<std::size_t>(Face::low_x);
    band = linear(bands_, (p.y + linear(bends_[side], side < 2 ? p.z : p.x)) * (1 << picture::kBandFineness));
  }
  return color_ * ((2540 + band * 41 / 256) / picture::kColor);
}

ExactGround::Surface ExactGround::surface(Exact p, Face face) const {
  switch (face) {
    case Face::none:
      return {{}, cut_color(p, face)};
    case Face::low_x:
      return {{-1, 0, 0}, cut_color(p, face)};
    case Face::high_x:
      return {{1, 0, 0}, cut_color(p, face)};
    case Face::low_z:
      return {{0, 0, -1}, cut_color(p, face)};
    case Face::high_z:
      return {{0, 0, 1}, cut_color(p, face)};
    case Face::under:
      return {{0, -1, 0}, cut_color(p, face)};
    default:
      break;
  }
  const auto rim = [](double at, int cells) {
    return 2 * (std::max(0.0, 0.5 - (cells - at)) - std::max(0.0, 0.5 - at));
  };
  const auto bare = [&](double x, double z) { return height(bare_, x, z); };
  const Exact normal = unit({bare(p.x - 0.5, p.z) - bare(p.x + 0.5, p.z) + rim(p.x, cells_[0]), 1,
                             bare(p.x, p.z - 0.5) - bare(p.x, p.z + 0.5) + rim(p.z, cells_[2])});
  if (texels_per_cell_ == 0) return {normal, color_};
  const Between x = between(p.x * texels_per_cell_, cells_[0] * texels_per_cell_),
                z = between(p.z * texels_per_cell_, cells_[2] * texels_per_cell_);
  Exact color, bump;
  const auto add = [&](int i, int k, double weight) {
    const picture::Texel& texel = texels_[k * cells_[0] * texels_per_cell_ + i];
    color = color + exact({texel.red, texel.green, texel.blue}, picture::kColor) * weight;
    bump = bump + exact({texel.bump_x, 0, texel.bump_z}, 1 << picture::kBumpBits) * weight;
  };
  add(x.low, z.low, (1 - x.part) * (1 - z.part));
  add(x.high, z.low, x.part * (1 - z.part));
  add(x.low, z.high, (1 - x.part) * z.part);
  add(x.high, z.high, x.part * z.part);
  return {unit(normal + bump), color};
}

}  // namespace voxmelt::accuracy
