#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "kernel/scene/conduction.h"
#include "kernel/scene/parameter_readers.h"
#include "kernel/scene/text/units.h"

namespace voxmelt::scene {
namespace {

// Is pi / 8: up to here a checkerboard of heat loses at least half of its swing in each step. With 26
// neighbours the corners damp it, and no wave that changes its sign keeps more than a fifth.
constexpr double kCalmGamma = 0.3927;
constexpr double kLargestPower = 4194303;     // x 2^28 fits 50 bits
constexpr double kLargestExchange = 0.66666;  // 2 / 3: a corner exposed on three axes stays within the air
constexpr double kSmallestExchange = 1 / 65536.0;  // less is nothing in the rule
constexpr double kLargestGlow = 0.16666;  // 1 / 6: a corner at the highest temperature does not overshoot
constexpr double kLargestRadius = 8192;
constexpr double kLargestDirection = 1e6;
constexpr std::uint32_t kLastStep = 0xFFFFFFFF;

Range power() { return at_most(kLargestPower); }

void read_conduction(Reader& reader, rule::Heat& heat, std::vector<std::string>& warnings) {
  const int asked = reader.integer("neighbours", 6, 26, 6);
  if (asked != 6 && asked != 18 && asked != 26)
    reader.fail("neighbours", fmt::format(" = {} is not one of 6, 18, 26", asked));
  heat.neighbours = asked;
  const Range range = at_most(kLargestGamma).because(fmt::format("the bound for {} neighbours", asked));
  const double gamma = reader.number("gamma", range, kGamma);
  if (gamma > kCalmGamma && asked < 26)
    warnings.push_back(fmt::format(
        "heat.gamma = {} is above {}: hot and cold cells that alternate change places in each step "
        "and keep {:.0f} % of their difference",
        gamma, kCalmGamma, 100 * (12 * gamma / std::numbers::pi - 1)));
  heat.weight_face = conduction_weight(gamma, 1);
  if (asked >= 18) heat.weight_edge = conduction_weight(gamma, 2);
  if (asked == 26) heat.weight_corner = conduction_weight(gamma, 3);
}

void read_air_temperature(Reader& reader, rule::Heat& heat, int ny, std::optional<double> fallback = {}) {
  const double bottom = reader.number("bottom", fraction(), fallback);
  const double top = reader.number("top", fraction(), bottom);
  for (int y = 0; y < ny; ++y)
    heat.air_temperature.push_back(to_temperature(ny == 1 ? bottom : bottom + (top - bottom) * y / (ny - 1)));
  reader.finish();
}

// Glow goes with the fourth power of a temperature that counts from absolute zero.
void read_glow(Reader& reader, rule::Heat& heat, std::vector<std::string>& warnings) {
  const double glow = reader.number("glow", at_most(kLargestGlow), 0.0);
  heat.air_glow = to_factor16(glow);
  if (glow > 0 && std::abs(heat.air_glow / (65536 * glow) - 1) > 0.02)
    warnings.push_back(fmt::format("heat.air.glow = {} is taken as {:.3g}, in whole numbers of 1/65536", glow,
                                   heat.air_glow / 65536.0));
  heat.air_sky = to_temperature(reader.number("sky", fraction(), 0.0));
}

// The air meets the surface of a cell, and its heat is that of its centre. So the exchange and half a cell
// lie one behind the other, unless nothing conducts: then a cell has one temperature.
void read_air(Reader& reader, rule::Heat& heat, int ny, std::vector<std::string>& warnings) {
  heat.air = true;
  read_glow(reader, heat, warnings);
  if (heat.air_glow > 0 && !reader.has("exchange")) return read_air_temperature(reader, heat, ny, 0.0);
  const double given = reader.number("exchange", at_least(kSmallestExchange).at_most(kLargestExchange));
  const double half = half_cell(heat.weight_face, heat.weight_edge, heat.weight_corner),
               exchange = behind_half_cell(given, half);
  heat.air_exchange = to_factor16(exchange);
  const double taken = heat.air_exchange / 65536.0;
  if (std::abs(taken / exchange - 1) > 0.02)
    warnings.push_back(fmt::format("heat.air.exchange = {} is taken as {:.3g}, in whole numbers of 1/65536",
                                   given, half > 0 ? taken / std::max(1e-9, 1 - taken / half) : taken));
  read_air_temperature(reader, heat, ny);
}

int read_rays(Reader& reader) {
  const int asked = reader.integer("rays_per_face", 1, 16, 1);
  if (asked != 1 && asked != 4 && asked != 16)
    reader.fail("rays_per_face", fmt::format(" = {} is not one of 1, 4, 16", asked));
  return asked;
}

// Reads a key of a source, as far as its kind has the numbers.
rule::SourceKey read_source_key(Reader& reader, const rule::SourceKindRow& kind, std::uint32_t step) {
  rule::SourceKey key{.step = step};
  if (kind.at) key.at = to_position(reader.vector<3>("at", coordinate()));
  if (kind.radius) key.radius = to_position(reader.number("radius", at_most(kLargestRadius)));
  if (kind.direction) {
    const std::array<double, 3> direction = reader.vector<3>("direction", within(kLargestDirection));
    if (std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])}) == 0)
      reader.fail("direction", " has no length");
    key.direction = to_direction(direction);
  }
  key.power = to_power(reader.number("power", power()));
  return key;
}

rule::HeatSource read_source(Reader& reader) {
  std::vector<std::string> kinds;
  kinds.reserve(rule::kSourceKinds.size());
  for (const rule::SourceKindRow& row : rule::kSourceKinds) kinds.emplace_back(row.name);
  const rule::SourceKindRow& kind = rule::kSourceKinds[reader.choice("kind", kinds, 0)];
  rule::HeatSource source{.keys = {}, .kind = kind.kind};
  if (!reader.has("keyframes")) {
    source.keys.push_back(read_source_key(reader, kind, 0));
  } else {
    for (const char* key : {"at", "radius", "direction", "power"})
      if (reader.has(key))
        reader.fail("keyframes", fmt::format(" excludes {}: each keyframe has its own", key));
    std::vector<Reader> frames = reader.tables("keyframes");
    if (frames.empty()) reader.fail("keyframes", " is empty");
    for (Reader& frame : frames) {
      const std::uint32_t step = frame.integer("step", 0, kLastStep);
      if (!source.keys.empty() && step <= source.keys.back().step)
        frame.fail("step",
                   fmt::format(" = {} must be after the keyframe before, {}", step, source.keys.back().step));
      source.keys.push_back(read_source_key(frame, kind, step));
      frame.finish();
    }
  }
  reader.finish();
  return source;
}

}  // namespace

std::vector<rule::HeatSource> read_heat_sources(Reader& root) {
  std::vector<rule::HeatSource> sources;
  for (Reader& source : root.tables("heat_source")) sources.push_back(read_source(source));
  return sources;
}

rule::Heat read_heat(Reader& root, int ny, std::vector<std::string>& warnings) {
  rule::Heat heat;
  std::optional<Reader> reader = root.table("heat");
  if (!reader) {
    const std::vector<Reader> sources = root.tables("heat_source");
    if (!sources.empty())
      fail_at(sources.front().place(), "heat_source needs a [heat] table: without it nothing is heated");
    return heat;
  }
  heat.enabled = true;
  read_conduction(*reader, heat, warnings);
  heat.convection = static_cast<std::uint16_t>(
      std::min<long>(32767, std::lround(reader->number("convection", at_most(0.5), 0.0) * 65536)));
  heat.visibility_every = reader->integer<std::uint32_t>("visibility_every", 1, 1024, 1);
  heat.rays_per_face = read_rays(*reader);
  if (std::optional<Reader> air = reader->table("air")) read_air(*air, heat, ny, warnings);
  reader->finish();

  heat.sources = read_heat_sources(root);
  heat.radiation = !heat.sources.empty();
  return heat;
}

}  // namespace voxmelt::scene
