#include "hwmodel/rtl/host/material_tables.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hwmodel/pipeline/model/viscous_run.h"

namespace voxmelt::hwmodel {
namespace {

// Fills words with numbers, from the lowest bit on.
class Filled {
 public:
  explicit Filled(std::int64_t bits) : words_(static_cast<std::size_t>((bits + 31) / 32)) {}
  void put(std::int64_t value, int bits) {
    for (int bit = 0; bit < bits; ++bit, ++at_)
      words_[at_ / 32] |= static_cast<std::uint32_t>(value >> bit & 1) << (at_ % 32);
  }
  PortWords words() && { return std::move(words_); }

 private:
  PortWords words_;
  std::size_t at_ = 0;
};

}  // namespace

PortWords curve_rows(const Design& design, int bits) {
  Filled rows(std::int64_t{49} << bits);
  const Curves curves(design.parameters);
  for (const Curves::Curve& curve : curves.rows()) {
    rows.put(curve.warmth, 17);
    rows.put(curve.melting_point, 16);
    rows.put(curve.beyond, 16);
  }
  return std::move(rows).words();
}

PortWords melting_rows(const Design& design, int bits) {
  Filled rows(std::int64_t{33} << bits);
  const Curves curves(design.parameters);
  for (int material = 0; material < design.materials(); ++material) {
    rows.put(curves.liquid_from(material), 16);
    rows.put(curves.rows()[static_cast<std::size_t>(material)].as_first, 17);
  }
  return std::move(rows).words();
}

PortWords bed_rows(const Design& design, int bits) {
  Filled rows(std::int64_t{48} << bits);
  const Curves curves(design.parameters);
  const SolidBed bed(design);
  for (int material = 0; material < design.materials(); ++material) {
    const SolidBed::Melt& melt = bed.melts()[static_cast<std::size_t>(material)];
    rows.put(curves.liquid_from(material), 16);
    rows.put(melt.range, 16);
    rows.put(melt.shift, 2);
    rows.put(melt.scale, 14);
  }
  return std::move(rows).words();
}

PortWords air_rows(const Design& design, int bits) {
  Filled rows(std::int64_t{48} << bits);
  const rule::Heat& heat = design.parameters.heat;
  const auto put = [&](std::int64_t rate) {
    rows.put(heat.air ? static_cast<std::int64_t>(exchange_weights(rate)) : 0, 48);
  };
  if (!design.of_materials()) put(heat.air_exchange);
  for (const rule::SolidMaterial& material : design.parameters.materials) put(material.air_exchange);
  return std::move(rows).words();
}

PortWords pair_rows(const Design& design, std::uint16_t only, PairWeights::Row row, int bits) {
  Filled rows(std::int64_t{16} << (2 * bits));
  const PairWeights weights(design.parameters, only, row);
  for (std::int64_t one = 0; one < std::int64_t{1} << bits; ++one)
    for (std::int64_t other = 0; other < std::int64_t{1} << bits; ++other)
      rows.put(std::max(one, other) < design.materials() ? weights.of(one, other) : 0, 16);
  return std::move(rows).words();
}

std::uint64_t exchange_weights(std::int64_t rate) {
  return static_cast<std::uint64_t>(rate | (rate * 5 >> 2) << 16 | (rate * 6 >> 2) << 32);
}

}  // namespace voxmelt::hwmodel
