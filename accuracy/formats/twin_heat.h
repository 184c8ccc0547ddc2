// The twin runs sections 6 and 7 of docs/automaton.md, heat and melting, in any number format.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "accuracy/formats/twin_cells.h"
#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/field.h"

namespace voxmelt::accuracy::front {

template <class Format>
class HeatRules {
 public:
  using Value = typename Format::Value;
  using Wide = typename Format::Wide;

  explicit HeatRules(const rule::Parameters& parameters)
      : heat_(parameters.heat),
        melting_(Format::of(parameters.material.melting_point)),
        latent_(parameters.material.latent_heat > 0 ? Format::of(parameters.material.latent_heat) : Wide{0}),
        reheat_(parameters.flow.paper.reheat) {}

  void heat(std::uint32_t step, const state::Field<std::uint16_t>* irradiance, Cells<Format>& cells,
            const Rows& rows) {
    if (!heat_.enabled) return;
    conduct(rule::kFaceAxes, heat_.weight_face, step, cells, rows);
    if (heat_.neighbours >= 18) conduct(rule::kEdgeAxes, heat_.weight_edge, step, cells, rows);
    if (heat_.neighbours >= 26) conduct(rule::kCornerAxes, heat_.weight_corner, step, cells, rows);
    if (heat_.convection > 0) convect(step, cells, rows);
    if (irradiance != nullptr || heat_.air) take_in(step, irradiance, cells, rows);
  }

  void melt(Cells<Format>& cells, const Rows& rows) {
    if (!heat_.enabled) return;
    rows.for_each([&](int x, int y, int z) {
      const std::size_t i = cells.at(x, y, z);
      if (!cells.matter(i) || cells.heat[i] < melting_ + latent_) return;
      if (cells.kind[i] == kSolid) {
        cells.kind[i] = kLiquid | kFresh;
        cells.masks.solid.set(x, y, z, false);
        cells.energy[i] = cells.amount[i];
      } else if (reheat_ > 0) {
        cells.energy[i] = static_cast<Value>(
            cells.energy[i] + Format::part(Wide{cells.amount[i]} - Wide{cells.energy[i]}, reheat_));
      }
    });
  }

 private:
  Wide temperature(Wide h) const { return h <= melting_ ? h : std::max(melting_, h - latent_); }

  void conduct(std::span<const rule::Offset> axes, std::int64_t weight, std::uint32_t step,
               Cells<Format>& cells, const Rows& rows) {
    next_ = cells.heat;
    const int parts = static_cast<int>(axes.size());
    std::array<std::ptrdiff_t, 6> way{};
    std::array<std::int64_t, 6> dither{};
    for (std::size_t k = 0; k < axes.size(); ++k) {
      way[k] = cells.way(axes[k]);
      dither[k] = rule::dither(step, static_cast<int>(k), parts);
    }
    rows.for_each([&](int x, int y, int z) {
      const std::size_t i = cells.at(x, y, z);
      if (!cells.matter(i)) return;
      const Wide own = temperature(cells.heat[i]);
      Wide gain = 0;
      const auto conducts = [&](std::size_t j) {  // matter, or a wall of fixed temperature
        return cells.matter(j) || cells.heat[j] > 0;
      };
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const std::size_t ahead = Cells<Format>::moved(i, way[k]), behind = Cells<Format>::moved(i, -way[k]);
        if (conducts(ahead)) gain += Format::part(temperature(cells.heat[ahead]) - own, weight, dither[k]);
        if (conducts(behind)) gain -= Format::part(own - temperature(cells.heat[behind]), weight, dither[k]);
      }
      // With the dither, nothing is cut here. Without it, small flows round the same way on all sides.
      next_[i] = static_cast<Value>(std::clamp(cells.heat[i] + gain, Wide{0}, Format::kMost));
    });
    cells.heat.swap(next_);
  }

  void convect(std::uint32_t step, Cells<Format>& cells, const Rows& rows) {
    next_ = cells.heat;
    const std::int64_t dither = rule::dither(step);
    rows.for_each([&](int x, int y, int z) {
      const std::size_t low = cells.at(x, y, z), high = Cells<Format>::moved(low, cells.line);
      if (!cells.liquid(low) || !cells.liquid(high)) return;
      const Wide warmer = temperature(cells.heat[low]) - temperature(cells.heat[high]);
      if (!(warmer > 0)) return;
      const Wide flow = Format::part(warmer, heat_.convection, dither);
      next_[low] = static_cast<Value>(next_[low] - flow);
      next_[high] = static_cast<Value>(next_[high] + flow);
    });
    cells.heat.swap(next_);
  }

  // Adds radiation and exchange with air, which concern each cell alone.
  void take_in(std::uint32_t step, const state::Field<std::uint16_t>* irradiance, Cells<Format>& cells,
               const Rows& rows) {
    const std::int64_t dither = rule::dither(step);
    rows.for_each([&](int x, int y, int z) {
      const std::size_t i = cells.at(x, y, z);
      if (!cells.matter(i)) return;
      Wide h = cells.heat[i];
      if (irradiance != nullptr && cells.kind[i] == kSolid)
        h += std::min(Format::radiated((*irradiance)[irradiance->layout().at(x, y, z)], dither),
                      Format::kMost - h);
      if (const int axes = heat_.air ? exposed_axes(cells, i) : 0; axes > 0) {
        const std::int64_t rate = (heat_.air_exchange * (3 + axes)) >> 2;
        const Wide air = Format::of(heat_.air_temperature[y]);
        h += std::min(Format::part(air - temperature(h), rate, dither), Format::kMost - h);
      }
      cells.heat[i] = static_cast<Value>(h);
    });
  }

  static int exposed_axes(const Cells<Format>& cells, std::size_t i) {
    int axes = 0;
    for (const std::ptrdiff_t way :
         {std::ptrdiff_t{1}, std::ptrdiff_t{cells.line}, std::ptrdiff_t{cells.slice}})
      axes += cells.is_air(Cells<Format>::moved(i, way)) || cells.is_air(Cells<Format>::moved(i, -way));
    return axes;
  }

  rule::Heat heat_;
  Wide melting_, latent_;
  std::int64_t reheat_;
  std::vector<Value> next_;
};

}  // namespace voxmelt::accuracy::front
