#include "accuracy/formats/twin.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "accuracy/formats/twin_cells.h"
#include "accuracy/formats/twin_flow.h"
#include "accuracy/formats/twin_heat.h"
#include "kernel/engine/visibility/kept_rays.h"

namespace voxmelt::accuracy::front {
namespace {

template <class Format>
class TwinIn final : public Twin {
 public:
  TwinIn(const rule::Parameters& parameters, const state::Volume& start, std::uint32_t first_step)
      : heat_of_scene_(parameters.heat),
        cells_(start),
        heat_(parameters),
        flow_(parameters),
        step_(first_step) {
    if (heat_of_scene_.radiates()) irradiance_ = state::Field<std::uint16_t>(start.grid);
  }

  void step() override {
    const bool radiates = heat_of_scene_.radiates();
    if (radiates && heat_of_scene_.is_visibility_step(step_))
      rays_.irradiance(cells_.masks, heat_of_scene_, step_, irradiance_);
    flow_.source(step_, cells_);
    const Rows rows = cells_.rows(), columns = rows.columns();
    heat_.heat(step_, radiates ? &irradiance_ : nullptr, cells_, rows);
    heat_.melt(cells_, rows);
    flow_.gravity(step_, cells_, columns);
    flow_.spread(step_, cells_, cells_.rows());
    ++step_;
  }

  void for_each_matter(const VisitHeld& visit) const override {
    for_each([&](int x, int y, int z, std::size_t i) {
      if (cells_.matter(i))
        visit(x, y, z,
              {cells_.kind[i] == kSolid, Format::in_units(cells_.amount[i]) / 4096,
               Format::in_units(cells_.energy[i]) / 4096, Format::in_units(cells_.heat[i]) / 65536});
    });
  }

  state::Volume volume() const override {
    state::Volume volume(cells_.grid);
    const auto nearest = [](double units) {
      return static_cast<std::uint16_t>(std::lround(std::clamp(units, 0.0, 65535.0)));
    };
    for_each([&](int x, int y, int z, std::size_t i) {
      const state::Slot to = volume.at(x, y, z);
      volume.amount[to] = nearest(Format::in_units(cells_.amount[i]));
      volume.energy[to] = nearest(Format::in_units(cells_.energy[i]));
      volume.heat[to] = nearest(Format::in_units(cells_.heat[i]));
      volume.solid.set(x, y, z, cells_.kind[i] == kSolid);
      volume.liquid.set(x, y, z, cells_.kind[i] == kLiquid);
      volume.inert.set(x, y, z, cells_.kind[i] == kInert);
    });
    return volume;
  }

 private:
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int z = 0; z < cells_.grid.z; ++z)
      for (int y = 0; y < cells_.grid.y; ++y)
        for (int x = 0; x < cells_.grid.x; ++x) visit(x, y, z, cells_.at(x, y, z));
  }

  rule::Heat heat_of_scene_;
  Cells<Format> cells_;
  HeatRules<Format> heat_;
  FlowRules<Format> flow_;
  visibility::KeptRays rays_;
  state::Field<std::uint16_t> irradiance_;
  std::uint32_t step_;
};

template <class Stored>
std::unique_ptr<Twin> whole(Rounding rounding, const rule::Parameters& p, const state::Volume& start,
                            std::uint32_t step) {
  switch (rounding) {
    case Rounding::truncate:
      return std::make_unique<TwinIn<Whole<Stored, Rounding::truncate>>>(p, start, step);
    case Rounding::nearest:
      return std::make_unique<TwinIn<Whole<Stored, Rounding::nearest>>>(p, start, step);
    case Rounding::dithered:
      break;
  }
  return std::make_unique<TwinIn<Whole<Stored, Rounding::dithered>>>(p, start, step);
}

}  // namespace

bool is_real(Number number) { return number == Number::f32 || number == Number::f64; }

std::string name_of(Arithmetic arithmetic) {
  constexpr const char* kNumbers[] = {"u8", "u16", "u32", "float", "double"};
  constexpr const char* kRoundings[] = {" truncated", " nearest", " dithered"};
  return std::string(kNumbers[static_cast<std::size_t>(arithmetic.number)]) +
         (is_real(arithmetic.number) ? "" : kRoundings[static_cast<std::size_t>(arithmetic.rounding)]);
}

const std::vector<Arithmetic>& all_arithmetics() {
  static const std::vector<Arithmetic> all = [] {
    std::vector<Arithmetic> found;
    for (const Number number : {Number::u8, Number::u16, Number::u32})
      for (const Rounding rounding : {Rounding::truncate, Rounding::nearest, Rounding::dithered})
        found.push_back({number, rounding});
    found.push_back({Number::f32, Rounding::truncate});
    found.push_back(kExact);
    return found;
  }();
  return all;
}

int state_bits(Number number, const rule::Parameters& parameters) {
  constexpr int kBits[] = {8, 16, 32, 32, 64};
  return 2 + kBits[static_cast<std::size_t>(number)] * (parameters.heat.enabled ? 3 : 2);
}

std::unique_ptr<Twin> make_twin(Arithmetic arithmetic, const rule::Parameters& parameters,
                                const state::Volume& start, std::uint32_t first_step) {
  if (parameters.flow.law != rule::Law::paper || parameters.flow.paper.reading != rule::EnergyReading::text)
    throw std::invalid_argument("the twin knows the paper's law, reading `text`");
  switch (arithmetic.number) {
    case Number::u8:
      return whole<std::uint8_t>(arithmetic.rounding, parameters, start, first_step);
    case Number::u16:
      return whole<std::uint16_t>(arithmetic.rounding, parameters, start, first_step);
    case Number::u32:
      return whole<std::uint32_t>(arithmetic.rounding, parameters, start, first_step);
    case Number::f32:
      return std::make_unique<TwinIn<Real<float>>>(parameters, start, first_step);
    case Number::f64:
      break;
  }
  return std::make_unique<TwinIn<Real<double>>>(parameters, start, first_step);
}

}  // namespace voxmelt::accuracy::front
