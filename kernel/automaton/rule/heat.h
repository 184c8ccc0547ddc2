// A cell gains or loses heat by conduction (Eq. 1), convection in liquid, radiation received and exchange
// with air.
//
// The stored field is the heat content h of a cell. It equals the temperature except in scenes with latent
// heat. There a cell at the melting point takes up `latent_heat` units before its temperature rises again.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

VOXMELT_RULE std::int32_t temperature_of(std::int32_t h, const Material& material) {
  const std::int32_t melting = material.melting_point, latent = material.latent_heat;
  if (h <= melting) return h;
  return std::max(melting, h - latent);
}

// Applies Eq. 1 to one pair: the first cell gains the result, and the second loses it. `weight` is 65536
// gamma / (pi l^2).
VOXMELT_RULE std::int32_t conducted(std::int32_t first, std::int32_t second, std::int32_t weight,
                                    std::int32_t dither) {
  return scaled(second - first, weight, dither);
}

// Returns the convection in liquid (paper section 3). A hot cell below a cold one gives heat upwards. Nothing
// flows down.
VOXMELT_RULE std::int32_t convected(std::int32_t lower, std::int32_t upper, std::int32_t weight,
                                    std::int32_t dither) {
  return lower > upper ? scaled(lower - upper, weight, dither) : 0;
}

// Returns the exchange of a cell by the number of its exposed axes, 1 to 3. On a plane of any direction cells
// have an area of (3 + axes) / 4 on the mean: a face has 1, and no direction is more than 13 % off.
VOXMELT_RULE std::int32_t exposed_exchange(std::int32_t exchange, int axes) {
  return (exchange * (3 + axes)) >> 2;
}

// Returns the heat gained from the irradiance of a cell (UQ12.4 temperature units per step).
VOXMELT_RULE std::int32_t radiated(std::int32_t h, std::int32_t irradiance, std::int32_t dither) {
  return std::min((irradiance * 4096 + dither) >> 16, kTemperatureMax - h);
}

// Applies Newton's law of cooling, or of heating, by moving air. `own` is the temperature of heat content h.
// The result stays between the two temperatures.
VOXMELT_RULE std::int32_t exchanged(std::int32_t h, std::int32_t own, std::int32_t air, std::int32_t exchange,
                                    int exposed_axes, std::int32_t dither) {
  const std::int32_t rate = exposed_exchange(exchange, exposed_axes);
  return std::min(scaled(air - own, rate, dither), kTemperatureMax - h);
}

// Returns the fourth power of a temperature that counts from absolute zero, in units of temperature.
VOXMELT_RULE std::int32_t fourth_power(std::int32_t temperature) {
  const auto square = static_cast<std::int32_t>((std::int64_t{temperature} * temperature) >> 16);
  return static_cast<std::int32_t>((std::int64_t{square} * square) >> 16);
}

// Returns the heat that a cell gains from what it glows at, mostly below 0.
VOXMELT_RULE std::int32_t glowed(std::int32_t h, std::int32_t own, std::int32_t sky, std::int32_t glow,
                                 int exposed_axes, std::int32_t dither) {
  const std::int32_t difference = fourth_power(sky) - fourth_power(own);
  return std::min(scaled(difference, exposed_exchange(glow, exposed_axes), dither), kTemperatureMax - h);
}

// Returns the heat of a cell after its contents were mixed, since heat travels with liquid. `content` is the
// sum of amount x h over the new contents of the cell. `amount` is its new amount (> 0).
VOXMELT_RULE std::int32_t mixed(std::uint64_t content, std::uint64_t amount, std::int32_t dither) {
  const std::uint64_t offset = (amount * dither) >> 16;
  return static_cast<std::int32_t>((content + offset) / amount);
}

// Tells if a solid melts: its heat has reached the melting point, and the latent heat has been paid.
VOXMELT_RULE bool melts(std::int32_t h, const Material& material) {
  return h >= std::int32_t{material.melting_point} + material.latent_heat;
}

// Tells if liquid is so cold that it freezes, or sets: it has given off all its latent heat.
VOXMELT_RULE bool is_cold(std::int32_t h, const Material& material) { return h < material.freezing_point; }
// Tells if a cold cell holds enough to become solid.
VOXMELT_RULE bool is_full(std::int32_t amount) { return amount >= kOne - kOne / 64; }

}  // namespace voxmelt::rule
